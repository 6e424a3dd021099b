// SPDX-License-Identifier: MIT
#include "SceneMaker.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "Random.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"

namespace allpairs::bench {

namespace {

/// Of a scene, ten times what the family asks for: the lists of all contenders are kept at the same time.
constexpr std::uint64_t kMostPairsKept = 100000000;
constexpr std::size_t kFewBoxes = 10000;  ///< Have no more, whatever they are.

using generate::Random;
using Point = std::array<double, 3>;

/// Where the randomness of a set of a scene comes from.
std::uint64_t streamOf(std::uint64_t seed, std::uint64_t number, bool isSecond) {
  return Random(seed, 2 * number + (isSecond ? 2 : 1)).bits();
}

Point unitPoint(Random& random) { return {random.unit(), random.unit(), random.unit()}; }

/// Clusters are the same for all scenes of a family and for both sets.
Point clustered(Random& random, std::uint64_t seed, std::size_t clusters) {
  Random cluster(~seed, random.below(clusters));
  Point point = unitPoint(cluster);
  const double spread = cluster.between(0.02, 0.16) / std::cbrt(static_cast<double>(clusters));
  for (double& coordinate : point) coordinate += spread * random.bell();
  return point;
}

/// Descends from a cube to one of its eight parts, and on.
Point fractal(Random& random, const std::array<double, 8>& cumulative) {
  constexpr int kLevels = 9;
  Point point = unitPoint(random);
  for (int level = 0; level < kLevels; ++level) {
    const double draw = random.unit();
    const auto part = static_cast<unsigned>(
        std::min<std::ptrdiff_t>(std::upper_bound(cumulative.begin(), cumulative.end(), draw) - cumulative.begin(), 7));
    for (unsigned axis = 0; axis < 3; ++axis) point[axis] = 0.5 * (point[axis] + ((part >> axis) & 1U));
  }
  return point;
}

/// How many cells a lattice has on an axis.
std::size_t latticeSide(std::size_t count, std::size_t dimension) {
  const double root = std::pow(static_cast<double>(count), 1.0 / static_cast<double>(dimension));
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(root - 1e-9)));
}

/// The edge of a cell, a power of two: with it, boxes of a lattice touch exactly.
double latticeEdge(std::size_t side) { return std::exp2(-std::ceil(std::log2(static_cast<double>(side)))); }

Point latticePoint(std::size_t cell, std::size_t side, double edge) {
  const auto along = [edge](std::size_t index) { return edge * static_cast<double>(index); };
  return {along(cell % side), along(cell / side % side), along(cell / side / side)};
}

/// The cells of boxes in another order for each scene, in which those that are left over are others too.
std::size_t latticeCell(std::size_t box, std::uint64_t stream, std::size_t cells) {
  Random random(stream, 0);
  const std::size_t shift = random.below(cells);
  std::size_t step = 1 + random.below(cells);
  while (std::gcd(step, cells) != 1) ++step;
  return (box * step + shift) % cells;
}

double sizeOf(Random& random, Sizes sizes) {
  switch (sizes) {
    case Sizes::Equal:
      return 1.0;
    case Sizes::Uniform:
      return random.between(0.1, 1.9);
    case Sizes::LogNormal:
      return std::exp(random.bell());
    case Sizes::PowerLaw:
      return std::min(1.0 / std::sqrt(1.0 - random.unit()), 100.0);
  }
  return 1.0;
}

Point halfOf(Random& random, const SceneFamily& family, std::size_t axis) {
  const double size = sizeOf(random, family.sizes);
  Point half{size, size, size};
  const std::size_t drawn = random.below(3);
  switch (family.shape) {
    case Shape::Cubes:
      break;
    case Shape::Plates:
      half[axis] /= family.aspect;
      break;
    case Shape::MixedPlates:
      half[drawn] /= family.aspect;
      break;
    case Shape::Needles:
      half[axis] *= family.aspect;
      break;
    case Shape::MixedNeedles:
      half[drawn] *= family.aspect;
      break;
  }
  return half;
}

