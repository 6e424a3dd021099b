// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "sofa/mesh/Mesh.h"

namespace allpairs::scene::sofa {

/// How a surface is filled with tetrahedra.
struct Stuffing {
  Box box{};         ///< The box to fill; that of the surface, a little larger, where its x is no interval.
  double size = -8;  ///< Of a cell; below zero, how many of them lie along the longest side.
  double alphaLong = 0.24999;
  double alphaShort = 0.42978;
  bool snap = false;   ///< Move points onto the surface that are nearer to it, on an edge, than alpha times its length.
  bool split = false;  ///< Cut the tetrahedra that the surface runs through.
};

/// How many points the grids have that tetrahedra are made of.
[[nodiscard]] double stuffingPoints(const Mesh& surface, const Stuffing& how);

/// The tetrahedra inside of a surface of triangles, as SOFA makes them.
///
/// Reference: Labelle and Shewchuk, "Isosurface Stuffing: Fast Tetrahedral Meshes with Good Dihedral Angles", 2007.
[[nodiscard]] Mesh stuffed(const Mesh& surface, const Stuffing& how, TakeWork takeWork);

}  // namespace allpairs::scene::sofa
