// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/graph/Links.h"

namespace allpairs::scene::sofa {
namespace {

using enum ComponentKind;

/// A point in the coordinates of one cell.
struct Coordinates {
  std::size_t cell = 0;
  Vec3 at{};
};

/// The cells that points may be bound to: all of one dimension, triangles before quads and tetrahedra before hexahedra.
///
/// Coordinates of a cell are along the edges from its first corner; a point goes to the cell in whose coordinates it is
/// deepest inside, or if it is in none to the one with the nearest centre. Of a set container only cells near the point
/// count, by the grid that SOFA looks them up in.
class Cells {
 public:
  Cells(Topology& topology, Generation generation)
      : m_flattest(generation == Generation::Sofa20 ? 1e-100 : std::numeric_limits<double>::epsilon()),
        m_tetrahedra(topology.tetrahedra()),
        m_hexahedra(topology.hexahedra()) {
    if (topology.family == Topology::Family::Container) m_sides = topology.edges();
    if (!m_tetrahedra.empty() || !m_hexahedra.empty()) return;
    m_triangles = topology.triangles();
    m_quads = topology.quads();
    if (m_triangles.empty() && m_quads.empty()) m_edges = topology.edges();
  }

  [[nodiscard]] std::size_t count() const {
    return m_tetrahedra.size() + m_hexahedra.size() + m_triangles.size() + m_quads.size() + m_edges.size();
  }
  [[nodiscard]] bool onlyEdges() const { return !m_edges.empty(); }
  [[nodiscard]] bool empty() const { return count() == 0; }
  /// Tetrahedra and triangles give back the point they were given; the others may not.
  [[nodiscard]] bool onlyTetrahedra() const { return !m_tetrahedra.empty() && m_hexahedra.empty(); }

  [[nodiscard]] std::vector<Coordinates> locate(const std::vector<Vec3>& points, const std::vector<Vec3>& in,
                                                const ReadScope& scope) const {
    if (!m_edges.empty()) return locateOnEdges(points, in, scope);
    std::vector<Frame> frames;
    for (const auto& c : m_tetrahedra) frames.push_back(frame(in, c, {c[1], c[2], c[3]}, Shape::Tetrahedron));
    for (const auto& c : m_hexahedra) frames.push_back(frame(in, c, {c[1], c[3], c[4]}, Shape::Hexahedron));
    for (const auto& c : m_triangles) frames.push_back(frame(in, c, {c[1], c[2], c[0]}, Shape::Triangle));
    for (const auto& c : m_quads) frames.push_back(frame(in, c, {c[1], c[3], c[0]}, Shape::Quad));
    const auto reaches = m_sides.empty() ? Reaches{} : reachesIn(in);
    std::vector<Coordinates> result;
    for (const auto& point : points) {
      scope.checkStop();  // A point looks at all cells.
      result.push_back(m_sides.empty() ? nearestOf(frames, point) : nearestInGrid(frames, reaches, point));
    }
    return result;
  }

  [[nodiscard]] Vec3 interpolate(const Coordinates& c, const std::vector<Vec3>& in) const {
    const auto& [x, y, z] = c.at;
    if (!m_edges.empty()) return in[m_edges[c.cell][0]] * (1 - x) + in[m_edges[c.cell][1]] * x;
    if (c.cell < m_tetrahedra.size()) {
      const auto& t = m_tetrahedra[c.cell];
      return in[t[0]] * (1 - x - y - z) + in[t[1]] * x + in[t[2]] * y + in[t[3]] * z;
    }
    if (const auto cell = c.cell - m_tetrahedra.size(); cell < m_hexahedra.size()) {
      const auto& h = m_hexahedra[cell];
      return bilinear(in, {h[0], h[1], h[2], h[3]}, x, y) * (1 - z) + bilinear(in, {h[4], h[5], h[6], h[7]}, x, y) * z;
    }
    if (c.cell < m_triangles.size()) {
      const auto& t = m_triangles[c.cell];
      return in[t[0]] * (1 - x - y) + in[t[1]] * x + in[t[2]] * y;
    }
    return bilinear(in, m_quads[c.cell - m_triangles.size()], x, y);
  }

 private:
  enum class Shape { Tetrahedron, Hexahedron, Triangle, Quad };