/// From the unit cube, or the part of it that has the dimension of the support, to the support.
Point onto(Support support, const Point& point, std::size_t axis) {
  Point result{};
  switch (support) {
    case Support::Volume:
      return point;
    case Support::Plane:
      result[(axis + 1) % 3] = point[0];
      result[(axis + 2) % 3] = point[1];
      return result;
    case Support::TiltedPlane:
      return {point[0], point[1], 0.5 * (point[0] + point[1])};
    case Support::AxisLine:
      result[axis] = point[0];
      return result;
    case Support::DiagonalLine:
      return {point[0], point[0], point[0]};
  }
  return result;
}

template <class T>
bool hasTooMany(const Scene<T>& scene) {
  OverlapSearch search({.maxPairs = kMostPairsKept});
  const BoxView first = BoxView::fromRows(scene.first);
  try {
    return (scene.areTwo ? search.count(first, BoxView::fromRows(scene.second)) : search.count(first)) > kMostPairsKept;
  } catch (const LimitExceeded&) {
    return true;
  }
}

}  // namespace

SceneMaker::SceneMaker(const SceneFamily& family) : m_family(family) {
  Random random(family.seed, 0);
  m_axis = random.below(3);
  double sum = 0.0;
  for (double& share : m_cumulative) share = sum += std::pow(random.unit(), 3.0);
  for (double& share : m_cumulative) share /= sum;
  const std::size_t dimension = dimensionOf(family.support);
  m_sides = {latticeSide(family.first, dimension), latticeSide(family.second, dimension)};
  m_scale = family.spacing == Spacing::Lattice ? latticeScale() : scaleForPairs();
  if (m_family.boxes() > kFewBoxes && hasTooManyPairs()) shrink();
}

/// Until the pairs of a scene are few enough. Where they would be too many even of points, since far from the origin
/// too many of these are one point, the scene lies at the origin instead.
void SceneMaker::shrink() {
  const double scale = std::exchange(m_scale, 0.0);
  if (hasTooManyPairs()) m_family.offset = 0.0;
  constexpr double kLeast = 0x1p-60;  // Boxes are points then, in float64 too.
  for (m_scale = scale; m_scale > kLeast && hasTooManyPairs();) m_scale *= 0.75;
}

SceneMaker::Placed SceneMaker::place(const Draw& draw) const {
  Random random(draw.stream, draw.box);
  Point point{};
  switch (m_family.spacing) {
    case Spacing::Uniform:
      point = unitPoint(random);
      break;
    case Spacing::Clusters:
      point = clustered(random, m_family.seed, m_family.clusters);
      break;
    case Spacing::Fractal:
      point = fractal(random, m_cumulative);
      break;
    case Spacing::Lattice: {
      const std::size_t side = m_sides[draw.isSecond ? 1 : 0];
      const auto cells = static_cast<std::size_t>(std::pow(side, dimensionOf(m_family.support)));
      point = latticePoint(latticeCell(draw.box, draw.stream, cells), side, latticeEdge(side));
      break;
    }
  }
  Placed placed{onto(m_family.support, point, m_axis), halfOf(random, m_family, m_axis)};
  constexpr double kLocal = 0.0625;  // Of the space, on each axis.
  if (draw.isSecond && m_family.isLocal) {
    for (double& coordinate : placed.centre) coordinate = 0.5 + kLocal * (coordinate - 0.5);
  }
  return placed;
}

std::vector<SceneMaker::Placed> SceneMaker::placeSet(std::uint64_t number, bool isSecond, std::size_t count) const {
  const std::uint64_t stream = streamOf(m_family.seed, number, isSecond);
  std::vector<Placed> boxes(count);
  for (std::size_t i = 0; i < count; ++i) boxes[i] = place({stream, i, isSecond});
  return boxes;
}

template <class T>
std::vector<T> SceneMaker::rowsOf(const std::vector<Placed>& boxes, double scale, double offset) const {
  std::vector<T> rows;
  rows.reserve(6 * boxes.size());
  for (const Placed& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rows.push_back(static_cast<T>(offset + (box.centre[axis] - scale * box.half[axis])));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rows.push_back(static_cast<T>(offset + (box.centre[axis] + scale * box.half[axis])));
    }
  }
  return rows;
}

