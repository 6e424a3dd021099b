// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/graph/Links.h"

namespace allpairs::scene::sofa {
namespace {

using enum ComponentKind;

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

/// Points at given coordinates of each point, edge, face and cell of a topology.
class PointMaker {
 public:
  PointMaker(Evaluation& evaluation, const Component& mapping, Topology& from, Topology& to)
      : m_evaluation(evaluation), m_mapping(mapping), m_from(from), m_points(to.given.positions) {}

  void makeAll() {
    const auto onPoints = coordinates("pointBaryCoords", m_from.pointCount);
    for (std::size_t i = 0; i < m_from.pointCount; ++i)
      for (const auto& c : onPoints) m_points.push_back(m_from.position(i) + c);
    make("edgeBaryCoords", m_from.edges(),
         [](const auto& p, const Vec3& c) { return p[0] * (1 - c[0]) + p[1] * c[0]; });
    make("triangleBaryCoords", m_from.triangles(),
         [](const auto& p, const Vec3& c) { return p[0] * (1 - c[0] - c[1]) + p[1] * c[0] + p[2] * c[1]; });
    make("quadBaryCoords", m_from.quads(), [](const auto& p, const Vec3& c) {
      // SOFA takes the corners row by row here, though they go round.
      return p[0] * ((1 - c[0]) * (1 - c[1])) + p[1] * (c[0] * (1 - c[1])) + p[2] * ((1 - c[0]) * c[1]) +
             p[3] * (c[0] * c[1]);
    });
    make("tetraBaryCoords", m_from.tetrahedra(), [](const auto& p, const Vec3& c) {
      return p[0] * (1 - c[0] - c[1] - c[2]) + p[1] * c[0] + p[2] * c[1] + p[3] * c[2];
    });
    make("hexaBaryCoords", m_from.hexahedra(), inCube);
  }

 private:
  static Vec3 inCube(const std::array<Vec3, 8>& p, const Vec3& c) {
    constexpr std::array<std::size_t, 8> kRowByRow{0, 1, 3, 2, 4, 5, 7, 6};
    Vec3 sum{};
    for (std::size_t i = 0; i < 8; ++i) {
      const double x = i & 1 ? c[0] : 1 - c[0], y = i & 2 ? c[1] : 1 - c[1], z = i & 4 ? c[2] : 1 - c[2];
      const auto part = p[kRowByRow[i]] * (x * y * z);
      sum = i == 0 ? part : sum + part;
    }
    return sum;
  }

  [[nodiscard]] std::vector<Vec3> coordinates(std::string_view data, std::size_t elements) {
    auto result = m_evaluation.points(m_mapping, {data});
    m_evaluation.takePoints(m_mapping, std::uint64_t{result.size()} * elements);
    return result;
  }

  template <std::size_t N, class Place>
  void make(std::string_view data, const Elements<N>& elements, const Place& place) {
    const auto all = coordinates(data, elements.size());
    for (const auto& element : elements) {
      std::array<Vec3, N> corners{};
      for (std::size_t i = 0; i < N; ++i) corners[i] = m_from.position(element[i]);
      for (const auto& c : all) m_points.push_back(place(corners, c));
    }
  }

