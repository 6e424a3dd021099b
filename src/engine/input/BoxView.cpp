// SPDX-License-Identifier: MIT
#include "allpairs/BoxView.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

#include "allpairs/Error.h"
#include "kernels/Kernels.h"

namespace allpairs {

const char containers::ALLPAIRS_CONTAINERS = 0;
namespace {

void checkCount(std::size_t size) {
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidArgument("a set of " + std::to_string(size) + " boxes; at most 4294967295 can be numbered");
  }
}

template <class T>
std::size_t rowCount(Span<const T> values, std::size_t width) {
  if (values.size() % width != 0) {
    throw InvalidArgument(std::to_string(values.size()) + " values are no whole number of rows of " +
                          std::to_string(width));
  }
  return values.size() / width;
}

template <class T>
std::size_t cornerCount(Span<const T> min, Span<const T> max) {
  const std::size_t size = rowCount(min, 3);
  if (rowCount(max, 3) != size) {
    throw InvalidArgument(std::to_string(size) + " min corners, but " + std::to_string(max.size() / 3) +
                          " max corners");
  }
  return size;
}

/// Whether a corner coordinate of box i is a NaN.
template <class T>
bool hasNanAt(const CornerView<T>& corner, std::ptrdiff_t i) {
  const T* row = corner.data + i * corner.boxStride;
  const T x = row[0];
  const T y = row[corner.axisStride];
  const T z = row[2 * corner.axisStride];
  return (x != x) | (y != y) | (z != z);
}

/// Of a box that has one.
[[noreturn]] void throwNan(std::size_t index, const Box& box) {
  std::size_t k = 0;
  while (!std::isnan(k < 3 ? box.min[k] : box.max[k - 3])) ++k;
  throw InvalidBox::ofSet(index, std::string(k < 3 ? "min " : "max ") + "xyz"[k % 3] + " is not a number (NaN)");
}

/// Up to so many values a loop here takes less time than finding the kernel for this processor (few_benchmark).
constexpr std::size_t kFewValues = 64;

/// Whether any of the values is a NaN.
template <class T>
bool anyNan(const T* values, std::size_t count) {
  if (count > kFewValues) return engine::findKernels({})->plain<T>().anyNan(values, count);
  // A loop that compilers vectorise, with flags as wide as the values.
  std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t> nans = 0;
  for (std::size_t i = 0; i < count; ++i) nans |= values[i] != values[i] ? 1U : 0U;
  return nans != 0;
}

/// The same of one corner of each box.
template <class T>
bool anyNan(std::size_t size, const CornerView<T>& corner) {
  if (corner.boxStride == 3 && corner.axisStride == 1) return anyNan(corner.data, 3 * size);
  if (corner.boxStride == 1) {
    const auto column = [&](std::ptrdiff_t axis) { return anyNan(corner.data + axis * corner.axisStride, size); };
    return column(0) || column(1) || column(2);
  }
  bool found = false;
  for (std::size_t i = 0; i < size; ++i) found |= hasNanAt(corner, static_cast<std::ptrdiff_t>(i));
  return found;
}

template <class T>
[[noreturn]] void throwFirstNan(const BoxView& set, const BoxView::Corners<T>& corners) {
  std::ptrdiff_t i = 0;
  while (!hasNanAt(corners.min, i) && !hasNanAt(corners.max, i)) ++i;
  throwNan(static_cast<std::size_t>(i), set[static_cast<std::size_t>(i)]);
}

/// Of boxes that have one.
[[noreturn]] void throwFirstNan(const BoxView& set) {
  set.isFloat64() ? throwFirstNan(set, set.float64()) : throwFirstNan(set, set.float32());
}

template <class T>
bool anyNan(std::size_t size, const BoxView::Corners<T>& corners) {
  return corners.isPacked() ? anyNan(corners.min.data, 6 * size)
                            : anyNan(size, corners.min) || anyNan(size, corners.max);
}

template <class T>
void checkCorners(std::size_t size, const CornerView<T>& min, const CornerView<T>& max) {
  checkCount(size);
  if (size == 0 || (min.data != nullptr && max.data != nullptr)) return;
  throw InvalidArgument("the corners are not in memory: their data is null");
}

/// Moves the view to start at box `begin`.
template <class T>
void moveTo(BoxView::Corners<T>& corners, std::size_t begin) {
  if (corners.min.data == nullptr) return;
  corners.min.data += static_cast<std::ptrdiff_t>(begin) * corners.min.boxStride;
  corners.max.data += static_cast<std::ptrdiff_t>(begin) * corners.max.boxStride;
}

}  // namespace

