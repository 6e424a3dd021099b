// SPDX-License-Identifier: MIT
#include "Deepest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "Inside.h"
#include "Nearest.h"
#include "PointTriangle.h"
#include "Polygon.h"
#include "TriangleMeeting.h"

namespace allpairs::exact {
namespace {

/// The corners, the middles of the sides and the middle of all.
void addPointsOf(const Polygon& polygon, std::vector<Point>& points) {
  const auto corners = polygon.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points.push_back(corners[i]);
    points.push_back((corners[i] + corners[(i + 1) % corners.size()]) / 2.0);
  }
  points.push_back(polygon.middle());
}

void keepEachOnce(std::vector<Point>& points) {
  std::sort(points.begin(), points.end(), isBefore);
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

/// Where the triangles of another part cross a triangle, which they cut into regions.
using Cuts = std::vector<std::array<Point, 2>>;

/// A triangle in such regions.
class CutTriangle {
 public:
  CutTriangle(const Corners& corners, const Cuts& cuts)
      : m_corners(corners), m_cuts(cuts), m_normal(normalOf(corners).normalized()) {}

  /// Adds a point on either side of each cut, halfway to the next one: in each region that a cut bounds.
  void addBeside(std::vector<Point>& points) const {
    const std::size_t stride = (m_cuts.size() + kMostCuts - 1) / kMostCuts;
    for (std::size_t i = 0; i < m_cuts.size(); i += stride) {
      const auto& [from, to] = m_cuts[i];
      const Point middle = (from + to) / 2.0;
      const Point direction = m_normal.cross(to - from).normalized();
      for (const Point& side : {direction, Point(-direction)}) {
        const double way = wayToNext(middle, side);
        if (std::isfinite(way)) points.push_back(middle + (way / 2.0) * side);
      }
    }
  }

 private:
  static constexpr std::size_t kMostCuts = 256;  // that are looked from; each looks at all

  /// How far it is from a point along a direction, both in the plane of the triangle, to the next cut or side of it.
  [[nodiscard]] double wayToNext(const Point& point, const Point& direction) const {
    double way = std::numeric_limits<double>::infinity();
    const Point across = m_normal.cross(direction);
    const auto look = [&](const Point& from, const Point& to) {
      const double before = across.dot(from - point);
      const double after = across.dot(to - point);
      if ((before > 0.0 && after > 0.0) || (before < 0.0 && after < 0.0) || before == after) return;
      const Point passed = from + (before / (before - after)) * (to - from);
      const double at = direction.dot(passed - point);
      if (at > 0.0) way = std::min(way, at);
    };
    for (const auto& [from, to] : m_cuts) look(from, to);
    for (std::size_t i = 0; i < 3; ++i) look(m_corners[i], m_corners[(i + 1) % 3]);
    return way;
  }

  const Corners& m_corners;
  const Cuts& m_cuts;
  Point m_normal;
};

/// Where surfaces cross, a part of each lies on either side, however thin: between all corners and middles, perhaps.
void addBesideCrossings(const ExactPart& outer, const ExactPart& inner, std::vector<TrianglePair> pairs,
                        std::vector<Point>& points) {
  std::sort(pairs.begin(), pairs.end(), [](const TrianglePair& a, const TrianglePair& b) { return a.first < b.first; });
  Cuts cuts;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Corners& corners = inner.triangles()[pairs[i].first];
    const auto meeting = meetingOf(corners, outer.triangles()[pairs[i].second]);
    if (meeting && meeting->ends[0] != meeting->ends[1]) cuts.push_back(meeting->ends);
    const bool isLast = i + 1 == pairs.size() || pairs[i + 1].first != pairs[i].first;
    if (isLast && !cuts.empty()) CutTriangle(corners, cuts).addBeside(points);
    if (isLast) cuts.clear();
  }
}

/// The points worth asking: those that are exact for flat faces and vertices, and others.
struct Samples {
  std::vector<Point> plain;
  std::vector<Point> beside;  ///< Of lines in which the surfaces cross.
};

Samples samples(const ExactPart& outer, const ExactPart& inner, const std::vector<TrianglePair>& pairs) {
  Samples points;
  const Box shared = common(outer.box(), inner.box());
  for (std::size_t i = 0; i < inner.triangles().size(); ++i) {
    if (!overlap(shared, inner.triangleBoxes()[i])) continue;
    Polygon polygon(inner.triangles()[i]);
    polygon.cut(shared);
    if (polygon.empty()) continue;
    addPointsOf(polygon, points.plain);
  }
  for (const TrianglePair& pair : pairs) {
    Polygon polygon(inner.triangles()[pair.first]);
    polygon.cut(outer.triangleBoxes()[pair.second]);
    if (!polygon.empty()) points.plain.push_back(polygon.middle());
  }
  addBesideCrossings(outer, inner, pairs, points.beside);
  keepEachOnce(points.plain);
  return points;
}

/// A point that may be the deepest, and how deep it can lie at most.
struct Candidate {
  Point point;
  double limit = 0.0;
};

/// A surface is no further than the side of the box around it.
double limitWithin(const Box& box, const Point& point) {
  double depth = box.max[0] - box.min[0];
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    depth = std::min({depth, point[axis] - box.min[a], box.max[a] - point[axis]});
  }
  return depth;
}

