// SPDX-License-Identifier: MIT
// Sets so small that they are searched in memory on the stack: every count around the limits between the ways of doing
// so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <string_view>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/StopFlag.h"
#include "support/Boxes.h"
#include "support/Corners.h"
#include "support/Numbers.h"
#include "support/Oracle.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

constexpr std::size_t kSomewhatMany = 131;

/// Of every eight boxes one is empty, two reach to infinity, and one touches its neighbour.
template <class T>
std::vector<BasicBox<T>> someBoxes(std::size_t n, unsigned seed) {
  const T infinity = std::numeric_limits<T>::infinity();
  std::vector<BasicBox<T>> boxes(n);
  const std::vector<BoxF> random = test::randomBoxes(n, seed, 1.6F);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      boxes[i].min[axis] = static_cast<T>(random[i].min[axis]) / 3;
      boxes[i].max[axis] = static_cast<T>(random[i].max[axis]) / 3;
    }
    if (i % 8 == 3) std::swap(boxes[i].min[i % 3], boxes[i].max[i % 3]);
    if (i % 8 == 5) boxes[i].min[i % 3] = -infinity;
    if (i % 8 == 7) boxes[i].max[i % 3] = infinity;
    if (i % 8 == 6) boxes[i].min[0] = boxes[i - 2].max[0];
    if (i % 8 == 6) boxes[i].max[0] = boxes[i].min[0] + 1;
  }
  return boxes;
}

template <class T>
std::vector<Box> inDouble(const std::vector<BasicBox<T>>& boxes) {
  std::vector<Box> result(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::copy(boxes[i].min.begin(), boxes[i].min.end(), result[i].min.begin());
    std::copy(boxes[i].max.begin(), boxes[i].max.end(), result[i].max.begin());
  }
  return result;
}

template <class T>
class FewBoxes : public ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(FewBoxes, Precisions);

TYPED_TEST(FewBoxes, GiveTheOraclesPairsInEveryOrderForEveryCount) {
  OverlapSearch kept;
  for (std::size_t n = 0; n <= kSomewhatMany; ++n) {
    const auto boxes = someBoxes<TypeParam>(n, static_cast<unsigned>(n));
    const std::vector<Pair> expected = test::oracle(inDouble(boxes));
    for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
      OverlapOptions options;
      options.order = order;
      kept.setOptions(options);
      std::vector<Pair> made = overlaps(boxes, options);
      std::vector<Pair> found = test::toVector(kept.find(boxes));
      if (order == Order::Unordered) std::sort(made.begin(), made.end());
      if (order == Order::Unordered) std::sort(found.begin(), found.end());
      ASSERT_EQ(made, test::inOrder(expected, order)) << n << " boxes";
      ASSERT_EQ(found, test::inOrder(expected, order)) << n << " boxes";
      ASSERT_EQ(kept.statistics().pairs, expected.size()) << n << " boxes";
      ASSERT_EQ(kept.count(boxes), expected.size()) << n << " boxes";
    }
  }
}

TYPED_TEST(FewBoxes, OfTwoSetsGiveTheOraclesPairsInEveryOrder) {
  OverlapSearch kept;
  for (std::size_t n = 0; n <= kSomewhatMany; n += n < 20 ? 1 : 9) {
    for (const std::size_t m : {0U, 1U, 7U, 16U, 33U, 128U, 129U}) {
      const auto first = someBoxes<TypeParam>(n, static_cast<unsigned>(n));
      const auto second = someBoxes<TypeParam>(m, static_cast<unsigned>(1000 + m));
      const std::vector<Pair> expected = test::oracleBetween(inDouble(first), inDouble(second));
      for (const Order order : {Order::ByFirst, Order::BySecond}) {
        OverlapOptions options;
        options.order = order;
        kept.setOptions(options);
        ASSERT_EQ(overlaps(first, second, options), test::inOrder(expected, order)) << n << " and " << m << " boxes";
        ASSERT_EQ(test::toVector(kept.find(first, second)), test::inOrder(expected, order))
            << n << " and " << m << " boxes";
        ASSERT_EQ(kept.count(first, second), expected.size()) << n << " and " << m << " boxes";
      }
    }
  }
}

