// SPDX-License-Identifier: MIT
// Boxes of float64 whose bounds take few values, which are searched as boxes of float32 in the same order.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "allpairs/Neighbors.h"
#include "allpairs/Overlaps.h"
#include "support/Boxes.h"
#include "support/Oracle.h"

namespace allpairs {
namespace {

/// The values that bounds on an axis take, for each axis.
using AxisValues = std::array<std::vector<double>, 3>;

/// Boxes that begin and end at some of the values, some flat, some empty.
std::vector<Box> boxesOf(const AxisValues& values, std::size_t n, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<Box> boxes(n);
  for (Box& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::vector<double>& v = values[axis];
      const std::size_t first = generator() % v.size();
      box.min[axis] = v[first];
      box.max[axis] = v[std::min(v.size() - 1, first + generator() % 3)];
      if (generator() % 50 == 0) std::swap(box.min[axis], box.max[axis]);
    }
  }
  return boxes;
}

/// Multiples of a step and, of each, the next doubles on both sides.
std::vector<double> steps(double from, double step, std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = from + static_cast<double>(i) * step;
    values.insert(values.end(), {std::nextafter(value, -HUGE_VAL), value, std::nextafter(value, HUGE_VAL)});
  }
  return values;
}

/// What is hard to tell apart: doubles next to each other, around zero, far from it, of all sizes, and infinities.
AxisValues valuesOf(std::size_t kind) {
  constexpr double kMost = std::numeric_limits<double>::max();
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  switch (kind) {
    case 0:
      return {{steps(0.1, 0.1, 7), steps(-0.35, 0.1, 7), steps(0.0, 0.3, 5)}};
    case 1:
      return {{steps(1e9, 0.1, 7), steps(-1e9, 1e-6, 6), steps(4e6, 0.7, 5)}};
    case 2:
      return {{{-HUGE_VAL, -0.1, 0.1, 0.3, HUGE_VAL}, {-HUGE_VAL, HUGE_VAL, 0.7}, {-0.0, 0.0, 0.1, -0.1}}};
    case 3:
      return {{{-kMost, -1e300, -0.1, 0.1, 1e300, kMost}, {-kMost, kMost}, {-1e-300, 0.1, 1e-300, -0.1}}};
    case 4:
      return {{{-kLeast, 0.0, kLeast, 2 * kLeast}, {0.1, 0.1}, {1e-310, 2e-310, 3e-320}}};
    case 5:
      return {{{-HUGE_VAL, HUGE_VAL}, {HUGE_VAL, 0.1}, {-HUGE_VAL, 0.1}}};
    default:
      return {{steps(0.1, 1e-17, 2), {0.1, 1e30, 1e30 + 1e15}, {-1e30, 0.1, std::nextafter(0.1, 1.0), 0.2}}};
  }
}
constexpr std::size_t kValueKinds = 7;

std::vector<Pair> inOrderOf(Order order, std::vector<Pair> pairs) {
  if (order == Order::BySecond) {
    std::stable_sort(pairs.begin(), pairs.end(), [](Pair a, Pair b) { return a.second < b.second; });
  }
  return pairs;
}

/// By each call, in each order.
void expectPairs(const std::vector<Box>& boxes, const std::vector<Pair>& expected, Strategy strategy) {
  for (const Order order : {Order::ByFirst, Order::BySecond}) {
    OverlapSearch search({.strategy = strategy, .order = order});
    const std::vector<Pair> sorted = inOrderOf(order, expected);
    const Span<const Pair> found = search.find(boxes);
    ASSERT_EQ(std::vector<Pair>(found.begin(), found.end()), sorted);
    ASSERT_EQ(search.statistics().exactTests, 0U);
    ASSERT_EQ(search.count(boxes), expected.size());
    std::vector<Pair> streamed;
    search.stream(boxes, [&](Span<const Pair> batch) { streamed.insert(streamed.end(), batch.begin(), batch.end()); });
    ASSERT_EQ(streamed, sorted);
    ASSERT_EQ(search.statistics().exactTests, 0U);
  }
  std::vector<Pair> unordered = overlaps(boxes, {.strategy = strategy, .order = Order::Unordered});
  std::sort(unordered.begin(), unordered.end());
  ASSERT_EQ(unordered, expected);
}

TEST(FewValues, OfOneSetHaveThePairsOfTheDoubleLoop) {
  for (std::size_t kind = 0; kind < kValueKinds; ++kind) {
    SCOPED_TRACE(kind);
    for (const std::size_t n : {256U, 300U, 1500U}) {
      const std::vector<Box> boxes = boxesOf(valuesOf(kind), n, static_cast<unsigned>(n + kind));
      const std::vector<Pair> expected = test::oracle(boxes);
      ASSERT_FALSE(expected.empty());
      for (const Strategy strategy : {Strategy::Automatic, Strategy::Exhaustive, Strategy::Bvh}) {
        expectPairs(boxes, expected, strategy);
      }
    }
  }
}

TEST(FewValues, OfTwoSetsHaveThePairsOfTheDoubleLoop) {
  for (std::size_t kind = 0; kind < kValueKinds; ++kind) {
    SCOPED_TRACE(kind);
    const std::vector<Box> first = boxesOf(valuesOf(kind), 700, 1);
    const std::vector<Box> second = boxesOf(valuesOf(kind), 500, 2);
    const std::vector<Pair> expected = test::oracleBetween(first, second);
    OverlapSearch search;
    const Span<const Pair> found = search.find(first, second);
    ASSERT_EQ(std::vector<Pair>(found.begin(), found.end()), expected);
    ASSERT_EQ(search.statistics().exactTests, 0U);
    ASSERT_EQ(search.count(second, first), expected.size());
  }
}

