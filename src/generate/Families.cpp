// SPDX-License-Identifier: MIT
#include "Families.h"

#include <algorithm>
#include <cmath>

#include "Arithmetic.h"
#include "Random.h"

namespace allpairs::generate {

namespace {

std::array<double, 3> unitPoint(Random& random) { return {random.unit(), random.unit(), random.unit()}; }

/// The side of n cubes that fill `filled` of the unit cube between them.
double sideOfCubes(std::size_t count, double filled) {
  return cubeRoot(filled / static_cast<double>(std::max<std::size_t>(count, 1)));
}

}  // namespace

std::vector<float> uniformBoxes(std::size_t count, std::uint64_t seed) {
  constexpr double kFilledAtRandom = 0.625;  // n/2 * 8 * 0.625 = 2.5 pairs a box, less at the walls.
  const double side = sideOfCubes(count, kFilledAtRandom);
  Rows rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    rows.addAround(unitPoint(random), {side, side, side});
  }
  return std::move(rows).take();
}

std::vector<float> clusteredBoxes(std::size_t count, std::uint64_t seed) {
  constexpr std::size_t kBoxesPerCluster = 500;
  constexpr double kSideOfSpread = 0.42;  // Gives about three pairs a box within a cluster.
  const std::size_t clusters = count / kBoxesPerCluster + 1;
  const double room = sideOfCubes(clusters, 1.0);
  Rows rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    Random cluster(~seed, random.below(clusters));
    std::array<double, 3> centre = unitPoint(cluster);
    const double spread = room * cluster.between(0.02, 0.16);
    for (double& coordinate : centre) coordinate += spread * random.bell();
    const double side = kSideOfSpread * spread * random.between(0.5, 1.5);
    rows.addAround(centre, {side, side, side});
  }
  return std::move(rows).take();
}

std::vector<float> powerLawBoxes(std::size_t count, std::uint64_t seed) {
  constexpr double kLargest = 0.25;
  const double smallest = std::sqrt(2.0 / static_cast<double>(std::max<std::size_t>(count, 32)));
  Rows rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    // P(side > s) = (smallest / s)^2 up to the largest.
    const double side = std::min(kLargest, smallest / std::sqrt(1.0 - random.unit()));
    rows.addAround(unitPoint(random), {side, side, side});
  }
  return std::move(rows).take();
}

std::vector<float> cityBoxes(std::size_t count, std::uint64_t seed) {
  const double side = std::sqrt(1.5 / static_cast<double>(std::max<std::size_t>(count, 1)));
  Rows rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    const std::array<double, 3> size{side * random.between(0.5, 1.5), side * random.between(0.5, 1.5),
                                     side * random.between(0.5, 5.0)};
    rows.addAround({random.unit(), random.unit(), 0.5 * size[2]}, size);
  }
  return std::move(rows).take();
}

std::vector<float> needleBoxes(std::size_t count, std::uint64_t seed) {
  constexpr double kLengthOfThickness = 20.0;
  const double thickness = sideOfCubes(count, 0.0156);  // Four to five pairs a box.
  Rows rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    std::array<double, 3> size{thickness, thickness, thickness};
    const std::size_t longAxis = random.below(3);
    size[longAxis] *= kLengthOfThickness * random.between(0.5, 1.5);
    rows.addAround(unitPoint(random), size);
  }
  return std::move(rows).take();
}

std::vector<float> overlappingBoxes(std::size_t count, std::uint64_t seed) {
  Rows rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    const std::array<double, 3> below = unitPoint(random);
    rows.add({-below[0], -below[1], -below[2]}, unitPoint(random));
  }
  return std::move(rows).take();
}

}  // namespace allpairs::generate