/// Boxes reach over a whole number of cells, and so touch, or over half a cell more or less.
double SceneMaker::latticeScale() const {
  const std::size_t dimension = dimensionOf(m_family.support);
  const double reach = 0.5 * (std::pow(2.0 * m_family.pairs + 1.0, 1.0 / static_cast<double>(dimension)) - 1.0);
  const bool touches = Random(m_family.seed, 1).unit() < 0.5;
  const double cells = touches ? std::max(1.0, std::round(reach)) : std::max(0.5, std::floor(reach) + 0.5);
  return 0.5 * cells * latticeEdge(m_sides[0]);
}

/// Halves the range of scales until some boxes of the family have as many pairs as their share in the whole tells.
double SceneMaker::scaleForPairs() const {
  const Sample sample = drawSample();
  OverlapSearch search({.order = Order::Unordered});
  double low = -24.0;  // Logarithms of the scale, to base 2.
  double high = 8.0;
  constexpr int kSteps = 13;
  for (int step = 0; step < kSteps; ++step) {
    const double middle = 0.5 * (low + high);
    double pairs = 0.0;
    for (std::size_t i = 0; i < sample.first.size(); ++i) {
      const std::vector<float> a = rowsOf<float>(sample.first[i], std::exp2(middle), 0.0);
      const std::vector<float> b = rowsOf<float>(sample.second[i], std::exp2(middle), 0.0);
      const BoxView view = BoxView::fromRows(a);
      pairs += static_cast<double>(m_family.areTwo() ? search.count(view, BoxView::fromRows(b)) : search.count(view));
    }
    (pairs < sample.pairs ? low : high) = middle;
  }
  return std::exp2(0.5 * (low + high));
}

/// Whether a whole scene does: a sample may tell far fewer pairs. Those of the precision that the scene will have: what
/// is apart in float64 may be one point in float32.
bool SceneMaker::hasTooManyPairs() const {
  return m_family.isFloat64 ? hasTooMany(make<double>(0)) : hasTooMany(make<float>(0));
}

SceneMaker::Sample SceneMaker::drawSample() const {
  constexpr std::size_t kBoxes = 20000;
  constexpr std::size_t kMostScenes = 500;
  const double share = std::min(1.0, static_cast<double>(kBoxes) / static_cast<double>(m_family.boxes()));
  const auto part = [share](std::size_t whole) {
    return static_cast<std::size_t>(std::ceil(share * static_cast<double>(whole)));
  };
  const std::array<std::size_t, 2> counts{part(m_family.first), part(m_family.second)};
  const std::size_t scenes = std::clamp<std::size_t>(kBoxes / (2 * m_family.boxes()), 1, kMostScenes);
  Sample sample;
  for (std::size_t number = 0; number < scenes; ++number) {
    sample.first.push_back(placeSet(number, false, counts[0]));
    sample.second.push_back(placeSet(number, true, counts[1]));
  }
  const auto shareOf = [](std::size_t of, std::size_t whole) {
    return static_cast<double>(of) / static_cast<double>(whole);
  };
  const double firstShare = shareOf(counts[0], m_family.first);
  const double otherShare = m_family.areTwo() ? shareOf(counts[1], m_family.second) : firstShare;
  const double all = m_family.pairs * static_cast<double>(m_family.boxes()) * static_cast<double>(scenes);
  sample.pairs = all * firstShare * otherShare;
  return sample;
}

template <class T>
Scene<T> SceneMaker::make(std::uint64_t number) const {
  Scene<T> scene{{}, {}, m_family.areTwo()};
  scene.first = rowsOf<T>(placeSet(number, false, m_family.first), m_scale, m_family.offset);
  if (scene.areTwo) scene.second = rowsOf<T>(placeSet(number, true, m_family.second), m_scale, m_family.offset);
  return scene;
}

template Scene<float> SceneMaker::make<float>(std::uint64_t) const;
template Scene<double> SceneMaker::make<double>(std::uint64_t) const;

}  // namespace allpairs::bench
