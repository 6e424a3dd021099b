// SPDX-License-Identifier: MIT
#include "SceneFamily.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "Random.h"

namespace allpairs::bench {

namespace {

using generate::Random;

constexpr double kMostPairs = 1e7;  // In a scene.

double logUniform(Random& random, double low, double high) {
  return std::exp(random.between(std::log(low), std::log(high)));
}

/// A value that stands among the choices more often is more likely.
template <class Value, std::size_t kCount>
Value oneOf(Random& random, const std::array<Value, kCount>& choices) {
  return choices[random.below(kCount)];
}

/// One set; or two of similar size, or one large and one small, in either order.
void drawCounts(Random& random, SceneFamily& family) {
  const double boxes = std::round(logUniform(random, 2.0, static_cast<double>(kMostBoxes)));
  family.first = static_cast<std::size_t>(boxes);
  if (random.unit() < 0.6) return;
  const bool isLopsided = random.unit() < 0.6;
  const double share = isLopsided ? logUniform(random, 1.0 / boxes, 0.5) : random.between(0.3, 0.5);
  family.second = std::max<std::size_t>(static_cast<std::size_t>(share * boxes), 1);
  family.first -= family.second;
  family.isLocal = isLopsided && random.unit() < 0.5;
  if (!family.isLocal && random.unit() < 0.5) std::swap(family.first, family.second);
}

/// As many pairs as this many boxes can have, and a scene holds.
void drawPairs(Random& random, SceneFamily& family) {
  const auto boxes = static_cast<double>(family.boxes());
  family.pairs = random.unit() < 0.1 ? 0.0 : logUniform(random, 0.02, 100.0);
  const double most = family.areTwo() ? static_cast<double>(family.first) * static_cast<double>(family.second) / boxes
                                      : 0.5 * (boxes - 1.0);
  family.pairs = std::min({family.pairs, most, kMostPairs / boxes});
}

void drawPlaces(Random& random, SceneFamily& family) {
  family.support =
      oneOf(random, std::array{Support::Volume, Support::Volume, Support::Volume, Support::Volume, Support::Plane,
                               Support::TiltedPlane, Support::AxisLine, Support::DiagonalLine});
  family.spacing = oneOf(random, std::array{Spacing::Uniform, Spacing::Uniform, Spacing::Uniform, Spacing::Clusters,
                                            Spacing::Clusters, Spacing::Fractal, Spacing::Lattice});
  const double most = std::max(2.0, static_cast<double>(family.boxes()) / 10.0);
  family.clusters = static_cast<std::size_t>(logUniform(random, 1.0, most));
}

void drawShapes(Random& random, SceneFamily& family) {
  family.sizes = oneOf(random, std::array{Sizes::Equal, Sizes::Uniform, Sizes::LogNormal, Sizes::PowerLaw});
  family.shape = oneOf(random, std::array{Shape::Cubes, Shape::Cubes, Shape::Cubes, Shape::Plates, Shape::MixedPlates,
                                          Shape::Needles, Shape::MixedNeedles});
  if (family.spacing == Spacing::Lattice) {
    family.sizes = Sizes::Equal;
    if (family.shape == Shape::Needles || family.shape == Shape::MixedNeedles) family.shape = Shape::Cubes;
  }
  if (family.shape != Shape::Cubes) family.aspect = std::round(logUniform(random, 4.0, 200.0));
}

void drawNumbers(Random& random, SceneFamily& family) {
  family.isFloat64 = random.unit() < 0.35;
  const bool isFar = random.unit() < 0.3;
  if (isFar) family.offset = family.isFloat64 ? 1e7 : 100.0;
}

const char* nameOf(Support support) {
  constexpr std::array<const char*, 5> kNames{"volume", "plane", "tilted plane", "line along an axis", "diagonal line"};
  return kNames[static_cast<std::size_t>(support)];
}

const char* nameOf(Spacing spacing) {
  constexpr std::array<const char*, 4> kNames{"uniform", "clusters", "fractal", "lattice"};
  return kNames[static_cast<std::size_t>(spacing)];
}

const char* nameOf(Sizes sizes) {
  constexpr std::array<const char*, 4> kNames{"equal", "uniform", "log-normal", "power-law"};
  return kNames[static_cast<std::size_t>(sizes)];
}

const char* nameOf(Shape shape) {
  constexpr std::array<const char*, 5> kNames{"cubes", "parallel plates", "plates", "parallel needles", "needles"};
  return kNames[static_cast<std::size_t>(shape)];
}

}  // namespace

SceneFamily familyOf(std::uint64_t seed) {
  Random random(seed, 0);
  SceneFamily family{.seed = seed};
  drawCounts(random, family);
  drawPairs(random, family);
  drawPlaces(random, family);
  drawShapes(random, family);
  drawNumbers(random, family);
  return family;
}

SceneFamily shrunk(const SceneFamily& family, std::size_t boxes) {
  if (family.boxes() <= boxes) return family;
  const double share = static_cast<double>(boxes) / static_cast<double>(family.boxes());
  const auto part = [share](std::size_t whole) {
    return std::max<std::size_t>(static_cast<std::size_t>(share * static_cast<double>(whole)), 1);
  };
  SceneFamily result = family;
  result.first = part(family.first);
  if (family.areTwo()) result.second = part(family.second);
  result.clusters = part(family.clusters);
  return result;
}

std::size_t dimensionOf(Support support) noexcept {
  constexpr std::array<std::size_t, 5> kDimensions{3, 2, 2, 1, 1};
  return kDimensions[static_cast<std::size_t>(support)];
}

std::string describe(const SceneFamily& family) {
  std::ostringstream text;
  text << (family.isFloat64 ? "float64" : "float32");
  if (family.offset != 0.0) text << " at " << family.offset;
  if (family.areTwo()) {
    text << ", " << family.first << " x " << family.second << (family.isLocal ? ", the second set local" : "");
  }
  text << ", " << nameOf(family.spacing);
  if (family.spacing == Spacing::Clusters) text << " (" << family.clusters << ")";
  text << " in " << nameOf(family.support) << ", " << nameOf(family.shape);
  if (family.shape != Shape::Cubes) text << " 1:" << family.aspect;
  text << ", " << nameOf(family.sizes) << " sizes";
  return text.str();
}

}  // namespace allpairs::bench
