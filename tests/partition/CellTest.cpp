// SPDX-License-Identifier: MIT
#include "allpairs/partition/Cell.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "allpairs/Error.h"
#include "support/Boxes.h"
#include "support/Numbers.h"

namespace allpairs::partition {
namespace {

using test::cube;
using test::kInfinity;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

const std::vector<Box> kRow = {cube(0, 0, 0), cube(1, 0, 0), cube(1.5, 0, 0), cube(4, 0, 0)};
const std::vector<std::uint64_t> kIds = {50, std::uint64_t{1} << 40, 7, 8};

TEST(Cell, HoldsItsMinimumAndNotItsMaximum) {
  const Cell cell{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(cell.holds({0, 0, 0}));
  EXPECT_TRUE(cell.holds({0.5, 0.5, 0.5}));
  EXPECT_FALSE(cell.holds({1, 0, 0}));
  EXPECT_FALSE(cell.holds({0, 0, -0.1}));
}

TEST(Cell, TheOutermostHoldInfinity) {
  EXPECT_TRUE(Cell().holds({kInfinity, -kInfinity, 0}));
  EXPECT_TRUE((Cell{{1, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}}).holds({kInfinity, 0, 0}));
  EXPECT_FALSE((Cell{{-kInfinity, 0, 0}, {1, 1, 1}}).holds({kInfinity, 0, 0}));
}

TEST(Cell, OneWithoutExtentHoldsNothingAtInfinityEither) {
  const Box atInfinity{{kInfinity, kInfinity, kInfinity}, {kInfinity, kInfinity, kInfinity}};
  const Cell cell{atInfinity.min, atInfinity.max};
  EXPECT_FALSE(cell.holds(atInfinity.min));
  const std::vector<Box> boxes(2, atInfinity);
  CellSearch search;
  EXPECT_TRUE(search.find(boxes, cell).empty());
}

TEST(Cell, APairBelongsToTheGreaterMinima) { EXPECT_EQ(pairPoint(cube(0, 3, -2), cube(1, 2, -5)), (Point{1, 3, -2})); }

TEST(Cell, ReachIsWidenedAboveOnlyAndByTheGreatestMargin) {
  const Box reach = reachOf(cube(0, 0, 0), 0.5, 1.0, 2.0);
  EXPECT_EQ(reach, (Box{{0, 0, 0}, {4.5, 4.5, 4.5}}));
  EXPECT_EQ(reachOf(cube(0, 0, 0), 0.0, -3.0, 0.0), cube(0, 0, 0)) << "a pair may begin anywhere in the box";
  EXPECT_TRUE(isEmpty(reachOf({{1, 0, 0}, {0, 0, 0}}, 0.0, 10.0)));
  EXPECT_EQ(reachOf({{-kInfinity, 0, 0}, {-kInfinity, 1, 1}}, 0.0, kInfinity).max[0], kInfinity);
}

TEST(Cell, ReachIsThatOfTheGreaterOfBothRoundings) {
  constexpr double kHuge = 0x1p53;  // (1 + kHuge) + 1 is rounded down twice, (1 + 1) + kHuge is exact.
  const Box point{{0, 0, 0}, {0, 0, 0}};
  EXPECT_EQ(reachOf(point, kHuge, 1.0, 1.0).max[0], kHuge + 2.0);
  EXPECT_EQ(reachOf(point, 1.0, 1.0, kHuge).max[0], kHuge + 2.0);
}

/// The sum with the greatest margin may be NaN where the sum with a lesser one is a number.
TEST(Cell, ReachIsToInfinityWhereMarginsAre) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(reachOf(box, -1.7e308, -1.7e308, kInfinity).max[0], kInfinity);
  EXPECT_EQ(reachOf(box, kInfinity, -1.7e308, -1.7e308).max[0], kInfinity);
  EXPECT_EQ(reachOf(box, 0.0, -1.7e308, 0.0).max[0], 1.0);
}

TEST(Cell, ASearchThatHasBeenMovedFromIsANewOne) {
  CellSearch search(OverlapOptions{.distance = 5.0});
  const CellSearch taken = std::move(search);
  const std::vector<Box> boxes{cube(0, 0, 0), cube(3, 0, 0), cube(3.5, 0, 0)};
  EXPECT_EQ(search.find(boxes, Cell()).size(), 1U);  // NOLINT(bugprone-use-after-move): what is tested
}

TEST(Cell, ANanOnAnyAxisIsRefused) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Cell low;
    Cell high;
    low.min[axis] = std::numeric_limits<double>::quiet_NaN();
    high.max[axis] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW((void)countOverlapsInCell(kRow, low), InvalidArgument);
    EXPECT_THROW((void)countOverlapsInCell(kRow, high), InvalidArgument);
  }
}