/// Written value by value: reading structs of arguments back from the stack would wait for it, which takes longer than
/// checking a box.
template <class T>
BoxView BoxView::ofCorners(std::size_t size, const T* min, const T* max, std::ptrdiff_t boxStride) {
  BoxView set;
  if (size == 0) return set;
  checkCount(size);
  const auto place = [&](Corners<T>& corners) {
    corners.min.data = min;
    corners.max.data = max;
    corners.min.boxStride = corners.max.boxStride = boxStride;
  };
  set.m_size = size;
  if constexpr (std::is_same_v<T, double>) {
    set.m_isFloat64 = true;
    place(set.m_float64);
  } else {
    place(set.m_float32);
  }
  const bool isPacked = boxStride == 6 && max == min + 3;
  const bool found = isPacked ? anyNan(min, 6 * size) : anyNan(min, 3 * size) || anyNan(max, 3 * size);
  if (found) throwFirstNan(set);
  return set;
}

BoxView BoxView::fromBoxes(Span<const Box> boxes) {
  static_assert(sizeof(Box) == 6 * sizeof(double));
  return boxes.empty() ? BoxView() : ofCorners(boxes.size(), boxes.data()->min.data(), boxes.data()->max.data(), 6);
}
BoxView BoxView::fromBoxes(Span<const BoxF> boxes) {
  static_assert(sizeof(BoxF) == 6 * sizeof(float));
  return boxes.empty() ? BoxView() : ofCorners(boxes.size(), boxes.data()->min.data(), boxes.data()->max.data(), 6);
}

BoxView BoxView::fromRows(Span<const float> rows) {
  return rows.empty() ? BoxView() : ofCorners(rowCount(rows, 6), rows.data(), rows.data() + 3, 6);
}
BoxView BoxView::fromRows(Span<const double> rows) {
  return rows.empty() ? BoxView() : ofCorners(rowCount(rows, 6), rows.data(), rows.data() + 3, 6);
}

BoxView BoxView::fromCorners(Span<const float> min, Span<const float> max) {
  return ofCorners(cornerCount(min, max), min.data(), max.data(), 3);
}
BoxView BoxView::fromCorners(Span<const double> min, Span<const double> max) {
  return ofCorners(cornerCount(min, max), min.data(), max.data(), 3);
}

BoxView BoxView::fromStrided(std::size_t size, CornerView<float> min, CornerView<float> max) {
  checkCorners(size, min, max);
  BoxView set;
  if (size == 0) return set;
  set.m_size = size;
  set.m_float32 = {min, max};
  if (anyNan(size, set.m_float32)) throwFirstNan(set);
  return set;
}

BoxView BoxView::fromStrided(std::size_t size, CornerView<double> min, CornerView<double> max) {
  checkCorners(size, min, max);
  BoxView set;
  if (size == 0) return set;
  set.m_size = size;
  set.m_isFloat64 = true;
  set.m_float64 = {min, max};
  if (anyNan(size, set.m_float64)) throwFirstNan(set);
  return set;
}

void BoxView::setMargin(double margin) {
  if (!isDistance(margin)) throw InvalidArgument("the margin of the set is NaN or -infinity");
  m_margin = m_leastMargin = m_greatestMargin = margin;
  m_margins = {};
}

void BoxView::setMargins(Span<const double> margins) {
  if (!margins.empty() && margins.size() != m_size) {
    throw InvalidArgument(std::to_string(margins.size()) + " margins for " + std::to_string(m_size) + " boxes");
  }
  double least = margins.empty() ? m_margin : margins.front();
  double greatest = least;
  for (std::size_t i = 0; i < margins.size(); ++i) {
    if (!isDistance(margins[i])) throw InvalidBox::ofSet(i, "its margin is NaN or -infinity");
    least = std::min(least, margins[i]);
    greatest = std::max(greatest, margins[i]);
  }
  m_margins = margins;
  m_leastMargin = least;
  m_greatestMargin = greatest;
}

BoxView BoxView::slice(std::size_t begin, std::size_t end) const {
  if (begin > end || end > m_size) {
    throw InvalidArgument("boxes " + std::to_string(begin) + " to " + std::to_string(end) + " of a set of " +
                          std::to_string(m_size));
  }
  BoxView part = *this;
  part.m_size = end - begin;
  moveTo(part.m_float32, begin);
  moveTo(part.m_float64, begin);
  if (!m_margins.empty()) part.m_margins = m_margins.subspan(begin, end - begin);
  return part;
}

}  // namespace allpairs
