// SPDX-License-Identifier: MIT
#include "Enclosure.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "Inside.h"
#include "Nearest.h"
#include "PointTriangle.h"

namespace allpairs::exact {
namespace {

/// From a point to the surface of a part that is not thick.
double distanceTo(const ExactPart& part, const Point& point) { return nearest(part, point).distance; }

/// The corners of the triangles, the middles of their sides and their own, each once.
std::vector<Point> samplesOf(const ExactPart& part) {
  std::vector<Point> points;
  for (const Corners& corners : part.triangles()) {
    for (std::size_t i = 0; i < 3; ++i) {
      points.push_back(corners[i]);
      points.push_back((corners[i] + corners[(i + 1) % 3]) / 2.0);
    }
    points.push_back((corners[0] + corners[1] + corners[2]) / 3.0);
  }
  std::sort(points.begin(), points.end(), isBefore);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// In a ball or a capsule, which is convex: all of a part is within if its corners are.
bool isWithinRound(const ExactPart& outer, const ExactPart& inner, double tolerance) {
  const Corners& core = outer.triangles().front();
  return std::all_of(inner.triangles().begin(), inner.triangles().end(), [&](const Corners& corners) {
    return std::all_of(corners.begin(), corners.end(), [&](const Point& corner) {
      return (corner - nearestPoint(core, corner)).norm() + inner.radius() <= outer.radius() + tolerance;
    });
  });
}

bool haveSameTriangles(const ExactPart& first, const ExactPart& second, double tolerance) {
  const auto areNear = [tolerance](const Corners& a, const Corners& b) {
    return std::equal(a.begin(), a.end(), b.begin(),
                      [tolerance](const Point& p, const Point& q) { return (p - q).norm() <= tolerance; });
  };
  return std::equal(first.triangles().begin(), first.triangles().end(), second.triangles().begin(),
                    second.triangles().end(), areNear);
}

bool liesOn(const ExactPart& surface, const ExactPart& part, double tolerance) {
  const std::vector<Point> points = samplesOf(part);
  return std::all_of(points.begin(), points.end(),
                     [&](const Point& point) { return distanceTo(surface, point) <= tolerance; });
}

/// The area of a surface, and how long all sides of its triangles are.
struct Extent {
  double area = 0.0;
  double sides = 0.0;
};

Extent extentOf(const ExactPart& part) {
  Extent extent;
  for (const std::uint32_t number : part.shell().triangles) {  // of what is there for either side, one
    const Corners& corners = part.triangles()[number];
    extent.area += normalOf(corners).norm() / 2.0;
    for (std::size_t i = 0; i < 3; ++i) extent.sides += (corners[(i + 1) % 3] - corners[i]).norm();
  }
  return extent;
}

/// A hole that no point asked lies in is missing from the area.
bool haveSameArea(const ExactPart& first, const ExactPart& second, double tolerance) {
  const Extent a = extentOf(first);
  const Extent b = extentOf(second);
  return std::abs(a.area - b.area) <= tolerance * (a.sides + b.sides);
}

}  // namespace

bool holds(const Box& outer, const Box& inner, double slack) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (inner.min[axis] < outer.min[axis] - slack || inner.max[axis] > outer.max[axis] + slack) return false;
  }
  return true;
}

bool isWithin(const ExactPart& outer, const ExactPart& inner, double tolerance) {
  if (!holds(outer.box(), inner.box(), outer.radius() - inner.radius() + tolerance)) return false;
  if (outer.radius() > 0.0) return isWithinRound(outer, inner, tolerance);
  if (outer.volume() == Volume::None) return false;
  const std::vector<Point> points = samplesOf(inner);
  const std::vector<Point> inside = pointsInside(outer, points);
  std::vector<Point> outside;
  std::set_difference(points.begin(), points.end(), inside.begin(), inside.end(), std::back_inserter(outside),
                      isBefore);
  const auto isOnSurface = [&](const Point& point) { return distanceTo(outer, point) <= tolerance; };
  if (inner.radius() == 0.0) return std::all_of(outside.begin(), outside.end(), isOnSurface);
  const auto hasRoom = [&](const Point& point) { return distanceTo(outer, point) >= inner.radius() - tolerance; };
  return outside.empty() && std::all_of(inside.begin(), inside.end(), hasRoom);
}

bool areSame(const ExactPart& first, const ExactPart& second, double tolerance) {
  if (std::abs(first.radius() - second.radius()) > tolerance) return false;
  if (!holds(first.box(), second.box(), tolerance) || !holds(second.box(), first.box(), tolerance)) return false;
  if (haveSameTriangles(first, second, tolerance)) return true;
  if ((first.isOpen() || second.isOpen()) && !haveSameArea(first, second, tolerance)) return false;
  const bool isThick = first.radius() != 0.0 || second.radius() != 0.0;
  if (isThick && (first.triangles().size() != 1 || second.triangles().size() != 1)) return false;  // of one core each
  return liesOn(first, second, tolerance) && liesOn(second, first, tolerance);
}

}  // namespace allpairs::exact
