// SPDX-License-Identifier: MIT
#include "Nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "PointTriangle.h"
#include "TriangleMeeting.h"

namespace allpairs::exact {
namespace {

Box boxAt(const Point& point) { return {toVec3(point), toVec3(point)}; }

/// Takes the nearer of what is known and two points.
void take(const Point& onFirst, const Point& onSecond, Nearest& nearest) {
  const double distance = (onFirst - onSecond).norm();
  if (distance >= nearest.distance) return;
  nearest.distance = distance;
  nearest.onFirst = onFirst;
  nearest.onSecond = onSecond;
}

/// Where two sides pass each other between their ends; at the ends corners are measured.
///
/// Source: C. Ericson, Real-Time Collision Detection (2005), section 5.1.9.
void takeSides(const std::array<Point, 2>& first, const std::array<Point, 2>& second, Nearest& nearest) {
  const Point u = first[1] - first[0];
  const Point v = second[1] - second[0];
  const Point w = first[0] - second[0];
  const double uu = u.squaredNorm();
  const double vv = v.squaredNorm();
  const double uv = u.dot(v);
  const double determinant = uu * vv - uv * uv;
  constexpr double kParallel = 1e-14;
  if (determinant <= kParallel * uu * vv) return;
  const double s = std::clamp((uv * v.dot(w) - vv * u.dot(w)) / determinant, 0.0, 1.0);
  const double t = std::clamp((uv * s + v.dot(w)) / vv, 0.0, 1.0);
  take(first[0] + s * u, second[0] + t * v, nearest);
}

/// No less than this lies between two triangles: how far they are apart along the normal of the first, whichever way
/// rounding has it point.
double gapAlongNormal(const Corners& first, const Corners& second) {
  const Point normal = normalOf(first);
  const double length = normal.norm();
  if (length == 0.0) return 0.0;
  const auto span = [&](const Corners& corners) {
    return std::minmax({normal.dot(corners[0]), normal.dot(corners[1]), normal.dot(corners[2])});
  };
  const auto [low, high] = span(first);
  const auto [otherLow, otherHigh] = span(second);
  return std::max(otherLow - high, low - otherHigh) / length;
}

/// Looks for the two nearest triangles of two parts, or the one nearest to a point, the nearer nodes first. FCL's own
/// measures of triangles are 0, or anything, where corners lie in a line, as they do beside a corner in the middle of a
/// side, and where sides are short in the unit of the file.
class Search {
 public:
  explicit Search(const ExactPart& first) : m_first(first) {
    m_nearest.distance = std::numeric_limits<double>::infinity();
  }

  Nearest nearestTo(const ExactPart& second) {
    const auto split = [&](int a, int b) {
      const auto& nodeA = m_first.hierarchy().getBV(a);
      const auto& nodeB = second.hierarchy().getBV(b);
      if (nodeA.isLeaf() && nodeB.isLeaf()) return measure(second, nodeA.primitiveId(), nodeB.primitiveId());
      const bool splitsFirst =
          !nodeA.isLeaf() && (nodeB.isLeaf() || sizeOf(m_first.nodeBox(a)) >= sizeOf(second.nodeBox(b)));
      for (const int child : {0, 1}) {
        const int nextA = splitsFirst ? nodeA.leftChild() + child : a;
        const int nextB = splitsFirst ? b : nodeB.leftChild() + child;
        m_open.push_back({boxGap(m_first.nodeBox(nextA), second.nodeBox(nextB)), nextA, nextB});
      }
      putNearerLast();
    };
    run(split);
    return m_nearest;
  }

  Nearest nearestTo(const Point& point) {
    const Box box = boxAt(point);
    run([&](int a, int) {
      const auto& node = m_first.hierarchy().getBV(a);
      if (node.isLeaf()) return measure(point, node.primitiveId());
      for (const int child : {node.leftChild(), node.rightChild()}) {
        m_open.push_back({boxGap(m_first.nodeBox(child), box), child, 0});
      }
      putNearerLast();
    });
    return m_nearest;
  }

 private:
  struct Nodes {
    double limit = 0.0;
    int first = 0;
    int second = 0;
  };

  static double sizeOf(const Box& box) {
    return std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
  }

  void putNearerLast() {
    const std::size_t last = m_open.size() - 1;
    if (m_open[last - 1].limit < m_open[last].limit) std::swap(m_open[last - 1], m_open[last]);
  }

  template <class Look>
  void run(const Look& look) {
    m_open.push_back({});
    while (!m_open.empty() && m_nearest.distance > 0.0) {
      const Nodes nodes = m_open.back();
      m_open.pop_back();
      if (nodes.limit < m_nearest.distance) look(nodes.first, nodes.second);
    }
  }

  void measure(const Point& point, int triangle) {
    const double before = m_nearest.distance;
    take(nearestPoint(m_first.triangles()[static_cast<std::size_t>(triangle)], point), point, m_nearest);
    if (m_nearest.distance < before) m_nearest.triangle = triangle;
  }

  void measure(const ExactPart& second, int a, int b) {
    const auto first = static_cast<std::size_t>(a);
    const auto other = static_cast<std::size_t>(b);
    const Corners& corners = m_first.triangles()[first];
    const Corners& others = second.triangles()[other];
    constexpr double kSlack = 1.0 - 1e-9;
    const double least = std::max(gapAlongNormal(corners, others), gapAlongNormal(others, corners));
    if (least * kSlack >= m_nearest.distance) return;
    for (const Point& corner : corners) take(corner, nearestPoint(others, corner), m_nearest);
    for (const Point& corner : others) take(nearestPoint(corners, corner), corner, m_nearest);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        takeSides({corners[i], corners[(i + 1) % 3]}, {others[j], others[(j + 1) % 3]}, m_nearest);
      }
    }
    if (!overlap(m_first.triangleBoxes()[first], second.triangleBoxes()[other])) return;
    if (const auto meeting = meetingOf(corners, others)) take(meeting->middle, meeting->middle, m_nearest);
  }

  const ExactPart& m_first;
  std::vector<Nodes> m_open;
  Nearest m_nearest;
};

}  // namespace

double boxGap(const Box& first, const Box& second) {
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::max({0.0, first.min[axis] - second.max[axis], second.min[axis] - first.max[axis]});
    squared += gap * gap;
  }
  return std::sqrt(squared);
}

Nearest nearest(const ExactPart& first, const ExactPart& second) { return Search(first).nearestTo(second); }

Nearest nearest(const ExactPart& part, const Point& point) { return Search(part).nearestTo(point); }

}  // namespace allpairs::exact
