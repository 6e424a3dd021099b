// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "sofa/mesh/Mesh.h"

namespace allpairs::scene::sofa {

/// Where a line crosses a surface, in lengths of its direction, and whether it leaves (1) or enters (-1).
struct Crossing {
  double at = 0;
  int leaves = 0;
};

/// Finds the triangles that lines of one direction cross.
class LineCaster {
 public:
  LineCaster(const Mesh& surface, const Vec3& direction);

  /// The crossings of a half line of this direction, the nearest first.
  [[nodiscard]] std::vector<Crossing> crossings(const Vec3& origin, const Vec3& direction) const;

 private:
  using Flat = std::array<double, 2>;
  struct Shadow {
    Flat low, high;
  };

  [[nodiscard]] Flat across(const Vec3& p) const;
  [[nodiscard]] std::optional<Crossing> cross(std::size_t triangle, const Vec3& origin, const Vec3& direction) const;

  const Mesh& m_surface;
  Vec3 m_direction;
  std::vector<Shadow> m_shadows;
};

}  // namespace allpairs::scene::sofa
