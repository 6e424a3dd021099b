// SPDX-License-Identifier: MIT
#include "ElementLists.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "allpairs/collision/TriangleModel.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadInput.h"

namespace allpairs::bench {
namespace {

const collision::TriangleModel& meshOf(const scene::Scene& scene, const std::string& path) {
  const auto* mesh = dynamic_cast<const collision::TriangleModel*>(scene.models.at(0).get());
  if (mesh == nullptr) throw FileError(path, "holds no triangles");
  return *mesh;
}

std::vector<double> numbersOf(const collision::TriangleModel& mesh) {
  std::vector<double> numbers;
  for (const auto& point : mesh.positions()) numbers.insert(numbers.end(), point.begin(), point.end());
  return numbers;
}

float below(double value) {
  const auto nearest = static_cast<float>(value);
  return static_cast<double>(nearest) > value ? std::nextafterf(nearest, -std::numeric_limits<float>::infinity())
                                              : nearest;
}

using Bounds = std::array<double, 6>;

/// Of an element over the step: minima, then maxima.
Bounds boundsOf(const ElementStep& step, std::span<const std::uint32_t> vertices) {
  Bounds bounds{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double min = std::numeric_limits<double>::infinity();
    double max = -min;
    for (const std::uint32_t vertex : vertices) {
      const std::size_t i = 3 * std::size_t{vertex} + axis;
      min = std::min({min, step.start[i], step.end[i]});
      max = std::max({max, step.start[i], step.end[i]});
    }
    bounds[axis] = min;
    bounds[axis + 3] = max;
  }
  return bounds;
}

bool meet(const Bounds& a, const Bounds& b) {
  return a[0] <= b[3] && b[0] <= a[3] && a[1] <= b[4] && b[1] <= a[4] && a[2] <= b[5] && b[2] <= a[5];
}

void addRow(const ElementStep& step, std::span<const std::uint32_t> vertices, std::vector<float>& rows) {
  const Bounds bounds = boundsOf(step, vertices);
  std::array<float, 6> row{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    row[axis] = below(bounds[axis]);
    row[axis + 3] = -below(-bounds[axis + 3]);
  }
  rows.insert(rows.end(), row.begin(), row.end());
}

template <class Element>
std::vector<float> rowsOf(const ElementStep& step, Span<const Element> elements) {
  std::vector<float> rows;
  rows.reserve(6 * elements.size());
  for (const Element& element : elements) addRow(step, element, rows);
  return rows;
}

template <class A, class B>
bool share(const A& a, const B& b) {
  bool shared = false;
  for (const std::uint32_t vertex : a) shared |= std::find(b.begin(), b.end(), vertex) != b.end();
  return shared;
}

}  // namespace

ElementStep readStep(const std::string& start, const std::string& end) {
  const scene::Scene first = scene::readInput(start);
  const scene::Scene last = scene::readInput(end);
  ElementStep step{numbersOf(meshOf(first, start)), numbersOf(meshOf(last, end)), {}};
  for (const auto& t : meshOf(first, start).triangles())
    step.triangles.insert(step.triangles.end(), t.begin(), t.end());
  return step;
}

std::vector<float> vertexRows(const ElementStep& step) {
  std::vector<float> rows;
  for (std::uint32_t v = 0; v < step.start.size() / 3; ++v) addRow(step, std::span(&v, 1), rows);
  return rows;
}

std::vector<float> edgeRows(const ElementStep& step, const elements::MeshTopology& topology) {
  return rowsOf(step, topology.edges());
}

std::vector<float> faceRows(const ElementStep& step, const elements::MeshTopology& topology) {
  return rowsOf(step, topology.triangles());
}

std::vector<Pair> withoutShared(std::span<const Pair> pairs, elements::CandidateKind kind,
                                const elements::MeshTopology& topology) {
  const auto edges = topology.edges();
  const auto faces = topology.triangles();
  std::vector<Pair> kept;
  for (const Pair& pair : pairs) {
    const bool shared = kind == elements::CandidateKind::EdgeEdge   ? share(edges[pair.first], edges[pair.second])
                        : kind == elements::CandidateKind::FaceFace ? share(faces[pair.first], faces[pair.second])
                                                                    : share(std::array{pair.first}, faces[pair.second]);
    if (!shared) kept.push_back(pair);
  }
  return kept;
}

std::vector<Pair> overlapping(std::span<const Pair> pairs, elements::CandidateKind kind, const ElementStep& step,
                              const elements::MeshTopology& topology) {
  const auto firstBounds = [&](std::uint32_t i) {
    return kind == elements::CandidateKind::VertexFace ? boundsOf(step, std::array{i})
           : kind == elements::CandidateKind::EdgeEdge ? boundsOf(step, topology.edges()[i])
                                                       : boundsOf(step, topology.triangles()[i]);
  };
  const auto secondBounds = [&](std::uint32_t i) {
    return kind == elements::CandidateKind::EdgeEdge ? boundsOf(step, topology.edges()[i])
                                                     : boundsOf(step, topology.triangles()[i]);
  };
  std::vector<Pair> kept;
  for (Pair pair : pairs) {
    if (!meet(firstBounds(pair.first), secondBounds(pair.second))) continue;
    if (kind != elements::CandidateKind::VertexFace && pair.first > pair.second) std::swap(pair.first, pair.second);
    kept.push_back(pair);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace allpairs::bench
