// SPDX-License-Identifier: MIT
#include "PointTriangle.h"

#include <algorithm>

namespace allpairs::exact {
namespace {

constexpr double kNarrowest = 1e-11;  // width by length

Point nearestOnSegment(const Point& from, const Point& to, const Point& point) {
  const Point way = to - from;
  const double squared = way.squaredNorm();
  const double t = squared > 0.0 ? std::clamp(way.dot(point - from) / squared, 0.0, 1.0) : 0.0;
  return from + t * way;
}

}  // namespace

bool hasArea(const Corners& corners) {
  const auto& [a, b, c] = corners;
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() > kNarrowest * longest;
}

Point nearestPoint(const Corners& corners, const Point& point) {
  const auto& [a, b, c] = corners;
  const Point normal = (b - a).cross(c - a);
  const auto isInside = [&](const Point& from, const Point& to) {
    return normal.dot((to - from).cross(point - from)) >= 0.0;
  };
  if (hasArea(corners) && isInside(a, b) && isInside(b, c) && isInside(c, a)) {
    return point - normal * (normal.dot(point - a) / normal.squaredNorm());
  }
  const std::array<Point, 3> candidates{nearestOnSegment(a, b, point), nearestOnSegment(b, c, point),
                                        nearestOnSegment(c, a, point)};
  return *std::min_element(candidates.begin(), candidates.end(), [&](const Point& p, const Point& q) {
    return (p - point).squaredNorm() < (q - point).squaredNorm();
  });
}

}  // namespace allpairs::exact
