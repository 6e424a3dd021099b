// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <set>
#include <span>

#include "sofa/mesh/Mesh.h"

namespace allpairs::scene::sofa {

/// Puts cells of VTK's types into a mesh.
/// Reference: "VTK File Formats", the figures of the linear and non-linear cell types.
class VtkCells {
 public:
  explicit VtkCells(Mesh& mesh) : m_mesh(mesh) {}

  /// Returns false if the cell has too few points for its type; cells of other types are passed over, and counted.
  [[nodiscard]] bool add(std::int64_t type, std::span<const Index> corners);
  /// The type of a polygon in XML: a line, a triangle, a quad, or else a line through all corners, which no list holds.
  [[nodiscard]] static std::int64_t typeOfPolygon(std::size_t corners);
  /// A polygon of a surface: a quad, or a fan of triangles.
  void addPolygon(std::span<const Index> corners);

 private:
  void addLinear(std::int64_t type, std::span<const Index> c);
  void addQuadratic(std::int64_t type, std::span<const Index> c);
  void addFan(std::span<const Index> c);
  void addStrip(std::span<const Index> c);

  Mesh& m_mesh;
  std::set<std::array<Index, 2>> m_edges;
};

}  // namespace allpairs::scene::sofa
