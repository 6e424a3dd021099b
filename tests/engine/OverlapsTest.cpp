// SPDX-License-Identifier: MIT
#include "allpairs/Neighbors.h"
#include "allpairs/Overlaps.h"
#include "allpairs/World.h"
#include "allpairs/Worlds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory_resource>
#include <vector>

#include "allpairs/Error.h"
#include "support/Boxes.h"
#include "support/Numbers.h"
#include "support/Oracle.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

using test::cube;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using test::kInfinity;
constexpr Box kWholeSpace{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};

/// Runs with each strategy; whatever is written here holds for all of them.
class Overlaps_ : public ::testing::TestWithParam<Strategy> {
 protected:
  static OverlapOptions options() {
    OverlapOptions result;
    result.strategy = GetParam();
    return result;
  }
  static std::vector<Pair> pairsOf(const std::vector<Box>& boxes, const OverlapOptions& with = options()) {
    return overlaps(boxes, with);
  }
};

INSTANTIATE_TEST_SUITE_P(EachStrategy, Overlaps_,
                         ::testing::Values(Strategy::Automatic, Strategy::Exhaustive, Strategy::Bvh));

TEST_P(Overlaps_, NoBoxesAndOneBoxHaveNoPairs) {
  EXPECT_THAT(pairsOf({}), IsEmpty());
  EXPECT_THAT(pairsOf({cube(0, 0, 0)}), IsEmpty());
}

TEST_P(Overlaps_, BoxesSharingAFaceAnEdgeOrACornerAreAPair) {
  EXPECT_THAT(pairsOf({cube(0, 0, 0), cube(1, 0, 0)}), ElementsAre(Pair{0, 1}));
  EXPECT_THAT(pairsOf({cube(0, 0, 0), cube(1, 1, 0)}), ElementsAre(Pair{0, 1}));
  EXPECT_THAT(pairsOf({cube(0, 0, 0), cube(1, 1, 1)}), ElementsAre(Pair{0, 1}));
}

TEST_P(Overlaps_, TheSmallestGapInDoubleIsNoPair) {
  Box right = cube(1, 0, 0);
  right.min[0] += std::numeric_limits<double>::epsilon();
  EXPECT_THAT(pairsOf({cube(0, 0, 0), right}), IsEmpty());
}

TEST_P(Overlaps_, PairsComeOrderedByFirstAndThenSecond) {
  const std::vector<Box> boxes(4, cube(0, 0, 0));
  EXPECT_THAT(pairsOf(boxes), ElementsAre(Pair{0, 1}, Pair{0, 2}, Pair{0, 3}, Pair{1, 2}, Pair{1, 3}, Pair{2, 3}));
}

TEST_P(Overlaps_, PairsCanBeOrderedBySecondAndThenFirst) {
  OverlapOptions bySecond = options();
  bySecond.order = Order::BySecond;
  const std::vector<Box> boxes(4, cube(0, 0, 0));
  EXPECT_THAT(pairsOf(boxes, bySecond),
              ElementsAre(Pair{0, 1}, Pair{0, 2}, Pair{1, 2}, Pair{0, 3}, Pair{1, 3}, Pair{2, 3}));
}

TEST_P(Overlaps_, EmptyBoxesOverlapNothingNotEvenTheWholeSpace) {
  Box inverted = cube(0, 0, 0);
  std::swap(inverted.min[1], inverted.max[1]);
  EXPECT_THAT(pairsOf({inverted, kWholeSpace, kEmptyBox, cube(0, 0, 0)}), ElementsAre(Pair{1, 3}));
}

TEST_P(Overlaps_, ADistanceDoesNotMakeAnEmptyBoxFull) {
  OverlapOptions far = options();
  far.distance = 100.0;
  Box inverted = cube(0, 0, 0);
  std::swap(inverted.min[1], inverted.max[1]);
  EXPECT_THAT(pairsOf({inverted, cube(0, 0, 0), cube(50, 0, 0)}, far), ElementsAre(Pair{1, 2}));
}

TEST_P(Overlaps_, InfiniteBoxesOverlapWhatTheyReach) {
  Box half = kWholeSpace;
  half.min[0] = 10.0;
  Box atInfinity = kWholeSpace;
  atInfinity.min[0] = kInfinity;
  EXPECT_THAT(pairsOf({cube(0, 0, 0), half, cube(20, 0, 0), atInfinity}), ElementsAre(Pair{1, 2}, Pair{1, 3}));
}