  struct Frame {
    Shape shape;
    Vec3 origin;
    Vec3 centre;
    Mat3 toLocal;
  };

  static Vec3 bilinear(const std::vector<Vec3>& in, const std::array<Index, 4>& q, double x, double y) {
    return in[q[0]] * ((1 - x) * (1 - y)) + in[q[1]] * (x * (1 - y)) + in[q[3]] * ((1 - x) * y) + in[q[2]] * (x * y);
  }

  template <std::size_t N>
  Frame frame(const std::vector<Vec3>& in, const std::array<Index, N>& corners, const std::array<Index, 3>& along,
              Shape shape) const {
    Frame result{shape, in[corners[0]], {}, {}};
    for (const auto corner : corners) result.centre = result.centre + in[corner];
    result.centre = result.centre * (1.0 / static_cast<double>(N));
    Mat3 basis{in[along[0]] - result.origin, in[along[1]] - result.origin, in[along[2]] - result.origin};
    if (shape == Shape::Triangle || shape == Shape::Quad) basis.z = cross(basis.x, basis.y);
    const bool isFlat = std::abs(dot(basis.x, cross(basis.y, basis.z))) <= m_flattest;
    result.toLocal = isFlat ? instead(basis) : inverse(basis);
    return result;
  }

  /// What SOFA has where it cannot invert: in containers the edges that it would have inverted, else zero.
  [[nodiscard]] Mat3 instead(const Mat3& m) const {
    if (m_sides.empty()) return {{}, {}, {}};
    return {{m.x[0], m.y[0], m.z[0]}, {m.x[1], m.y[1], m.z[1]}, {m.x[2], m.y[2], m.z[2]}};
  }

  /// How far outside of a cell its own coordinates are, at most zero inside.
  static double outside(Shape shape, const Vec3& v) {
    constexpr double kThickness = 0.01;  // How far off a face, in the length of its normal, still counts as on it.
    switch (shape) {
      case Shape::Tetrahedron:
        return std::max({-v[0], -v[1], -v[2], v[0] + v[1] + v[2] - 1});
      case Shape::Hexahedron:
        return std::max({-v[0], -v[1], -v[2], v[0] - 1, v[1] - 1, v[2] - 1});
      case Shape::Triangle:
        return std::max({-v[0], -v[1], std::abs(v[2]) - kThickness, v[0] + v[1] - 1});
      case Shape::Quad:
        break;
    }
    return std::max({-v[0], -v[1], v[0] - 1, v[1] - 1, std::abs(v[2]) - kThickness});
  }

  /// The best cell so far.
  struct Nearest {
    Coordinates at;
    double distance = std::numeric_limits<double>::max();

    void consider(const std::vector<Frame>& frames, std::size_t cell, const Vec3& point) {
      const auto& frame = frames[cell];
      const auto local = frame.toLocal * (point - frame.origin);
      double candidate = outside(frame.shape, local);
      if (candidate > 0) candidate = dot(point - frame.centre, point - frame.centre);
      if (!(candidate < distance)) return;
      distance = candidate;
      at = {cell, local};
    }
  };

  static Coordinates nearestOf(const std::vector<Frame>& frames, const Vec3& point) {
    Nearest nearest;
    for (std::size_t i = 0; i < frames.size(); ++i) nearest.consider(frames, i, point);
    return nearest.at;
  }

  /// The places of a grid that the box of each cell touches; as wide as the sides of cells are long on average.
  struct Reaches {
    double width = 0;
    std::vector<std::array<Vec3, 2>> boxes;

    [[nodiscard]] Vec3 placeOf(const Vec3& p) const {
      const double perWidth = 1 / width;
      return {std::floor(p[0] * perWidth), std::floor(p[1] * perWidth), std::floor(p[2] * perWidth)};
    }
  };

