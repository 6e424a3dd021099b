// SPDX-License-Identifier: MIT
#pragma once

#include "sofa/mesh/Grid.h"
#include "sofa/mesh/Mesh.h"

namespace allpairs::scene::sofa {

/// The points, edges and quads on the surface of a grid, numbered as SOFA does: the bottom, the top, then the sides layer
/// by layer. With the points inside, or with less than two on an axis, all points, row by row.
[[nodiscard]] Mesh cubeSurface(const GridShape& grid, bool hasInner);

}  // namespace allpairs::scene::sofa