  Evaluation& m_evaluation;
  const Component& m_mapping;
  Topology& m_from;
  std::vector<Vec3>& m_points;
};

template <std::size_t N>
void copyRenumbered(const Elements<N>& from, std::size_t step, Elements<N>& to) {
  for (auto element : from) {
    for (auto& corner : element) corner = static_cast<Index>(corner * step);
    to.push_back(element);
  }
}

void makePoints(Evaluation& evaluation, const Component& mapping, Topology& from, Topology& to) {
  PointMaker(evaluation, mapping, from, to).makeAll();
  to.pointCount = to.given.positions.size();
  to.hasPositions = to.pointCount > 0;
  const auto step = evaluation.points(mapping, {"pointBaryCoords"}).size();
  if (step == 0) return;
  if (evaluation.flag(mapping, "copyEdges", false)) copyRenumbered(from.edges(), step, to.given.edges);
  if (evaluation.flag(mapping, "copyTriangles", false)) copyRenumbered(from.triangles(), step, to.given.triangles);
  if (evaluation.flag(mapping, "copyTetrahedra", false)) copyRenumbered(from.tetrahedra(), step, to.given.tetrahedra);
}

void fill(Evaluation& evaluation, const Component& mapping, Topology& from, Topology& to) {
  switch (mapping.kind()) {
    case Tetra2Triangle:
      if (!evaluation.flag(mapping, "noInitialTriangles", false))
        to.given.triangles = borderOf(from.triangles(), from.tetrahedra());
      break;
    case Hexa2Quad:
      to.given.quads = borderOf(from.quads(), from.hexahedra());
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
    case Mesh2Point:
      makePoints(evaluation, mapping, from, to);
      break;
    default:
      throw Unplaceable(mapping, "this kind of topological mapping is not known to this reader");
  }
}

/// The kind of container that a topology counts as: its own, or that of the highest elements in it.
ComponentKind kindOf(const Component& component, const Topology& topology) {
  if (topology.family == Topology::Family::Container) return component.kind();
  const auto& given = topology.given;
  if (!given.hexahedra.empty()) return HexahedronContainer;
  if (!given.tetrahedra.empty()) return TetrahedronContainer;
  if (!given.quads.empty()) return QuadContainer;
  if (!given.triangles.empty()) return TriangleContainer;
  return given.edges.empty() ? PointContainer : EdgeContainer;
}

struct ElementKind {
  ComponentKind container;
  std::string_view elements;
  std::string_view modifier;
};

constexpr std::array<ElementKind, 5> kElementKinds{
    {{EdgeContainer, "edges", "EdgeSetTopologyModifier"},
     {TriangleContainer, "triangles", "TriangleSetTopologyModifier"},
     {QuadContainer, "quads", "QuadSetTopologyModifier"},
     {TetrahedronContainer, "tetrahedra", "TetrahedronSetTopologyModifier"},
     {HexahedronContainer, "hexahedra", "HexahedronSetTopologyModifier"}}};

const ElementKind& elementsOf(ComponentKind container) {
  return *std::ranges::find(kElementKinds, container, &ElementKind::container);
}

/// What SOFA asks of a mapping before it carries it out.
struct Conditions {
  std::optional<ComponentKind> input;
  std::optional<ComponentKind> output;
  std::optional<ComponentKind> modifier;  ///< In the node of the output or above.
};

Conditions conditionsOf(ComponentKind mapping, Generation generation) {
  const bool isNew = generation == Generation::Sofa26;
  const auto onlyNew = [&](ComponentKind kind) { return isNew ? std::optional{kind} : std::nullopt; };
  const auto onlyOld = [&](ComponentKind kind) { return isNew ? std::nullopt : std::optional{kind}; };
  switch (mapping) {
    case Hexa2Quad:
      return {onlyNew(HexahedronContainer), QuadContainer, QuadContainer};
    case Quad2Triangle:
      return {onlyNew(QuadContainer), TriangleContainer, TriangleContainer};
    case Triangle2Edge:
      return {onlyNew(TriangleContainer), onlyNew(EdgeContainer), EdgeContainer};
    case Tetra2Triangle:
      return {{}, onlyOld(TriangleContainer), onlyOld(TriangleContainer)};
    case Hexa2Tetra:
      return {{}, {}, onlyOld(TetrahedronContainer)};
    default:
      return {};
  }
}

bool hasModifier(const Node& node, ComponentKind container) {
  const auto isModifier = [container](const Component& component) {
    return std::ranges::any_of(kElementKinds, [&](const ElementKind& kind) {
      return component.type.ends_with(kind.modifier) && canHold(kind.container, container);
    });
  };
  return inContext(node, isModifier) != nullptr;
}

/// Why SOFA refuses a mapping from one topology to another; empty if it doesn't.
std::string refusalOf(Evaluation& evaluation, const Component& mapping, const Component& input,
                      const Component& target) {
  const bool isNew = evaluation.generation() == Generation::Sofa26;
  const auto conditions = conditionsOf(mapping.kind(), evaluation.generation());
  if (conditions.input && kindOf(input, evaluation.topology(input)) != *conditions.input)
    return "its input is no topology of " + std::string{elementsOf(*conditions.input).elements};
  const bool isMesh = isNew && target.kind() == MeshTopology;
  const auto kind = isMesh ? kindOf(target, buildTopology(evaluation, target)) : target.kind();
  if (conditions.output && kind != *conditions.output && (isNew || !canHold(kind, *conditions.output)))
    return "its output is no topology of " + std::string{elementsOf(*conditions.output).elements};
  if (conditions.modifier && !hasModifier(*target.node, *conditions.modifier))
    return "there is no " + std::string{elementsOf(*conditions.modifier).modifier} +
           " in the node of its output or above";
  return {};
}

}  // namespace

Topology mapTopology(Evaluation& evaluation, const Component& mapping, const Component& target) {
  const auto* input = mappingInput(mapping, isTopology);
  if (input == nullptr) throw Unplaceable(mapping, "the topology that it reads is nowhere to be found");
  if (input == &target) throw Unplaceable(mapping, "it reads the topology that it writes");
  auto& from = evaluation.topology(*input);
  if (from.unknown || (from.sparse && (mapping.kind() != Hexa2Tetra || evaluation.flag(mapping, "swapping", false))))
    throw Unplaceable(mapping, "the cells of a sparse grid are not known to this reader");
  if (const auto refusal = refusalOf(evaluation, mapping, *input, target); !refusal.empty()) {
    evaluation.warn(mapping, "SOFA refuses it, and it is left out: " + refusal);
    return buildTopology(evaluation, target);
  }
  Topology to;
  to.family = target.kind() == MeshTopology ? Topology::Family::Mesh : Topology::Family::Container;
  to.pointCount = from.pointCount;
  fill(evaluation, mapping, from, to);
  return to;
}

}  // namespace allpairs::scene::sofa