/// Whatever way a search of these two sets is asked for gives the pairs, in the order of the search's options.
template <class T>
void expectPairs(OverlapSearch& search, const std::vector<BasicBox<T>>& first, const std::vector<BasicBox<T>>& second,
                 const std::vector<Pair>& expected) {
  const auto comparable = [&](std::vector<Pair> pairs) {
    if (search.options().order == Order::Unordered) std::sort(pairs.begin(), pairs.end());
    return pairs;
  };
  ASSERT_EQ(comparable(test::toVector(search.find(first, second))), expected);
  ASSERT_EQ(search.statistics().pairs, expected.size());
  const std::size_t few = std::min(first.size(), second.size());
  const std::size_t many = std::max(first.size(), second.size());
  if (many <= 64 || (few > 4 && many <= 72)) {  // Else a few may be beside many, or boxes in a hierarchy.
    ASSERT_EQ(search.statistics().boxTests, first.size() * second.size());
  }
  std::vector<Pair> memory(expected.size());
  ASSERT_EQ(search.findInto(first, second, memory).size(), expected.size());
  ASSERT_EQ(comparable(memory), expected);
  ASSERT_EQ(search.count(first, second), expected.size());
  ASSERT_EQ(comparable(overlaps(first, second, search.options())), expected);
}

TYPED_TEST(FewBoxes, OfTwoSetsGiveTheOraclesPairsForEveryCountWithEveryInstructionSet) {
  constexpr std::size_t kStep = test::kIsSanitized ? 3 : 1;
  for (std::size_t n = 0; n <= kSomewhatMany; n += n < 70 ? 1 : 13) {
    for (std::size_t m = n % kStep; m <= kSomewhatMany; m += m < 70 ? kStep : 7) {
      const auto first = someBoxes<TypeParam>(n, static_cast<unsigned>(n));
      const auto second = someBoxes<TypeParam>(m, static_cast<unsigned>(100 + m));
      const std::vector<Pair> expected = test::oracleBetween(inDouble(first), inDouble(second));
      const std::string_view instructionSet = instructionSets()[(n + m) % instructionSets().size()];
      for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
        OverlapSearch search({.order = order, .instructionSet = instructionSet});
        ASSERT_NO_FATAL_FAILURE(expectPairs(search, first, second, test::inOrder(expected, order)))
            << n << " and " << m << " boxes, " << instructionSet;
      }
    }
  }
}

TYPED_TEST(FewBoxes, OfTwoSetsInTwoArraysGiveTheOraclesPairs) {
  for (std::size_t n = 1; n <= kSomewhatMany; n += n < 20 ? 1 : 11) {
    for (const std::size_t m : {1U, 6U, 8U, 13U, 64U, 65U, 130U}) {
      const auto first = someBoxes<TypeParam>(n, static_cast<unsigned>(n));
      const auto second = someBoxes<TypeParam>(m, static_cast<unsigned>(500 + m));
      const test::Corners<TypeParam> firstCorners(first);
      const test::Corners<TypeParam> secondCorners(second);
      const std::vector<Pair> expected = test::oracleBetween(inDouble(first), inDouble(second));
      for (const std::string_view instructionSet : instructionSets()) {
        for (const Order order : {Order::ByFirst, Order::BySecond}) {
          const OverlapOptions options{.order = order, .instructionSet = instructionSet};
          const std::vector<Pair> inOrder = test::inOrder(expected, order);
          ASSERT_EQ(overlaps(firstCorners.view(), secondCorners.view(), options), inOrder) << n << " and " << m;
          ASSERT_EQ(overlaps(first, secondCorners.view(), options), inOrder) << n << " and " << m;
        }
      }
    }
  }
}

