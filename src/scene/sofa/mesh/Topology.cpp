// SPDX-License-Identifier: MIT
#include "sofa/mesh/Topology.h"

#include <algorithm>
#include <span>
#include <unordered_map>
#include <unordered_set>

namespace allpairs::scene::sofa {
namespace {

template <std::size_t N>
struct CornersHash {
  std::size_t operator()(const std::array<Index, N>& corners) const {
    std::size_t hash = 0;
    for (const auto corner : corners) hash = (hash ^ corner) * 0x9E3779B97F4A7C15U;  // 2^64 over the golden ratio.
    return hash ^ (hash >> 29);
  }
};

template <std::size_t N>
using Seen = std::unordered_set<std::array<Index, N>, CornersHash<N>>;
template <std::size_t N>
using Counts = std::unordered_map<std::array<Index, N>, std::size_t, CornersHash<N>>;

/// Collects edges, each once, whichever way round it comes.
class EdgeCollector {
 public:
  void addSorted(Index a, Index b) {
    const auto edge = sorted<2>({a, b});
    if (m_seen.insert(edge).second) edges.push_back(edge);
  }
  void addAsIs(Index a, Index b) {
    if (m_seen.insert(sorted<2>({a, b})).second) edges.push_back({a, b});
  }

  Elements<2> edges;

