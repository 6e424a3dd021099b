// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>

#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/graph/Links.h"

namespace allpairs::scene::sofa {
namespace {

/// Boxes or spheres, each by a test of its own.
using Regions = std::vector<std::function<bool(const Vec3&)>>;

Regions boxesOf(Evaluation& evaluation, const Component& engine) {
  Regions regions;
  auto given = evaluation.numbers(engine, {"box"}, 6);
  if (!given) given = Numbers{{0, 0, 0, 1, 1, 1}, 6};
  for (std::size_t i = 0; given && i < given->size(); ++i) {
    const auto* v = given->values.data() + 6 * i;
    const Vec3 a{v[0], v[1], v[2]}, b{v[3], v[4], v[5]};
    regions.emplace_back([a, b](const Vec3& p) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (p[axis] < std::min(a[axis], b[axis]) || p[axis] > std::max(a[axis], b[axis])) return false;
      return true;
    });
  }
  return regions;
}

Regions spheresOf(Evaluation& evaluation, const Component& engine) {
  Regions regions;
  const auto centres = evaluation.points(engine, {"centers"});
  const auto radii = evaluation.numbers(engine, {"radii"}, 1);
  if (!radii || radii->size() != centres.size()) throw Unplaceable(engine, "it has not one radius for each centre");
  for (std::size_t i = 0; i < centres.size(); ++i)
    regions.emplace_back(
        [centre = centres[i], radius = radii->values[i]](const Vec3& p) { return !(lengthOf(p - centre) > radius); });
  return regions;
}

/// The lists that the engine was given; of edges, triangles and tetrahedra else those of the topology that it sees.
Mesh inputOf(Evaluation& evaluation, const Component& engine) {
  Mesh mesh = evaluation.elementLists(engine);
  if (!evaluation.isGiven(engine, {"rest_position"})) throw Unplaceable(engine, "it is given no rest_position");
  mesh.positions = evaluation.points(engine, {"rest_position"});
  if (!evaluation.isGiven(engine, {"src"})) {
    const auto* which = firstInContext(*engine.node, isTopology);
    auto* topology = which != nullptr ? &evaluation.topology(*which) : nullptr;
    if (topology != nullptr && topology->sparse) throw Unplaceable(engine, "it reads a sparse grid");
    if (topology != nullptr && !evaluation.isGiven(engine, {"edges"})) mesh.edges = topology->edges();
    if (topology != nullptr && !evaluation.isGiven(engine, {"triangles"})) mesh.triangles = topology->triangles();
    if (topology != nullptr && !evaluation.isGiven(engine, {"tetrahedra"})) mesh.tetrahedra = topology->tetrahedra();
  }
  if (indicesUsed(mesh) > mesh.positions.size())
    throw Unplaceable(engine, "its elements name points that are not there");
  return mesh;
}

/// A mesh in two parts. If each part numbers its points from 0, the points that both parts share have the lowest
/// numbers.
class Parting {
 public:
  Parting(const Mesh& mesh, const Regions& regions, bool renumber, const ReadScope& scope)
      : m_mesh(mesh), m_regions(regions), m_renumber(renumber), m_scope(scope) {
    if (renumber) m_mesh.tetrahedra.empty() ? addBorder(m_mesh.triangles) : addBorder(m_mesh.tetrahedra);
    partPoints();
    part(m_mesh.edges, &Mesh::edges);
    part(m_mesh.triangles, &Mesh::triangles);
    part(m_mesh.quads, &Mesh::quads);
    part(m_mesh.tetrahedra, &Mesh::tetrahedra);
    part(m_mesh.hexahedra, &Mesh::hexahedra);
  }

  Mesh in{};
  Mesh out{};
  std::vector<Index> indices{};  ///< Of the points inside.

 private:
  [[nodiscard]] bool isIn(Index point, std::size_t region) const { return m_regions[region](m_mesh.positions[point]); }

  /// The points inside of elements that are partly inside of the first region.
  template <std::size_t N>
  void addBorder(const Elements<N>& elements) {
    m_isBorder.resize(m_mesh.positions.size());
    for (const auto& corners : elements) {
      const auto inside = std::ranges::count_if(corners, [&](Index c) { return isIn(c, 0); });
      if (inside == 0 || inside == static_cast<std::ptrdiff_t>(N)) continue;
      for (const auto corner : corners)
        if (isIn(corner, 0)) m_isBorder[corner] = true;
    }
  }

