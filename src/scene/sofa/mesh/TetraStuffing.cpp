// SPDX-License-Identifier: MIT
#include "sofa/mesh/TetraStuffing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "sofa/mesh/LineCaster.h"

namespace allpairs::scene::sofa {
namespace {

using LatticePlace = std::array<int, 3>;
using FourPoints = std::array<int, 4>;

constexpr int kNone = -1;
constexpr int kAxisEdges =
    6;  // To the neighbours in the same grid, two along each axis; the others lead to the other grid.
constexpr int kEdges = 14;  // Of a point; edges 2k and 2k + 1 go opposite ways.

double volume(const std::vector<Vec3>& points, const FourPoints& t) {
  const auto side = [&](std::size_t i) {
    return points[static_cast<std::size_t>(t[i])] - points[static_cast<std::size_t>(t[0])];
  };
  return dot(side(1), cross(side(2), side(3)));
}

/// A grid of points, and another one of the middles of its cells, one point longer to each side.
class Lattice {
 public:
  Lattice(const Box& box, double size) : m_size(size) {
    const Vec3 middle = middleOf(box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double down = cells(middle[axis] - box.min[axis], size), up = cells(box.max[axis] - middle[axis], size);
      m_firstCount[axis] = static_cast<int>(std::min(up + down + 1, kMostPoints));
      m_secondCount[axis] = m_firstCount[axis] + 1;
      m_first[axis] = middle[axis] + -down * size;
      m_second[axis] = m_first[axis] - size / 2;
    }
  }

  [[nodiscard]] static double pointsIn(const Box& box, double size) {
    const Vec3 middle = middleOf(box);
    double product = 2;
    for (std::size_t axis = 0; axis < 3; ++axis)
      product *= cells(middle[axis] - box.min[axis], size) + cells(box.max[axis] - middle[axis], size) + 2;
    return product;
  }

  [[nodiscard]] int firstPoints() const { return m_firstCount[0] * m_firstCount[1] * m_firstCount[2]; }
  [[nodiscard]] const LatticePlace& firstCount() const { return m_firstCount; }
  [[nodiscard]] const LatticePlace& secondCount() const { return m_secondCount; }

  [[nodiscard]] std::vector<Vec3> points() const {
    std::vector<Vec3> points;
    for (const auto& [count, origin] : {std::pair{m_firstCount, m_first}, std::pair{m_secondCount, m_second}})
      for (int z = 0; z < count[2]; ++z)
        for (int y = 0; y < count[1]; ++y)
          for (int x = 0; x < count[0]; ++x) points.push_back(origin + Vec3{x * m_size, y * m_size, z * m_size});
    return points;
  }

  /// The point at the other end of an edge, or none.
  [[nodiscard]] int neighbour(int point, int edge) const {
    const bool isFirst = point < firstPoints();
    LatticePlace at = place(isFirst ? point : point - firstPoints(), isFirst ? m_firstCount : m_secondCount);
    if (edge < kAxisEdges) {
      at[static_cast<std::size_t>(edge / 2)] += edge % 2 == 1 ? 1 : -1;
      return number(at, isFirst);
    }
    const auto bits = static_cast<unsigned>(edge - kAxisEdges);
    const unsigned steps[3] = {bits & 1U, (bits ^ (bits >> 1U)) & 1U, (bits ^ (bits >> 2U)) & 1U};
    for (std::size_t axis = 0; axis < 3; ++axis) at[axis] += static_cast<int>(steps[axis]) - (isFirst ? 0 : 1);
    return number(at, !isFirst);
  }

 private:
  static constexpr double kMostPoints = 1e6;  // On an axis; more would have been refused before.

  [[nodiscard]] static Vec3 middleOf(const Box& box) {
    const Vec3 sum = box.min + box.max;
    return {sum[0] / 2, sum[1] / 2, sum[2] / 2};
  }

  [[nodiscard]] static double cells(double length, double size) { return std::trunc(length / size) + 2; }

  [[nodiscard]] static LatticePlace place(int point, const LatticePlace& count) {
    return {point % count[0], point / count[0] % count[1], point / count[0] / count[1]};
  }

