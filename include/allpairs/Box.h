// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "allpairs/DebugMode.h"

namespace allpairs {

/// An axis-aligned box: the closed set of points p with min[a] <= p[a] <= max[a] on each axis a.
///
/// Geometry:  min > max on some axis means empty; infinite bounds are allowed; units and frame are the caller's.
/// Bad input: functions that take a box reject a NaN; this class does not.
template <class T>
struct BasicBox {
  std::array<T, 3> min{};
  std::array<T, 3> max{};

  friend constexpr bool operator==(const BasicBox& a, const BasicBox& b) {
    return a.min[0] == b.min[0] && a.min[1] == b.min[1] &&
           a.min[2] == b.min[2] &&  // == of arrays is constexpr in C++20 only
           a.max[0] == b.max[0] && a.max[1] == b.max[1] && a.max[2] == b.max[2];
  }
  friend constexpr bool operator!=(const BasicBox& a, const BasicBox& b) { return !(a == b); }
};

using Box = BasicBox<double>;
using BoxF = BasicBox<float>;

/// The box that holds nothing, and leaves any other unchanged when merged with it.
inline constexpr Box kEmptyBox{{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::infinity()},
                               {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity()}};

/// Whether the box holds no point: min > max on some axis.
template <class T>
[[nodiscard]] constexpr bool isEmpty(const BasicBox<T>& box) noexcept {
  return box.min[0] > box.max[0] || box.min[1] > box.max[1] || box.min[2] > box.max[2];
}

/// Whether any of the six bounds is a NaN.
template <class T>
[[nodiscard]] constexpr bool hasNan(const BasicBox<T>& box) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (box.min[axis] != box.min[axis] || box.max[axis] != box.max[axis]) return true;
  }
  return false;
}

/// Whether a number can be a distance or a margin: it is no NaN, and not -infinity.
[[nodiscard]] constexpr bool isDistance(double value) noexcept {
  return value > -std::numeric_limits<double>::infinity();
}

/// Whether two boxes are at most `distance` apart on every axis; with distance 0, whether they overlap.
///
/// Geometry:  closed, per axis and not Euclidean, in double: apart if min1 > max2 + d or min2 > max1 + d on some axis,
///            the sum rounded as written. A negative distance requires that much overlap. An empty box overlaps
///            nothing.
[[nodiscard]] constexpr bool overlap(const Box& a, const Box& b, double distance = 0.0) noexcept {
  if (isEmpty(a) || isEmpty(b)) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a.min[axis] > b.max[axis] + distance || b.min[axis] > a.max[axis] + distance) return false;
  }
  return true;
}

/// The smallest box that holds both; an empty box adds nothing.
[[nodiscard]] constexpr Box merge(const Box& a, const Box& b) noexcept {
  if (isEmpty(a)) return b;
  if (isEmpty(b)) return a;
  Box result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.min[axis] = b.min[axis] < a.min[axis] ? b.min[axis] : a.min[axis];
    result.max[axis] = a.max[axis] < b.max[axis] ? b.max[axis] : a.max[axis];
  }
  return result;
}

}  // namespace allpairs
