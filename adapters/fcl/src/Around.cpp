// SPDX-License-Identifier: MIT
#include "Around.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace allpairs::exact {
Around::Around(const Point& middle, const Point& along, double tolerance)
    : m_middle(middle), m_along(along), m_u(along.unitOrthogonal()), m_v(along.cross(m_u)), m_tolerance(tolerance) {}

void Around::add(const Corners& corners, Surface surface) {
  Point farthest = Point::Zero();
  for (const Point& corner : corners) {
    const Point off = offLine(corner);
    if (off.squaredNorm() > farthest.squaredNorm()) farthest = off;
  }
  if (farthest.norm() <= m_tolerance) return;
  const Point way = farthest.normalized();
  double back = 0.0;
  for (const Point& corner : corners) back = std::max(back, -way.dot(offLine(corner)));
  addWay(way, surface);
  if (back > m_tolerance) addWay(-way, surface);
}

void Around::addWay(const Point& direction, Surface surface) {
  m_ways.push_back({std::atan2(m_v.dot(direction), m_u.dot(direction)), surface});
}

bool Around::takeTurns() {
  std::sort(m_ways.begin(), m_ways.end(), [](const Way& a, const Way& b) { return a.angle < b.angle; });
  std::vector<Surface> turns;
  for (const Way& way : m_ways) {
    if (!isShared(way) && (turns.empty() || turns.back() != way.surface)) turns.push_back(way.surface);
  }
  if (turns.size() > 1 && turns.front() == turns.back()) turns.pop_back();
  return turns.size() >= 4;
}

Point Around::offLine(const Point& point) const {
  const Point off = point - m_middle;
  return off - off.dot(m_along) * m_along;
}

/// Where both go on together they touch.
bool Around::isShared(const Way& way) const {
  return std::any_of(m_ways.begin(), m_ways.end(), [&](const Way& other) {
    const double between = std::abs(std::remainder(other.angle - way.angle, 2.0 * std::numbers::pi));
    return other.surface != way.surface && between < kSameAngle;
  });
}

}  // namespace allpairs::exact
