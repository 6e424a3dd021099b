// SPDX-License-Identifier: MIT
#include "sofa/mesh/LineCaster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace allpairs::scene::sofa {

LineCaster::LineCaster(const Mesh& surface, const Vec3& direction) : m_surface(surface), m_direction(direction) {
  constexpr double kSlack = 1e-9;  // of all coordinates: far more than the test's own, which says what counts
  double largest = 0;
  for (const auto& p : surface.positions)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  for (const auto& t : surface.triangles) {
    Shadow shadow{across(surface.positions[t[0]]), across(surface.positions[t[0]])};
    for (const auto corner : t) {
      const auto a = across(surface.positions[corner]);
      for (std::size_t i = 0; i < 2; ++i) {
        shadow.low[i] = std::min(shadow.low[i], a[i] - kSlack * largest);
        shadow.high[i] = std::max(shadow.high[i], a[i] + kSlack * largest);
      }
    }
    m_shadows.push_back(shadow);
  }
}

std::vector<Crossing> LineCaster::crossings(const Vec3& origin, const Vec3& direction) const {
  std::vector<Crossing> found;
  const auto a = across(origin);
  for (std::size_t t = 0; t < m_shadows.size(); ++t) {
    const auto& [low, high] = m_shadows[t];
    if (a[0] < low[0] || a[0] > high[0] || a[1] < low[1] || a[1] > high[1]) continue;
    if (const auto crossing = cross(t, origin, direction)) found.push_back(*crossing);
  }
  std::ranges::stable_sort(found, {}, &Crossing::at);
  return found;
}

/// Two coordinates that do not change along the lines.
LineCaster::Flat LineCaster::across(const Vec3& p) const {
  const auto& d = m_direction;
  if (d[1] == 0 && d[2] == 0) return {p[1], p[2]};
  if (d[0] == 0 && d[2] == 0) return {p[0], p[2]};
  if (d[0] == 0 && d[1] == 0) return {p[0], p[1]};
  return {d[0] * p[1] - d[1] * p[0], d[0] * p[2] - d[2] * p[0]};
}

/// Reference: Moeller and Trumbore, "Fast, minimum storage ray-triangle intersection", 1997.
std::optional<Crossing> LineCaster::cross(std::size_t triangle, const Vec3& origin, const Vec3& direction) const {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const auto& t = m_surface.triangles[triangle];
  const auto& corner = m_surface.positions[t[0]];
  const Vec3 first = m_surface.positions[t[1]] - corner, second = m_surface.positions[t[2]] - corner;
  const Vec3 p = scene::cross(direction, second);
  const double determinant = dot(first, p);
  if (std::abs(determinant) <= kEpsilon) return std::nullopt;
  const double inverse = 1 / determinant;
  const Vec3 from = origin - corner;
  const double u = dot(from, p) * inverse;
  if (u < -kEpsilon || u > 1 + kEpsilon) return std::nullopt;
  const Vec3 q = scene::cross(from, first);
  const double v = dot(direction, q) * inverse;
  if (v < -kEpsilon || u + v > 1 + kEpsilon) return std::nullopt;
  const double at = dot(second, q) * inverse;
  if (!(at >= kEpsilon)) return std::nullopt;
  return Crossing{at, dot(scene::cross(first, second), direction) < 0 ? -1 : 1};
}

}  // namespace allpairs::scene::sofa