  [[nodiscard]] int number(const LatticePlace& at, bool inFirst) const {
    const auto& count = inFirst ? m_firstCount : m_secondCount;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (at[axis] < 0 || at[axis] >= count[axis]) return kNone;
    return at[0] + count[0] * (at[1] + count[1] * at[2]) + (inFirst ? 0 : firstPoints());
  }

  double m_size;
  LatticePlace m_firstCount{};
  LatticePlace m_secondCount{};
  Vec3 m_first{};
  Vec3 m_second{};
};

class Stuffer {
 public:
  Stuffer(const Mesh& surface, const Lattice& lattice, const Stuffing& how, TakeWork takeWork)
      : m_lattice(lattice),
        m_how(how),
        m_points(lattice.points()),
        m_count(static_cast<int>(m_points.size())),
        m_inside(m_points.size(), 0),
        m_cuts(m_points.size()) {
    for (int edge = 0; edge < kEdges; edge += 2) castAlong(surface, edge, takeWork);
    for (auto& inside : m_inside)
      if (inside == 0) inside = -1;
  }

  Mesh make() {
    if (m_how.snap) snapPoints();
    if (m_how.split) cutEdges();
    addAll();
    return compressed();
  }

 private:
  [[nodiscard]] Vec3& point(int p) { return m_points[static_cast<std::size_t>(p)]; }
  /// Above zero inside of the surface, below zero outside, zero on it.
  [[nodiscard]] int& inside(int p) { return m_inside[static_cast<std::size_t>(p)]; }
  /// How far along an edge of a point the surface is, as a part of its length; zero where it is not.
  [[nodiscard]] double& cut(int p, int edge) {
    return m_cuts[static_cast<std::size_t>(p)][static_cast<std::size_t>(edge)];
  }
  [[nodiscard]] double alpha(int edge) const { return edge < kAxisEdges ? m_how.alphaLong : m_how.alphaShort; }

  /// Whether the surface cuts an edge nearer to its point than may be.
  [[nodiscard]] bool isNear(int p, int edge, double limit) { return cut(p, edge) != 0 && cut(p, edge) < limit; }

  void castAlong(const Mesh& surface, int edge, TakeWork takeWork) {
    std::vector<int> starts;
    for (int p = 0; p < m_count; ++p)
      if (m_lattice.neighbour(p, edge) != kNone && m_lattice.neighbour(p, edge + 1) == kNone) starts.push_back(p);
    if (starts.empty()) return;
    takeWork(std::uint64_t{starts.size()} * surface.triangles.size());
    const auto directionOf = [&](int p) { return point(m_lattice.neighbour(p, edge)) - point(p); };
    const LineCaster caster(surface, directionOf(starts.front()));
    for (const int p : starts) {
      takeWork(0);  // was taken; asks for a stop
      noteCrossings(p, edge, caster.crossings(point(p), directionOf(p)));
    }
  }

  void noteCrossings(int p, int edge, const std::vector<Crossing>& crossings) {
    if (crossings.empty()) return;
    std::size_t i = 0;
    for (double along = 0; p != kNone; p = m_lattice.neighbour(p, edge), ++along) {
      while (i < crossings.size() && crossings[i].at < along) ++i;
      inside(p) += votes(crossings, i, along);
      if (i < crossings.size()) cut(p, edge) = crossings[i].at - along;
      if (i > 0) cut(p, edge + 1) = along - crossings[i - 1].at;
    }
  }

  /// What the crossing on one side of a point, or on the other, says of whether the point is inside.
  static int votes(const std::vector<Crossing>& crossings, std::size_t next, double along) {
    if (next == crossings.size()) return -crossings.back().leaves;
    if (next == 0) return crossings.front().leaves;
    const bool takesNext = along - crossings[next - 1].at < crossings[next].at - along;
    return takesNext ? crossings[next].leaves : -crossings[next - 1].leaves;
  }

