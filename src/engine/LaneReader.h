// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "Lanes.h"
#include "allpairs/Box.h"
#include "allpairs/BoxSet.h"
#include "allpairs/OverlapOptions.h"

namespace allpairs::engine {

/// The greatest float32 that is not above the value, kept within the finite ones; the lowest for a NaN. No branches.
[[nodiscard]] inline float roundDown(double value) noexcept {
  constexpr auto kMax = static_cast<double>(kLaneMax);
  const double above = value > -kMax ? value : -kMax;
  const double inside = above < kMax ? above : kMax;
  const auto nearest = static_cast<float>(inside);
  // One float32 further down is one less for a positive number's bits and one more for a negative one's. Zero never has
  // to go down: a negative value that is rounded to zero becomes -0.
  const auto bits = std::bit_cast<std::int32_t>(nearest);
  const std::int32_t step = -1 - 2 * (bits >> 31);
  const std::int32_t isAbove = -static_cast<std::int32_t>(static_cast<double>(nearest) > inside);
  return std::bit_cast<float>(bits + (step & isAbove));
}

/// The least float32 that is not below the value, kept within the finite ones; the greatest for a NaN.
[[nodiscard]] inline float roundUp(double value) noexcept { return -roundDown(-value); }

/// Reads the boxes of a set as float32 lanes that are never smaller than the boxes, with half the distance of the
/// search and the box's own margin added on each side.
///
/// Boxes that can overlap nothing, because they are empty or outside of the region, are told apart.
class LaneReader {
 public:
  LaneReader(const BoxSet& boxes, const OverlapOptions& options)
      : m_boxes(&boxes), m_distance(options.distance), m_region(options.region) {}

  [[nodiscard]] std::size_t size() const noexcept { return m_boxes->size(); }

  /// Calls use(lanesOf) with the functor that reads lanes for this kind of set, so that the choice is made once for
  /// many boxes: `lanesOf(i, lanes)` reads box i and returns whether its lanes are exactly the box,
  /// `lanesOf.isEmpty(i)` says whether it is empty.
  template <class Use>
  auto withLanes(Use&& use) const {
    if (isWidened()) return use(WidenedLanes{*this});
    if (m_boxes->isFloat64()) return use(RoundedLanes{*m_boxes});
    return use(PlainLanes{m_boxes->float32()});
  }

  /// Calls visit(i, lanes) for the boxes i in [begin, end) that may overlap something, and skip(i) for the others.
  ///
  /// Returns whether the lanes of all of them are exactly the boxes, so that no test in double is needed.
  template <class Visit, class Skip>
  bool read(std::size_t begin, std::size_t end, Visit&& visit, Skip&& skip) const {
    return withLanes([&](const auto& lanesOf) {
      bool exact = true;
      LaneBox lanes;
      for (std::size_t i = begin; i < end; ++i) {
        if (lanesOf.isEmpty(i) || (m_region && !touchesRegion(i))) {
          skip(i);
          continue;
        }
        exact &= lanesOf(i, lanes);
        visit(i, lanes);
      }
      return exact;
    });
  }

  /// Where the boxes lie as rows of six that need no more than to be rounded: no margins, no region; else null.
  [[nodiscard]] const float* plainFloat32() const noexcept {
    return isPlain() && !m_boxes->isFloat64() && m_boxes->float32().isPacked() ? m_boxes->float32().min.data : nullptr;
  }
  [[nodiscard]] const double* plainFloat64() const noexcept {
    return isPlain() && m_boxes->isFloat64() && m_boxes->float64().isPacked() ? m_boxes->float64().min.data : nullptr;
  }

  /// Asks for the memory of box i ahead of its use.
  void prefetch(std::size_t i) const noexcept {
    const auto row = static_cast<std::ptrdiff_t>(i);
    if (m_boxes->isFloat64()) {
      __builtin_prefetch(m_boxes->float64().min.data + row * m_boxes->float64().min.boxStride);
      __builtin_prefetch(m_boxes->float64().max.data + row * m_boxes->float64().max.boxStride);
    } else {
      __builtin_prefetch(m_boxes->float32().min.data + row * m_boxes->float32().min.boxStride);
      __builtin_prefetch(m_boxes->float32().max.data + row * m_boxes->float32().max.boxStride + 2);
    }
  }

