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

/// How often the ray from each point passes some triangles of a part: by the way they face, or not.
std::vector<int> crossingsOf(const ExactPart& part, const std::vector<std::uint32_t>& triangles,
                             std::span<const Point> points, bool byWay) {
  std::vector<int> counts(points.size(), 0);
  std::vector<Box> rays;
  rays.reserve(points.size());
  Box all = kEmptyBox;
  for (const Point& point : points) all = merge(all, rays.emplace_back(rayFrom(point)));
  std::vector<Box> boxes;  // of those that some ray may pass
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t number : triangles) {
    if (!overlap(all, part.triangleBoxes()[number])) continue;
    boxes.push_back(part.triangleBoxes()[number]);
    numbers.push_back(number);
  }
  const auto count = [&](Span<const Pair> pairs) {
    for (const auto& [ray, box] : pairs) {
      const int found = crossing(part.triangles()[numbers[box]], points[ray]);
      counts[ray] += byWay ? found : std::abs(found);
    }
  };
  OverlapOptions options;
  options.order = Order::Unordered;
  // Streamed: the box of a long triangle may meet all rays.
  streamOverlaps(std::span<const Box>(rays), std::span<const Box>(boxes), count, options);
  return counts;
}

/// Whether a point is inside from which a ray passes so many triangles: those that bound a volume, counted as that of the
/// shell asks for, and those of two sides.
bool isInside(const Shell& shell, int count, int twoSided) {
  return (shell.volume == Volume::Winding ? count != 0 : count % 2 != 0) || twoSided % 2 != 0;
}

/// Calls `found` with each triangle that the ray from a point passes, and the way it faces.
template <class Found>
void forEachPassed(const ExactPart& part, const Point& point, const Found& found) {
  const Box ray = rayFrom(point);
  std::vector<int> open{0};
  while (!open.empty()) {
    const int number = open.back();
    open.pop_back();
    if (!overlap(part.nodeBox(number), ray)) continue;
    const auto& node = part.hierarchy().getBV(number);
    if (!node.isLeaf()) {
      open.insert(open.end(), {node.leftChild(), node.rightChild()});
    } else if (const int way = crossing(part.triangles()[static_cast<std::size_t>(node.primitiveId())], point)) {
      found(static_cast<std::uint32_t>(node.primitiveId()), way);
    }
  }
}

}  // namespace

std::vector<Point> pointsInside(const ExactPart& part, std::span<const Point> points) {
  if (part.volume() == Volume::None || points.empty()) return {};
  const Shell& shell = part.shell();
  const std::vector<int> counts = crossingsOf(part, shell.triangles, points, shell.volume == Volume::Winding);
  std::vector<int> twoSided(points.size(), 0);
  if (!shell.twoSided.empty()) twoSided = crossingsOf(part, shell.twoSided, points, false);
  std::vector<Point> inside;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (isInside(shell, counts[i], twoSided[i])) inside.push_back(points[i]);
  }
  return inside;
}

bool isInside(const ExactPart& part, const Point& point) {
  const Shell& shell = part.shell();
  const bool isWinding = shell.volume == Volume::Winding;
  const auto holds = [](const std::vector<std::uint32_t>& triangles, std::uint32_t triangle) {
    return std::binary_search(triangles.begin(), triangles.end(), triangle);
  };
  int count = 0;
  int twoSided = 0;
  forEachPassed(part, point, [&](std::uint32_t triangle, int way) {
    if (holds(shell.triangles, triangle)) count += isWinding ? way : 1;
    if (holds(shell.twoSided, triangle)) ++twoSided;
  });
  return isInside(shell, count, twoSided);
}

}  // namespace allpairs::exact