  [[nodiscard]] Reaches reachesIn(const std::vector<Vec3>& in) const {
    Reaches reaches;
    for (const auto& [a, b] : m_sides) reaches.width += lengthOf(in[a] - in[b]);
    reaches.width /= static_cast<double>(m_sides.size());
    const auto addAll = [&](const auto& cells) {
      for (const auto& corners : cells) {
        std::array<Vec3, std::tuple_size_v<std::decay_t<decltype(corners)>>> points{};
        std::ranges::transform(corners, points.begin(), [&](auto corner) { return in[corner]; });
        const auto [low, high] = boundsOf(points);
        reaches.boxes.push_back({reaches.placeOf(low), reaches.placeOf(high)});
      }
    };
    addAll(m_tetrahedra), addAll(m_hexahedra), addAll(m_triangles), addAll(m_quads);
    return reaches;
  }

  /// The cells that touch a point's place come first; if none is near enough, those that touch the places around it in
  /// the order of these; and all if none touches its own.
  static Coordinates nearestInGrid(const std::vector<Frame>& frames, const Reaches& reaches, const Vec3& point) {
    const auto place = reaches.placeOf(point);
    const auto touching = [&](double around) {
      std::vector<std::pair<Vec3, std::size_t>> found;
      for (std::size_t i = 0; i < reaches.boxes.size(); ++i) {
        const auto& [low, high] = reaches.boxes[i];
        Vec3 first{};
        bool touches = true;
        for (std::size_t axis = 0; axis < 3 && touches; ++axis) {
          touches = low[axis] <= place[axis] + around && high[axis] >= place[axis] - around;
          first[axis] = std::max(low[axis], place[axis] - around);
        }
        if (touches) found.emplace_back(first, i);
      }
      std::ranges::sort(found);
      return found;
    };
    Nearest nearest;
    for (const auto& [first, cell] : touching(0)) nearest.consider(frames, cell, point);
    if (nearest.distance == std::numeric_limits<double>::max()) return nearestOf(frames, point);
    // A squared length, or how deep inside, against a length: so SOFA.
    if (std::abs(nearest.distance) > reaches.width / 2)
      for (const auto& [first, cell] : touching(1)) nearest.consider(frames, cell, point);
    return nearest.at;
  }

  /// The first edge beside which a point lies, or else the last edge.
  [[nodiscard]] std::vector<Coordinates> locateOnEdges(const std::vector<Vec3>& points, const std::vector<Vec3>& in,
                                                       const ReadScope& scope) const {
    std::vector<Coordinates> result;
    for (const auto& point : points) {
      scope.checkStop();
      Coordinates found;
      for (std::size_t e = 0; e < m_edges.size(); ++e) {
        const auto along = in[m_edges[e][1]] - in[m_edges[e][0]];
        found = {e, {dot(along, point - in[m_edges[e][0]]) / dot(along, along), 0, 0}};
        if (found.at[0] >= 0 && found.at[0] <= 1) break;
      }
      result.push_back(found);
    }
    return result;
  }

