// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "sofa/mesh/Mesh.h"
#include "sofa/mesh/Topology.h"

namespace allpairs::scene::sofa {

/// The cells of a regular grid that a surface runs through or encloses, first the former, and their corners.
///
/// Geometry: a cell counts if a triangle, in float32, meets the closed cell and lies between the cells of its corners.
///           Corners come in ascending order of x, then y, then z.
/// Bad input: nothing if a point of the surface is in no cell.
[[nodiscard]] std::optional<Mesh> sparseGrid(const GridShape& grid, const Mesh& surface, TakeWork takeWork);

}  // namespace allpairs::scene::sofa