TEST_P(Overlaps_, BoundsBeyondFloat32AreTestedInDouble) {
  const Box huge{{1e300, 0, 0}, {1.5e300, 1, 1}};
  const Box beyond{{1.6e300, 0, 0}, {kInfinity, 1, 1}};
  const Box touching{{1.5e300, 0, 0}, {1.55e300, 1, 1}};
  EXPECT_THAT(pairsOf({huge, beyond, touching}), ElementsAre(Pair{0, 2}));
}

TEST_P(Overlaps_, TheDistanceIsPerAxisAndClosed) {
  OverlapOptions half = options();
  half.distance = 0.5;
  EXPECT_THAT(pairsOf({cube(0, 0, 0), cube(1.5, 1.5, 1.5)}, half), ElementsAre(Pair{0, 1}));
  EXPECT_THAT(pairsOf({cube(0, 0, 0), cube(1.5000001, 0, 0)}, half), IsEmpty());
}

TEST_P(Overlaps_, ANegativeDistanceShrinks) {
  OverlapOptions deep = options();
  deep.distance = -0.5;
  EXPECT_THAT(pairsOf({cube(0, 0, 0), cube(0.5, 0, 0)}, deep), ElementsAre(Pair{0, 1}));
  EXPECT_THAT(pairsOf({cube(0, 0, 0), cube(0.75, 0, 0)}, deep), IsEmpty());
}

TEST_P(Overlaps_, AnInfiniteDistancePairsEverythingThatIsNotEmpty) {
  OverlapOptions any = options();
  any.distance = kInfinity;
  EXPECT_THAT(pairsOf({cube(0, 0, 0), kEmptyBox, cube(1e30, 0, 0)}, any), ElementsAre(Pair{0, 2}));
}

TEST_P(Overlaps_, MarginsAddUpFromLeftToRight) {
  // 0.1 + 0.2 + 0.3 is 0.6000000000000001 from left to right and 0.6 from right to left.
  const std::vector<Box> boxes{cube(0, 0, 0), {{1.6000000000000001, 0, 0}, {2, 1, 1}}};
  const std::vector<double> margins{0.2, 0.3};
  BoxView set(boxes);
  set.setMargins(margins);
  OverlapOptions with = options();
  with.distance = 0.1;
  EXPECT_EQ(overlaps(set, with), test::oracle(boxes, 0.1, margins));
}

TEST_P(Overlaps_, AMarginOfTheSetCountsForEachBoxOfAPair) {
  const std::vector<Box> boxes{cube(0, 0, 0), cube(1.5, 0, 0)};
  BoxView set(boxes);
  set.setMargin(0.25);
  EXPECT_THAT(overlaps(set, options()), ElementsAre(Pair{0, 1}));
  set.setMargin(0.2);
  EXPECT_THAT(overlaps(set, options()), IsEmpty());
}

TEST_P(Overlaps_, BoxesOutsideOfTheRegionAreLeftOut) {
  OverlapOptions within = options();
  within.region = Box{{0, 0, 0}, {10, 10, 10}};
  const std::vector<Box> boxes{cube(9, 0, 0), cube(9.5, 0, 0), cube(10, 0, 0), cube(10.25, 0, 0)};
  EXPECT_THAT(pairsOf(boxes, within), ElementsAre(Pair{0, 1}, Pair{0, 2}, Pair{1, 2}));
  within.distance = 0.25;
  EXPECT_EQ(pairsOf(boxes, within).size(), 6U);
}

TEST_P(Overlaps_, FilterBitsLeavePairsOut) {
  const std::vector<Box> boxes(4, cube(0, 0, 0));
  const std::vector<std::uint32_t> categories{1, 2, 1, 4};
  const std::vector<std::uint32_t> masks{2 | 4, 1, 2 | 4, 1};
  OverlapOptions with = options();
  with.filter.first.categories = categories;
  with.filter.first.masks = masks;
  EXPECT_THAT(pairsOf(boxes, with), ElementsAre(Pair{0, 1}, Pair{0, 3}, Pair{1, 2}, Pair{2, 3}));
}

