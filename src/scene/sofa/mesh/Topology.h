// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "sofa/mesh/Grid.h"
#include "sofa/mesh/Mesh.h"

namespace allpairs::scene::sofa {

/// The points and elements that a topology component of a scene holds; lists that it wasn't given it derives when
/// asked.
///
/// Geometry: derived lists come in the order, and their elements in the orientation, in which SOFA derives them.
class Topology {
 public:
  /// How a component derives the lists that it wasn't given.
  enum class Family {
    Mesh,       ///< From cells to faces, from cells or else faces to edges.
    Container,  ///< Each container from its own elements, and only if it has points.
  };

  Family family = Family::Mesh;
  std::size_t pointCount = 0;
  bool hasPositions = false;  ///< Whether states may take their points from it.
  Mesh given;                 ///< Positions may be fewer or more than pointCount.
  std::optional<GridShape> grid;
  GridPlace cells{2, 1, 1};  ///< Of grids along x, y and z, which some mappings ask for.
  bool sparse = false;       ///< A sparse grid, of which edges and faces are not known.
  bool unknown = false;      ///< Neither are its points and its cells.

  [[nodiscard]] const Elements<2>& edges();
  [[nodiscard]] const Elements<3>& triangles();
  [[nodiscard]] const Elements<4>& quads();
  [[nodiscard]] const Elements<4>& tetrahedra() const { return given.tetrahedra; }
  [[nodiscard]] const Elements<8>& hexahedra() const { return given.hexahedra; }
  /// The position of a point, the origin where none was given.
  [[nodiscard]] Vec3 position(std::size_t index) const;

 private:
  [[nodiscard]] Elements<2> derivedEdges();
  void completeEdges(Elements<2>& derived) const;

  std::optional<Elements<2>> m_edges;
  std::optional<Elements<3>> m_triangles;
  std::optional<Elements<4>> m_quads;
};

/// One more than the largest index that any element uses.
[[nodiscard]] std::size_t indicesUsed(const Mesh& mesh);

/// Whether a face that two tetrahedra have the same way round, which only damaged meshes have, is listed twice.
enum class SameWayRound { Once, Twice };
/// The faces of tetrahedra, each once.
[[nodiscard]] Elements<3> facesOf(const Elements<4>& tetrahedra, SameWayRound sameWayRound);
/// The faces of hexahedra, each once.
[[nodiscard]] Elements<4> facesOf(const Elements<8>& hexahedra);
/// Those of the triangles that are a face of exactly one of the tetrahedra.
[[nodiscard]] Elements<3> borderOf(const Elements<3>& triangles, const Elements<4>& tetrahedra);
[[nodiscard]] Elements<4> borderOf(const Elements<4>& quads, const Elements<8>& hexahedra);
/// Those of the edges that belong to exactly one of the triangles.
[[nodiscard]] Elements<2> borderOf(const Elements<2>& edges, const Elements<3>& triangles);

/// What a regular grid lists; the rest is derived as for any mesh.
struct GridLists {
  bool cubes = true;
  bool quads = true;
  bool triangles = true;  ///< The halves of the quads, which are listed with them.
  bool edges = true;
  bool diagonals = false;  ///< Edges are those of the triangles, where there are any, in their order.
};

/// The elements of a regular grid.
void fillGrid(Topology& topology, const GridPlace& points, const GridLists& lists = {});

}  // namespace allpairs::scene::sofa
