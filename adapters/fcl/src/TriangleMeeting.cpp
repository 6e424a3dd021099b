// SPDX-License-Identifier: MIT
#include "TriangleMeeting.h"

#include <algorithm>
#include <cmath>

#include "PointTriangle.h"
#include "Polygon.h"

namespace allpairs::exact {
namespace {

constexpr double kSlack = 1e-9;  // relative: points on an edge belong to both triangles that share it

/// Sums up points, and keeps two that are far from each other.
struct Shared {
  Point sum = Point::Zero();
  int count = 0;
  std::array<Point, 2> ends{};

  void add(const Point& point) {
    sum += point;
    if (count++ == 0) ends = {point, point};
    if ((point - ends[0]).squaredNorm() > (ends[1] - ends[0]).squaredNorm()) ends[1] = point;
  }
};

/// Whether a point in the plane of a triangle lies in it.
bool contains(const Corners& corners, const Point& normal, const Point& point) {
  const double slack = kSlack * normal.squaredNorm();
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& corner = corners[i];
    if ((corners[(i + 1) % 3] - corner).cross(point - corner).dot(normal) < -slack) return false;
  }
  return true;
}

/// How far a height above the plane of a triangle, times the length of its normal, is as good as 0.
double slackOf(const Point& normal) { return kSlack * normal.norm() * std::sqrt(normal.norm()); }

/// Adds the points where the edges of one triangle pass through the other, or begin on it.
void addCrossings(const Corners& edges, const Corners& through, Shared& shared) {
  const Point normal = normalOf(through);
  const double slack = slackOf(normal);
  std::array<double, 3> heights{};
  for (std::size_t i = 0; i < 3; ++i) heights[i] = normal.dot(edges[i] - through[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& from = edges[i];
    const Point& to = edges[(i + 1) % 3];
    const double before = heights[i];
    const double after = heights[(i + 1) % 3];
    if (std::abs(before) <= slack) {
      if (contains(through, normal, from)) shared.add(from);
    } else if (std::abs(after) > slack && (before < 0.0) != (after < 0.0)) {
      const Point point = from + (before / (before - after)) * (to - from);
      if (contains(through, normal, point)) shared.add(point);
    }
  }
}

bool areCoplanar(const Corners& a, const Corners& b) {
  const Point normal = normalOf(b);
  const double slack = slackOf(normal);
  return std::all_of(a.begin(), a.end(), [&](const Point& p) { return std::abs(normal.dot(p - b[0])) <= slack; });
}

/// What two triangles of one plane share: the one cut by the edges of the other.
void addShared(const Corners& a, const Corners& b, Shared& shared) {
  const Point normal = normalOf(b);
  Polygon common(a);
  for (std::size_t i = 0; i < 3 && !common.empty(); ++i) {
    const Point outward = (b[(i + 1) % 3] - b[i]).cross(normal);
    common.cut(outward, outward.dot(b[i]));
  }
  if (!common.empty()) shared.add(common.middle());
}

/// How far a triangle reaches to that side of another's plane to which it reaches less.
double reachThrough(const Corners& corners, const Corners& plane) {
  const Point normal = normalOf(plane);
  const double length = normal.norm();
  if (length == 0.0) return 0.0;
  double least = 0.0;
  double most = 0.0;
  for (const Point& corner : corners) {
    const double height = normal.dot(corner - plane[0]) / length;
    least = std::min(least, height);
    most = std::max(most, height);
  }
  return std::min(most, -least);
}

}  // namespace

std::optional<TriangleMeeting> meetingOf(const Corners& a, const Corners& b) {
  Shared shared;
  const bool hasPlane = hasArea(a);
  const bool hasOther = hasArea(b);
  const bool isFlat = hasPlane && hasOther && areCoplanar(a, b);
  if (isFlat) {
    addShared(a, b, shared);
  } else {
    if (hasOther) addCrossings(a, b, shared);
    if (hasPlane) addCrossings(b, a, shared);
  }
  if (shared.count == 0) return std::nullopt;
  const double crossing = isFlat ? 0.0 : std::min(reachThrough(a, b), reachThrough(b, a));
  const double passing = hasPlane == hasOther ? 0.0 : (hasPlane ? reachThrough(b, a) : reachThrough(a, b));
  return TriangleMeeting{.middle = shared.sum / shared.count,
                         .ends = shared.ends,
                         .crossing = std::min(crossing, (shared.ends[1] - shared.ends[0]).norm()),
                         .passing = passing};
}

}  // namespace allpairs::exact
