// SPDX-License-Identifier: MIT
#include "Deeper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <queue>
#include <vector>

#include "Inside.h"
#include "Nearest.h"
#include "PointTriangle.h"
#include "Polygon.h"

namespace allpairs::exact {
namespace {

/// By how much more a depth may be missed: what docs/fcl.md promises.
constexpr double kMuch = 1.01;

/// Of one part in the other. With 300 one pair of some 1,100 of overlapping meshes had 0.65 of the depth that a grid of
/// 2,000 points finds, with 500 at least 0.83.
constexpr int kMostMeasures = 500;

/// A point that was measured.
struct Measured {
  Point point = Point::Zero();
  double depth = 0.0;  ///< Negative outside.
  Nearest surface;
};

/// Where deeper points may lie: in the triangles below a node of the hierarchy, or in a piece of a triangle.
struct Region {
  double limit = std::numeric_limits<double>::infinity();  ///< No point of it lies deeper.
  double depth = 0.0;                                      ///< The greatest measured, of its middle or of its corners.
  int node = 0;
  bool isPiece = false;
  std::array<std::size_t, 3> corners{};  ///< Of a piece, by their numbers.
};

/// Branch and bound: regions are divided, those first that are deep where they were measured, until none may reach much
/// deeper than what was found.
///
/// Between two points the depth, negative outside, differs by no more than they are apart. And no point of a region
/// is deeper than it is far from any one triangle, which none is further from than one of the corners.
class DeeperSearch {
 public:
  DeeperSearch(const ExactPart& outer, const ExactPart& inner, double known)
      : m_outer(outer), m_inner(inner), m_shared(common(outer.box(), inner.box())) {
    m_deepest.depth = known;
  }

  Deepest find() {
    push({});
    while (!m_regions.empty() && m_measures < kMostMeasures) {
      const Region region = m_regions.top();
      m_regions.pop();
      if (!mayBeMuchDeeper(region.limit)) continue;
      region.isPiece ? divide(region) : open(region);
    }
    return m_deepest;
  }

 private:
  struct IsLater {
    bool operator()(const Region& a, const Region& b) const { return a.depth < b.depth; }
  };

  [[nodiscard]] bool mayBeMuchDeeper(double limit) const { return limit > kMuch * m_deepest.depth; }

  void push(const Region& region) {
    if (mayBeMuchDeeper(region.limit)) m_regions.push(region);
  }

  Measured measure(const Point& point) {
    ++m_measures;
    const Nearest surface = nearest(m_outer, point);
    return {point, isInside(m_outer, point) ? surface.distance : -surface.distance, surface};
  }

  void open(const Region& region) {
    const auto& node = m_inner.hierarchy().getBV(region.node);
    if (node.isLeaf()) {
      return addTriangle(m_inner.triangles()[static_cast<std::size_t>(node.primitiveId())], region.limit);
    }
    for (const int child : {node.leftChild(), node.rightChild()}) {
      const Box box = common(m_inner.nodeBox(child), m_shared);
      if (isEmpty(box)) continue;
      const Point half = (toPoint(box.max) - toPoint(box.min)) / 2.0;
      const double depth = measure(toPoint(box.min) + half).depth;
      push({.limit = std::min(region.limit, depth + half.norm()), .depth = depth, .node = child});
    }
  }

  void addTriangle(const Corners& triangle, double limit) {
    Polygon polygon(triangle);
    polygon.cut(m_shared);
    std::vector<std::size_t> corners;
    for (const Point& point : polygon.corners()) corners.push_back(addPoint(point));
    for (std::size_t i = 2; i < corners.size(); ++i) addPiece({corners[0], corners[i - 1], corners[i]}, limit);
  }

  /// Cuts the longest side of a piece.
  void divide(const Region& region) {
    const auto sideOf = [&](std::size_t i) {
      return (pointOf(region.corners[(i + 1) % 3]) - pointOf(region.corners[i])).squaredNorm();
    };
    std::size_t longest = sideOf(1) > sideOf(0) ? 1 : 0;
    if (sideOf(2) > sideOf(longest)) longest = 2;
    const std::size_t from = region.corners[longest];
    const std::size_t to = region.corners[(longest + 1) % 3];
    const std::size_t other = region.corners[(longest + 2) % 3];
    const std::size_t middle = addPoint(cutBetween(m_points[from], m_points[to]));
    addPiece({from, middle, other}, region.limit);
    addPiece({middle, to, other}, region.limit);
  }

  /// Where the nearest triangles of the two are equally far, as on the ridge between two faces, so that one triangle
  /// tells for either side how deep it is; else halfway.
  [[nodiscard]] Point cutBetween(const Measured& from, const Measured& to) const {
    constexpr double kLeast = 0.1;
    double at = 0.5;
    if (from.depth > 0.0 && to.depth > 0.0 && from.surface.triangle != to.surface.triangle) {
      const double before = distanceToNearestOf(to, from.point) - from.depth;
      const double after = distanceToNearestOf(from, to.point) - to.depth;
      const double ridge = before / (before + after);
      if (ridge > kLeast && ridge < 1.0 - kLeast) at = ridge;
    }
    return from.point + at * (to.point - from.point);
  }

  /// From a point to the triangle that is nearest to a measured one.
  [[nodiscard]] double distanceToNearestOf(const Measured& measured, const Point& point) const {
    const std::ptrdiff_t triangle = measured.surface.triangle;
    if (triangle < 0) return std::numeric_limits<double>::infinity();
    return (point - nearestPoint(m_outer.triangles()[static_cast<std::size_t>(triangle)], point)).norm();
  }

  std::size_t addPoint(const Point& point) {
    const Measured& added = m_points.emplace_back(measure(point));
    if (added.depth > m_deepest.depth) {
      m_deepest = {.found = true, .depth = added.depth, .point = point, .surface = added.surface.onFirst};
    }
    return m_points.size() - 1;
  }

  void addPiece(const std::array<std::size_t, 3>& corners, double limit) {
    for (const std::size_t from : corners) {
      double way = 0.0;
      for (const std::size_t to : corners) way = std::max(way, (pointOf(to) - pointOf(from)).norm());
      limit = std::min(limit, m_points[from].depth + way);
    }
    for (const std::size_t from : corners) {
      if (!mayBeMuchDeeper(limit)) return;
      double distance = std::abs(m_points[from].depth);
      for (const std::size_t to : corners) {
        if (to != from) distance = std::max(distance, distanceToNearestOf(m_points[from], pointOf(to)));
      }
      limit = std::min(limit, distance);
    }
    const double depth = std::max({m_points[corners[0]].depth, m_points[corners[1]].depth, m_points[corners[2]].depth});
    push({.limit = limit, .depth = depth, .isPiece = true, .corners = corners});
  }

  [[nodiscard]] const Point& pointOf(std::size_t corner) const { return m_points[corner].point; }

  const ExactPart& m_outer;
  const ExactPart& m_inner;
  Box m_shared;
  Deepest m_deepest;
  int m_measures = 0;
  std::vector<Measured> m_points;
  std::priority_queue<Region, std::vector<Region>, IsLater> m_regions;
};

}  // namespace

Deepest deeperWithin(const ExactPart& outer, const ExactPart& inner, double known) {
  return outer.volume() == Volume::None ? Deepest() : DeeperSearch(outer, inner, known).find();
}

}  // namespace allpairs::exact
