// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "allpairs/Pair.h"
#include "allpairs/elements/ElementCandidates.h"

namespace allpairs::test {

/// A mesh with its positions at the start and at the end of a step, in rows of 3.
struct MovingMesh {
  std::vector<double> start;
  std::vector<double> end;
  std::vector<std::uint32_t> triangles;
};

/// What is to be left out, and how far apart candidates may be.
struct Wanted {
  double distance = 0.0;
  bool within = true;
  bool between = true;
};

/// An element as the oracle sees it: its vertices, numbered through all meshes, its mesh, and its bounds.
struct OracleElement {
  std::set<std::size_t> vertices;
  std::size_t mesh = 0;
  std::array<double, 3> min{};
  std::array<double, 3> max{};
};

/// The double loop over elements that every search for candidates must agree with. Shares no code with the library.
class ElementOracle {
 public:
  explicit ElementOracle(const std::vector<MovingMesh>& meshes) {
    std::size_t first = 0;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
      const std::size_t count = meshes[m].start.size() / 3;
      std::set<std::array<std::size_t, 2>> edges;
      for (std::size_t v = 0; v < count; ++v) m_vertices.push_back(make(meshes[m], m, first, {v}));
      for (std::size_t t = 0; t + 2 < meshes[m].triangles.size(); t += 3) {
        const std::size_t a = meshes[m].triangles[t];
        const std::size_t b = meshes[m].triangles[t + 1];
        const std::size_t c = meshes[m].triangles[t + 2];
        m_faces.push_back(make(meshes[m], m, first, {a, b, c}));
        for (const auto& [p, q] : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) {
          if (p != q) edges.insert({std::min(p, q), std::max(p, q)});
        }
      }
      for (const auto& [p, q] : edges) m_edges.push_back(make(meshes[m], m, first, {p, q}));
      first += count;
    }
  }

  [[nodiscard]] std::vector<Pair> vertexFace(const Wanted& wanted = {}) const {
    return pairs(m_vertices, m_faces, false, wanted);
  }
  [[nodiscard]] std::vector<Pair> edgeEdge(const Wanted& wanted = {}) const {
    return pairs(m_edges, m_edges, true, wanted);
  }
  [[nodiscard]] std::vector<Pair> faceFace(const Wanted& wanted = {}) const {
    return pairs(m_faces, m_faces, true, wanted);
  }

 private:
  static OracleElement make(const MovingMesh& mesh, std::size_t m, std::size_t first, std::set<std::size_t> vertices) {
    OracleElement element;
    element.mesh = m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double> values;
      for (const std::size_t v : vertices) {
        values.push_back(mesh.start[3 * v + axis]);
        values.push_back(mesh.end[3 * v + axis]);
      }
      element.min[axis] = *std::min_element(values.begin(), values.end());
      element.max[axis] = *std::max_element(values.begin(), values.end());
    }
    for (const std::size_t v : vertices) element.vertices.insert(first + v);
    return element;
  }

  static bool isCandidate(const OracleElement& a, const OracleElement& b, const Wanted& wanted) {
    if (a.mesh == b.mesh ? !wanted.within : !wanted.between) return false;
    for (const std::size_t vertex : a.vertices) {
      if (b.vertices.contains(vertex)) return false;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (a.min[axis] > b.max[axis] + wanted.distance || b.min[axis] > a.max[axis] + wanted.distance) return false;
    }
    return true;
  }

  static std::vector<Pair> pairs(const std::vector<OracleElement>& first, const std::vector<OracleElement>& second,
                                 bool one, const Wanted& wanted) {
    std::vector<Pair> found;
    for (std::uint32_t i = 0; i < first.size(); ++i) {
      for (std::uint32_t j = one ? i + 1 : 0; j < second.size(); ++j) {
        if (isCandidate(first[i], second[j], wanted)) found.push_back({i, j});
      }
    }
    return found;
  }

  std::vector<OracleElement> m_vertices;
  std::vector<OracleElement> m_edges;
  std::vector<OracleElement> m_faces;
};

/// The library's search over the same meshes.
inline elements::ElementCandidates candidatesOf(const std::vector<MovingMesh>& meshes,
                                                const elements::CandidateOptions& options = {}) {
  std::vector<elements::MeshView> views;
  for (const MovingMesh& mesh : meshes) views.push_back({mesh.start.size() / 3, mesh.triangles});
  elements::ElementCandidates candidates(elements::MeshTopology(views), options);
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    candidates.setPositions(m, std::span<const double>(meshes[m].start), meshes[m].end);
  }
  return candidates;
}

}  // namespace allpairs::test