 private:
  /// float32 boxes without margins: the lanes are the box, but that infinity becomes the largest number.
  struct PlainLanes {
    BoxSet::Corners<float> corners;

    bool operator()(std::size_t i, LaneBox& lanes) const noexcept {
      bool exact = true;
      const auto row = static_cast<std::ptrdiff_t>(i);
      const float* min = corners.min.data + row * corners.min.boxStride;
      const float* max = corners.max.data + row * corners.max.boxStride;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float lo = min[static_cast<std::ptrdiff_t>(axis) * corners.min.axisStride];
        const float hi = max[static_cast<std::ptrdiff_t>(axis) * corners.max.axisStride];
        lanes.bound[axis] = std::clamp(lo, -kLaneMax, kLaneMax);
        lanes.bound[axis + 3] = std::clamp(hi, -kLaneMax, kLaneMax);
        exact &= (lanes.bound[axis] == lo) & (lanes.bound[axis + 3] == hi);
      }
      return exact;
    }
    [[nodiscard]] bool isEmpty(std::size_t i) const noexcept {
      const auto row = static_cast<std::ptrdiff_t>(i);
      const float* min = corners.min.data + row * corners.min.boxStride;
      const float* max = corners.max.data + row * corners.max.boxStride;
      const std::ptrdiff_t a = corners.min.axisStride;
      const std::ptrdiff_t b = corners.max.axisStride;
      return (min[0] > max[0]) | (min[a] > max[b]) | (min[2 * a] > max[2 * b]);
    }
  };

  /// float64 boxes without margins, rounded outward.
  struct RoundedLanes {
    const BoxSet& boxes;

    bool operator()(std::size_t i, LaneBox& lanes) const noexcept {
      const Box box = boxes[i];
      bool exact = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        lanes.bound[axis] = roundDown(box.min[axis]);
        lanes.bound[axis + 3] = roundUp(box.max[axis]);
        exact &= (static_cast<double>(lanes.bound[axis]) == box.min[axis]) &
                 (static_cast<double>(lanes.bound[axis + 3]) == box.max[axis]);
      }
      return exact;
    }
    [[nodiscard]] bool isEmpty(std::size_t i) const noexcept { return allpairs::isEmpty(boxes[i]); }
  };

  /// Boxes with margins or a distance, in double, with a slack that is larger than what all roundings of the exact
  /// expression, max + ((distance + margin) + margin), can add up to.
  struct WidenedLanes {
    const LaneReader& reader;

    bool operator()(std::size_t i, LaneBox& lanes) const noexcept {
      constexpr double kSlack = 0x1p-48;
      const Box box = (*reader.m_boxes)[i];
      const double margin = reader.m_boxes->margin(i);
      const double half = 0.5 * reader.m_distance + margin;
      const double magnitude = 0.5 * std::abs(reader.m_distance) + std::abs(margin);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float low = roundDown(box.min[axis] - half - kSlack * (std::abs(box.min[axis]) + magnitude));
        const float high = roundUp(box.max[axis] + half + kSlack * (std::abs(box.max[axis]) + magnitude));
        // A negative margin may turn a box over, and it can still meet a larger one. Turned back it is no smaller.
        lanes.bound[axis] = std::min(low, high);
        lanes.bound[axis + 3] = std::max(low, high);
      }
      return false;
    }
    [[nodiscard]] bool isEmpty(std::size_t i) const noexcept { return allpairs::isEmpty((*reader.m_boxes)[i]); }
  };

  [[nodiscard]] bool isWidened() const noexcept { return m_distance != 0.0 || m_boxes->hasMargins(); }
  [[nodiscard]] bool isPlain() const noexcept { return !isWidened() && !m_region; }

  [[nodiscard]] bool touchesRegion(std::size_t i) const noexcept {
    return overlap((*m_boxes)[i], *m_region, m_distance + m_boxes->margin(i));
  }

  const BoxSet* m_boxes;
  double m_distance;
  std::optional<Box> m_region;
};

}  // namespace allpairs::engine
