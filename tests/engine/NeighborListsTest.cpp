// SPDX-License-Identifier: MIT
// Boxes with many partners each: pairs in order come from a list for each box.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "support/Boxes.h"
#include "support/Numbers.h"
#include "support/Oracle.h"

namespace allpairs {
namespace {

/// Some thousand pairs of a few dozen for each box, among them boxes that are empty, infinite, giant and alike.
std::vector<Box> denseBoxes(std::size_t n, unsigned seed) {
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(n, seed, 2.5F));
  std::swap(boxes[3].min[1], boxes[3].max[1]);
  boxes[n / 2] = kEmptyBox;
  boxes[n / 3] = {{-test::kInfinity, 0, 0}, {test::kInfinity, 2, 2}};
  boxes[n / 4] = {{-1e30, -1e30, -1e30}, {1e30, 1e30, 1e30}};
  for (std::size_t i = 0; i < 40; ++i) boxes[n - 1 - 7 * i] = boxes[n / 5];
  return boxes;
}

constexpr std::size_t kDenseBoxes = 1500;

/// The pairs as they come by (second, first).
std::vector<Pair> bySecond(std::vector<Pair> pairs) {
  std::sort(pairs.begin(), pairs.end(), test::isLessBySecond);
  return pairs;
}

std::vector<OverlapOptions> waysToSearch() {
  static parallel::TbbExecutor threads(3);
  std::vector<OverlapOptions> all;
  for (const std::string_view name : instructionSets()) {
    OverlapOptions options;
    options.strategy = Strategy::Bvh;
    options.instructionSet = name;
    all.push_back(options);
  }
  all.push_back(all.front());
  all.back().executor = &threads;
  return all;
}

template <class Boxes>
void expectPairs(const Boxes& boxes, const OverlapOptions& given, const std::vector<Pair>& expected) {
  ASSERT_GT(expected.size(), 15 * boxes.size()) << "too few for lists";
  for (OverlapOptions options : waysToSearch()) {
    options.filter = given.filter;
    options.distance = given.distance;
    ASSERT_EQ(overlaps(boxes, options), expected) << options.instructionSet;
    options.order = Order::BySecond;
    ASSERT_EQ(overlaps(boxes, options), bySecond(expected)) << options.instructionSet;
  }
}

TEST(NeighborLists, OfOneSetGiveTheOraclesPairs) {
  const std::vector<Box> boxes = denseBoxes(kDenseBoxes, 1);
  expectPairs(boxes, {}, test::oracle(boxes));
  const std::vector<BoxF> inFloat = test::randomBoxes(kDenseBoxes, 2, 2.5F);
  expectPairs(inFloat, {}, test::oracle(test::toDouble(inFloat)));
}

TEST(NeighborLists, AreNotNeededForAFewBoxesWithManyPartners) {
  // Most rows of a bucket are ordered by ranks; those with a row of thousands, or with too many pairs, are radix
  // sorted.
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(4 * kDenseBoxes, 7));
  for (const std::size_t giant : {std::size_t{5}, kDenseBoxes, 4 * kDenseBoxes - 300}) {
    boxes[giant] = {{-1e30, -1e30, -1e30}, {1e30, 1e30, 1e30}};
  }
  const std::vector<Box> others = test::toDouble(test::randomBoxes(kDenseBoxes, 8, 1.5F));
  const std::vector<Pair> expected = test::oracle(boxes);
  const std::vector<Pair> expectedBetween = test::oracleBetween(boxes, others);
  ASSERT_LT(expected.size(), 8 * boxes.size()) << "too many for buckets";
  for (OverlapOptions options : waysToSearch()) {
    ASSERT_EQ(overlaps(boxes, options), expected) << options.instructionSet;
    ASSERT_EQ(overlaps(boxes, others, options), expectedBetween) << options.instructionSet;
    options.order = Order::BySecond;
    ASSERT_EQ(overlaps(boxes, options), bySecond(expected)) << options.instructionSet;
    ASSERT_EQ(overlaps(boxes, others, options), bySecond(expectedBetween)) << options.instructionSet;
  }
}

