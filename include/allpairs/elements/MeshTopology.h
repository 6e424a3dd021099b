// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/DebugMode.h"

namespace allpairs::elements {

/// Two vertices, the smaller first.
using Edge = std::array<std::uint32_t, 2>;

/// Three vertices.
using Triangle = std::array<std::uint32_t, 3>;

/// How many vertices a mesh has, and which of them its triangles join: rows of 3 indices.
struct MeshView {
  std::size_t vertexCount = 0;
  std::span<const std::uint32_t> triangles;
};

/// How many vertices, edges and triangles there are, or come before a mesh.
struct ElementCounts {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t triangles = 0;

  friend constexpr bool operator==(const ElementCounts&, const ElementCounts&) = default;
};

/// The vertices, edges and triangles of one or more triangle meshes, numbered through: those of the first mesh, then
/// those of the second, and so on.
///
/// Triangles keep their order. Edges are unique, ascending by their two vertices. A triangle that names a vertex twice is
/// kept, and gives no edge from that vertex to itself. Vertices that no triangle names are elements too.
/// Bad input: a span that is no rows of 3, or a vertex that the mesh doesn't have, throws InvalidArgument that names mesh
///            and triangle; so do more than 2^32 - 1 elements of a kind.
/// Cost:      O(vertices + triangles); 24 bytes a triangle and 4 a vertex are kept.
/// Threads:   const use from any number of threads.
class MeshTopology {
 public:
  explicit MeshTopology(const MeshView& mesh);
  explicit MeshTopology(std::span<const MeshView> meshes);

  /// No meshes, as in a topology that has been moved from.
  MeshTopology() = default;

  [[nodiscard]] std::size_t meshCount() const noexcept { return m_before.empty() ? 0 : m_before.size() - 1; }

  /// How many elements there are in all.
  [[nodiscard]] const ElementCounts& counts() const noexcept { return m_before.empty() ? kNone : m_before.back(); }

  /// How many elements come before those of a mesh: its first vertex, edge and triangle.
  ///
  /// Bad input: a mesh that isn't there throws InvalidArgument; meshCount() is allowed, and gives counts().
  [[nodiscard]] const ElementCounts& before(std::size_t mesh) const;

  [[nodiscard]] std::span<const Edge> edges() const noexcept { return m_edges; }
  [[nodiscard]] std::span<const Triangle> triangles() const noexcept { return m_triangles; }

  /// The mesh of each vertex; empty where there is only one mesh.
  [[nodiscard]] std::span<const std::uint32_t> meshOfVertex() const noexcept { return m_meshOfVertex; }

 private:
  void add(const MeshView& mesh);
  void extractEdges();

  static constexpr ElementCounts kNone{};

  std::vector<ElementCounts> m_before;  ///< Of each mesh, and of one more; may be empty where there are none.
  std::vector<Edge> m_edges;
  std::vector<Triangle> m_triangles;
  std::vector<std::uint32_t> m_meshOfVertex;
};

}  // namespace allpairs::elements