 private:
  Seen<2> m_seen;
};

constexpr std::size_t kTetrahedronEdges[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
constexpr std::size_t kHexahedronEdges[12][2] = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                                                 {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
constexpr std::size_t kHexahedronFaces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

void collect(EdgeCollector& into, const Elements<4>& tetrahedra, const Elements<8>& hexahedra) {
  for (const auto& t : tetrahedra)
    for (const auto& [a, b] : kTetrahedronEdges) into.addSorted(t[a], t[b]);
  for (const auto& h : hexahedra)
    for (const auto& [a, b] : kHexahedronEdges) into.addSorted(h[a], h[b]);
}

void collect(EdgeCollector& into, const Elements<3>& triangles) {
  for (const auto& t : triangles)
    for (std::size_t j = 0; j < 3; ++j) into.addAsIs(t[(j + 1) % 3], t[(j + 2) % 3]);
}

void collectQuads(EdgeCollector& into, const Elements<4>& quads) {
  for (const auto& q : quads)
    for (std::size_t j = 0; j < 4; ++j) into.addSorted(q[(j + 1) % 4], q[(j + 2) % 4]);
}

std::array<Index, 3> faceOf(const std::array<Index, 4>& t, std::size_t j) {
  std::array<Index, 3> face{t[(j + 1) % 4], t[(j + 2) % 4], t[(j + 3) % 4]};
  if (j % 2 == 0) std::swap(face[1], face[2]);
  std::ranges::rotate(face, std::ranges::min_element(face));
  return face;
}

std::array<Index, 4> faceOf(const std::array<Index, 8>& h, std::size_t j) {
  const auto& corners = kHexahedronFaces[j];
  std::array<Index, 4> face{h[corners[0]], h[corners[1]], h[corners[2]], h[corners[3]]};
  std::ranges::rotate(face, std::ranges::min_element(face));
  return face;
}

template <std::size_t N>
std::size_t indicesUsed(const Elements<N>& elements) {
  std::size_t used = 0;
  for (const auto& corners : elements)
    for (const auto corner : corners) used = std::max(used, std::size_t{corner} + 1);
  return used;
}

template <std::size_t N>
Elements<N> onlyOnce(const Elements<N>& elements, const Counts<N>& counts) {
  Elements<N> result;
  for (const auto& corners : elements)
    if (const auto found = counts.find(sorted(corners)); found != counts.end() && found->second == 1)
      result.push_back(corners);
  return result;
}

}  // namespace

std::size_t indicesUsed(const Mesh& mesh) {
  return std::max({indicesUsed(mesh.edges), indicesUsed(mesh.triangles), indicesUsed(mesh.quads),
                   indicesUsed(mesh.tetrahedra), indicesUsed(mesh.hexahedra)});
}

Elements<3> facesOf(const Elements<4>& tetrahedra, SameWayRound sameWayRound) {
  Elements<3> faces;
  Seen<3> seen;
  for (const auto& tetrahedron : tetrahedra)
    for (std::size_t j = 0; j < 4; ++j) {
      const auto face = faceOf(tetrahedron, j);
      if (seen.contains({face[0], face[2], face[1]})) continue;
      if (seen.insert(face).second || sameWayRound == SameWayRound::Twice) faces.push_back(face);
    }
  return faces;
}

Elements<4> facesOf(const Elements<8>& hexahedra) {
  Elements<4> faces;
  Seen<4> seen;
  for (const auto& hexahedron : hexahedra)
    for (std::size_t j = 0; j < 6; ++j) {
      const auto face = faceOf(hexahedron, j);
      if (seen.insert(sorted(face)).second) faces.push_back(face);
    }
  return faces;
}

Elements<3> borderOf(const Elements<3>& triangles, const Elements<4>& tetrahedra) {
  Counts<3> counts;
  for (const auto& tetrahedron : tetrahedra)
    for (std::size_t j = 0; j < 4; ++j) ++counts[sorted(faceOf(tetrahedron, j))];
  return onlyOnce(triangles, counts);
}

Elements<4> borderOf(const Elements<4>& quads, const Elements<8>& hexahedra) {
  Counts<4> counts;
  for (const auto& hexahedron : hexahedra)
    for (std::size_t j = 0; j < 6; ++j) ++counts[sorted(faceOf(hexahedron, j))];
  return onlyOnce(quads, counts);
}

Elements<2> borderOf(const Elements<2>& edges, const Elements<3>& triangles) {
  Counts<2> counts;
  for (const auto& t : triangles)
    for (std::size_t j = 0; j < 3; ++j) ++counts[sorted<2>({t[j], t[(j + 1) % 3]})];
  return onlyOnce(edges, counts);
}

const Elements<3>& Topology::triangles() {
  if (!given.triangles.empty() || given.tetrahedra.empty()) return given.triangles;
  if (family == Family::Container && pointCount == 0) return given.triangles;
  const auto sameWayRound = family == Family::Mesh ? SameWayRound::Twice : SameWayRound::Once;
  if (!m_triangles) m_triangles = facesOf(given.tetrahedra, sameWayRound);
  return *m_triangles;
}

const Elements<4>& Topology::quads() {
  if (!given.quads.empty() || given.hexahedra.empty()) return given.quads;
  if (family == Family::Container && pointCount == 0) return given.quads;
  if (!m_quads) m_quads = facesOf(given.hexahedra);
  return *m_quads;
}

const Elements<2>& Topology::edges() {
  if (family == Family::Container && pointCount == 0) return given.edges;
  const bool mayLack = family == Family::Container && !given.tetrahedra.empty();
  if (!given.edges.empty() && !mayLack) return given.edges;
  if (m_edges) return *m_edges;
  m_edges = derivedEdges();
  if (!given.edges.empty()) completeEdges(*m_edges);
  return *m_edges;
}

/// Containers of tetrahedra keep the edges that they were given; if one of a tetrahedron is not among them, they add
/// those of all tetrahedra, the given ones once more.
void Topology::completeEdges(Elements<2>& derived) const {
  Seen<2> known;
  for (const auto& edge : given.edges) known.insert(sorted(edge));
  const bool isComplete = std::ranges::all_of(derived, [&](const auto& edge) { return known.contains(edge); });
  if (isComplete) derived.clear();
  derived.insert(derived.begin(), given.edges.begin(), given.edges.end());
}

Elements<2> Topology::derivedEdges() {
  EdgeCollector collector;
  if (!given.tetrahedra.empty() || !given.hexahedra.empty()) {
    collect(collector, given.tetrahedra, given.hexahedra);
  } else {
    collect(collector, triangles());
    collectQuads(collector, quads());
  }
  return std::move(collector.edges);
}

Vec3 Topology::position(std::size_t index) const {
  return index < given.positions.size() ? given.positions[index] : Vec3{};
}

namespace {

constexpr GridPlace kSteps[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// The points of a grid, and the visits to all from which so many steps are left on each axis.
struct GridPoints {
  GridPlace count;

  [[nodiscard]] Index at(const GridPlace& point) const { return static_cast<Index>(indexOf(point, count)); }

  template <class Visit>
  void forAll(const GridPlace& steps, const Visit& visit) const {
    GridPlace left{};
    for (std::size_t axis = 0; axis < 3; ++axis) left[axis] = count[axis] - std::min(steps[axis], count[axis]);
    forAllPlaces(left, visit);
  }
};

void addQuads(const GridPoints& grid, const GridPlace& u, const GridPlace& v, Elements<4>& quads) {
  grid.forAll(u + v, [&](const GridPlace& p) {
    quads.push_back({grid.at(p), grid.at(p + u), grid.at(p + u + v), grid.at(p + v)});
  });
}

Elements<2> edgesAlongAxes(const GridPoints& grid) {
  Elements<2> edges;
  for (const auto& s : kSteps)
    grid.forAll(s, [&](const GridPlace& p) { edges.push_back({grid.at(p), grid.at(p + s)}); });
  return edges;
}

Elements<2> edgesOf(const Elements<3>& triangles) {
  EdgeCollector collector;
  collect(collector, triangles);
  return std::move(collector.edges);
}

Elements<8> cubesOf(const GridPoints& grid) {
  Elements<8> cubes;
  grid.forAll({1, 1, 1}, [&](const GridPlace& p) {
    auto& cube = cubes.emplace_back();
    for (std::size_t i = 0; i < 8; ++i) cube[i] = grid.at(p + kCellCorners[i]);
  });
  return cubes;
}

}  // namespace

void fillGrid(Topology& topology, const GridPlace& points, const GridLists& lists) {
  const GridPoints grid{points};
  auto& mesh = topology.given;
  if (lists.quads || lists.triangles) {
    addQuads(grid, kSteps[0], kSteps[1], mesh.quads);
    addQuads(grid, kSteps[0], kSteps[2], mesh.quads);
    addQuads(grid, kSteps[1], kSteps[2], mesh.quads);
  }
  if (lists.triangles) addHalves(mesh.quads, mesh.triangles);
  if (lists.cubes) mesh.hexahedra = cubesOf(grid);
  if (lists.edges)
    mesh.edges = lists.diagonals && !mesh.triangles.empty() ? edgesOf(mesh.triangles) : edgesAlongAxes(grid);
}

}  // namespace allpairs::scene::sofa
