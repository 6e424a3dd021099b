// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "allpairs/Box.h"
#include "allpairs/Span.h"

namespace allpairs {

/// Where one corner (min or max) of each box lies in memory: coordinate `axis` of box `i` is
/// data[i * boxStride + axis * axisStride]. Strides count elements and may be negative.
template <class T>
struct CornerView {
  const T* data = nullptr;
  std::ptrdiff_t boxStride = 3;
  std::ptrdiff_t axisStride = 1;
};

/// A validated view of n boxes in the caller's memory, float32 or float64, in any strided layout.
///
/// Nothing is copied: the memory must outlive the view and stay unchanged while it is in use. Constructing a view from
/// a temporary container does not compile: give the container a name.
/// Geometry:  boxes are closed; min > max on an axis means empty; infinite bounds are allowed.
/// Bad input: a NaN throws InvalidBox, which names the box; more than 2^32 - 1 boxes or a span of the wrong length
///            throw InvalidArgument.
/// Cost:      one pass over the boxes to check them, no allocation.
/// Threads:   const use from any number of threads.
class BoxView {
 public:
  /// No boxes.
  BoxView() = default;

  /// From any array of boxes: std::vector, std::array, std::span, of Box or BoxF.
  template <class Boxes, std::enable_if_t<std::is_convertible_v<const Boxes&, Span<const Box>>, int> = 0>
  BoxView(const Boxes& boxes) : BoxView(fromBoxes(boxes)) {}  // NOLINT(google-explicit-constructor): a view of the same
  template <class Boxes, std::enable_if_t<std::is_convertible_v<const Boxes&, Span<const BoxF>>, bool> = true>
  BoxView(const Boxes& boxes) : BoxView(fromBoxes(boxes)) {}  // NOLINT(google-explicit-constructor): a view of the same

  /// A temporary that owns its boxes would be destroyed before the view is used.
  template <class Boxes,
            std::enable_if_t<!internal::kIsBorrowed<Boxes> && (std::is_convertible_v<const Boxes&, Span<const Box>> ||
                                                               std::is_convertible_v<const Boxes&, Span<const BoxF>>),
                             int> = 0>
  BoxView(const Boxes&& boxes) = delete;

  [[nodiscard]] static BoxView fromBoxes(Span<const Box> boxes);
  [[nodiscard]] static BoxView fromBoxes(Span<const BoxF> boxes);

  /// From rows of 6: minx miny minz maxx maxy maxz, n rows one after the other.
  [[nodiscard]] static BoxView fromRows(Span<const float> rows);
  [[nodiscard]] static BoxView fromRows(Span<const double> rows);

  /// From two arrays of n rows of 3: all min corners, all max corners.
  [[nodiscard]] static BoxView fromCorners(Span<const float> min, Span<const float> max);
  [[nodiscard]] static BoxView fromCorners(Span<const double> min, Span<const double> max);

  /// From corners in any strided layout, such as columns of a larger table or six separate arrays one after the other.
  ///
  /// Bad input: a null pointer throws InvalidArgument if there are boxes.
  [[nodiscard]] static BoxView fromStrided(std::size_t size, CornerView<float> min, CornerView<float> max);
  [[nodiscard]] static BoxView fromStrided(std::size_t size, CornerView<double> min, CornerView<double> max);

  /// Gives every box the same margin: how far it extends beyond its bounds, on all sides. Replaces margins of their
  /// own, for good.
  ///
  /// Bad input: NaN or -infinity throws InvalidArgument.
  void setMargin(double margin);

  /// Gives each box its own margin, in place of that of setMargin(); an empty span removes them, and that one holds
  /// again. The memory stays the caller's.
  ///
  /// Bad input: a span of the wrong length throws InvalidArgument; a NaN or -infinity throws InvalidBox.
  void setMargins(Span<const double> margins);

  /// The boxes [begin, end) as a view, with their margins. Constant time: they have been validated.
  ///
  /// Bad input: a range that is not within the view throws InvalidArgument.
  [[nodiscard]] BoxView slice(std::size_t begin, std::size_t end) const;

  [[nodiscard]] std::size_t size() const noexcept { return m_size; }
  [[nodiscard]] bool empty() const noexcept { return m_size == 0; }

  /// Whether the bounds are stored as float64; otherwise they are float32.
  [[nodiscard]] bool isFloat64() const noexcept { return m_isFloat64; }

  /// Whether any box has a margin other than 0; of a slice, any of the view that it is part of.
  [[nodiscard]] bool hasMargins() const noexcept { return m_leastMargin != 0.0 || m_greatestMargin != 0.0; }

  /// Box i in double, which holds float32 exactly, without its margin.
  [[nodiscard]] Box operator[](std::size_t i) const noexcept {
    return m_isFloat64 ? at(m_float64, i) : at(m_float32, i);
  }

  /// Bounds of all margins; of a slice, those of the view that it is part of.
  [[nodiscard]] double leastMargin() const noexcept { return m_leastMargin; }
  [[nodiscard]] double greatestMargin() const noexcept { return m_greatestMargin; }

  /// The margin of box i.
  [[nodiscard]] double margin(std::size_t i) const noexcept { return m_margins.empty() ? m_margin : m_margins[i]; }

  /// The corners in memory; only the pair of the type that isFloat64() states is set.
  template <class T>
  struct Corners {
    CornerView<T> min;
    CornerView<T> max;

    /// Whether the boxes lie as rows of 6, one after the other.
    [[nodiscard]] bool isPacked() const noexcept {
      return min.boxStride == 6 && max.boxStride == 6 && min.axisStride == 1 && max.axisStride == 1 &&
             min.data != nullptr && max.data == min.data + 3;
    }
  };
  [[nodiscard]] const Corners<float>& float32() const noexcept { return m_float32; }
  [[nodiscard]] const Corners<double>& float64() const noexcept { return m_float64; }

 private:
  /// Boxes whose coordinates of a corner follow each other.
  template <class T>
  static BoxView ofCorners(std::size_t size, const T* min, const T* max, std::ptrdiff_t boxStride);

  template <class T>
  static Box at(const Corners<T>& corners, std::size_t i) noexcept {
    Box box;
    const auto row = static_cast<std::ptrdiff_t>(i);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::ptrdiff_t>(axis);
      box.min[axis] = static_cast<double>(corners.min.data[row * corners.min.boxStride + a * corners.min.axisStride]);
      box.max[axis] = static_cast<double>(corners.max.data[row * corners.max.boxStride + a * corners.max.axisStride]);
    }
    return box;
  }

  std::size_t m_size = 0;
  bool m_isFloat64 = false;
  Corners<float> m_float32;
  Corners<double> m_float64;
  double m_margin = 0.0;
  Span<const double> m_margins;
  double m_leastMargin = 0.0;
  double m_greatestMargin = 0.0;
};

}  // namespace allpairs