/// Finds the deepest of many points without measuring them all. To measure is to ask FCL how far the surface is. From
/// one that was measured follows how deep its neighbours can lie at most: no deeper than the triangle that is nearest
/// to it, and by no more than they are away. What can't be the deepest is dropped; the rest is halved, and halves
/// measured.
class DeepestSearch {
 public:
  explicit DeepestSearch(const ExactPart& outer) : m_outer(outer) {}

  /// The deepest of these and of those before.
  Deepest among(std::span<const Point> points) {
    std::vector<Candidate> candidates;
    for (const Point& point : points) candidates.push_back({point, limitWithin(m_outer.box(), point)});
    // A few from all over give a depth with which much can be dropped at once.
    const std::size_t stride = candidates.size() / kFirstMeasured + 1;
    for (std::size_t i = stride / 2; i < candidates.size(); i += stride) {
      if (!isShallow(candidates[i])) measure(candidates[i]);
    }
    search(candidates);
    return m_deepest;
  }

 private:
  static constexpr std::size_t kFirstMeasured = 16;

  Nearest measure(const Candidate& candidate) {
    Nearest surface = nearest(m_outer, candidate.point);
    const double distance = surface.distance;
    if (!m_deepest.found || distance > m_deepest.depth * (1.0 + kRounding)) {
      m_deepest = {.found = true,
                   .depth = distance,
                   .point = candidate.point,
                   .surface = distance > 0.0 ? surface.onFirst : candidate.point};
    }
    return surface;
  }

  void search(std::span<Candidate> candidates) {
    candidates = dropShallow(candidates);
    if (candidates.empty()) return;
    const auto middle = halve(candidates);
    const Candidate measured = candidates[middle];
    const Nearest surface = measure(measured);
    for (Candidate& candidate : candidates) {
      candidate.limit = std::min(candidate.limit, surface.distance + (candidate.point - measured.point).norm());
      if (surface.triangle < 0) continue;
      const Corners& nearest = m_outer.triangles()[static_cast<std::size_t>(surface.triangle)];
      candidate.limit = std::min(candidate.limit, (candidate.point - nearestPoint(nearest, candidate.point)).norm());
    }
    search(candidates.first(middle));
    search(candidates.subspan(middle + 1));
  }

  [[nodiscard]] bool isShallow(const Candidate& candidate) const {
    return m_deepest.found && candidate.limit <= m_deepest.depth * (1.0 + kRounding);
  }

  /// Those that can be deeper than what was found.
  std::span<Candidate> dropShallow(std::span<Candidate> candidates) const {
    const auto end = std::remove_if(candidates.begin(), candidates.end(),
                                    [this](const Candidate& candidate) { return isShallow(candidate); });
    return candidates.first(static_cast<std::size_t>(end - candidates.begin()));
  }

  /// Brings the candidates of either side of a plane together, and says which one lies in it.
  static std::size_t halve(std::span<Candidate> candidates) {
    Box box = kEmptyBox;
    for (const Candidate& candidate : candidates) include(box, candidate.point);
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis) {
      if (sideOf(box, axis) > sideOf(box, longest)) longest = axis;
    }
    const auto middle = candidates.begin() + static_cast<std::ptrdiff_t>(candidates.size() / 2);
    std::nth_element(candidates.begin(), middle, candidates.end(), [&](const Candidate& a, const Candidate& b) {
      return std::pair(a.point[longest], toVec3(a.point)) < std::pair(b.point[longest], toVec3(b.point));
    });
    return candidates.size() / 2;
  }

  static double sideOf(const Box& box, int axis) {
    const auto a = static_cast<std::size_t>(axis);
    return box.max[a] - box.min[a];
  }

  /// Points that are deeper by less are as deep: a face that lies flat in the other has many.
  static constexpr double kRounding = 1e-12;

  const ExactPart& m_outer;
  Deepest m_deepest;
};

}  // namespace

Deepest deepestWithin(const ExactPart& outer, const ExactPart& inner, const std::vector<TrianglePair>& innerAndOuter) {
  if (outer.volume() == Volume::None) return {};
  const Samples points = samples(outer, inner, innerAndOuter);
  DeepestSearch search(outer);
  search.among(pointsInside(outer, points.plain));
  return search.among(pointsInside(outer, points.beside));  // only where one of them is deeper
}

}  // namespace allpairs::exact