TEST_P(Overlaps_, CategoriesOrMasksOfOneSetAloneLeavePairsOut) {
  const std::vector<Box> boxes(3, cube(0, 0, 0));
  const std::vector<Box> one(1, cube(0, 0, 0));
  const std::vector<std::uint32_t> bits{1, 0, 1};
  OverlapOptions categories = options();
  categories.filter.first.categories = bits;
  OverlapOptions masks = options();
  masks.filter.first.masks = bits;
  OverlapOptions ofSecond = options();
  ofSecond.filter.second.masks = bits;
  for (const OverlapOptions& with : {categories, masks}) {
    EXPECT_THAT(pairsOf(boxes, with), ElementsAre(Pair{0, 2}));
    EXPECT_THAT(overlaps(boxes, one, with), ElementsAre(Pair{0, 0}, Pair{2, 0}));
  }
  EXPECT_THAT(overlaps(one, boxes, ofSecond), ElementsAre(Pair{0, 0}, Pair{0, 2}));
}

TEST_P(Overlaps_, BoxesOfOneGroupAreNoPairAndGroupZeroIsNone) {
  const std::vector<Box> boxes(4, cube(0, 0, 0));
  const std::vector<std::uint32_t> groups{7, 7, 0, 0};
  OverlapOptions with = options();
  with.filter.first.groups = groups;
  EXPECT_THAT(pairsOf(boxes, with), ElementsAre(Pair{0, 2}, Pair{0, 3}, Pair{1, 2}, Pair{1, 3}, Pair{2, 3}));
}

TEST_P(Overlaps_, TheCallersPredicateSeesOverlappingPairsOnly) {
  const std::vector<Box> boxes{cube(0, 0, 0), cube(0.5, 0, 0), cube(5, 0, 0), cube(0.75, 0, 0)};
  OverlapOptions with = options();
  std::vector<Pair> asked;
  with.filter.accept = [&](std::uint32_t first, std::uint32_t second) {
    asked.push_back({first, second});
    return second != 3;
  };
  EXPECT_THAT(pairsOf(boxes, with), ElementsAre(Pair{0, 1}));
  EXPECT_THAT(asked, ::testing::UnorderedElementsAre(Pair{0, 1}, Pair{0, 3}, Pair{1, 3}));
}

TEST_P(Overlaps_, BetweenTwoSetsThePairIsOneOfEach) {
  const std::vector<Box> first{cube(0, 0, 0), cube(5, 0, 0)};
  const std::vector<Box> second{cube(5.5, 0, 0), cube(0.5, 0, 0), cube(0.75, 0, 0)};
  EXPECT_THAT(overlaps(first, second, options()), ElementsAre(Pair{0, 1}, Pair{0, 2}, Pair{1, 0}));
  OverlapOptions bySecond = options();
  bySecond.order = Order::BySecond;
  EXPECT_THAT(overlaps(first, second, bySecond), ElementsAre(Pair{1, 0}, Pair{0, 1}, Pair{0, 2}));
}

TEST_P(Overlaps_, BetweenTwoSetsEachHasItsOwnFilterAndMargins) {
  const std::vector<Box> first{cube(0, 0, 0), cube(0, 0, 0)};
  const std::vector<Box> second{cube(1.5, 0, 0), cube(1.25, 0, 0)};
  BoxView wide(first);
  const std::vector<double> margins{0.25, 0.5};
  wide.setMargins(margins);
  EXPECT_THAT(overlaps(wide, second, options()), ElementsAre(Pair{0, 1}, Pair{1, 0}, Pair{1, 1}));
  const std::vector<std::uint32_t> groupsOfFirst{1, 2};
  const std::vector<std::uint32_t> groupsOfSecond{2, 1};
  OverlapOptions with = options();
  with.filter.first.groups = groupsOfFirst;
  with.filter.second.groups = groupsOfSecond;
  EXPECT_THAT(overlaps(wide, second, with), ElementsAre(Pair{1, 1}));
}

TEST_P(Overlaps_, OneEmptySetOfTwoHasNoPairs) {
  const std::vector<Box> boxes(20, cube(0, 0, 0));
  const std::vector<Box> none;
  const std::vector<Box> allEmpty(20, kEmptyBox);
  EXPECT_THAT(overlaps(boxes, none, options()), IsEmpty());
  EXPECT_THAT(overlaps(none, boxes, options()), IsEmpty());
  EXPECT_THAT(overlaps(allEmpty, boxes, options()), IsEmpty());
  EXPECT_THAT(pairsOf(allEmpty), IsEmpty());
}

TEST_P(Overlaps_, SetsOfVeryDifferentSizeAreJoined) {
  const std::vector<Box> many = test::toDouble(test::randomBoxes(3000, 5));
  const std::vector<Box> few = test::toDouble(test::randomBoxes(3, 6, 3.0F));
  EXPECT_EQ(overlaps(many, few, options()), test::oracleBetween(many, few));
  EXPECT_EQ(overlaps(few, many, options()), test::oracleBetween(few, many));
}