  void snapPoints() {
    m_violated.assign(m_points.size(), false);
    std::set<int> insiders, outsiders;
    for (int p = 0; p < m_count; ++p) {
      if (!isViolated(p)) continue;
      m_violated[static_cast<std::size_t>(p)] = true;
      (inside(p) > 0 ? insiders : outsiders).insert(p);
    }
    for (bool moved = true; moved;) {
      moved = false;
      for (const int p : outsiders)
        if (inside(p) != 0 && snapOutsider(p, insiders)) moved = true;
    }
    for (const int p : insiders)
      if (const int edge = inside(p) != 0 ? nearestCut(p, [&](int q) { return inside(q) < 0; }) : kNone; edge != kNone)
        snap(p, edge);
  }

  [[nodiscard]] bool isViolated(int p) {
    for (int edge = 0; edge < kEdges; ++edge) {
      const int q = m_lattice.neighbour(p, edge);
      if (q != kNone && (inside(p) > 0) != (inside(q) > 0) && isNear(p, edge, alpha(edge))) return true;
    }
    return false;
  }

  /// The edge on which the surface is nearest, of those that are cut too near and lead where they may.
  template <class May>
  [[nodiscard]] int nearestCut(int p, const May& mayLeadTo) {
    constexpr double kLong = 4, kShort = 3;  // The squares of lengths, by that of half a long edge.
    int nearest = kNone;
    double least = 0;
    for (int edge = 0; edge < kEdges; ++edge) {
      const int q = m_lattice.neighbour(p, edge);
      if (q == kNone || !mayLeadTo(q) || !isNear(p, edge, alpha(edge))) continue;
      const double distance = cut(p, edge) * cut(p, edge) * (edge < kAxisEdges ? kLong : kShort);
      if (nearest != kNone && !(distance < least)) continue;
      nearest = edge;
      least = distance;
    }
    return nearest;
  }

  bool snapOutsider(int p, std::set<int>& insiders) {
    const int edge = nearestCut(p, [&](int q) { return inside(q) <= 0 && !m_violated[static_cast<std::size_t>(q)]; });
    if (edge == kNone) return false;
    snap(p, edge, &insiders);
    return true;
  }

  /// Moves a point along an edge onto the surface; those inside that are then no longer too near are struck off.
  void snap(int p, int along, std::set<int>* insiders = nullptr) {
    const int to = m_lattice.neighbour(p, along);
    point(p) = point(p) + (point(to) - point(p)) * cut(p, along);
    inside(p) = 0;
    m_violated[static_cast<std::size_t>(p)] = false;
    for (int edge = 0; edge < kEdges; ++edge) {
      cut(p, edge) = 0;
      const int q = m_lattice.neighbour(p, edge);
      if (q == kNone) continue;
      cut(q, edge ^ 1) = 0;
      if (insiders == nullptr || !m_violated[static_cast<std::size_t>(q)] || inside(q) <= 0) continue;
      if (isStillNear(q, alpha(edge))) continue;
      m_violated[static_cast<std::size_t>(q)] = false;
      insiders->erase(q);
    }
  }

  [[nodiscard]] bool isStillNear(int p, double limit) {
    for (int edge = 0; edge < kEdges; ++edge)
      if (const int q = m_lattice.neighbour(p, edge); q != kNone && inside(q) < 0 && isNear(p, edge, limit))
        return true;
    return false;
  }

  /// A point on each edge from outside to inside.
  void cutEdges() {
    for (int p = 0; p < m_count; ++p)
      for (int edge = 0; inside(p) < 0 && edge < kEdges; ++edge) {
        const int q = m_lattice.neighbour(p, edge);
        if (q == kNone || inside(q) <= 0) continue;
        m_cutPoints[{p, q}] = static_cast<int>(m_points.size());
        m_points.push_back(point(p) + (point(q) - point(p)) * cut(p, edge));
      }
  }

  [[nodiscard]] int cutPoint(int outer, int inner) const {
    const auto found = m_cutPoints.find({outer, inner});
    return found == m_cutPoints.end() ? outer : found->second;
  }