  void partPoints() {
    const auto count = static_cast<Index>(m_mesh.positions.size());
    m_numbers.resize(count);
    const auto isBorder = [&](Index i) { return m_renumber && m_isBorder[i]; };
    const auto add = [&](Index i, Mesh& part) {
      m_numbers[i] = static_cast<Index>(part.positions.size());
      part.positions.push_back(m_mesh.positions[i]);
    };
    for (Index i = 0; i < count; ++i)
      if (isBorder(i)) add(i, in), out.positions.push_back(m_mesh.positions[i]), indices.push_back(i);
    for (Index i = 0; i < count; ++i) {
      if (isBorder(i)) continue;
      m_scope.checkStop();
      const bool inside =
          std::ranges::any_of(m_regions, [&](const auto& region) { return region(m_mesh.positions[i]); });
      add(i, inside ? in : out);
      if (inside) indices.push_back(i);
    }
  }

  template <std::size_t N>
  void part(const Elements<N>& elements, Elements<N> Mesh::*list) {
    for (auto corners : elements) {
      bool inside = false;
      m_scope.checkStop();
      for (std::size_t r = 0; r < m_regions.size() && !inside; ++r)
        inside = std::ranges::all_of(corners, [&](Index c) { return isIn(c, r); });
      if (m_renumber)
        for (auto& corner : corners) corner = m_numbers[corner];
      ((inside ? in : out).*list).push_back(corners);
    }
  }

  const Mesh& m_mesh;
  const Regions& m_regions;
  bool m_renumber;
  const ReadScope& m_scope;
  std::vector<bool> m_isBorder;
  std::vector<Index> m_numbers;
};

/// The points that a region chooses from: given, or those at rest of the state or the loader beside it, or of the state
/// above.
Numbers candidatesOf(Evaluation& evaluation, const Component& engine, std::size_t width) {
  if (auto given = evaluation.numbers(engine, {"position"}, width)) return std::move(*given);
  const auto* loader = firstIn(*engine.node, [](const Component& c) { return c.kind() == ComponentKind::MeshLoader; });
  if (loader != nullptr && firstIn(*engine.node, isState) == nullptr)
    return toNumbers(evaluation.mesh(*loader).positions);
  const auto* state = inContext(*engine.node, isState);
  if (state == nullptr) throw Unplaceable(engine, "it has no points to choose from");
  return toNumbers(evaluation.knownState(*state).rest);
}

/// A list that was given to a region, or else to the topology beside it; nothing where that topology derives it.
template <std::size_t N>
std::optional<Elements<N>> choiceOf(Evaluation& evaluation, const Component& engine, std::string_view list,
                                    Elements<N> Mesh::*member) {
  if (evaluation.isGiven(engine, {list, "src"})) return evaluation.elementLists(engine).*member;
  const auto* found = firstIn(*engine.node, isTopology);
  if (found == nullptr) return Elements<N>{};
  const auto& topology = evaluation.topology(*found);
  if (topology.sparse || (topology.given.*member).empty()) return std::nullopt;
  return topology.given.*member;
}

/// Points in any of several boxes, and the elements of which all corners are, or else the middle is.
class Roi {
 public:
  Roi(Evaluation& evaluation, const Component& engine, std::size_t width)
      : m_evaluation(evaluation),
        m_engine(engine),
        m_regions(boxesOf(evaluation, engine)),
        m_candidates(candidatesOf(evaluation, engine, width)),
        m_strict(evaluation.flag(engine, "strict", true)) {
    takeWork(evaluation, engine, std::uint64_t{m_candidates.size()} * m_regions.size());
    for (std::size_t i = 0; i < m_candidates.size(); ++i) m_isIn.push_back(has(position(i)));
  }

  [[nodiscard]] Numbers points(bool inside) const {
    Numbers result{.values = {}, .width = m_candidates.width};
    const auto width = static_cast<std::ptrdiff_t>(m_candidates.width);
    for (std::size_t i = 0; i < m_candidates.size(); ++i) {
      const auto at = m_candidates.values.begin() + static_cast<std::ptrdiff_t>(i) * width;
      if (m_isIn[i] == inside) result.values.insert(result.values.end(), at, at + width);
    }
    return result;
  }

  [[nodiscard]] Numbers indices(bool inside) const {
    Numbers result;
    for (std::size_t i = 0; i < m_candidates.size(); ++i)
      if (m_isIn[i] == inside) result.values.push_back(static_cast<double>(i));
    return result;
  }

  template <std::size_t N>
  [[nodiscard]] std::optional<Numbers> elements(std::string_view list, std::string_view flag, Elements<N> Mesh::*member,
                                                bool inside) const {
    if (!m_evaluation.flag(m_engine, flag, true)) return toNumbers(Elements<N>{});
    const auto all = choiceOf(m_evaluation, m_engine, list, member);
    if (!all) return std::nullopt;
    if (!m_strict) takeWork(m_evaluation, m_engine, std::uint64_t{all->size()} * m_regions.size());
    Elements<N> result;
    for (const auto& element : *all)
      if (hasElement(element) == inside) result.push_back(element);
    return toNumbers(result);
  }