TEST(NeighborLists, OfTwoSetsGiveTheOraclesPairs) {
  const std::vector<Box> first = denseBoxes(kDenseBoxes, 3);
  for (const std::size_t size : {std::size_t{700}, kDenseBoxes + 1, 2 * kDenseBoxes}) {
    const std::vector<Box> second = denseBoxes(size, 4);
    const std::vector<Pair> expected = test::oracleBetween(first, second);
    for (OverlapOptions options : waysToSearch()) {
      ASSERT_EQ(overlaps(first, second, options), expected) << options.instructionSet;
      options.order = Order::BySecond;
      ASSERT_EQ(overlaps(first, second, options), bySecond(expected)) << options.instructionSet;
    }
  }
}

/// Cubes whose faces touch, or are apart by less than float32 can tell. Some begin lower, each at a place of its own, so
/// that bounds do not take few values.
std::vector<Box> latticeBoxes() {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < kDenseBoxes; ++i) {
    const double apart = i % 3 == 0 ? 1e-12 : 0.0;
    const std::size_t place = i / 3;
    boxes.push_back(test::cube(static_cast<double>(place % 8) + apart, static_cast<double>(place / 8 % 8) / 3.0,
                               static_cast<double>(place / 64)));
    if (i % 4 == 0) boxes.back().min[2] -= 1e-5 * static_cast<double>(i);
  }
  return boxes;
}

TEST(NeighborLists, DecideInDoubleWhatLanesCannot) {
  const std::vector<Box> boxes = latticeBoxes();
  const std::vector<Pair> expected = test::oracle(boxes);
  expectPairs(boxes, {}, expected);
  OverlapSearch search;
  EXPECT_EQ(test::toVector(search.find(boxes)), expected);
  EXPECT_GT(search.statistics().exactTests, 0U);
  EXPECT_EQ(search.statistics().pairs, expected.size());
}

TEST(NeighborLists, DecideInDoubleNoMoreThanThat) {
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(kDenseBoxes, 6, 2.5F));
  // Twenty of them touch one, or end a hair before it; all their other partners are certain.
  const Box one = test::cube(1e3, 0, 0);
  for (std::size_t i = 0; i < 20; ++i) {
    boxes[40 * i] = {{999, 0, 0}, {i % 2 == 0 ? one.min[0] : std::nextafter(one.min[0], 0.0), 1, 1}};
  }
  boxes.back() = one;
  OverlapOptions options;
  options.strategy = Strategy::Bvh;
  OverlapSearch search(options);
  const std::vector<Pair> expected = test::oracle(boxes);
  ASSERT_GT(expected.size(), 15 * boxes.size()) << "too few for lists";
  EXPECT_EQ(test::toVector(search.find(boxes)), expected);
  EXPECT_EQ(search.statistics().exactTests, 20U);
}

/// Some of the boxes are in groups, and a predicate forbids more; returns the pairs of those that both allow.
std::vector<Pair> setFilter(std::vector<std::uint32_t>& groups, OverlapOptions& options, std::vector<Pair> pairs) {
  for (std::size_t i = 0; i < groups.size(); ++i) groups[i] = static_cast<std::uint32_t>(i % 5);
  options.filter.first.groups = groups;
  options.filter.accept = [](std::uint32_t a, std::uint32_t b) { return (a + 2 * b) % 11 != 0; };
  std::erase_if(pairs, [&groups](Pair pair) {
    const bool alike = groups[pair.first] != 0 && groups[pair.first] == groups[pair.second];
    return alike || (pair.first + 2 * pair.second) % 11 == 0;
  });
  return pairs;
}