TEST_P(Overlaps_, CountingAgreesWithFinding) {
  const std::vector<BoxF> boxes = test::randomBoxes(2000, 1);
  const std::vector<BoxF> others = test::randomBoxes(700, 2);
  EXPECT_EQ(countOverlaps(boxes, options()), overlaps(boxes, options()).size());
  EXPECT_EQ(countOverlaps(boxes, others, options()), overlaps(boxes, others, options()).size());
  OverlapOptions filtered = options();
  filtered.filter.accept = [](std::uint32_t first, std::uint32_t) { return first % 2 == 0; };
  EXPECT_EQ(countOverlaps(boxes, filtered), overlaps(boxes, filtered).size());
}

TEST_P(Overlaps_, MorePairsThanAllowedThrowAndNothingIsCut) {
  const std::vector<Box> boxes(100, cube(0, 0, 0));
  OverlapOptions limited = options();
  limited.maxPairs = 4950;
  EXPECT_EQ(pairsOf(boxes, limited).size(), 4950U);
  limited.maxPairs = 4949;
  try {
    static_cast<void>(pairsOf(boxes, limited));
    FAIL() << "the limit was passed without an error";
  } catch (const LimitExceeded& error) {
    EXPECT_GT(error.count(), 4949U);
    EXPECT_THAT(error.what(), HasSubstr("4949"));
  }
  EXPECT_THROW(static_cast<void>(countOverlaps(boxes, limited)), LimitExceeded);
  std::size_t streamed = 0;
  const auto take = [&](std::span<const Pair> pairs) { streamed += pairs.size(); };
  EXPECT_THROW(streamOverlaps(boxes, take, limited, 100), LimitExceeded);
  EXPECT_EQ(streamed, 4900U);
  limited.maxPairs = 4950;
  EXPECT_EQ(countOverlaps(boxes, limited), 4950U);
  streamed = 0;
  streamOverlaps(boxes, take, limited, 100);
  EXPECT_EQ(streamed, 4950U);
}

TEST_P(Overlaps_, AnObjectCanBeUsedAgainAfterItThrew) {
  const std::vector<Box> boxes(100, cube(0, 0, 0));
  OverlapSearch search(options());
  OverlapOptions limited = options();
  limited.maxPairs = 3;
  search.setOptions(limited);
  EXPECT_THROW(static_cast<void>(search.find(boxes)), LimitExceeded);
  search.setOptions(options());
  EXPECT_EQ(search.find(boxes).size(), 4950U);
}

TEST_P(Overlaps_, BadOptionsAreRefusedByName) {
  const std::vector<Box> boxes(2, cube(0, 0, 0));
  OverlapOptions bad = options();
  bad.distance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(pairsOf(boxes, bad), InvalidArgument);
  bad = options();
  bad.region = Box{{0, 0, 0}, {-1, 1, 1}};
  EXPECT_THROW(pairsOf(boxes, bad), InvalidArgument);
  bad = options();
  const std::vector<std::uint32_t> three(3);
  bad.filter.first.groups = three;
  EXPECT_THROW(pairsOf(boxes, bad), InvalidArgument);
  bad = options();
  const std::vector<std::uint32_t> two(2);
  bad.filter.second.groups = two;
  EXPECT_THROW(pairsOf(boxes, bad), InvalidArgument);
  EXPECT_NO_THROW(static_cast<void>(overlaps(boxes, boxes, bad)));
  bad = options();
  EXPECT_THROW(streamOverlaps(
                   boxes, [](std::span<const Pair>) {}, bad, 0),
               InvalidArgument);
  bad.memory = std::pmr::new_delete_resource();
  EXPECT_THROW(OverlapSearch(options()).setOptions(bad), InvalidArgument);
  bad = options();
  bad.instructionSet = "MMX";
  try {
    pairsOf(boxes, bad);
    FAIL() << "an unknown instruction set was taken";
  } catch (const InvalidArgument& error) {
    EXPECT_THAT(error.what(), HasSubstr("MMX"));
    EXPECT_THAT(error.what(), HasSubstr("SCALAR"));
  }
}

