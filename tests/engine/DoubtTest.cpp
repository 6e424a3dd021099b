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
#include <string_view>
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
/// each axis some are far from the others, at so many places that bounds do not take few values.
std::vector<Box> mixedBoxes(std::size_t n, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> far(0.0, 0.25);
  const double justAfter = std::nextafter(0.1, 1.0);
  std::vector<Box> boxes(n);
  for (Box& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t kind = generator() % 8;
      box.min[axis] = kind < 2    ? 0.0
                      : kind == 2 ? justAfter
                      : kind == 3 ? 0.1
                      : kind == 4 ? 0.7 + far(generator)
                                  : 0.05;
      box.max[axis] = kind < 2 ? 0.1 : kind == 4 ? 1.0 + far(generator) : 0.2;
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
      OverlapSearch search(optionsFor(strategy));
      ASSERT_EQ(search.find(boxes).size(), expected.size()) << n;
      if (n == 700) {  // of few they are not counted
        ASSERT_GT(search.statistics().exactTests, expected.size() / 4);
      }
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

/// Boxes of float32 on a grid far away, and of float64 that begin or end there, or a hair from it.
TEST_P(Doubt, OfTwoPrecisionsFarFromTheOriginIsDecidedWhereItIs) {
  std::mt19937 generator(4);
  const double far = 1e7;
  std::vector<BoxF> first(700);
  std::vector<Box> second(650);
  for (BoxF& box : first) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = static_cast<float>(far) + static_cast<float>(generator() % 8);
      box.max[axis] = box.min[axis] + static_cast<float>(generator() % 3);
    }
  }
  for (Box& box : second) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double min = far + static_cast<double>(generator() % 8);
      const double max = min + static_cast<double>(generator() % 3);
      box.min[axis] = generator() % 3 == 0 ? std::nextafter(min, 0.0) : min;
      box.max[axis] = generator() % 3 == 0 ? std::nextafter(max, 2 * far) : max;
    }
  }
  const std::vector<Pair> expected = test::oracleBetween(test::toDouble(first), second);
  for (const Strategy strategy : kWays) {
    ASSERT_EQ(overlaps(first, second, optionsFor(strategy)), expected);
    OverlapSearch search(optionsFor(strategy));
    std::vector<Pair> streamed;
    search.stream(first, second,
                  [&](std::span<const Pair> pairs) { streamed.insert(streamed.end(), pairs.begin(), pairs.end()); });
    ASSERT_EQ(streamed, expected);
    ASSERT_EQ(overlaps(second, first, optionsFor(strategy)).size(), expected.size());
  }
}

struct Widened {
  std::vector<Box> boxes;
  std::vector<double> margins;
};

std::vector<Pair> oracleBetween(const Widened& first, const Widened& second, double distance) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < first.boxes.size(); ++i) {
    for (std::uint32_t j = 0; j < second.boxes.size(); ++j) {
      const double d = distance + first.margins[i] + second.margins[j];
      if (test::overlapByOracle(first.boxes[i], second.boxes[j], d)) pairs.push_back({i, j});
    }
  }
  return pairs;
}

/// Boxes that end, or begin, some millionths from a point.
Widened besideAPoint(std::size_t n, unsigned seed, double point, bool end, double margin) {
  std::mt19937 generator(seed);
  Widened set{std::vector<Box>(n), std::vector<double>(n, margin)};
  for (Box& box : set.boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double bound = point + 1e-6 * (static_cast<double>(generator() % 16) - 8.0);
      box.min[axis] = end ? bound - 1.0 : bound;
      box.max[axis] = end ? bound : bound + 1.0;
    }
  }
  return set;
}

Widened cubesOfSide(double side, std::size_t n, unsigned seed, double margin) {
  std::mt19937 generator(seed);
  Widened set{{}, std::vector<double>(n, margin)};
  for (std::size_t i = 0; i < n; ++i) {
    const auto coordinate = [&generator] { return 0.1 * static_cast<double>(generator() % 40); };
    const double x = coordinate();
    const double y = coordinate();
    set.boxes.push_back(test::cube(x, y, coordinate(), side));
  }
  return set;
}

/// What widens or shrinks boxes may be far greater than what is left of them, or leave nothing; and boxes may be far from
/// the origin.
TEST_P(Doubt, OfTwoSetsThatAreWidenedIsDecidedWhereItIs) {
  constexpr double kFar = 1e9;
  struct Scene {
    Widened some;
    Widened others;
    double distance = 0.0;
  };
  const std::vector<Scene> scenes{
      {besideAPoint(300, 5, kFar, false, kFar), besideAPoint(320, 6, 0.0, true, 0.0)},
      {cubesOfSide(0.3, 300, 7, -0.5), cubesOfSide(2.0, 320, 8, 0.0)},
      {besideAPoint(300, 9, kFar / 2.0, false, 0.0), besideAPoint(320, 10, -kFar / 2.0, true, 0.0), kFar},
      {besideAPoint(300, 11, kFar + 0.1, false, 0.0), besideAPoint(320, 12, kFar, true, 0.0), 0.1},
  };
  for (const auto& [some, others, distance] : scenes) {
    for (const bool isSwapped : {false, true}) {
      const Widened& first = isSwapped ? others : some;
      const Widened& second = isSwapped ? some : others;
      BoxView firstView(first.boxes);
      BoxView secondView(second.boxes);
      if (!isSwapped) firstView.setMargins(first.margins);
      if (isSwapped) secondView.setMargins(second.margins);
      const std::vector<Pair> expected = oracleBetween(first, second, distance);
      ASSERT_GT(expected.size(), 100U);
      for (const Strategy strategy : kWays) {
        OverlapOptions options = optionsFor(strategy);
        options.distance = distance;
        ASSERT_EQ(overlaps(firstView, secondView, options), expected) << isSwapped;
        ASSERT_EQ(countOverlaps(firstView, secondView, options), expected.size()) << isSwapped;
      }
    }
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