/// Values that only one of the sets has lie between those of the other, and one set may be float32 as it is.
TEST(FewValues, OfTwoSetsMayBeOthersInEach) {
  const AxisValues whole{{{0.0, 1.0, 2.0, 3.0}, {0.0, 1.0, 2.0}, {0.0, 1.0}}};
  const AxisValues between{{steps(0.0, 0.1, 30), steps(0.0, 0.1, 20), steps(0.0, 0.1, 10)}};
  const std::vector<Box> first = boxesOf(whole, 2500, 3);
  const std::vector<Box> second = boxesOf(between, 2500, 4);
  OverlapSearch search;
  const Span<const Pair> found = search.find(first, second);
  ASSERT_EQ(std::vector<Pair>(found.begin(), found.end()), test::oracleBetween(first, second));
  ASSERT_EQ(search.statistics().exactTests, 0U);
}

TEST(FewValues, GiveTheNeighborsOfTheDoubleLoop) {
  const std::vector<Box> boxes = boxesOf(valuesOf(0), 1000, 5);
  OverlapSearch search;
  const NeighborsView rows = search.findNeighbors(boxes, NeighborRows::Half);
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    for (std::uint64_t at = rows.offsets[i]; at < rows.offsets[i + 1]; ++at) pairs.push_back({i, rows.indices[at]});
  }
  ASSERT_EQ(pairs, test::oracle(boxes));
  ASSERT_EQ(search.statistics().exactTests, 0U);
}

/// There more than the order of bounds decides.
TEST(FewValues, CountAsTheyAreWithDistanceMarginsAndRegion) {
  const std::vector<Box> boxes = boxesOf(valuesOf(0), 1000, 6);
  EXPECT_EQ(overlaps(boxes, {.distance = 0.1}), test::oracle(boxes, 0.1));
  const std::vector<double> margins(boxes.size(), 0.05);
  BoxView view(boxes);
  view.setMargins(margins);
  EXPECT_EQ(overlaps(view), test::oracle(boxes, 0.0, margins));
  const Box region{{0.1, -0.25, 0.3}, {0.1, 0.35, 0.6}};
  std::vector<Pair> expected;
  for (const Pair pair : test::oracle(boxes)) {
    if (test::overlapByOracle(boxes[pair.first], region, 0.0) && test::overlapByOracle(boxes[pair.second], region, 0.0))
      expected.push_back(pair);
  }
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(overlaps(boxes, {.region = region}), expected);
}

/// A search after another, of boxes of few values or not, has nothing of it.
TEST(FewValues, AreForgottenByTheNextSearch) {
  OverlapSearch search;
  for (unsigned seed = 0; seed < 12; ++seed) {
    const std::size_t n = 300 + 211 * (seed % 5);
    const std::vector<Box> boxes =
        seed % 3 == 2 ? test::toDouble(test::randomBoxes(n, seed)) : boxesOf(valuesOf(seed % kValueKinds), n, seed);
    const Span<const Pair> found = search.find(boxes);
    ASSERT_EQ(std::vector<Pair>(found.begin(), found.end()), test::oracle(boxes)) << seed;
    if (seed % 4 == 1) search.shrink();
  }
}

/// As many values as there may be of 2,500 boxes, which all hash to one of the 256 slots (input/FewValues.cpp): they would
/// be looked for one after the other.
TEST(FewValues, ChosenToCollideAreLeftAsTheyAre) {
  std::uint64_t inverse = 0x9E3779B97F4A7C15ULL;  // Newton's method: each step doubles the bits that are right.
  for (int step = 0; step < 6; ++step) inverse *= 2 - 0x9E3779B97F4A7C15ULL * inverse;
  std::vector<double> colliding;
  for (std::uint64_t i = 0; colliding.size() < 98; ++i) {
    const auto value = std::bit_cast<double>(((std::uint64_t{77} << 56U) + i) * inverse);
    if (std::isfinite(value)) colliding.push_back(value);
  }
  std::sort(colliding.begin(), colliding.end());
  const std::vector<Box> boxes = boxesOf({{colliding, colliding, colliding}}, 2500, 8);
  OverlapSearch search;
  const Span<const Pair> found = search.find(boxes);
  EXPECT_EQ(std::vector<Pair>(found.begin(), found.end()), test::oracle(boxes));
  EXPECT_GT(search.statistics().exactTests, 0U);
}

/// The limit of values, which grows with the number of boxes, is met by the values of the last box: it is one more, so
/// that boxes are searched as they are, and exact tests decide about those that touch.
TEST(FewValues, AreNotManyOfThem) {
  const auto exactTestsOf = [](std::size_t count) {
    AxisValues values;
    for (std::vector<double>& axis : values) {
      for (std::size_t i = 0; i < count; ++i) axis.push_back(0.1 * static_cast<double>(i));
    }
    std::vector<Box> boxes = boxesOf(values, 2500, 7);
    OverlapSearch search;
    const Span<const Pair> found = search.find(boxes);
    EXPECT_EQ(std::vector<Pair>(found.begin(), found.end()), test::oracle(boxes));
    return search.statistics().exactTests;
  };
  EXPECT_EQ(exactTestsOf(100), 0U);
  EXPECT_GT(exactTestsOf(101), 0U);
}

}  // namespace
}  // namespace allpairs