/// The sum that the exact test makes overflows, and nothing is farther apart than infinity.
TEST(Overlaps, MarginsThatAddUpToInfinityReachEveryBox) {
  std::vector<Box> boxes(12, Box{{0, 1, 1}, {0, 1, 1}});
  boxes[0].min[0] = boxes[0].max[0] = 1.79e308;
  boxes[1].min[0] = boxes[1].max[0] = -1.79e308;
  BoxView set(boxes);
  const std::vector<double> margins(boxes.size(), 1e308);
  for (const Strategy strategy : {Strategy::Automatic, Strategy::Exhaustive, Strategy::Bvh}) {
    OverlapOptions options;
    options.strategy = strategy;
    set.setMargins(margins);
    EXPECT_EQ(overlaps(set, options), test::oracle(boxes, 0.0, margins));
    EXPECT_EQ(countOverlaps(set, options), 66U);
    set.setMargins({});
    options.distance = 1.79e308;
    EXPECT_EQ(overlaps(set, options), test::oracle(boxes, options.distance));
  }
}

TEST(Overlaps, ExhaustiveMakesEveryTestAndCountsThem) {
  OverlapOptions exhaustive;
  exhaustive.strategy = Strategy::Exhaustive;
  const std::vector<BoxF> boxes = test::randomBoxes(1000, 3);
  OverlapSearch search(exhaustive);
  static_cast<void>(search.find(boxes));
  EXPECT_EQ(search.statistics().boxTests, 1000U * 999U / 2U);
  const std::vector<BoxF> others = test::randomBoxes(70, 4);
  static_cast<void>(search.find(boxes, others));
  EXPECT_EQ(search.statistics().boxTests, 70000U);
}

/// Every `period`-th box is another one, where a sample at equal distances would find nothing else.
std::vector<BoxF> periodicBoxes(std::size_t n, std::size_t period, const BoxF& other) {
  std::vector<BoxF> boxes = test::randomBoxes(n, 51);
  for (std::size_t i = 0; i < n; i += period) boxes[i] = other;
  return boxes;
}

std::uint64_t testsFor(const std::vector<BoxF>& boxes, const OverlapOptions& options) {
  OverlapSearch search(options);
  static_cast<void>(search.count(boxes));
  return search.statistics().boxTests + search.statistics().groupTests;
}

TEST(Overlaps, PeriodicInputDoesNotLookLikeSomethingElse) {
  constexpr std::size_t kBoxes = std::size_t{1} << 14;
  const BoxF large{{0, 0, 0}, {30, 30, 30}};
  const BoxF none{{1, 1, 1}, {0, 0, 0}};
  OverlapOptions ordered;
  EXPECT_LT(testsFor(periodicBoxes(kBoxes, kBoxes / 24, large), ordered), kBoxes * 1000);
  OverlapOptions bvh;
  bvh.strategy = Strategy::Bvh;
  EXPECT_LT(testsFor(periodicBoxes(kBoxes, kBoxes / 256, none), bvh), kBoxes * 300);
}

TEST(Overlaps, NoInputCostsMuchMoreThanAllTests) {
  constexpr std::size_t kBoxes = 4000;
  const auto sheet = [](std::size_t axis) {
    std::vector<BoxF> boxes = test::randomBoxes(kBoxes, 52);
    for (BoxF& box : boxes) box.min[axis] = box.max[axis] = 1.0F;
    return boxes;
  };
  std::vector<BoxF> scales = test::randomBoxes(kBoxes, 53);
  for (std::size_t i = 0; i < kBoxes; ++i) {
    const float scale = std::pow(10.0F, static_cast<float>(i % 61) - 30.0F);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      scales[i].min[axis] *= scale;
      scales[i].max[axis] *= scale;
    }
  }
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const std::vector<BoxF> everywhere(kBoxes, {{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}});
  const std::vector<BoxF> equal(kBoxes, {{0, 0, 0}, {1, 1, 1}});
  OverlapOptions bvh;
  bvh.strategy = Strategy::Bvh;
  for (const std::vector<BoxF>& boxes : {sheet(0), sheet(2), scales, everywhere, equal}) {
    EXPECT_LT(testsFor(boxes, bvh), kBoxes * (kBoxes - 1));
  }
}

TEST(Overlaps, BvhMakesFarFewerTests) {
  OverlapOptions bvh;
  bvh.strategy = Strategy::Bvh;
  const std::vector<BoxF> boxes = test::randomBoxes(20000, 3);
  OverlapSearch search(bvh);
  static_cast<void>(search.find(boxes));
  EXPECT_LT(search.statistics().boxTests + search.statistics().groupTests, 20000U * 200U);
}

