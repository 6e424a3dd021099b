// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "ExactPart.h"

namespace allpairs::exact {

/// Where two triangles meet.
struct TriangleMeeting {
  Point middle = Point::Zero();
  std::array<Point, 2> ends{};  ///< Of the segment that they share; the same point twice where they share no segment.
  /// How far each of them, on either side of the other's plane, reaches at least; 0 if one ends there.
  double crossing = 0.0;
  double passing = 0.0;  ///< Likewise one without an area, a segment, of the other's plane.
};

/// Where two triangles meet, or nothing where rounding leaves no point that both have, or neither has an area.
[[nodiscard]] std::optional<TriangleMeeting> meetingOf(const Corners& a, const Corners& b);

}  // namespace allpairs::exact
