// SPDX-License-Identifier: MIT
#pragma once

#include <LinearMath/btVector3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "allpairs/Box.h"

/// Bullet's vectors as the broad phase needs them: an implementation detail.
namespace allpairs::internal {

[[nodiscard]] inline std::array<double, 3> toArray(const btVector3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

[[nodiscard]] inline Box toBox(const btVector3& min, const btVector3& max) { return {toArray(min), toArray(max)}; }

[[nodiscard]] inline bool areFinite(std::initializer_list<btVector3> points) {
  return std::all_of(points.begin(), points.end(), [](const btVector3& point) {
    const std::array<double, 3> x = toArray(point);
    return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
  });
}

[[nodiscard]] inline btVector3 minimum(btVector3 a, const btVector3& b) {
  a.setMin(b);
  return a;
}

[[nodiscard]] inline btVector3 maximum(btVector3 a, const btVector3& b) {
  a.setMax(b);
  return a;
}

}  // namespace allpairs::internal