  /// Four tetrahedra around each edge of the first grid, with the edges of the second one that go round it.
  void addAll() {
    const auto& n = m_lattice.firstCount();
    const auto& m = m_lattice.secondCount();
    const int row = m[0], layer = m[0] * m[1];
    for (int z = 0; z < n[2]; ++z)
      for (int y = 0; y < n[1]; ++y)
        for (int x = 0; x < n[0]; ++x) {
          const int p = x + n[0] * (y + n[1] * z);
          const int h = m_lattice.firstPoints() + x + m[0] * (y + m[1] * z);
          if (x > 0) addAround(p, p - 1, {h, h + row, h + row + layer, h + layer});
          if (y > 0) addAround(p, p - n[0], {h, h + layer, h + 1 + layer, h + 1});
          if (z > 0) addAround(p, p - n[0] * n[1], {h, h + 1, h + 1 + row, h + row});
        }
  }

  void addAround(int p, int q, const std::array<int, 4>& ring) {
    for (std::size_t i = 0; i < 4; ++i) add({p, q, ring[(i + 1) % 4], ring[i]});
  }

  void add(FourPoints t) {
    if (volume(m_points, t) < 0) std::swap(t[2], t[3]);
    std::vector<int> in, on, out;
    for (const int p : t) (inside(p) > 0 ? in : inside(p) < 0 ? out : on).push_back(p);
    if (in.empty() && !out.empty()) return;
    if (out.empty() || !m_how.split)
      addFinal(t, false);
    else if (in.size() == 1)
      addCorner(t, in[0]);
    else if (in.size() == 3)
      addThreeOfFour(t, in, out[0]);
    else if (out.size() == 1)
      addTwoOfThree(t, in, on[0], out[0]);
    else
      addTwoOfFour(t, in, out);
  }

  void addFinal(FourPoints t, bool flip) {
    if (flip) std::swap(t[2], t[3]);
    if (volume(m_points, t) < 0) std::swap(t[2], t[3]);
    m_tetrahedra.push_back(t);
  }

  void addCorner(FourPoints t, int in) {
    for (int& p : t)
      if (inside(p) < 0) p = cutPoint(p, in);
    addFinal(t, false);
  }

  void addTwoOfThree(const FourPoints& t, const std::vector<int>& in, int on, int out) {
    const int first = cutPoint(out, in[0]), second = cutPoint(out, in[1]);
    const bool flip = isFlipped({on, in[0], in[1], out}, t);
    const bool other = takesOtherDiagonal(in[0], in[1], second, out);
    addFinal({on, in[0], in[1], other ? first : second}, flip);
    addFinal({on, in[other ? 1 : 0], second, first}, flip);
  }

  void addTwoOfFour(const FourPoints& t, const std::vector<int>& in, const std::vector<int>& out) {
    const int a0 = cutPoint(out[0], in[0]), a1 = cutPoint(out[0], in[1]);
    const int b0 = cutPoint(out[1], in[0]), b1 = cutPoint(out[1], in[1]);
    const bool other = takesOtherDiagonal(in[0], in[1], a1, out[0]);
    if (other == takesOtherDiagonal(in[0], in[1], b1, out[1]))
      return;  // SOFA finds no way to cut it, and leaves it out.
    const bool flip = isFlipped({in[0], in[1], out[0], out[1]}, t);
    if (other) {
      addFinal({in[0], in[1], a0, b1}, flip);
      addFinal({in[1], a0, b1, a1}, flip);
      addFinal({in[0], a0, b0, b1}, flip);
    } else {
      addFinal({in[0], in[1], a1, b0}, flip);
      addFinal({in[0], a1, a0, b0}, flip);
      addFinal({in[1], a1, b0, b1}, flip);
    }
  }

  void addThreeOfFour(const FourPoints& t, const std::vector<int>& in, int out) {
    const std::array<int, 3> cuts{cutPoint(out, in[0]), cutPoint(out, in[1]), cutPoint(out, in[2])};
    std::array<bool, 3> other{};
    for (std::size_t i = 0; i < 3; ++i) other[i] = takesOtherDiagonal(in[i], in[(i + 1) % 3], cuts[(i + 1) % 3], out);
    if (other[0] == other[1] && other[1] == other[2]) other[2] = !other[0];
    // Two diagonals meet in one of the three inside, and two in one of the cuts.
    const std::size_t corner = other[0] && !other[1] ? 1 : other[1] && !other[2] ? 2 : 0;
    const std::size_t cut = !other[0] && other[1] ? 1 : !other[1] && other[2] ? 2 : 0;
    const bool flip = isFlipped({out, in[0], in[1], in[2]}, t);
    addFinal({in[corner], cuts[0], cuts[2], cuts[1]}, flip);
    addFinal({cuts[cut], in[0], in[1], in[2]}, flip);
    const std::size_t last = other[0] == other[1] ? 1 : other[1] == other[2] ? 2 : 0;
    const int third = in[3 - corner - last];
    addFinal({in[last], cuts[last], in[corner], cuts[cut]}, isFlipped({in[last], out, in[corner], third}, t));
  }

