// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "allpairs/Box.h"
#include "mesh/Transform.h"

namespace allpairs::scene::sofa {

using Vec3 = std::array<double, 3>;

[[nodiscard]] constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
[[nodiscard]] constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
[[nodiscard]] constexpr Vec3 operator*(const Vec3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
[[nodiscard]] constexpr Vec3 scaled(const Vec3& a, const Vec3& s) { return {a[0] * s[0], a[1] * s[1], a[2] * s[2]}; }
[[nodiscard]] constexpr double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
[[nodiscard]] inline double lengthOf(const Vec3& a) { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline bool isFinite(const Vec3& a) {
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

/// The box around points, of which there must be one.
[[nodiscard]] inline Box boundsOf(std::span<const Vec3> points) {
  Box box{points[0], points[0]};
  for (const auto& p : points)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(box.min[axis], p[axis]);
      box.max[axis] = std::max(box.max[axis], p[axis]);
    }
  return box;
}

/// The box that SOFA fills around a surface: larger than that of its points by a hundredth to each side.
[[nodiscard]] inline Box boxToFill(std::span<const Vec3> points) {
  constexpr double kMargin = 0.01;
  const Box box = boundsOf(points);
  const Vec3 margin = (box.max - box.min) * kMargin;
  return {box.min - margin, box.max + margin};
}

/// A rotation; not normalised, because scenes give quaternions that aren't and mean what the matrix below makes of
/// them.
struct Quat {
  double x = 0, y = 0, z = 0, w = 1;

  friend constexpr bool operator==(const Quat&, const Quat&) = default;
};

[[nodiscard]] constexpr Quat operator*(const Quat& a, const Quat& b) {
  return {.x = a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          .y = a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
          .z = a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x,
          .w = a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

[[nodiscard]] constexpr Quat conjugate(const Quat& q) { return {-q.x, -q.y, -q.z, q.w}; }

[[nodiscard]] constexpr Vec3 rotate(const Quat& q, const Vec3& v) {
  return {(1 - 2 * (q.y * q.y + q.z * q.z)) * v[0] + 2 * (q.x * q.y - q.z * q.w) * v[1] +
              2 * (q.z * q.x + q.y * q.w) * v[2],
          2 * (q.x * q.y + q.z * q.w) * v[0] + (1 - 2 * (q.z * q.z + q.x * q.x)) * v[1] +
              2 * (q.y * q.z - q.x * q.w) * v[2],
          2 * (q.z * q.x - q.y * q.w) * v[0] + 2 * (q.y * q.z + q.x * q.w) * v[1] +
              (1 - 2 * (q.y * q.y + q.x * q.x)) * v[2]};
}

/// The number between the bounds that is nearest; the lower one for a NaN, which std::clamp would keep.
[[nodiscard]] constexpr double clamped(double value, double low, double high) {
  return value >= low ? std::min(value, high) : low;
}

/// The rotation Rz Ry Rx by angles in degrees about the fixed axes.
[[nodiscard]] inline Quat fromEulerDegrees(const Vec3& degrees) {
  constexpr double kHalfRadians = std::numbers::pi / 360.0;
  const auto about = [](double degree) {
    return std::array<double, 2>{std::sin(degree * kHalfRadians), std::cos(degree * kHalfRadians)};
  };
  const auto [sx, cx] = about(degrees[0]);
  const auto [sy, cy] = about(degrees[1]);
  const auto [sz, cz] = about(degrees[2]);
  return Quat{0, 0, sz, cz} * Quat{0, sy, 0, cy} * Quat{sx, 0, 0, cx};
}

/// A linear map of space by columns.
struct Mat3 {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  [[nodiscard]] constexpr Vec3 operator*(const Vec3& v) const { return x * v[0] + y * v[1] + z * v[2]; }
};

/// The inverse, or the zero map where there is none.
[[nodiscard]] constexpr Mat3 inverse(const Mat3& m) {
  const double determinant = dot(m.x, cross(m.y, m.z));
  if (determinant == 0) return {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  const Vec3 r0 = cross(m.y, m.z) * (1 / determinant);
  const Vec3 r1 = cross(m.z, m.x) * (1 / determinant);
  const Vec3 r2 = cross(m.x, m.y) * (1 / determinant);
  return {{r0[0], r1[0], r2[0]}, {r0[1], r1[1], r2[1]}, {r0[2], r1[2], r2[2]}};
}

}  // namespace allpairs::scene::sofa