TEST(Cell, ACallByItsOwnVisitorIsRefusedAndChangesNothing) {
  std::vector<Box> boxes;
  for (int i = 0; i < 30000; ++i) boxes.push_back(cube(0.5 * i, 0, 0));
  const Cell left{{-1e9, -1e9, -1e9}, {2000, 1e9, 1e9}};
  const Cell right{{2000, -1e9, -1e9}, {1e9, 1e9, 1e9}};
  CellSearch search;
  std::vector<Pair> found;
  std::size_t refused = 0;
  search.stream(BoxView::fromBoxes(boxes), left, [&](std::span<const Pair> pairs) {
    found.insert(found.end(), pairs.begin(), pairs.end());
    try {
      search.stream(BoxView::fromBoxes(boxes), right, [](std::span<const Pair>) {});
    } catch (const InvalidArgument& error) {
      refused += std::string(error.what()).starts_with("CellSearch is called by its own") ? 1U : 0U;
    }
    EXPECT_THROW(static_cast<void>(search.find(BoxView::fromBoxes(boxes), right)), InvalidArgument);
    EXPECT_THROW(search.setFilter({}), InvalidArgument);
  });
  EXPECT_GE(refused, 1U);
  std::sort(found.begin(), found.end());
  CellSearch other;
  EXPECT_TRUE(std::ranges::equal(found, other.find(BoxView::fromBoxes(boxes), left)));
}

TEST(Cell, ASearchOfOneSetAfterOneOfTwoKnowsNothingOfThose) {
  const Cell cell{{-kInfinity, -kInfinity, -kInfinity}, {0.75, kInfinity, kInfinity}};
  const std::vector<Box> outside(4, cube(1, 0, 0));
  const std::vector<Box> inside(4, cube(-1, 0, 0));
  for (const auto& second : {outside, inside}) {
    CellSearch search;
    search.stream(kRow, second, cell, [](Span<const Pair>) {});
    std::uint64_t count = 0;
    search.stream(kRow, cell, [&](Span<const Pair> pairs) { count += pairs.size(); });
    EXPECT_EQ(count, countOverlapsInCell(kRow, cell));
  }
}

TEST(Cell, PairsOfIdsAreInLexicographicOrder) {
  const std::vector<IdPair> pairs = {{1, 1}, {1, 2}, {2, 0}, {2, 1}, {3, 0}};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      EXPECT_EQ(pairs[i] < pairs[k], i < k);
      EXPECT_EQ(pairs[i] <= pairs[k], i <= k);
      EXPECT_EQ(pairs[i] > pairs[k], i > k);
      EXPECT_EQ(pairs[i] >= pairs[k], i >= k);
      EXPECT_EQ(pairs[i] == pairs[k], i == k);
      EXPECT_EQ(pairs[i] != pairs[k], i != k);
    }
  }
}

