// SPDX-License-Identifier: MIT
// What decides the answer of a query.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "allpairs/Box.h"
#include "allpairs/WorldTypes.h"

namespace allpairs::engine {

inline constexpr double kFar = std::numeric_limits<double>::infinity();

/// A box with its margin added, in double.
[[nodiscard]] inline Box widened(const Box& box, double margin) noexcept {
  Box result = box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.min[axis] -= margin;
    result.max[axis] += margin;
  }
  return result;
}

/// The least t at which a moving box meets a resting one, infinity if it doesn't; bounds may be turned over by a margin.
[[nodiscard]] inline double meetingTime(const BoxSweep& sweep, const Box& box) noexcept {
  double enter = 0.0;
  double leave = sweep.length;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double v = sweep.motion[axis];
    const double ahead = box.min[axis] - sweep.box.max[axis];
    const double behind = box.max[axis] - sweep.box.min[axis];
    if (v == 0.0) {
      if (ahead > 0.0 || behind < 0.0) return kFar;
      continue;
    }
    const double in = (v > 0.0 ? ahead : behind) / v;
    const double out = (v > 0.0 ? behind : ahead) / v;
    // A NaN, of two infinities, leaves both as they are.
    if (in > enter) enter = in;
    if (out < leave) leave = out;
  }
  if (enter > leave) return kFar;
  return enter;
}

/// The Euclidean distance of a point from a box.
[[nodiscard]] inline double distanceFrom(const std::array<double, 3>& point, const Box& box) noexcept {
  double squares = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double apart = std::max({box.min[axis] - point[axis], point[axis] - box.max[axis], 0.0});
    squares += apart * apart;
  }
  return std::sqrt(squares);
}

[[nodiscard]] inline BoxSweep sweepOf(const Ray& ray) noexcept {
  return {{ray.origin, ray.origin}, ray.direction, ray.length};
}

}  // namespace allpairs::engine