TEST(NeighborLists, AreFilteredAndWidened) {
  const std::vector<Box> boxes = denseBoxes(kDenseBoxes, 5);
  std::vector<std::uint32_t> groups(boxes.size());
  for (const double distance : {0.0, 0.25, -0.125}) {
    OverlapOptions options;
    options.distance = distance;
    expectPairs(boxes, options, setFilter(groups, options, test::oracle(boxes, distance)));
  }
}

TEST(NeighborLists, AreFilteredAfterTheExactTest) {
  const std::vector<Box> boxes = latticeBoxes();
  std::vector<std::uint32_t> groups(boxes.size());
  OverlapOptions options;
  const std::vector<Pair> expected = setFilter(groups, options, test::oracle(boxes));
  const std::vector<Pair> touching = test::oracle(boxes);
  const PairPredicate accept = options.filter.accept;
  options.filter.accept = [&](std::uint32_t a, std::uint32_t b) {
    EXPECT_TRUE(std::binary_search(touching.begin(), touching.end(), Pair{a, b})) << a << ' ' << b;
    return accept(a, b);
  };
  expectPairs(boxes, options, expected);
}

TEST(NeighborLists, AreKeptFromSearchToSearchOfOtherSizesAndOrders) {
  OverlapOptions options;
  OverlapSearch search(options);
  for (const std::size_t n : {std::size_t{900}, kDenseBoxes, std::size_t{600}, std::size_t{1200}}) {
    const std::vector<Box> boxes = denseBoxes(n, static_cast<unsigned>(n));
    const std::vector<Box> sparse = test::toDouble(test::randomBoxes(n, 9, 0.5F));
    ASSERT_EQ(test::toVector(search.find(boxes)), test::oracle(boxes));
    ASSERT_EQ(test::toVector(search.find(sparse)), test::oracle(sparse));
    ASSERT_EQ(test::toVector(search.find(boxes, sparse)), test::oracleBetween(boxes, sparse));
    options.order = options.order == Order::ByFirst ? Order::BySecond : Order::ByFirst;
    search.setOptions(options);
    ASSERT_EQ(test::toVector(search.find(boxes)),
              options.order == Order::ByFirst ? test::oracle(boxes) : bySecond(test::oracle(boxes)));
    options.order = Order::ByFirst;
    search.setOptions(options);
  }
}

/// Boxes that all overlap each other, elsewhere on each axis.
std::vector<Box> crowd(std::size_t n) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < n; ++i) boxes.push_back(test::cube(30.0 + 0x1p-12 * static_cast<double>(i), 20, 10));
  return boxes;
}

TEST(NeighborLists, OfACrowdAfterASmallerOneAreAllPairs) {
  for (std::size_t n = 1060; n < 1180; n += 20) {  // twice as many, and some more
    OverlapSearch search({.strategy = Strategy::Bvh});
    ASSERT_EQ(search.find(test::lent(crowd(500))).size(), 500U * 499U / 2U);
    const Span<const Pair> found = search.find(test::lent(crowd(n)));
    ASSERT_EQ(found.size(), n * (n - 1) / 2) << n;
    std::size_t wrong = 0;
    std::size_t at = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t k = i + 1; k < n; ++k) wrong += found[at++] == Pair{i, k} ? 0U : 1U;
    }
    ASSERT_EQ(wrong, 0U) << n;
  }
}

TEST(NeighborLists, HoldNoMorePairsThanTheLimit) {
  const std::vector<Box> boxes = denseBoxes(kDenseBoxes, 6);
  const std::vector<Pair> expected = test::oracle(boxes);
  OverlapOptions options;
  options.maxPairs = expected.size();
  EXPECT_EQ(overlaps(boxes, options), expected);
  options.maxPairs = expected.size() - 1;
  EXPECT_THROW(static_cast<void>(overlaps(boxes, options)), LimitExceeded);
  options.maxPairs = 100;
  EXPECT_THROW(static_cast<void>(overlaps(boxes, options)), LimitExceeded);
}

}  // namespace
}  // namespace allpairs
