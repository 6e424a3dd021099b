// SPDX-License-Identifier: MIT
#include "Inside.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "Orientation.h"
#include "allpairs/Overlaps.h"

namespace allpairs::exact {
namespace {

/// On which side of the line through two points, seen along x, a third one lies: 1 or -1, 0 only if the two coincide
/// there. A point on the line counts as one that y, and then z, have moved by a trifle.
int side(const Point& from, const Point& to, const Point& point) {
  if (const int plain = sideOfLine(from, to, point); plain != 0) return plain;
  if (from.z() != to.z()) return from.z() < to.z() ? -1 : 1;
  if (from.y() != to.y()) return from.y() < to.y() ? 1 : -1;
  return 0;
}

/// 1 or -1 if the ray from the point along x passes the triangle, by the side on which the triangle shows.
int crossing(const Corners& corners, const Point& point) {
  const int way = side(corners[1], corners[2], point);
  if (way == 0 || side(corners[2], corners[0], point) != way || side(corners[0], corners[1], point) != way) return 0;
  return sideOfPlane(corners, point) == -way ? way : 0;  // else the triangle lies behind the point, or holds it
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
  for (const std::uint32_t i : part.shell()) {
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
