// SPDX-License-Identifier: MIT
// Pairs that float32 is certain of among pairs that it is not, in all places of vectors and blocks: each is decided as
// itself, and not as its neighbour.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "allpairs/Neighbors.h"
#include "allpairs/Overlaps.h"
#include "support/Boxes.h"
#include "support/Oracle.h"

namespace allpairs {
namespace {

class Doubt : public ::testing::TestWithParam<std::string_view> {
 protected:
  [[nodiscard]] static OverlapOptions optionsFor(Strategy strategy) {
    return {.strategy = strategy, .instructionSet = GetParam()};
  }
};

INSTANTIATE_TEST_SUITE_P(EachInstructionSet, Doubt,
                         ::testing::ValuesIn(instructionSets().begin(), instructionSets().end()),
                         [](const auto& test) { return std::string(test.param); });

constexpr Strategy kWays[] = {Strategy::Exhaustive, Strategy::Bvh};

/// Boxes that end where others begin, or a hair before, which float32 cannot tell, and some that reach over both; on
/// each axis some are far from the others.
std::vector<Box> mixedBoxes(std::size_t n, unsigned seed) {
  std::mt19937 generator(seed);
  const double justAfter = std::nextafter(0.1, 1.0);
  std::vector<Box> boxes(n);
  for (Box& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t kind = generator() % 8;
      box.min[axis] = kind < 2 ? 0.0 : kind == 2 ? justAfter : kind == 3 ? 0.1 : kind == 4 ? 0.7 : 0.05;
      box.max[axis] = kind < 2 ? 0.1 : kind == 4 ? 0.9 : 0.2;
    }
  }
  return boxes;
}

std::vector<std::vector<std::uint32_t>> partnersOf(const std::vector<Pair>& pairs, std::size_t boxes) {
  std::vector<std::vector<std::uint32_t>> partners(boxes);
  for (const Pair& pair : pairs) {
    partners[pair.first].push_back(pair.second);
    partners[pair.second].push_back(pair.first);
  }
  for (auto& list : partners) std::sort(list.begin(), list.end());
  return partners;
}

TEST_P(Doubt, OfOneSetIsDecidedWhereItIs) {
  for (const std::size_t n : {200U, 700U}) {
    const std::vector<Box> boxes = mixedBoxes(n, 1);
    const std::vector<Pair> expected = test::oracle(boxes);
    for (const Strategy strategy : kWays) {
      ASSERT_EQ(overlaps(boxes, optionsFor(strategy)), expected) << n;
      ASSERT_EQ(countOverlaps(boxes, optionsFor(strategy)), expected.size()) << n;
    }
  }
}

TEST_P(Doubt, OfTwoSetsIsDecidedWhereItIs) {
  const std::vector<Box> first = mixedBoxes(600, 2);
  const std::vector<Box> second = mixedBoxes(650, 3);
  const std::vector<Pair> expected = test::oracleBetween(first, second);
  for (const Strategy strategy : kWays) {
    ASSERT_EQ(overlaps(first, second, optionsFor(strategy)), expected);
    ASSERT_EQ(countOverlaps(first, second, optionsFor(strategy)), expected.size());
  }
}

TEST_P(Doubt, OfNeighborsIsDecidedWhereItIs) {
  const std::vector<Box> boxes = mixedBoxes(700, 4);
  const std::vector<std::vector<std::uint32_t>> expected = partnersOf(test::oracle(boxes), boxes.size());
  for (const Strategy strategy : kWays) {
    const Neighbors found = neighbors(boxes, NeighborRows::Full, optionsFor(strategy));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      ASSERT_EQ(std::vector<std::uint32_t>(found[i].begin(), found[i].end()), expected[i]) << "box " << i;
    }
  }
}

}  // namespace
}  // namespace allpairs
