// SPDX-License-Identifier: MIT
// The exact tests of queries.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "allpairs/Box.h"
#include "allpairs/WorldTypes.h"
#include "kernels/Lanes.h"

namespace allpairs::engine {

/// The time and the distance of what is never reached.
inline constexpr double kFar = std::numeric_limits<double>::infinity();

/// A box enlarged by its margin, in double. With an infinite margin it covers all of space, wherever the box is.
[[nodiscard]] inline Box widened(const Box& box, double margin) noexcept {
  if (margin == kFar) return {{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}};
  Box result = box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.min[axis] -= margin;
    result.max[axis] += margin;
  }
  return result;
}

/// The smallest t at which a swept box hits a resting one, or infinity; a margin may have inverted the bounds.
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
    // A NaN, from two infinities, changes neither.
    if (in > enter) enter = in;
    if (out < leave) leave = out;
  }
  if (enter > leave) return kFar;
  return enter;
}

/// The length of a vector whose components are not negative.
[[nodiscard]] inline double lengthOf(const std::array<double, 3>& vector) noexcept {
  const auto scaled = [&](double scale) {
    double squares = 0.0;
    for (const double component : vector) squares += (component * scale) * (component * scale);
    return squares;
  };
  constexpr double kLarge = 0x1p600;  // Its square overflows.
  const double squares = scaled(1.0);
  // Outside this range squares underflow or overflow; scaling by a power of two is exact.
  if (squares == kFar) return std::sqrt(scaled(1.0 / kLarge)) * kLarge;
  if (squares < 0x1p-960) return std::sqrt(scaled(kLarge)) / kLarge;
  return std::sqrt(squares);
}

/// The Euclidean distance between two boxes; a margin may have inverted the bounds of the second one.
[[nodiscard]] inline double distanceBetween(const Box& a, const Box& b) noexcept {
  std::array<double, 3> apart;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // The zero comes first: so a NaN, the difference of two infinities, is none.
    apart[axis] = std::max({0.0, b.min[axis] - a.max[axis], a.min[axis] - b.max[axis]});
  }
  return lengthOf(apart);
}

[[nodiscard]] inline BoxSweep sweepOf(const Ray& ray) noexcept {
  return {{ray.origin, ray.origin}, ray.direction, ray.length};
}
[[nodiscard]] inline const BoxSweep& sweepOf(const BoxSweep& sweep) noexcept { return sweep; }

// Queries for the kernels: in float32, and conservative, so that they find all that the query in double does.

/// The smallest float32 that is not less, infinity included.
[[nodiscard]] inline float roundUpFar(double value) noexcept {
  return value > static_cast<double>(kLaneMax) ? kNever : roundUp(value);
}

[[nodiscard]] inline SweepLanes lanesOf(const BoxSweep& sweep) noexcept {
  constexpr double kMost = 1e30;  // Above, and below its inverse, products in float32 overflow or underflow.
  SweepLanes lanes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lanes.min[axis] = -roundUpFar(-sweep.box.min[axis]);
    lanes.max[axis] = roundUpFar(sweep.box.max[axis]);
    const double speed = std::abs(sweep.motion[axis]);
    if (speed == 0.0) {
      lanes.axis[axis] = SweepLanes::Axis::Rests;
    } else if (speed > kMost || speed < 1.0 / kMost) {
      lanes.axis[axis] = SweepLanes::Axis::Unbounded;
    } else {
      lanes.axis[axis] = sweep.motion[axis] > 0.0 ? SweepLanes::Axis::Forward : SweepLanes::Axis::Backward;
      lanes.inverse[axis] = static_cast<float>(1.0 / speed);
    }
  }
  return lanes;
}

[[nodiscard]] inline LaneBox lanesOf(const Box& box) noexcept {
  LaneBox lanes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lanes.bound[axis] = roundDown(box.min[axis]);
    lanes.bound[axis + 3] = roundUp(box.max[axis]);
  }
  return lanes;
}

[[nodiscard]] inline Box boxOf(const LaneBox& lanes) noexcept {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = static_cast<double>(lanes.bound[axis]);
    box.max[axis] = static_cast<double>(lanes.bound[axis + 3]);
  }
  return box;
}

}  // namespace allpairs::engine
