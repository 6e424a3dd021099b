// SPDX-License-Identifier: MIT
#include "Inside.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "allpairs/Overlaps.h"

namespace allpairs::exact {
namespace {

/// On which side of the line through two points, seen along x, a third one lies. Never 0 unless the two coincide there,
/// and of opposite signs for the two directions of an edge, rounding included.
double side(const Point& from, const Point& to, const Point& point) {
  const bool isTurned = to.y() < from.y() || (to.y() == from.y() && to.z() < from.z());
  const Point& a = isTurned ? to : from;
  const Point& b = isTurned ? from : to;
  constexpr double kTrifle = std::numeric_limits<double>::denorm_min();
  double value = (b.y() - a.y()) * (point.z() - a.z()) - (b.z() - a.z()) * (point.y() - a.y());
  if (value == 0.0 && a.z() != b.z()) value = a.z() < b.z() ? -kTrifle : kTrifle;  // as y grows by a trifle
  if (value == 0.0 && a.y() != b.y()) value = kTrifle;                             // as z grows by a smaller one
  return isTurned ? -value : value;
}

/// 1 or -1 if the ray from the point passes the triangle, by the side on which the triangle shows.
int crossing(const Corners& corners, const Point& point) {
  const std::array<double, 3> sides{side(corners[1], corners[2], point), side(corners[2], corners[0], point),
                                    side(corners[0], corners[1], point)};
  const bool isLeft = sides[0] > 0.0 && sides[1] > 0.0 && sides[2] > 0.0;
  const bool isRight = sides[0] < 0.0 && sides[1] < 0.0 && sides[2] < 0.0;
  if (!isLeft && !isRight) return 0;
  const double x = (sides[0] * corners[0].x() + sides[1] * corners[1].x() + sides[2] * corners[2].x()) /
                   (sides[0] + sides[1] + sides[2]);
  if (x <= point.x()) return 0;
  return isLeft ? 1 : -1;
}

Box rayFrom(const Point& point) {
  const collision::Vec3 origin = toVec3(point);
  return {origin, {std::numeric_limits<double>::infinity(), origin[1], origin[2]}};
}

/// The boxes of triangles that some ray may pass, and which triangles they are.
struct Targets {
  std::vector<Box> boxes;
  std::vector<std::uint32_t> triangles;
};

Targets targetsOf(const ExactPart& part, const std::vector<Box>& rays) {
  Box all = kEmptyBox;
  for (const Box& ray : rays) all = merge(all, ray);
  Targets targets;
  for (std::uint32_t i = 0; i < part.triangleBoxes().size(); ++i) {
    if (!overlap(all, part.triangleBoxes()[i])) continue;
    targets.boxes.push_back(part.triangleBoxes()[i]);
    targets.triangles.push_back(i);
  }
  return targets;
}

}  // namespace

std::vector<Point> pointsInside(const ExactPart& part, std::span<const Point> points) {
  if (part.volume() == Volume::None || points.empty()) return {};
  std::vector<Box> rays;
  rays.reserve(points.size());
  for (const Point& point : points) rays.push_back(rayFrom(point));
  const Targets targets = targetsOf(part, rays);

  std::vector<int> crossings(points.size(), 0);
  OverlapSearch search;
  for (const Pair& pair : search.find(std::span<const Box>(rays), std::span<const Box>(targets.boxes))) {
    const int found = crossing(part.triangles()[targets.triangles[pair.second]], points[pair.first]);
    crossings[pair.first] += part.volume() == Volume::Parity ? std::abs(found) : found;
  }
  std::vector<Point> inside;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool isIn = part.volume() == Volume::Parity ? crossings[i] % 2 != 0 : crossings[i] != 0;
    if (isIn) inside.push_back(points[i]);
  }
  return inside;
}

}  // namespace allpairs::exact
