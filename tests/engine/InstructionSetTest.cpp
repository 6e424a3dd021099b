// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "allpairs/Overlaps.h"
#include "support/Boxes.h"
#include "support/Oracle.h"

namespace allpairs {
namespace {

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
    for (const Strategy strategy : {Strategy::Exhaustive, Strategy::Blocked}) {
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
    for (const Strategy strategy : {Strategy::Exhaustive, Strategy::Blocked}) {
      ASSERT_EQ(overlapsBetween(part, others, optionsFor(GetParam(), strategy)), expected) << n << " boxes";
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
    const BoxSet set = BoxSet::fromRows(std::span<const float>(rows).subspan(shift));
    for (const Strategy strategy : {Strategy::Exhaustive, Strategy::Blocked}) {
      ASSERT_EQ(overlaps(set, optionsFor(GetParam(), strategy)), expected) << "shifted by " << shift;
    }
  }
}

TEST_P(InstructionSet, GivesTheSameBytesInEveryOrderAsTheBestOne) {
  const std::vector<BoxF> boxes = test::randomBoxes(5000, 15);
  for (const Strategy strategy : {Strategy::Exhaustive, Strategy::Blocked}) {
    for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
      OverlapOptions options = optionsFor(GetParam(), strategy);
      options.order = order;
      OverlapOptions best = options;
      best.instructionSet = {};
      ASSERT_EQ(overlaps(boxes, options), overlaps(boxes, best));
    }
  }
}

}  // namespace
}  // namespace allpairs