TYPED_TEST(FewBoxes, GiveTheSameListWithEveryInstructionSet) {
  for (std::size_t n = 0; n <= kSomewhatMany; ++n) {
    const auto boxes = someBoxes<TypeParam>(n, static_cast<unsigned>(n));
    const auto others = someBoxes<TypeParam>(n / 2, static_cast<unsigned>(200 + n));
    const std::vector<Pair> expected = test::oracle(inDouble(boxes));
    const std::vector<Pair> between = test::oracleBetween(inDouble(boxes), inDouble(others));
    for (const std::string_view instructionSet : instructionSets()) {
      for (const Order order : {Order::ByFirst, Order::BySecond}) {
        const OverlapOptions options{.order = order, .instructionSet = instructionSet};
        ASSERT_EQ(overlaps(boxes, options), test::inOrder(expected, order)) << n << " boxes, " << instructionSet;
        ASSERT_EQ(overlaps(boxes, others, options), test::inOrder(between, order)) << n << " boxes, " << instructionSet;
      }
    }
  }
}

TYPED_TEST(FewBoxes, OfTwoSetsThatAllOverlapFitTheResult) {
  for (const std::size_t n : {1U, 5U, 31U, 32U, 33U, 63U, 64U, 65U, 128U}) {
    for (const std::size_t m : {1U, 31U, 32U, 63U, 64U, 65U, 128U}) {
      const std::vector<BasicBox<TypeParam>> first(n, {{0, 0, 0}, {1, 1, 1}});
      const std::vector<BasicBox<TypeParam>> second(m, {{1, 1, 1}, {2, 2, 2}});
      ASSERT_EQ(overlaps(first, second).size(), n * m);
      ASSERT_EQ(overlaps(second, first, {.order = Order::BySecond}).size(), n * m);
    }
  }
}

/// Around the most that are compared as they lie in memory, sparse and dense ones.
TYPED_TEST(FewBoxes, OfSeveralWordsGiveTheOraclesPairsWithEveryInstructionSet) {
  for (const std::size_t n : {129U, 191U, 192U, 193U, 256U, 257U, 320U, 321U, 383U, 384U, 385U}) {
    auto boxes = someBoxes<TypeParam>(n, static_cast<unsigned>(n));
    for (std::size_t i = 0; i < n / 2; ++i) {  // Half of them overlap many.
      for (std::size_t axis = 0; axis < 3; ++axis) boxes[i].max[axis] += n % 2 == 0 ? 0 : 2;
    }
    const auto others = someBoxes<TypeParam>(n / 3, static_cast<unsigned>(300 + n));
    const std::vector<Pair> expected = test::oracle(inDouble(boxes));
    const std::vector<Pair> between = test::oracleBetween(inDouble(boxes), inDouble(others));
    for (const std::string_view instructionSet : instructionSets()) {
      for (const Order order : {Order::ByFirst, Order::BySecond}) {
        for (const Strategy strategy : {Strategy::Automatic, Strategy::Exhaustive}) {
          OverlapSearch search({.strategy = strategy, .order = order, .instructionSet = instructionSet});
          ASSERT_EQ(test::toVector(search.find(boxes)), test::inOrder(expected, order)) << n << ", " << instructionSet;
          ASSERT_EQ(search.count(boxes), expected.size()) << n << ", " << instructionSet;
          ASSERT_EQ(overlaps(boxes, others, search.options()), test::inOrder(between, order)) << n << instructionSet;
        }
      }
    }
  }
}

/// More than are rounded to lanes, and as many as are compared as they lie in memory.
TYPED_TEST(FewBoxes, GiveTheSameUnorderedListWhateverTheLayout) {
  for (const std::size_t n : {250U, 257U, 300U, 320U, 321U}) {
    const auto boxes = someBoxes<TypeParam>(n, static_cast<unsigned>(n));
    std::vector<TypeParam> rowsOfSeven;
    for (const auto& box : boxes) {
      rowsOfSeven.insert(rowsOfSeven.end(), box.min.begin(), box.min.end());
      rowsOfSeven.insert(rowsOfSeven.end(), box.max.begin(), box.max.end());
      rowsOfSeven.push_back(0);
    }
    const CornerView<TypeParam> min{rowsOfSeven.data(), 7, 1};
    const CornerView<TypeParam> max{rowsOfSeven.data() + 3, 7, 1};
    const BoxView apart = BoxView::fromStrided(n, min, max);
    OverlapSearch search({.order = Order::Unordered});
    const std::vector<Pair> expected = test::toVector(search.find(boxes));
    EXPECT_EQ(test::toVector(search.find(apart)), expected) << n;
    EXPECT_EQ(overlaps(apart, {.order = Order::Unordered}), expected) << n;
  }
}

