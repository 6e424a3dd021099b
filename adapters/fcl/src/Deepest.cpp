// SPDX-License-Identifier: MIT
#include "Deepest.h"

#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>

#include "Inside.h"
#include "Polygon.h"

namespace allpairs::exact {
namespace {

Box common(const Box& a, const Box& b) {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::max(a.min[axis], b.min[axis]);
    box.max[axis] = std::min(a.max[axis], b.max[axis]);
  }
  return box;
}

/// The corners, the middles of the sides and the middle of all.
void addPointsOf(const Polygon& polygon, std::vector<Point>& points) {
  const auto corners = polygon.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points.push_back(corners[i]);
    points.push_back((corners[i] + corners[(i + 1) % corners.size()]) / 2.0);
  }
  points.push_back(polygon.middle());
}

/// The points worth asking, each once.
std::vector<Point> samples(const ExactPart& outer, const ExactPart& inner, const std::vector<TrianglePair>& pairs) {
  std::vector<Point> points;
  const Box shared = common(outer.box(), inner.box());
  for (std::size_t i = 0; i < inner.triangles().size(); ++i) {
    if (!overlap(shared, inner.triangleBoxes()[i])) continue;
    Polygon polygon(inner.triangles()[i]);
    polygon.cut(shared);
    if (polygon.empty()) continue;
    addPointsOf(polygon, points);
  }
  for (const TrianglePair& pair : pairs) {
    Polygon polygon(inner.triangles()[pair.first]);
    polygon.cut(outer.triangleBoxes()[pair.second]);
    if (!polygon.empty()) points.push_back(polygon.middle());
  }
  const auto isBefore = [](const Point& a, const Point& b) { return toVec3(a) < toVec3(b); };
  std::sort(points.begin(), points.end(), isBefore);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// How deep a point can lie at most: a surface is no further than the side of the box around it.
double deepestPossible(const Box& box, const Point& point) {
  double depth = box.max[0] - box.min[0];
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    depth = std::min({depth, point[axis] - box.min[a], box.max[a] - point[axis]});
  }
  return depth;
}

/// Replaces `deepest` if the point is deeper.
void consider(const ExactPart& outer, const Point& point, Deepest& deepest) {
  if (deepest.found && deepestPossible(outer.box(), point) <= deepest.depth) return;
  const ::fcl::Sphered ball(0.0);
  ::fcl::Transform3d pose = ::fcl::Transform3d::Identity();
  pose.translation() = point;
  const ::fcl::DistanceRequestd request(true);
  ::fcl::DistanceResultd result;
  const double distance =
      ::fcl::distance(&outer.hierarchy(), ::fcl::Transform3d::Identity(), &ball, pose, request, result);
  const bool isOnSurface = distance <= 0.0;
  if (deepest.found && distance <= deepest.depth) return;
  deepest = {.found = true,
             .depth = isOnSurface ? 0.0 : distance,
             .point = point,
             .surface = isOnSurface ? point : Point(result.nearest_points[0])};
}

}  // namespace

Deepest deepestWithin(const ExactPart& outer, const ExactPart& inner, const std::vector<TrianglePair>& innerAndOuter) {
  Deepest deepest;
  if (outer.volume() == Volume::None) return deepest;
  for (const Point& point : pointsInside(outer, samples(outer, inner, innerAndOuter))) consider(outer, point, deepest);
  return deepest;
}

}  // namespace allpairs::exact