 private:
  [[nodiscard]] std::size_t checked(std::size_t point) const {
    if (point >= m_candidates.size()) throw Unplaceable(m_engine, "its elements name points that are not there");
    return point;
  }

  [[nodiscard]] Vec3 position(std::size_t point) const {
    const auto* v = m_candidates.values.data() + point * m_candidates.width;
    return {v[0], v[1], v[2]};
  }

  [[nodiscard]] bool has(const Vec3& p) const {
    m_evaluation.scope().checkStop();
    return std::ranges::any_of(m_regions, [&](const auto& region) { return region(p); });
  }

  template <std::size_t N>
  [[nodiscard]] bool hasElement(const std::array<Index, N>& corners) const {
    if (m_strict) return std::ranges::all_of(corners, [&](Index c) { return m_isIn[checked(c)]; });
    Vec3 sum{};
    for (const auto corner : corners) sum = sum + position(checked(corner));
    return has({sum[0] / static_cast<double>(N), sum[1] / static_cast<double>(N), sum[2] / static_cast<double>(N)});
  }

  Evaluation& m_evaluation;
  const Component& m_engine;
  Regions m_regions;
  Numbers m_candidates;
  std::vector<bool> m_isIn;  ///< For each candidate.
  bool m_strict;
};

std::optional<Numbers> partOutput(const Mesh& mesh, std::string_view kind) {
  if (kind == "points") return toNumbers(mesh.positions);
  if (kind == "edges") return toNumbers(mesh.edges);
  if (kind == "triangles") return toNumbers(mesh.triangles);
  if (kind == "quads") return toNumbers(mesh.quads);
  if (kind == "tetrahedra") return toNumbers(mesh.tetrahedra);
  if (kind == "hexahedra") return toNumbers(mesh.hexahedra);
  return std::nullopt;
}

}  // namespace

std::optional<Numbers> roiOutput(Evaluation& evaluation, const Component& engine, std::string_view name) {
  const bool isOut = name.ends_with("OutROI"), isIndices = name == "indices" || name == "indicesOut";
  if ((!isOut && !isIndices && !name.ends_with("InROI")) || evaluation.isGiven(engine, {"orientedBox"}))
    return std::nullopt;
  const Roi roi(evaluation, engine, engine.attributes.value("template").starts_with("Rigid") ? 7 : 3);
  if (isIndices) return roi.indices(name == "indices");
  const auto list = name.substr(0, name.size() - std::string_view{isOut ? "OutROI" : "InROI"}.size());
  if (list == "points") return roi.points(!isOut);
  if (list == "edges") return roi.elements(list, "computeEdges", &Mesh::edges, !isOut);
  if (list == "triangles") return roi.elements(list, "computeTriangles", &Mesh::triangles, !isOut);
  if (list == "quads" && !isOut) return roi.elements(list, "computeQuads", &Mesh::quads, true);
  if (list == "tetrahedra") return roi.elements(list, "computeTetrahedra", &Mesh::tetrahedra, !isOut);
  if (list == "hexahedra" && !isOut) return roi.elements(list, "computeHexahedra", &Mesh::hexahedra, true);
  return std::nullopt;
}

std::optional<Numbers> subsetOutput(Evaluation& evaluation, const Component& engine, std::string_view name) {
  const bool isOut = name.ends_with("OutROI"), isIn = name.ends_with("InROI");
  if ((!isIn && !isOut && name != "indices") || evaluation.isGiven(engine, {"tetrahedraInput"})) return std::nullopt;
  const auto regions =
      evaluation.isGiven(engine, {"centers"}) ? spheresOf(evaluation, engine) : boxesOf(evaluation, engine);
  const bool renumber = evaluation.flag(engine, "localIndices", false);
  if (renumber && regions.empty()) return std::nullopt;
  const auto mesh = inputOf(evaluation, engine);
  evaluation.takePoints(engine, mesh.positions.size(), 2);
  const std::uint64_t corners = 2 * mesh.edges.size() + 3 * mesh.triangles.size() +
                                4 * (mesh.quads.size() + mesh.tetrahedra.size()) + 8 * mesh.hexahedra.size();
  takeWork(evaluation, engine, (mesh.positions.size() + corners) * regions.size());
  const Parting parting(mesh, regions, renumber, evaluation.scope());
  if (name == "indices") return Numbers{{parting.indices.begin(), parting.indices.end()}, 1};
  name.remove_suffix(isOut ? std::string_view{"OutROI"}.size() : std::string_view{"InROI"}.size());
  return partOutput(isOut ? parting.out : parting.in, name);
}

}  // namespace allpairs::scene::sofa