  /// Whether a face from two points inside to the cuts of their edges to a point outside is cut from the second point.
  [[nodiscard]] bool takesOtherDiagonal(int first, int second, int cutOfSecond, int out) const {
    const auto isFirstGrid = [&](int p) { return p < m_lattice.firstPoints(); };
    if (isFirstGrid(first) == isFirstGrid(out)) return true;
    if (isFirstGrid(second) == isFirstGrid(out)) return false;
    int greater = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (m_points[static_cast<std::size_t>(first)][axis] > m_points[static_cast<std::size_t>(cutOfSecond)][axis])
        ++greater;
    return greater % 2 != (isFirstGrid(first) ? 1 : 0);
  }

  /// Brings the least to the front, by turning the whole, and the second least behind it, by turning the rest.
  static bool normalise(FourPoints& t) {
    const auto least = std::ranges::min_element(t) - t.begin();
    std::ranges::rotate(t, t.begin() + least);
    std::rotate(t.begin() + 1, std::min_element(t.begin() + 1, t.end()), t.end());
    return least % 2 == 1;
  }

  /// Whether two orders of the same four points are of opposite orientation.
  [[nodiscard]] static bool isFlipped(FourPoints a, FourPoints b) {
    const bool flipA = normalise(a), flipB = normalise(b);
    return (flipA != flipB) != (a[2] == b[3]);
  }

  /// The points that tetrahedra use, and these, all of positive volume.
  [[nodiscard]] Mesh compressed() const {
    std::vector<Index> numbers(m_points.size(), 0);
    for (const auto& t : m_tetrahedra)
      for (const int p : t) numbers[static_cast<std::size_t>(p)] = 1;
    Mesh mesh;
    for (std::size_t p = 0; p < numbers.size(); ++p) {
      if (numbers[p] == 0) continue;
      numbers[p] = static_cast<Index>(mesh.positions.size());
      mesh.positions.push_back(m_points[p]);
    }
    for (auto t : m_tetrahedra) {
      if (volume(m_points, t) < 0) std::swap(t[2], t[3]);
      std::array<Index, 4> corners{};
      for (std::size_t i = 0; i < 4; ++i) corners[i] = numbers[static_cast<std::size_t>(t[i])];
      mesh.tetrahedra.push_back(corners);
    }
    return mesh;
  }

  const Lattice& m_lattice;
  const Stuffing& m_how;
  std::vector<Vec3> m_points;
  int m_count;  ///< Of the points of the lattice; cuts follow.
  std::vector<int> m_inside;
  std::vector<std::array<double, kEdges>> m_cuts;
  std::vector<bool> m_violated;
  std::map<std::pair<int, int>, int> m_cutPoints;
  std::vector<FourPoints> m_tetrahedra;
};

/// With the box to fill and the size of a cell in numbers.
Stuffing measured(const Mesh& surface, Stuffing how) {
  if (how.box.min[0] >= how.box.max[0]) how.box = boxToFill(surface.positions);
  if (how.size < 0) how.size = std::ranges::max(how.box.max - how.box.min) / -how.size;
  return how;
}

}  // namespace

double stuffingPoints(const Mesh& surface, const Stuffing& how) {
  const Stuffing in = measured(surface, how);
  return Lattice::pointsIn(in.box, in.size);
}

Mesh stuffed(const Mesh& surface, const Stuffing& how, TakeWork takeWork) {
  const Stuffing in = measured(surface, how);
  const Lattice lattice(in.box, in.size);
  return Stuffer(surface, lattice, in, takeWork).make();
}

}  // namespace allpairs::scene::sofa
