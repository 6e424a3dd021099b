// SPDX-License-Identifier: MIT
#include "PointTriangle.h"

#include <algorithm>

namespace allpairs::exact {
namespace {

constexpr double kNarrowest = 1e-11;  // of a narrower one the normal is rounding
constexpr double kNarrow = 1e-5;      // and of one like this the point below another is off by some of its width

Point nearestOnSegment(const Point& from, const Point& to, const Point& point) {
  const Point way = to - from;
  const double squared = way.squaredNorm();
  const double t = squared > 0.0 ? std::clamp(way.dot(point - from) / squared, 0.0, 1.0) : 0.0;
  return from + t * way;
}

/// Twice the area by the square of the longest side: about width by length.
double widthOf(const Corners& corners) {
  const auto& [a, b, c] = corners;
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return longest > 0.0 ? normalOf(corners).norm() / longest : 0.0;
}

}  // namespace

bool hasArea(const Corners& corners) { return widthOf(corners) > kNarrowest; }

Point nearestPoint(const Corners& corners, const Point& point) {
  const auto& [a, b, c] = corners;
  const Point normal = normalOf(corners);
  const auto isInside = [&](const Point& from, const Point& to) {
    return normal.dot((to - from).cross(point - from)) >= 0.0;
  };
  const double width = widthOf(corners);
  const bool isOver = width > kNarrowest && isInside(a, b) && isInside(b, c) && isInside(c, a);
  Point below = isOver ? Point(point - normal * (normal.dot(point - a) / normal.squaredNorm())) : a;
  if (isOver && width > kNarrow) return below;
  const std::array<Point, 4> candidates{nearestOnSegment(a, b, point), nearestOnSegment(b, c, point),
                                        nearestOnSegment(c, a, point), below};
  return *std::min_element(candidates.begin(), candidates.end(), [&](const Point& p, const Point& q) {
    return (p - point).squaredNorm() < (q - point).squaredNorm();
  });
}

}  // namespace allpairs::exact