/// Boxes that all overlap have several parts of pairs, and the flag is looked at before each.
TYPED_TEST(FewBoxes, AreStoppedBetweenPartsOfTheirPairs) {
  const std::vector<BasicBox<TypeParam>> boxes(250, {{0, 0, 0}, {1, 1, 1}});
  int asked = 0;
  int answered = 0;
  const auto ask = [&] { return ++asked > answered; };
  const StopFlag stop(ask);
  const std::size_t parts = boxes.size() * (boxes.size() - 1) / 2 / 4096 + 1;
  for (; answered < static_cast<int>(parts); ++answered) {
    asked = 0;
    EXPECT_THROW((void)overlaps(boxes, {.strategy = Strategy::Exhaustive, .stop = &stop}), Stopped) << answered;
  }
  answered = 1000;
  EXPECT_EQ(overlaps(boxes, {.strategy = Strategy::Exhaustive, .stop = &stop}), test::oracle(inDouble(boxes)));
}

TYPED_TEST(FewBoxes, OfTwoSetsAreStoppedBetweenPartsOfTheirPairs) {
  const std::vector<BasicBox<TypeParam>> boxes(200, {{0, 0, 0}, {1, 1, 1}});
  const std::vector<Pair> expected = test::oracleBetween(inDouble(boxes), inDouble(boxes));
  int asked = 0;
  int answered = 0;
  const auto ask = [&] { return ++asked > answered; };
  const StopFlag stop(ask);
  const OverlapOptions options{.strategy = Strategy::Exhaustive, .stop = &stop};
  for (; answered < static_cast<int>(expected.size() / 4096); ++answered) {
    asked = 0;
    EXPECT_THROW((void)overlaps(boxes, boxes, options), Stopped) << answered;
  }
  answered = 1000;
  EXPECT_EQ(overlaps(boxes, boxes, options), expected);
}

/// Bounds that float32 cannot tell apart.
TEST(FewBoxesInDouble, AreNotRounded) {
  for (const std::size_t n : {1U, 3U, 9U, 20U, 40U}) {
    const std::vector<Box> first(n, {{0, 0, 0}, {0.1, 1, 1}});
    const std::vector<Box> apart(n, {{std::nextafter(0.1, 1.0), 0, 0}, {1, 1, 1}});
    const std::vector<Box> touching(n, {{0.1, 0, 0}, {1, 1, 1}});
    for (const std::string_view instructionSet : instructionSets()) {
      const OverlapOptions options{.instructionSet = instructionSet};
      EXPECT_EQ(overlaps(first, apart, options).size(), 0U) << n << " boxes, " << instructionSet;
      EXPECT_EQ(overlaps(first, touching, options).size(), n * n) << n << " boxes, " << instructionSet;
    }
  }
}

TEST(FewBoxesOfTwoSets, OfDifferentPrecisionsAndLayoutsAreCompared) {
  const auto first = someBoxes<double>(20, 1);
  const auto second = someBoxes<float>(30, 2);
  const std::vector<Pair> expected = test::oracleBetween(first, inDouble(second));
  EXPECT_EQ(overlaps(first, second), expected);
  EXPECT_EQ(overlaps(second, first).size(), expected.size());
  const test::Corners<double> corners(first);
  const auto inDoubleSecond = inDouble(second);
  EXPECT_EQ(overlaps(corners.view(), inDoubleSecond), expected);
}

