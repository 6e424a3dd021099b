// SPDX-License-Identifier: MIT
#pragma once

#include "ExactPart.h"

namespace allpairs::exact {

/// The point of a triangle that is nearest to a point; the triangle may be a segment or a point.
[[nodiscard]] Point nearestPoint(const Corners& corners, const Point& point);

}  // namespace allpairs::exact
