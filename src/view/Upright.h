// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdlib>

#include "VectorMath.h"

namespace allpairs::view {

/// Three directions for whoever stands in a scene: right-handed, each of length 1 along an axis.
struct Upright {
  Vec3 right{};
  Vec3 ahead{};
  Vec3 up{};

  /// A direction given by its parts to the right, ahead and up.
  [[nodiscard]] Vec3 direction(const Vec3& parts) const {
    Vec3 result{};
    for (std::size_t i = 0; i < 3; ++i) result[i] = parts[0] * right[i] + parts[1] * ahead[i] + parts[2] * up[i];
    return result;
  }
};

/// Of a scene whose axis 1 to 3, x to z, points up; below 0 it points down. Where y is up, ahead is -z, as glTF has it.
[[nodiscard]] inline Upright uprightOf(int up) {
  Upright result;
  const double sign = up < 0 ? -1.0 : 1.0;
  switch (std::abs(up)) {
    case 1:
      result = {{0.0, sign, 0.0}, {0.0, 0.0, 1.0}, {sign, 0.0, 0.0}};
      break;
    case 2:
      result = {{sign, 0.0, 0.0}, {0.0, 0.0, -1.0}, {0.0, sign, 0.0}};
      break;
    default:
      result = {{sign, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, sign}};
      break;
  }
  return result;
}

[[nodiscard]] inline Vec3 unit(const Vec3& v) {
  const double length = std::sqrt(dot(v, v));
  return length > 0.0 ? Vec3{v[0] / length, v[1] / length, v[2] / length} : v;
}

}  // namespace allpairs::view