  double m_flattest;  ///< The largest determinant that SOFA takes for none.
  Elements<4> m_tetrahedra;
  Elements<8> m_hexahedra;
  Elements<3> m_triangles;
  Elements<4> m_quads;
  Elements<2> m_edges;
  Elements<2> m_sides;  ///< Of a set container: its edges, whatever its cells are.
};

/// Through the cells of a regular grid, found by arithmetic; points outside go with the nearest cell.
std::vector<Vec3> throughGrid(const GridShape& grid, const std::vector<Vec3>& in, const std::vector<Vec3>& points) {
  std::vector<Vec3> result;
  for (const auto& point : points) {
    GridPlace cell{};
    Vec3 at{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double local = grid.spacing[axis] != 0 ? (point[axis] - grid.origin[axis]) / grid.spacing[axis] : 0;
      const double last = static_cast<double>(grid.points[axis]) - 2;
      // Where coordinates overflow this is NaN: any cell will do, since the sum is not finite and is refused.
      cell[axis] = static_cast<std::size_t>(clamped(std::floor(local), 0, last));
      at[axis] = local - static_cast<double>(cell[axis]);
    }
    Vec3 sum{};
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const std::size_t dx = corner & 1, dy = (corner >> 1) & 1, dz = corner >> 2;
      const double weight = (dx ? at[0] : 1 - at[0]) * (dy ? at[1] : 1 - at[1]) * (dz ? at[2] : 1 - at[2]);
      sum = sum + in[indexOf(cell + GridPlace{dx, dy, dz}, grid.points)] * weight;
    }
    result.push_back(sum);
  }
  return result;
}

/// A volume of a grid is read by the numbers of its points, whether or not it lists cells of them.
std::size_t pointsRead(const Topology& topology) {
  const auto used = indicesUsed(topology.given);
  if (!topology.grid || !topology.grid->isVolume()) return used;
  const auto& points = topology.grid->points;
  return std::max(used, points[0] * points[1] * points[2]);
}

void checkPointCount(const Component& mapping, const Topology& topology, std::size_t points) {
  if (pointsRead(topology) > points)
    throw Unplaceable(mapping, "the topology of its input has more points than its input's state");
}

/// The states that a mapping reads and writes.
struct MappedStates {
  const State& in;
  const State& child;
};

std::vector<Vec3> throughCells(Evaluation& evaluation, const Component& mapping, const MappedStates& states,
                               const Cells& cells) {
  const auto& [in, child] = states;
  const bool boundAtRest = evaluation.flag(mapping, "useRestPosition", false);
  if (cells.onlyTetrahedra() && !boundAtRest) return child.positions;
  if (cells.empty()) return {};
  if (boundAtRest && in.rest.size() < in.positions.size()) return {};  // no cell is at rest anywhere
  const auto& points = boundAtRest ? child.rest : child.positions;
  takeWork(evaluation, mapping, std::uint64_t{points.size()} * cells.count());
  std::vector<Vec3> result;
  for (const auto& at : cells.locate(points, boundAtRest ? in.rest : in.positions, evaluation.scope()))
    result.push_back(cells.interpolate(at, in.positions));
  return result;
}

/// Whether a state has the points of a sparse grid, all moved as it says.
bool areOf(const Topology& grid, const State& state) {
  if (!state.fromTopology) return false;
  if (grid.unknown || state.pointsUnknown) return grid.unknown && state.pointsUnknown;
  constexpr double kTolerance = 1e-9;  // of coordinates, which were computed in two ways
  const auto& points = grid.given.positions;
  if (points.size() != state.positions.size()) return false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto expected = (*state.fromTopology)(points[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double difference = std::abs(expected[axis] - state.positions[i][axis]);
      if (!(difference <= kTolerance * std::max(1.0, std::abs(expected[axis])))) return false;
    }
  }
  return true;
}

}  // namespace

void takeWork(Evaluation& evaluation, const Component& component, std::uint64_t pairs) {
  evaluation.scope().checkStop();
  if (evaluation.scope().takeWork(pairs)) return;
  throw Unplaceable(
      component, "comparing so many points, elements or components takes too long; a larger --max-memory allows more");
}

std::vector<Vec3> mapBarycentrically(Evaluation& evaluation, const Component& mapping, const Component& parent,
                                     const State& child) {
  const auto* which = mapping.attributes.value("input_topology").empty()
                          ? firstInContext(*parent.node, isTopology)
                          : namedTopology(mapping, "input_topology", *parent.node);
  if (which == nullptr) throw Unplaceable(mapping, "its input has no topology");
  auto& topology = evaluation.topology(*which);
  const auto& in = evaluation.state(parent);
  if (topology.sparse) {
    if (!areOf(topology, in)) throw Unplaceable(mapping, "its sparse grid moves in an unknown way");
    std::vector<Vec3> moved;
    for (const auto& p : child.positions) moved.push_back((*in.fromTopology)(p));
    return moved;
  }
  (void)evaluation.knownState(parent);
  checkPointCount(mapping, topology, in.positions.size());
  if (topology.grid && topology.grid->isVolume()) return throughGrid(*topology.grid, in.positions, child.positions);
  if (topology.grid) {
    evaluation.warn(mapping, "the grid of its input is no volume, and it moves nothing, as in SOFA");
    return child.positions;
  }
  const Cells cells(topology, evaluation.generation());
  // SOFA binds no point to the edges of a container. Which container it is newer SOFA tells by what it has.
  const bool isContainer = topology.family == Topology::Family::Container;
  const bool byElements = isContainer && evaluation.generation() != Generation::Sofa20;
  if (which->kind() == EdgeContainer || (byElements && cells.onlyEdges())) return {};
  return throughCells(evaluation, mapping, {in, child}, cells);
}

}  // namespace allpairs::scene::sofa