/// Half of the boxes in a corner, which is `scale` of the others' space in size, and half of those in a corner of that.
std::vector<BoxF> crowds(std::size_t size, float scale) {
  std::vector<BoxF> boxes = test::randomBoxes(size, 11);
  for (std::size_t i = 0; i < size; ++i) {
    const float factor = i % 2 == 0 ? 1.0F : (i % 4 == 1 ? scale : scale * scale);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      boxes[i].min[axis] *= factor;
      boxes[i].max[axis] *= factor;
    }
  }
  return boxes;
}

TEST(Overlaps, CrowdsInACornerOfTheSceneAreAsCheapAsTheRest) {
  constexpr std::size_t kBoxes = 20000;
  OverlapOptions bvh;
  bvh.strategy = Strategy::Bvh;
  for (const float scale : {0.03F, 0.001F}) {
    EXPECT_LT(testsFor(crowds(kBoxes, scale), bvh), kBoxes * 200U) << scale;
  }
}

TEST(Overlaps, CrowdsInACornerOfTheSceneMissNoPair) {
  OverlapOptions bvh;
  bvh.strategy = Strategy::Bvh;
  const std::vector<BoxF> boxes = crowds(3000, 0.002F);
  EXPECT_EQ(overlaps(boxes, bvh), test::oracle(test::toDouble(boxes)));
}

TEST(Overlaps, CrowdsOfMoreBlocksThanATileHoldsMissNoPair) {
  const std::vector<BoxF> boxes(9001, BoxF{{0, 0, 0}, {1, 1, 1}});
  OverlapOptions bvh;
  bvh.strategy = Strategy::Bvh;
  EXPECT_EQ(countOverlaps(boxes, bvh), 9001U * 9000U / 2U);
  const std::span<const BoxF> few(boxes.data(), 700);
  EXPECT_EQ(countOverlaps(few, boxes, bvh), 700U * 9001U);
}

TEST(Overlaps, CountsMorePairsThan32BitsHold) {
  if (test::kIsSanitized) GTEST_SKIP() << "four billion tests take a minute then";
  const std::vector<BoxF> boxes(93000, BoxF{{0, 0, 0}, {1, 1, 1}});
  OverlapOptions options;
  options.strategy = Strategy::Exhaustive;
  OverlapSearch search(options);
  EXPECT_EQ(search.count(boxes), std::uint64_t{93000} * 92999 / 2);
  EXPECT_EQ(search.statistics().pairs, std::uint64_t{93000} * 92999 / 2);
}

TEST(Overlaps, AllowsMorePairsThan32BitsHold) {
  const std::vector<Box> boxes(100, test::cube(0, 0, 0));
  for (const std::uint64_t most : {std::uint64_t{1} << 32U, (std::uint64_t{1} << 32U) + 1}) {
    OverlapOptions options;
    options.maxPairs = most;
    EXPECT_EQ(overlaps(boxes, options).size(), 4950U);
  }
}

/// A number of a file that was cast to an enumeration.
TEST(OverlapOptions, AreOfKnownValues) {
  const std::vector<BoxF> boxes = test::randomBoxes(400, 3);
  const OverlapOptions order{.order = static_cast<Order>(3)};
  const OverlapOptions strategy{.strategy = static_cast<Strategy>(3)};
  for (const std::size_t size : {2U, 100U, 400U}) {
    const std::span<const BoxF> part(boxes.data(), size);
    for (const OverlapOptions& options : {order, strategy}) {
      EXPECT_THROW(static_cast<void>(overlaps(part, options)), InvalidArgument) << size;
      EXPECT_THROW(static_cast<void>(overlaps(part, part, options)), InvalidArgument) << size;
      EXPECT_THROW(static_cast<void>(countOverlaps(part, options)), InvalidArgument) << size;
      EXPECT_THROW(static_cast<void>(OverlapSearch(options).find(part)), InvalidArgument) << size;
    }
    EXPECT_THROW(static_cast<void>(neighbors(part, static_cast<NeighborRows>(2))), InvalidArgument) << size;
    EXPECT_THROW(static_cast<void>(OverlapSearch().findNeighbors(part, static_cast<NeighborRows>(2))), InvalidArgument);
  }
  const Worlds worlds = Worlds::ofEqualSize(boxes, 4);
  EXPECT_THROW(static_cast<void>(overlapsInWorlds(worlds, order)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(overlapsInWorlds(worlds, strategy)), InvalidArgument);
  EXPECT_THROW(World({.order = static_cast<Order>(3)}), InvalidArgument);
}

}  // namespace
}  // namespace allpairs
