// SPDX-License-Identifier: MIT
#include "allpairs/partition/Partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "allpairs/Error.h"
#include "support/Boxes.h"
#include "support/Numbers.h"

namespace allpairs::partition {
namespace {

using test::cube;
using test::kInfinity;

std::uint64_t sumOf(const std::vector<std::uint64_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

TEST(Partition, OfBoxesThatAreSpreadHasCellsOfLikeSize) {
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(20'000, 4));
  const Partition partition(boxes, 32);
  const std::vector<std::uint64_t> counts = boxesPerCell(partition, boxes);
  EXPECT_GE(partition.size(), 24U);
  EXPECT_LE(*std::max_element(counts.begin(), counts.end()), 2U * 20'000U / 32U);
  EXPECT_LT(sumOf(counts), 30'000U) << "copies";
}

TEST(Partition, CutsAreWhereFewBoxesAreOnBothSides) {
  std::vector<Box> needles;
  for (int i = 0; i < 1000; ++i) needles.push_back({{-50.0, 0.1 * i, 0}, {50.0 + i, 0.1 * i + 0.05, 0.01}});
  const Partition partition(needles, 8);
  EXPECT_EQ(sumOf(boxesPerCell(partition, needles)), 1000U) << "along the needles every cut would copy all";
}

TEST(Partition, WhatNoCutDividesStaysOneCell) {
  EXPECT_EQ(Partition(test::lent(std::vector<Box>(100, cube(1, 2, 3))), 16).size(), 1U);
  EXPECT_EQ(Partition(BoxView(), 16).size(), 1U);
  std::vector<Box> nested;
  for (int i = 0; i < 100; ++i) nested.push_back({{-1.0 * i, -1.0 * i, -1.0 * i}, {1.0 * i, 1.0 * i, 1.0 * i}});
  const Partition partition(nested, 16);
  EXPECT_LE(sumOf(boxesPerCell(partition, nested)), 100U * partition.size());
}

TEST(Partition, TwoBoxesApartAreCutFromEachOther) {
  const Partition partition(test::lent(std::vector<Box>{cube(0, 0, 0), cube(5, 0, 0)}), 2);
  ASSERT_EQ(partition.size(), 2U);
  EXPECT_NE(partition.cellOf({0, 0, 0}), partition.cellOf({5, 0, 0}));
}

TEST(Partition, BoxesThatBeginTogetherAreCutFromTheRest) {
  std::vector<Box> boxes(60, cube(0, 0, 0));
  boxes.resize(100, cube(5, 0, 0));
  const Partition partition(boxes, 2);
  ASSERT_EQ(partition.size(), 2U) << "the minimum in the middle is the least, and no box is below that";
  EXPECT_EQ(boxesPerCell(partition, boxes), (std::vector<std::uint64_t>{60, 40}));
}

TEST(Partition, BoxesThatBeginBeforeACellDoNotDecideWhereItIsCut) {
  std::vector<Box> boxes;
  for (int i = 0; i < 80; ++i) boxes.push_back({{0.1 * i, 0, 0}, {50.2, 1, 1}});  // over the first cut, at 50
  for (int i = 0; i < 20; ++i) boxes.push_back({{10.0 + i, 0, 0}, {10.5 + i, 1, 1}});
  for (int i = 0; i < 100; ++i) boxes.push_back({{50.0 + i, 0, 0}, {50.5 + i, 1, 1}});
  const Partition partition(boxes, 4);
  EXPECT_NE(partition.cellOf({50, 0, 0}), partition.cellOf({149, 0, 0}));
}

TEST(Partition, VisitsTheCellsOfManyBoxesAsOfEachAlone) {
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(5'000, 6));
  const Partition partition(boxes, 40);
  for (std::size_t i = 0; i < boxes.size(); i += 50) boxes[i].max[i % 3] += 0.5;  // in several cells
  for (std::size_t i = 7; i < boxes.size(); i += 70) boxes[i] = kEmptyBox;
  boxes[9] = {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  for (const Cut& cut : partition.cuts()) {  // up to a cut, and from it on
    boxes.push_back(cube(0, 0, 0));
    boxes.back().max[cut.axis] = cut.at;
    boxes.push_back(cube(0, 0, 0));
    boxes.back().min[cut.axis] = cut.at;
    boxes.back().max[cut.axis] = std::nextafter(cut.at, kInfinity);
  }
  for (const Partition& any : {partition, Partition()}) {
    std::vector<std::vector<std::uint32_t>> visited;
    any.visitCells(
        boxes.size(), [&](std::size_t i) { return boxes[i]; },
        [&](std::size_t i, Span<const std::uint32_t> cells) {
          EXPECT_EQ(i, visited.size());
          visited.emplace_back(cells.begin(), cells.end());
        });
    std::vector<std::vector<std::uint32_t>> expected;
    for (const Box& box : boxes) {
      std::vector<std::uint32_t>& cells = expected.emplace_back();
      for (std::uint32_t cell = 0; cell < any.size(); ++cell) {
        if (touches(any.cell(cell), box)) cells.push_back(cell);
      }
    }
    for (std::vector<std::uint32_t>& cells : visited) std::sort(cells.begin(), cells.end());
    EXPECT_EQ(visited, expected);
  }
}

TEST(Partition, HasCellsForAllRanksThatFitTheCacheWhereOneRankCanCutThem) {
  EXPECT_EQ(cellsOnRanks(0, 4), 32U);
  EXPECT_EQ(cellsOnRanks(10'000'000, 2), 38U);
  EXPECT_EQ(cellsOnRanks(100'000'000, 2), 64U) << "32 for each rank";
  EXPECT_EQ(cellsOnRanks(10'000'000'000, 64), 2384U) << "of four million boxes";
  EXPECT_EQ(cellsOnRanks(1000, 2, 10), 64U);
  EXPECT_EQ(cellsOnRanks(300, 2, 10), 30U);
}

TEST(Partition, ACellIsCutAgainAndTheOthersStay) {
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(5'000, 5));
  Partition partition(boxes, 4);
  const std::size_t before = partition.size();
  const Cell other = partition.cell(0);
  ASSERT_TRUE(partition.cutAgain(2, boxes, 4));
  EXPECT_EQ(partition.cell(0), other);
  EXPECT_EQ(partition.size(), before + 3);
  const std::vector<std::uint64_t> counts = boxesPerCell(partition, boxes);
  EXPECT_TRUE(std::all_of(counts.begin(), counts.end(), [](std::uint64_t count) { return count > 100; }));
  EXPECT_FALSE(partition.cutAgain(2, BoxView(), 4)) << "nothing to go by";
}

TEST(Partition, CellsAreCutAgainTogetherAsOneAfterTheOther) {
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(5'000, 5));
  boxes.push_back({{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}});
  for (const std::size_t cells : {1U, 2U, 30U}) {
    Partition together(boxes, cells, 0.5);
    Partition apart = together;
    std::vector<CellToCut> given;
    for (std::size_t number = cells / 4; number < together.size(); number += 3)
      given.push_back({number, 2 + number % 4});
    ASSERT_TRUE(together.cutAgain(given, boxes, 0.5));
    for (const auto& [number, parts] : given) EXPECT_TRUE(apart.cutAgain(number, boxes, parts, 0.5));
    const std::vector<Cell> found = together.cells();
    const std::vector<Cell> expected = apart.cells();
    EXPECT_TRUE(std::is_permutation(found.begin(), found.end(), expected.begin(), expected.end())) << cells;
    EXPECT_EQ(Partition::fromCuts(together.cuts()).cells(), found);
    const std::vector<Cell> before = Partition(boxes, cells, 0.5).cells();
    for (std::size_t i = 0; i < before.size(); ++i) {
      const bool isGiven =
          std::any_of(given.begin(), given.end(), [i](const CellToCut& cell) { return cell.number == i; });
      EXPECT_NE(found[i] == before[i], isGiven) << "cell " << i << " of " << cells;
    }
  }
}

TEST(Partition, CellsThatAreNotThereOrGivenTwiceAreNotCut) {
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(500, 5));
  Partition partition(boxes, 4);
  const std::vector<Cut> before(partition.cuts().begin(), partition.cuts().end());
  EXPECT_THROW(partition.cutAgain(std::vector<CellToCut>{{0, 2}, {4, 2}}, boxes), InvalidArgument);
  EXPECT_THROW(partition.cutAgain(std::vector<CellToCut>{{0, 2}, {1, 2}, {0, 2}}, boxes), InvalidArgument);
  EXPECT_FALSE(partition.cutAgain(std::vector<CellToCut>(), boxes));
  EXPECT_FALSE(partition.cutAgain(std::vector<CellToCut>{{0, 0}, {1, 1}}, boxes)) << "into one part";
  EXPECT_EQ(std::vector<Cut>(partition.cuts().begin(), partition.cuts().end()), before);
}

TEST(Partition, ACellThatIsCutInTwoKeepsItsNumberForOneHalf) {
  std::vector<Box> boxes;
  for (int i = 0; i < 8; ++i) boxes.push_back(cube(2 * i, 0, 0));
  Partition partition = Partition::fromCuts(std::vector<Cut>{{8.0, 0, ~0, ~1}});
  ASSERT_TRUE(partition.cutAgain(0, boxes, 2));
  const auto bounded = [](double low, double high) {
    return Cell{{low, -kInfinity, -kInfinity}, {high, kInfinity, kInfinity}};
  };
  const std::vector<Cell> expected{bounded(-kInfinity, 4), bounded(8, kInfinity), bounded(4, 8)};
  EXPECT_EQ(partition.cells(), expected);
  EXPECT_NO_THROW((void)Partition::fromCuts(partition.cuts())) << "which no cut leads back to itself in";
}

TEST(Partition, BoundsOfAllCellsAreThoseOfEach) {
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(3'000, 6));
  Partition partition(boxes, 30);
  ASSERT_TRUE(partition.cutAgain(3, boxes, 4));
  for (const Partition& any : {partition, Partition()}) {
    const std::vector<Cell> cells = any.cells();
    ASSERT_EQ(cells.size(), any.size());
    for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(cells[i], any.cell(i)) << i;
    // Each is where its points are said to be.
    for (const Box& box : boxes) EXPECT_TRUE(cells[any.cellOf(box.min)].holds(box.min));
  }
}

TEST(Partition, ASearchForCutsCanBeStopped) {
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(3'000, 6));
  StopFlag stop;
  EXPECT_EQ(Partition(boxes, 8, 0.0, &stop).size(), Partition(boxes, 8).size());
  stop.set();
  EXPECT_THROW(Partition(boxes, 8, 0.0, &stop), Stopped);
}

TEST(Partition, CountsByTheGreatestMarginOfEither) {
  const Partition partition = Partition::fromCuts(std::vector<Cut>{{10.0, 0, ~0, ~1}});
  const std::vector<Box> boxes = {cube(0, 0, 0), cube(5, 0, 0), cube(20, 0, 0)};
  const std::vector<double> margins = {0.0, -1.0, 4.0};
  BoxView view(boxes);
  EXPECT_EQ(boxesPerCell(partition, view), (std::vector<std::uint64_t>{2, 1}));
  view.setMargins(margins);
  EXPECT_EQ(greatestMargin(view), 4.0);
  EXPECT_EQ(boxesPerCell(partition, view), (std::vector<std::uint64_t>{2, 1})) << "5 + 1 + 4 - 1 is below the cut";
  EXPECT_EQ(boxesPerCell(partition, view, 1.0), (std::vector<std::uint64_t>{2, 2})) << "and with 1 on it";
  EXPECT_EQ(boxesPerCell(partition, view, 0.0, 5.0), (std::vector<std::uint64_t>{2, 2}));
  EXPECT_EQ(boxesPerCell(partition, view, 0.0, 9.0), (std::vector<std::uint64_t>{2, 3}));
}

TEST(Partition, AGreatestMarginThatIsNoNumberIsRefused) {
  const std::vector<Box> boxes = {cube(0, 0, 0)};
  EXPECT_THROW((void)boxesPerCell(Partition(), boxes, 0.0, std::nan("")), InvalidArgument);
}

TEST(Partition, IsCutAtNumbersAlone) {
  std::vector<Box> boxes;
  for (int i = 0; i < 10; ++i) boxes.push_back({{0, 0, 0}, {1, 1, 1}});
  for (int i = 0; i < 10; ++i) boxes.push_back({{kInfinity, 0, 0}, {kInfinity, 1, 1}});
  const Partition partition(boxes, 4);
  for (const Cut& cut : partition.cuts()) EXPECT_TRUE(std::isfinite(cut.at));
}

TEST(Partition, ComesBackFromItsCuts) {
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(1'000, 6));
  const Partition partition(boxes, 9);
  const Partition again = Partition::fromCuts(partition.cuts());
  ASSERT_EQ(again.size(), partition.size());
  for (std::size_t i = 0; i < again.size(); ++i) EXPECT_EQ(again.cell(i), partition.cell(i));
  EXPECT_EQ(again.cells(), partition.cells());
}

TEST(Partition, CutsThatAreNoTreeAreRefused) {
  const auto refused = [](std::vector<Cut> cuts) { EXPECT_THROW((void)Partition::fromCuts(cuts), InvalidArgument); };
  refused({{0.0, 3, ~0, ~1}});
  refused({{std::nan(""), 0, ~0, ~1}});
  refused({{kInfinity, 0, ~0, ~1}});
  refused({{0.0, 0, ~0, ~0}});
  refused({{0.0, 0, ~0, ~2}});
  refused({{0.0, 0, 0, ~0}});
  refused({{0.0, 0, ~0, ~1}, {0.0, 0, ~2, ~3}});
  refused({{0.0, 0, 1, ~0}, {0.0, 0, 0, ~1}});
  refused({{0.0, 0, ~0, ~1}, {0.0, 0, 1, ~2}});
  EXPECT_THROW((void)Partition().cell(1), InvalidArgument);
}

}  // namespace
}  // namespace allpairs::partition
