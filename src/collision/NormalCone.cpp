// SPDX-License-Identifier: MIT
#include "allpairs/collision/NormalCone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace allpairs::collision {
namespace {

Vec3 normalised(const Vec3& v, double length) { return {v[0] / length, v[1] / length, v[2] / length}; }

double lengthOf(const Vec3& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// The angle between two unit vectors; rounding must not push the cosine out of the range of acos.
double angleBetween(const Vec3& a, const Vec3& b) {
  return std::acos(std::clamp(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], -1.0, 1.0));
}

}  // namespace

NormalCone NormalCone::of(const Vec3& normal) {
  const double length = lengthOf(normal);
  if (!(length > 0.0) || !std::isfinite(length)) return {};
  return {normalised(normal, length), 0.0};
}

NormalCone NormalCone::ofTurning(const Vec3& start, const Vec3& end) {
  NormalCone cone = of(start);
  const NormalCone last = of(end);
  if (cone.halfAngle != 0.0 || last.halfAngle != 0.0) return {};
  cone.halfAngle = angleBetween(cone.axis, last.axis);
  return cone;
}

void NormalCone::merge(const NormalCone& other) {
  const double widest = std::max(halfAngle, other.halfAngle);
  const Vec3 sum{axis[0] + other.axis[0], axis[1] + other.axis[1], axis[2] + other.axis[2]};
  const double length = lengthOf(sum);
  if (!(widest <= std::numbers::pi / 2.0) || !(length > 0.0)) {  // opposite normals have no axis between them
    *this = NormalCone{};
    return;
  }
  halfAngle = angleBetween(axis, other.axis) / 2.0 + widest;
  axis = normalised(sum, length);
}

}  // namespace allpairs::collision
