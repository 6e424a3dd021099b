// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "support/Boxes.h"
#include "support/Numbers.h"
#include "support/Oracle.h"

namespace allpairs {
namespace {

using test::kInfinity;

class InstructionSet : public ::testing::TestWithParam<std::string_view> {};

INSTANTIATE_TEST_SUITE_P(All, InstructionSet, ::testing::ValuesIn(instructionSets().begin(), instructionSets().end()),
                         [](const auto& test) { return std::string(test.param); });

OverlapOptions optionsFor(std::string_view instructionSet, Strategy strategy) {
  OverlapOptions options;
  options.instructionSet = instructionSet;
  options.strategy = strategy;
  return options;
}

/// From none to four vectors of the widest instruction set and three boxes more.
constexpr std::size_t kMostBoxes = 4 * 16 + 3;

TEST_P(InstructionSet, GivesTheOraclesPairsForEveryCount) {
  const std::vector<BoxF> boxes = test::randomBoxes(kMostBoxes, 11, 2.5F);
  for (std::size_t n = 0; n <= kMostBoxes; ++n) {
    const std::span<const BoxF> part(boxes.data(), n);
    const std::vector<Pair> expected = test::oracle(test::toDouble(part));
    for (const Strategy strategy : {Strategy::Exhaustive, Strategy::Bvh}) {
      const OverlapOptions options = optionsFor(GetParam(), strategy);
      ASSERT_EQ(overlaps(part, options), expected) << n << " boxes";
      ASSERT_EQ(countOverlaps(part, options), expected.size()) << n << " boxes";
    }
  }
}

TEST_P(InstructionSet, GivesTheOraclesPairsBetweenSetsOfEveryCount) {
  const std::vector<BoxF> boxes = test::randomBoxes(kMostBoxes, 12, 2.5F);
  const std::vector<BoxF> others = test::randomBoxes(21, 13, 2.5F);
  for (std::size_t n = 0; n <= kMostBoxes; ++n) {
    const std::span<const BoxF> part(boxes.data(), n);
    const std::vector<Pair> expected = test::oracleBetween(test::toDouble(part), test::toDouble(others));
    for (const Strategy strategy : {Strategy::Exhaustive, Strategy::Bvh}) {
      ASSERT_EQ(overlaps(part, others, optionsFor(GetParam(), strategy)), expected) << n << " boxes";
    }
  }
}

TEST_P(InstructionSet, ReadsBoxesAtEveryMisalignment) {
  constexpr std::size_t kBoxes = 50;
  const std::vector<BoxF> boxes = test::randomBoxes(kBoxes, 14, 2.0F);
  const std::vector<Pair> expected = test::oracle(test::toDouble(boxes));
  for (std::size_t shift = 0; shift < 16; ++shift) {
    std::vector<float> rows(shift);
    for (const BoxF& box : boxes) {
      rows.insert(rows.end(), box.min.begin(), box.min.end());
      rows.insert(rows.end(), box.max.begin(), box.max.end());
    }
    const BoxView set = BoxView::fromRows(std::span<const float>(rows).subspan(shift));
    for (const Strategy strategy : {Strategy::Exhaustive, Strategy::Bvh}) {
      ASSERT_EQ(overlaps(set, optionsFor(GetParam(), strategy)), expected) << "shifted by " << shift;
    }
  }
}

/// Boxes in double a hair apart, turned over, infinite, and beyond float32, among others.
std::vector<Box> awkwardBoxes(std::size_t n) {
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(n, 16, 2.0F));
  for (std::size_t i = 0; i + 8 < n; i += 8) {
    boxes[i].min[0] = std::nextafter(boxes[i + 1].max[0], kInfinity);
    boxes[i].max[0] = boxes[i].min[0] + 0.1;
    boxes[i + 2].max[1] = boxes[i + 1].min[1];
    boxes[i + 3].max[2] = kInfinity;
    boxes[i + 4].min[2] = -1e300;
    boxes[i + 5].min[1] = std::nextafter(boxes[i + 5].max[1], kInfinity);
    boxes[i + 6] = {{-5e-324, -1e-46, 0}, {0, 1e-46, 5e-324}};
  }
  return boxes;
}

TEST_P(InstructionSet, GivesTheOraclesPairsOfAwkwardDoubles) {
  const std::vector<Box> boxes = awkwardBoxes(600);
  const std::vector<Pair> expected = test::oracle(boxes);
  for (const Strategy strategy : {Strategy::Exhaustive, Strategy::Bvh}) {
    EXPECT_EQ(overlaps(boxes, optionsFor(GetParam(), strategy)), expected);
  }
}

TEST_P(InstructionSet, GivesTheSameBytesInEveryOrderAsTheBestOne) {
  const std::vector<BoxF> boxes = test::randomBoxes(5000, 15);
  for (const Strategy strategy : {Strategy::Exhaustive, Strategy::Bvh}) {
    for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
      OverlapOptions options = optionsFor(GetParam(), strategy);
      options.order = order;
      OverlapOptions best = options;
      best.instructionSet = {};
      ASSERT_EQ(overlaps(boxes, options), overlaps(boxes, best));
    }
  }
}

TEST_P(InstructionSet, CountsManyColumnsAgainstAnyNumberOfRows) {
  const std::vector<BoxF> boxes = test::randomBoxes(1100, 16, 3.0F);
  const OverlapOptions options = optionsFor(GetParam(), Strategy::Exhaustive);
  for (std::size_t n = 1080; n < boxes.size(); ++n) {
    const std::span<const BoxF> part(boxes.data(), n);
    ASSERT_EQ(countOverlaps(part, options), test::oracle(test::toDouble(part)).size()) << n << " boxes";
  }
  for (std::size_t rows = 0; rows < 10; ++rows) {
    const auto some = std::span<const BoxF>(boxes).first(rows);
    const auto others = std::span<const BoxF>(boxes).subspan(20 + rows);
    const std::size_t expected = test::oracleBetween(test::toDouble(some), test::toDouble(others)).size();
    ASSERT_EQ(countOverlaps(some, others, options), expected) << rows << " rows";
    ASSERT_EQ(countOverlaps(others, some, options), expected) << rows << " columns";
  }
}

/// Most overlap most others, by more pairs than caches hold; every seventeenth hardly any.
std::vector<BoxF> crowdedBoxes(std::size_t n) {
  std::vector<BoxF> boxes = test::randomBoxes(n, 17, 60.0F);
  for (std::size_t i = 0; i < n; i += 17) boxes[i].max = boxes[i].min;
  return boxes;
}

TEST_P(InstructionSet, GivesTheOraclesPairsOfACrowd) {
  const std::vector<BoxF> boxes = crowdedBoxes(1200);
  const std::vector<Pair> expected = test::oracle(test::toDouble(boxes));
  ASSERT_GT(expected.size(), 500'000U);
  OverlapOptions options = optionsFor(GetParam(), Strategy::Exhaustive);
  EXPECT_EQ(overlaps(boxes, options), expected);
  options.order = Order::Unordered;
  EXPECT_EQ(overlaps(boxes, options), expected);  // found in order
  options.maxPairs = expected.size() - 1;
  EXPECT_THROW((void)overlaps(boxes, options), LimitExceeded);
}

}  // namespace
}  // namespace allpairs