TEST(FewBoxesOfTwoSets, WithOptionsGoTheWayOfMany) {
  const auto first = someBoxes<double>(20, 3);
  const auto second = someBoxes<double>(30, 4);
  EXPECT_EQ(overlaps(first, second, {.distance = 0.1}), test::oracleBetween(first, second, 0.1));
  OverlapOptions options;
  options.filter.accept = [](std::uint32_t a, std::uint32_t b) { return a < b; };
  std::vector<Pair> expected = test::oracleBetween(first, second);
  std::erase_if(expected, [](Pair pair) { return pair.first >= pair.second; });
  EXPECT_EQ(overlaps(first, second, options), expected);
  const std::vector<Box> one(1, test::cube(0, 0, 0));
  EXPECT_THROW((void)overlaps(one, one, {.instructionSet = "NONE"}), InvalidArgument);
  EXPECT_THROW((void)overlaps(one, one, {.maxPairs = 0}), LimitExceeded);
}

TYPED_TEST(FewBoxes, AreFilteredAndWidenedAsManyAre) {
  for (const std::size_t n : {2U, 5U, 8U, 9U, 16U, 60U, 128U, 129U}) {
    const auto boxes = someBoxes<TypeParam>(n, static_cast<unsigned>(n));
    std::vector<std::uint32_t> groups(n);
    std::vector<double> margins(n);
    for (std::size_t i = 0; i < n; ++i) groups[i] = static_cast<std::uint32_t>(i % 5);
    for (std::size_t i = 0; i < n; ++i) margins[i] = 0.03 * static_cast<double>(i % 3);
    const auto isKept = [&](Pair pair) { return groups[pair.first] == 0 || groups[pair.first] != groups[pair.second]; };
    BoxView view(boxes);
    for (const bool widened : {false, true}) {
      if (widened) view.setMargins(margins);
      std::vector<Pair> expected;
      for (const Pair pair : test::oracle(inDouble(boxes), 0.0, widened ? margins : std::vector<double>())) {
        if (isKept(pair)) expected.push_back(pair);
      }
      OverlapOptions options;
      options.filter.first.groups = groups;
      ASSERT_EQ(overlaps(view, options), expected) << n << " boxes";
      options.filter.first.groups = {};
      options.filter.accept = [&](std::uint32_t a, std::uint32_t b) { return isKept({a, b}); };
      ASSERT_EQ(overlaps(view, options), expected) << n << " boxes";
    }
  }
}

TYPED_TEST(FewBoxes, BeyondTheLimitAreAnErrorThatLeavesTheSearchUsable) {
  for (const std::size_t n : {3U, 8U, 9U, 128U}) {
    const std::vector<BasicBox<TypeParam>> boxes(n, {{0, 0, 0}, {1, 1, 1}});
    OverlapOptions options;
    options.maxPairs = n * (n - 1) / 2 - 1;
    OverlapSearch kept(options);
    EXPECT_THROW((void)kept.find(boxes), LimitExceeded) << n;
    EXPECT_THROW((void)kept.count(boxes), LimitExceeded) << n;
    EXPECT_EQ(kept.statistics().pairs, 0U) << n;
    ++options.maxPairs;
    kept.setOptions(options);
    EXPECT_EQ(kept.find(boxes).size(), options.maxPairs) << n;
    EXPECT_EQ(kept.statistics().boxTests, options.maxPairs) << n;
  }
}

TEST(FewBoxesOptions, AreCheckedHoweverFewTheBoxesAre) {
  const std::vector<Box> boxes(2, test::cube(0, 0, 0));
  OverlapOptions options;
  options.instructionSet = "NONE";
  EXPECT_THROW((void)overlaps(boxes, options), InvalidArgument);
  options = {};
  options.distance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)overlaps(boxes, options), InvalidArgument);
  options = {};
  const std::vector<std::uint32_t> groups{1};
  options.filter.first.groups = groups;
  EXPECT_THROW((void)overlaps(boxes, options), InvalidArgument);
  options = {};
  options.filter.second.masks = groups;
  EXPECT_THROW((void)overlaps(boxes, options), InvalidArgument);
}

}  // namespace
}  // namespace allpairs
