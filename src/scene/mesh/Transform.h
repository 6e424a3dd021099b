// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "mesh/MeshObject.h"

namespace allpairs::scene {

/// A node's transform into the world: three rows of four, in double.
using Transform = std::array<std::array<double, 4>, 3>;

inline constexpr Transform kIdentity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

[[nodiscard]] inline Transform multiply(const Transform& parent, const Transform& child) {
  Transform result{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = column == 3 ? parent[row][3] : 0.0;
      for (std::size_t k = 0; k < 3; ++k) sum += parent[row][k] * child[k][column];
      result[row][column] = sum;
    }
  }
  return result;
}

[[nodiscard]] inline Point placed(const Transform& transform, const Point& p) {
  Point result{};
  for (std::size_t row = 0; row < 3; ++row) {
    const std::array<double, 4>& m = transform[row];
    result[row] = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
  }
  return result;
}

[[nodiscard]] constexpr Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace allpairs::scene
