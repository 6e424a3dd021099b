// SPDX-License-Identifier: MIT
#include <algorithm>

#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/graph/Links.h"

namespace allpairs::scene::sofa {
namespace {

using enum ComponentKind;

const Component* inputOf(const Component& mapping) {
  const auto* text = mapping.attributes.find("input");
  if (text == nullptr) text = mapping.attributes.find("object1");
  return followTo(mapping, text != nullptr ? *text : "@../", [](const Component& c) { return isTopology(c.kind()); });
}

/// Cuts each cube into six tetrahedra; with `swapping`, neighbours in a grid are cut as mirror images.
Elements<4> cutCubes(const Topology& from, bool swapping) {
  Elements<4> tetrahedra;
  const auto nx = std::max<std::size_t>(from.cells[0], 1), ny = std::max<std::size_t>(from.cells[1], 1);
  const auto& cubes = from.hexahedra();
  for (std::size_t i = 0; i < cubes.size(); ++i) {
    auto c = cubes[i];
    bool mirrored = false;
    const auto mirror = [&](std::initializer_list<std::array<std::size_t, 2>> pairs) {
      for (const auto& [a, b] : pairs) std::swap(c[a], c[b]);
      mirrored = !mirrored;
    };
    if (swapping && (i % nx) % 2 == 0) mirror({{0, 1}, {3, 2}, {4, 5}, {7, 6}});
    if (swapping && (i / nx % ny) % 2 == 1) mirror({{0, 3}, {1, 2}, {4, 7}, {5, 6}});
    if (swapping && (i / (nx * ny)) % 2 == 1) mirror({{0, 4}, {1, 5}, {2, 6}, {3, 7}});
    if (!mirrored)
      tetrahedra.insert(tetrahedra.end(), {{c[0], c[5], c[1], c[6]},
                                           {c[0], c[1], c[3], c[6]},
                                           {c[1], c[3], c[6], c[2]},
                                           {c[6], c[3], c[0], c[7]},
                                           {c[6], c[7], c[0], c[5]},
                                           {c[7], c[5], c[4], c[0]}});
    else
      tetrahedra.insert(tetrahedra.end(), {{c[0], c[5], c[6], c[1]},
                                           {c[0], c[1], c[6], c[3]},
                                           {c[1], c[3], c[2], c[6]},
                                           {c[6], c[3], c[7], c[0]},
                                           {c[6], c[7], c[5], c[0]},
                                           {c[7], c[5], c[0], c[4]}});
  }
  return tetrahedra;
}

/// Cuts each quad in two, along diagonals that alternate in a grid.
Elements<3> cutQuads(Topology& from) {
  Elements<3> triangles;
  const std::size_t row = std::max<std::size_t>(from.cells[0] != 0 ? from.cells[0] : from.cells[1], 1);
  const auto& quads = from.quads();
  for (std::size_t i = 0; i < quads.size(); ++i) {
    const auto& q = quads[i];
    if (((i % row) ^ (i / row)) & 1) {
      triangles.push_back({q[0], q[1], q[3]});
      triangles.push_back({q[2], q[3], q[1]});
    } else {
      triangles.push_back({q[1], q[2], q[0]});
      triangles.push_back({q[3], q[0], q[2]});
    }
  }
  return triangles;
}

void fill(Evaluation& evaluation, const Component& mapping, Topology& from, Topology& to) {
  switch (mapping.kind()) {
    case Tetra2Triangle:
      if (!evaluation.flag(mapping, "noInitialTriangles", false))
        to.given.triangles = borderOf(from.triangles(), from.tetrahedra());
      break;
    case Hexa2Quad:
      to.given.quads = borderOf(from.quads(), from.hexahedra());
      evaluation.takePoints(mapping, from.pointCount);
      for (std::size_t i = 0; i < from.pointCount; ++i) to.given.positions.push_back(from.position(i));
      to.hasPositions = from.pointCount > 0;
      break;
    case Quad2Triangle:
      to.given.triangles = cutQuads(from);
      break;
    case Hexa2Tetra:
      to.given.tetrahedra = cutCubes(from, evaluation.flag(mapping, "swapping", false));
      break;
    case Triangle2Edge:
      to.given.edges = borderOf(from.edges(), from.triangles());
      break;
    default:
      throw Unplaceable(mapping, "this kind of topological mapping is not known to this reader");
  }
}

}  // namespace

Topology mapTopology(Evaluation& evaluation, const Component& mapping, const Component& target) {
  const auto* input = inputOf(mapping);
  if (input == nullptr) throw Unplaceable(mapping, "the topology that it reads is nowhere to be found");
  if (input == &target) throw Unplaceable(mapping, "it reads the topology that it writes");
  auto& from = evaluation.topology(*input);
  if (from.unknown || (from.sparse && (mapping.kind() != Hexa2Tetra || evaluation.flag(mapping, "swapping", false))))
    throw Unplaceable(mapping, "the cells of a sparse grid are not known to this reader");
  Topology to;
  to.family = target.kind() == MeshTopology ? Topology::Family::Mesh : Topology::Family::Container;
  to.pointCount = from.pointCount;
  fill(evaluation, mapping, from, to);
  return to;
}

}  // namespace allpairs::scene::sofa
