// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "sofa/mesh/Mesh.h"

namespace allpairs::scene::sofa {

/// A box of points, of which those inside and the lines and squares between them may be left out.
struct CubeSurface {
  std::array<std::size_t, 3> points{};
  Vec3 origin{};
  Vec3 spacing{};
  bool inner = false;  ///< Points inside count too.
};

/// The points, edges and quads of the surface, numbered as SOFA does: the bottom, the top, then the sides layer by
/// layer; with points inside or with less than two on an axis, all row by row.
[[nodiscard]] Mesh meshOf(const CubeSurface& cube);

}  // namespace allpairs::scene::sofa
