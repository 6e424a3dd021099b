// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "allpairs/DebugMode.h"
#include "allpairs/Span.h"

namespace allpairs::elements {

/// Two vertices, the smaller first.
using Edge = std::array<std::uint32_t, 2>;

/// Three vertices.
using Triangle = std::array<std::uint32_t, 3>;

/// The number of vertices of a mesh, and the vertices of its triangles in rows of 3 indices.
struct MeshView {
  std::size_t vertexCount = 0;
  Span<const std::uint32_t> triangles;
};

/// The number of vertices, edges and triangles, in all or before a mesh.
struct ElementCounts {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t triangles = 0;

  friend constexpr bool operator==(const ElementCounts& a, const ElementCounts& b) {
    return a.vertices == b.vertices && a.edges == b.edges && a.triangles == b.triangles;
  }
  friend constexpr bool operator!=(const ElementCounts& a, const ElementCounts& b) { return !(a == b); }
};

/// The vertices, edges and triangles of one or more triangle meshes, numbered consecutively: those of the first mesh,
/// then those of the second, and so on.
///
/// Triangles keep their order. Edges are unique, ascending by their two vertices. A triangle with a repeated vertex is
/// kept, and gives no edge from that vertex to itself. Vertices without triangles are elements too.
/// Bad input: a span that is not rows of 3, or a vertex out of range, throws InvalidArgument, which names mesh and
///            triangle; so do more than 2^32 - 1 elements of a kind.
/// Cost:      O(vertices + triangles); 12 bytes a triangle, 8 an edge and 4 a vertex are kept.
/// Threads:   const use from any number of threads.
class MeshTopology {
 public:
  explicit MeshTopology(const MeshView& mesh);
  explicit MeshTopology(Span<const MeshView> meshes);

  /// No meshes, like a moved-from topology.
  MeshTopology() = default;

  [[nodiscard]] std::size_t meshCount() const noexcept { return m_before.empty() ? 0 : m_before.size() - 1; }

  /// The number of all elements.
  [[nodiscard]] const ElementCounts& counts() const noexcept { return m_before.empty() ? kNone : m_before.back(); }

  /// The number of elements before those of a mesh: its first vertex, edge and triangle.
  ///
  /// Bad input: a mesh out of range throws InvalidArgument; meshCount() is allowed, and gives counts().
  [[nodiscard]] const ElementCounts& before(std::size_t mesh) const;

  /// The number of vertices of a mesh.
  ///
  /// Bad input: a mesh out of range throws InvalidArgument.
  [[nodiscard]] std::size_t vertexCount(std::size_t mesh) const;

  [[nodiscard]] Span<const Edge> edges() const noexcept { return m_edges; }
  [[nodiscard]] Span<const Triangle> triangles() const noexcept { return m_triangles; }

  /// The mesh of each vertex; empty where there is only one mesh.
  [[nodiscard]] Span<const std::uint32_t> meshOfVertex() const noexcept { return m_meshOfVertex; }

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
