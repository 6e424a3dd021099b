// SPDX-License-Identifier: MIT
#include "allpairs/elements/MeshTopology.h"

#include <algorithm>
#include <limits>
#include <string>

#include "allpairs/Error.h"

namespace allpairs::elements {
namespace {

constexpr std::size_t kMostElements = std::numeric_limits<std::uint32_t>::max();

[[noreturn]] void failIndex(std::size_t mesh, std::size_t triangle, std::uint32_t vertex, std::size_t vertices) {
  throw InvalidArgument("mesh " + std::to_string(mesh) + ": triangle " + std::to_string(triangle) + " names vertex " +
                        std::to_string(vertex) + " of " + std::to_string(vertices));
}

[[noreturn]] void failMesh(std::size_t mesh, std::size_t meshes) {
  throw InvalidArgument("there is no mesh " + std::to_string(mesh) + " among " + std::to_string(meshes));
}

/// The place of each vertex's edges to larger vertices, each as often as triangles name it: place[v] to place[v + 1].
std::vector<std::uint64_t> placesBySmallerVertex(std::span<const Triangle> triangles, std::size_t vertices) {
  std::vector<std::uint64_t> places(vertices + 1);
  for (const Triangle& t : triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = t[corner];
      const std::uint32_t b = t[(corner + 1) % 3];
      places[std::min(a, b)] += a != b ? 1U : 0U;
    }
  }
  std::uint64_t sum = 0;
  for (std::uint64_t& place : places) {
    const std::uint64_t count = place;
    place = sum;
    sum += count;
  }
  return places;
}

/// The larger vertices, sorted by the smaller one. Moves each place to its end, which is where the next one began.
std::vector<std::uint32_t> scatterLargerVertices(std::span<const Triangle> triangles,
                                                 std::vector<std::uint64_t>& places) {
  std::vector<std::uint32_t> larger(places.back());
  for (const Triangle& t : triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = t[corner];
      const std::uint32_t b = t[(corner + 1) % 3];
      if (a != b) larger[places[std::min(a, b)]++] = std::max(a, b);
    }
  }
  return larger;
}

using Place = std::vector<std::uint32_t>::iterator;

/// Sorts a vertex's edges, which are few but for the hub of a fan.
void sortFew(Place begin, Place end) {
  constexpr std::ptrdiff_t kFew = 24;
  if (end - begin > kFew) {
    std::sort(begin, end);
    return;
  }
  for (Place next = begin; next < end; ++next) {
    const std::uint32_t value = *next;
    Place hole = next;
    for (; hole > begin && *(hole - 1) > value; --hole) *hole = *(hole - 1);
    *hole = value;
  }
}

/// Sorts each of the parts of a list, which end at places, and returns how many different numbers they have in all.
std::size_t sortEach(std::vector<std::uint32_t>& numbers, std::span<const std::uint64_t> ends) {
  std::size_t different = 0;
  Place begin = numbers.begin();
  for (const std::uint64_t place : ends) {
    const Place end = numbers.begin() + static_cast<std::ptrdiff_t>(place);
    sortFew(begin, end);
    for (Place next = begin; next != end; ++next) different += next == begin || *next != *(next - 1) ? 1U : 0U;
    begin = end;
  }
  return different;
}

}  // namespace

MeshTopology::MeshTopology(const MeshView& mesh) : MeshTopology(std::span(&mesh, 1)) {}

MeshTopology::MeshTopology(Span<const MeshView> meshes) : m_before(1) {
  for (const MeshView& mesh : meshes) add(mesh);
  extractEdges();
  if (meshes.size() < 2) return;
  m_meshOfVertex.resize(counts().vertices);
  for (std::size_t mesh = 0; mesh < meshCount(); ++mesh) {
    std::fill(m_meshOfVertex.begin() + static_cast<std::ptrdiff_t>(m_before[mesh].vertices),
              m_meshOfVertex.begin() + static_cast<std::ptrdiff_t>(m_before[mesh + 1].vertices),
              static_cast<std::uint32_t>(mesh));
  }
}

const ElementCounts& MeshTopology::before(std::size_t mesh) const {
  if (mesh == meshCount()) return counts();
  if (mesh < m_before.size()) return m_before[mesh];
  failMesh(mesh, meshCount());
}

std::size_t MeshTopology::vertexCount(std::size_t mesh) const {
  if (mesh >= meshCount()) failMesh(mesh, meshCount());
  return m_before[mesh + 1].vertices - m_before[mesh].vertices;
}

void MeshTopology::add(const MeshView& mesh) {
  const std::string name = "mesh " + std::to_string(meshCount());
  if (mesh.triangles.size() % 3 != 0) {
    throw InvalidArgument(name + ": its triangles are " + std::to_string(mesh.triangles.size()) +
                          " indices, which is no multiple of 3");
  }
  ElementCounts next = counts();
  if (mesh.vertexCount > kMostElements - next.vertices || mesh.triangles.size() / 3 > kMostElements - next.triangles) {
    throw InvalidArgument(name + ": more than 2^32 - 1 vertices or triangles in all");
  }
  const auto first = static_cast<std::uint32_t>(next.vertices);
  const std::size_t count = mesh.triangles.size() / 3;
  const std::size_t room = next.triangles + count;
  if (room > m_triangles.capacity()) m_triangles.reserve(std::max(room, 2 * m_triangles.capacity()));
  for (std::size_t t = 0; t < count; ++t) {
    Triangle triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh.triangles[3 * t + corner];
      if (vertex >= mesh.vertexCount) failIndex(meshCount(), t, vertex, mesh.vertexCount);
      triangle[corner] = first + vertex;
    }
    m_triangles.push_back(triangle);
  }
  next.vertices += mesh.vertexCount;
  next.triangles += count;
  m_before.push_back(next);
}

/// A sort by key in two steps: by the smaller vertex in place, and each vertex's few edges by the larger one.
void MeshTopology::extractEdges() {
  std::vector<std::uint64_t> places = placesBySmallerVertex(m_triangles, counts().vertices);
  std::vector<std::uint32_t> larger = scatterLargerVertices(m_triangles, places);
  m_edges.reserve(sortEach(larger, places));
  std::size_t next = 0;
  std::size_t mesh = 0;
  for (std::size_t vertex = 0; vertex < counts().vertices; ++vertex) {
    while (vertex == m_before[mesh + 1].vertices) m_before[++mesh].edges = m_edges.size();
    for (const std::size_t begin = next; next != places[vertex]; ++next) {
      if (next == begin || larger[next] != larger[next - 1]) {
        m_edges.push_back({static_cast<std::uint32_t>(vertex), larger[next]});
      }
    }
  }
  while (++mesh < m_before.size()) m_before[mesh].edges = m_edges.size();
  if (m_edges.size() > kMostElements) throw InvalidArgument("the meshes have more than 2^32 - 1 edges");
}

}  // namespace allpairs::elements
