// SPDX-License-Identifier: MIT
// Queries as the kernels take them: in float32, and never asking for less than the query in double does.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "LaneReader.h"
#include "Lanes.h"
#include "allpairs/Box.h"
#include "allpairs/WorldTypes.h"

namespace allpairs::engine {

/// What is added to, or taken from, a result in float32 so that it bounds the same in double: far more than the four
/// roundings of it can come to, and than what may get lost below the least normal number.
inline constexpr float kQuerySlack = 0x1p-20F;
inline constexpr float kQueryTiny = 1e-36F;

/// The least float32 that is no less, infinity included.
[[nodiscard]] inline float roundUpFar(double value) noexcept {
  return value > static_cast<double>(kLaneMax) ? kNever : roundUp(value);
}

/// A box that moves, or a ray, against sixteen boxes.
struct SweepLanes {
  enum class Axis : std::uint8_t {
    Rests,      ///< The boxes must overlap on this axis.
    Forward,    ///< The query moves to greater values,
    Backward,   ///< or to smaller ones.
    Unbounded,  ///< So fast or slow that float32 can't say: whatever is met on the other axes may be met.
  };

  std::array<float, 3> min;
  std::array<float, 3> max;
  std::array<float, 3> inverse{};  ///< Of the speed.
  std::array<Axis, 3> axis{};
};

[[nodiscard]] inline SweepLanes lanesOf(const BoxSweep& sweep) noexcept {
  constexpr double kMost = 1e30;
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

/// A point between two float32 on each axis.
struct PointLanes {
  std::array<float, 3> below;
  std::array<float, 3> above;
};

[[nodiscard]] inline PointLanes lanesOf(const std::array<double, 3>& point) noexcept {
  PointLanes lanes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lanes.below[axis] = -roundUpFar(-point[axis]);
    lanes.above[axis] = roundUpFar(point[axis]);
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

}  // namespace allpairs::engine
