// SPDX-License-Identifier: MIT
#include "TriangleMeeting.h"

#include <algorithm>
#include <cmath>

#include "Polygon.h"

namespace allpairs::exact {
namespace {

constexpr double kSlack = 1e-9;  // relative: points on an edge belong to both triangles that share it

/// Sums up points.
struct Mean {
  Point sum = Point::Zero();
  int count = 0;

  void add(const Point& point) {
    sum += point;
    ++count;
  }
};

Point normalOf(const Corners& corners) { return (corners[1] - corners[0]).cross(corners[2] - corners[0]); }

/// Whether a point in the plane of a triangle lies in it.
bool contains(const Corners& corners, const Point& normal, const Point& point) {
  const double slack = kSlack * normal.squaredNorm();
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& corner = corners[i];
    if ((corners[(i + 1) % 3] - corner).cross(point - corner).dot(normal) < -slack) return false;
  }
  return true;
}

/// Adds the points where the edges of one triangle pass through the other.
void addCrossings(const Corners& edges, const Corners& through, Mean& mean) {
  const Point normal = normalOf(through);
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& from = edges[i];
    const Point& to = edges[(i + 1) % 3];
    const double before = normal.dot(from - through[0]);
    const double after = normal.dot(to - through[0]);
    if (before == after || (before < 0.0) == (after < 0.0)) continue;
    const Point point = from + (before / (before - after)) * (to - from);
    if (contains(through, normal, point)) mean.add(point);
  }
}

bool areCoplanar(const Corners& a, const Corners& b) {
  const Point normal = normalOf(b);
  const double slack = kSlack * normal.norm() * std::sqrt(normal.norm());
  return std::all_of(a.begin(), a.end(), [&](const Point& p) { return std::abs(normal.dot(p - b[0])) <= slack; });
}

/// What two triangles of one plane share: the one cut by the edges of the other.
void addShared(const Corners& a, const Corners& b, Mean& mean) {
  const Point normal = normalOf(b);
  Polygon shared(a);
  for (std::size_t i = 0; i < 3 && !shared.empty(); ++i) {
    const Point outward = (b[(i + 1) % 3] - b[i]).cross(normal);
    shared.cut(outward, outward.dot(b[i]));
  }
  if (!shared.empty()) mean.add(shared.middle());
}

}  // namespace

std::optional<Point> meetingPoint(const Corners& a, const Corners& b) {
  Mean mean;
  if (areCoplanar(a, b)) {
    addShared(a, b, mean);
  } else {
    addCrossings(a, b, mean);
    addCrossings(b, a, mean);
  }
  if (mean.count == 0) return std::nullopt;
  return mean.sum / mean.count;
}

}  // namespace allpairs::exact
