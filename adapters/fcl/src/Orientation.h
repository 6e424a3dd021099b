// SPDX-License-Identifier: MIT
#pragma once

#include "ExactPart.h"

namespace allpairs::exact {

/// Signs of determinants, as if nothing were rounded, unless numbers become too large or too small for a double.
///
/// Source: J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates",
/// Discrete & Computational Geometry 18 (1997), 305-363.

/// Seen along x, on which side of the line from `from` to `to` a point lies: 1 where y turns to z, -1, or 0 on it.
[[nodiscard]] int sideOfLine(const Point& from, const Point& to, const Point& point);

/// On which side of a triangle's plane a point lies: 1 on that from which its corners turn counterclockwise, -1 or 0.
[[nodiscard]] int sideOfPlane(const Corners& corners, const Point& point);

}  // namespace allpairs::exact
