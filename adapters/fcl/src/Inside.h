// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "ExactPart.h"

namespace allpairs::exact {

/// Those of the points that lie in the volume of a part, in their order. A point on the surface may be either.
///
/// Reference: a ray towards +x and the triangles that it passes, with the point moved by a symbolic trifle in y and
///            a smaller one in z, so that no ray meets an edge (simulation of simplicity, Edelsbrunner and Mücke 1990).
[[nodiscard]] std::vector<Point> pointsInside(const ExactPart& part, std::span<const Point> points);

/// The same of one point, of a part that has a volume.
[[nodiscard]] bool isInside(const ExactPart& part, const Point& point);

}  // namespace allpairs::exact