TEST(Cell, CellsAreEqualWhereBothCornersAre) {
  const Cell cell{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(cell == (Cell{{0, 0, 0}, {1, 1, 1}}));
  EXPECT_FALSE(cell != (Cell{{0, 0, 0}, {1, 1, 1}}));
  EXPECT_TRUE(cell != (Cell{{0, 0, 0}, {1, 2, 1}}));
  EXPECT_TRUE(cell != (Cell{{0, 0, -1}, {1, 1, 1}}));
}

TEST(Cell, EachPairIsFoundInItsOwnCellOnly) {
  const Cell left{{-kInfinity, -kInfinity, -kInfinity}, {1.5, kInfinity, kInfinity}};
  const Cell right{{1.5, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  EXPECT_THAT(overlapsInCell(kRow, kIds, left), ElementsAre(IdPair{50, std::uint64_t{1} << 40}));
  EXPECT_THAT(overlapsInCell(kRow, kIds, right), ElementsAre(IdPair{7, std::uint64_t{1} << 40}));
  EXPECT_EQ(countOverlapsInCell(kRow, left) + countOverlapsInCell(kRow, right), 2U);
}

TEST(Cell, OrderIsThatOfTheIds) {
  EXPECT_THAT(overlapsInCell(kRow, kIds, Cell()),
              ElementsAre(IdPair{7, std::uint64_t{1} << 40}, IdPair{50, std::uint64_t{1} << 40}));
  EXPECT_THAT(overlapsInCell(kRow, std::vector<std::uint64_t>{9, 5, 8, 1}, Cell(), {.order = Order::BySecond}),
              ElementsAre(IdPair{5, 8}, IdPair{5, 9}));
}

TEST(Cell, IdsThatDoNotFitAreNamed) {
  EXPECT_THROW((void)overlapsInCell(kRow, std::vector<std::uint64_t>{1, 2, 3}, Cell()), InvalidArgument);
  EXPECT_THROW((void)overlapsInCell(kRow, std::vector<std::uint64_t>{4, 4, 2, 3}, Cell()), InvalidArgument);
}

/// The sum of a pair's margins depends on which is added first.
TEST(Cell, BoxesWithMarginsAreGivenInTheOrderOfTheirIds) {
  const std::vector<Box> boxes{cube(0, 0, 0), cube(5, 0, 0), cube(9, 0, 0)};
  BoxView view(boxes);
  const std::vector<double> margins{0.1, 0.2, 0.3};
  view.setMargins(margins);
  const std::vector<std::uint64_t> ascending{4, 5, 9};
  const std::vector<std::uint64_t> descending{4, 9, 5};
  EXPECT_NO_THROW((void)overlapsInCell(view, ascending, Cell()));
  EXPECT_THROW((void)overlapsInCell(view, descending, Cell()), InvalidArgument);
  view.setMargins({});
  view.setMargin(0.1);
  EXPECT_NO_THROW((void)overlapsInCell(view, descending, Cell()));
}

TEST(Cell, TheLimitCountsPairsOfTheCellOnly) {
  const Cell left{{-kInfinity, -kInfinity, -kInfinity}, {1.5, kInfinity, kInfinity}};
  EXPECT_EQ(overlapsInCell(kRow, kIds, left, {.maxPairs = 1}).size(), 1U);
  EXPECT_THROW((void)overlapsInCell(kRow, kIds, Cell(), {.maxPairs = 1}), LimitExceeded);
}

/// More pairs than allowed are there, but not of the cell: they are not all in memory then.
TEST(Cell, PairsWithinTheLimitAreInOrder) {
  std::vector<Box> boxes;
  std::vector<Pair> expected;
  for (int i = 0; i < 8; ++i) boxes.push_back({{static_cast<double>(i % 3), 0, 0}, {9, 1, 1}});
  for (std::uint32_t first = 0; first < 8; ++first) {
    for (std::uint32_t second = first + 1; second < 8; ++second) {
      if (first % 3 == 1 && second % 3 < 2) expected.push_back({first, second});
      if (first % 3 == 0 && second % 3 == 1) expected.push_back({first, second});
    }
  }
  const Cell middle{{1, -kInfinity, -kInfinity}, {2, kInfinity, kInfinity}};
  CellSearch search({.order = Order::ByFirst, .maxPairs = expected.size()});
  EXPECT_THAT(search.find(boxes, middle), ElementsAreArray(expected));
  EXPECT_THAT(CellSearch({.order = Order::ByFirst}).find(boxes, middle), ElementsAreArray(expected));
  std::size_t streamed = 0;
  search.stream(boxes, middle, [&streamed](Span<const Pair> pairs) { streamed += pairs.size(); });
  EXPECT_EQ(streamed, expected.size());
  EXPECT_THROW((void)CellSearch({.maxPairs = expected.size() - 1}).find(boxes, middle), LimitExceeded);
}

TEST(Cell, BoxesOfOneIdDoNotUpsetTheOrder) {
  const std::vector<Box> first{cube(0, 0, 0), cube(5, 0, 0), cube(5, 0, 0)};
  const std::vector<Box> second{cube(5, 0, 0), cube(0, 0, 0)};
  const std::vector<std::uint64_t> firstIds{3, 3, 4};
  const std::vector<std::uint64_t> secondIds{1, 2};
  EXPECT_THAT(overlapsInCell(first, firstIds, second, secondIds, Cell()),
              ElementsAre(IdPair{3, 1}, IdPair{3, 2}, IdPair{4, 1}));
}

TEST(Cell, FiltersKnowBoxesByIndex) {
  OverlapOptions options;
  const std::array<std::uint32_t, 4> groups{1, 1, 0, 0};
  options.filter.first.groups = groups;
  EXPECT_THAT(overlapsInCell(kRow, kIds, Cell(), options), ElementsAre(IdPair{7, std::uint64_t{1} << 40}));
  options.filter.first.groups = {};
  options.filter.accept = [](std::uint32_t first, std::uint32_t second) { return first == 0 && second == 1; };
  EXPECT_THAT(overlapsInCell(kRow, kIds, Cell(), options), ElementsAre(IdPair{50, std::uint64_t{1} << 40}));
}

}  // namespace
}  // namespace allpairs::partition
