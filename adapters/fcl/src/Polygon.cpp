// SPDX-License-Identifier: MIT
#include "Polygon.h"

#include <utility>

namespace allpairs::exact {

Polygon::Polygon(const Corners& corners) {
  for (std::size_t i = 0; i < 3; ++i) m_corners[i] = corners[i];
}

void Polygon::append(const Point& point) {
  if (m_count < kMostCorners) m_corners[m_count++] = point;
}

void Polygon::cut(const Point& normal, double offset) {
  const std::array<Point, kMostCorners> corners = m_corners;
  const std::size_t count = std::exchange(m_count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const Point& from = corners[i];
    const Point& to = corners[(i + 1) % count];
    const double before = normal.dot(from) - offset;
    const double after = normal.dot(to) - offset;
    if (before <= 0.0) append(from);
    if ((before < 0.0 && after > 0.0) || (before > 0.0 && after < 0.0)) {
      append(from + (before / (before - after)) * (to - from));
    }
  }
}

void Polygon::cut(const Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    cut(Point::Unit(axis), box.max[a]);
    cut(-Point::Unit(axis), -box.min[a]);
  }
}

Point Polygon::middle() const {
  Point sum = Point::Zero();
  for (const Point& corner : corners()) sum += corner;
  return sum / static_cast<double>(m_count);
}

}  // namespace allpairs::exact
