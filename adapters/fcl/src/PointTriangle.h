// SPDX-License-Identifier: MIT
#pragma once

#include "ExactPart.h"

namespace allpairs::exact {

/// Whether three corners span a plane, and not only a segment or a point: of what is narrower the normal is mostly
/// rounding.
[[nodiscard]] bool hasArea(const Corners& corners);

/// The point of a triangle that is nearest to a point; the triangle may be a segment or a point.
[[nodiscard]] Point nearestPoint(const Corners& corners, const Point& point);

}  // namespace allpairs::exact
