// SPDX-License-Identifier: MIT
// Boxes along a straight line, which are ordered by one coordinate, and boxes that nearly are.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "allpairs/Overlaps.h"
#include "support/Boxes.h"
#include "support/Numbers.h"
#include "support/Oracle.h"

namespace allpairs {
namespace {

using Direction = std::array<double, 3>;

constexpr std::array<Direction, 5> kDirections{{{1, 0, 0}, {0, 0, -1}, {1, 1, 1}, {-1, 0.25, 0.001}, {0.5, -0.5, 0}}};

/// Boxes whose centres are on a line, in no order, up to `away` from it.
std::vector<Box> alongLine(std::size_t count, const Direction& direction, double side, double away = 0.0) {
  std::mt19937 generator(static_cast<unsigned>(count));
  std::uniform_real_distribution<double> place(0.0, static_cast<double>(count));
  std::uniform_real_distribution<double> aside(-away, away);
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = place(generator);
    Box& box = boxes.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double centre = at * direction[axis] + aside(generator);
      box.min[axis] = centre - 0.5 * side;
      box.max[axis] = centre + 0.5 * side;
    }
  }
  return boxes;
}

OverlapOptions byHierarchy(Order order = Order::ByFirst) {
  OverlapOptions options;
  options.strategy = Strategy::Bvh;
  options.order = order;
  return options;
}

void expectTheDoubleLoopsPairs(const std::vector<Box>& boxes) {
  EXPECT_EQ(overlaps(boxes, byHierarchy()), test::oracle(boxes));
  const std::vector<BoxF> rounded = test::toFloat32(boxes);
  EXPECT_EQ(overlaps(rounded, byHierarchy()), test::oracle(test::toDouble(rounded)));
  const std::span<const Box> all(boxes);
  const std::span<const Box> first = all.first(all.size() / 3);
  const std::span<const Box> second = all.subspan(all.size() / 3);
  EXPECT_EQ(overlaps(first, second, byHierarchy()),
            test::oracleBetween({first.begin(), first.end()}, {second.begin(), second.end()}));
}

TEST(Lines, InAnyDirectionGiveTheDoubleLoopsPairs) {
  for (const Direction& direction : kDirections) {
    for (const std::size_t count : {70U, 500U, 1500U}) {
      for (const double away : {0.0, 0.4, 3.0, 40.0}) {
        SCOPED_TRACE(std::to_string(count) + " boxes, " + std::to_string(away) + " from the line");
        expectTheDoubleLoopsPairs(alongLine(count, direction, 1.5, away));
      }
    }
  }
}

TEST(Lines, WithOthersBesideThemGiveTheDoubleLoopsPairs) {
  using test::kInfinity;
  std::vector<Box> boxes = alongLine(1200, {1, 1, 0}, 2.0);
  boxes[5] = Box{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
  boxes[77] = Box{{0, 0, 0}, {900, 1, 1}};         // long
  boxes[400] = test::cube(300, 300, -100, 200.0);  // large
  boxes[401] = test::cube(500, 0, 0);              // off the line
  boxes[402] = test::cube(0, 1e6, 0);              // far away
  boxes[900] = Box{{1, 1, 1}, {0, 2, 2}};          // empty
  for (std::size_t i = 1000; i < 1100; ++i) boxes[i] = test::cube(600, 600 + 0.01 * static_cast<double>(i), 0);
  expectTheDoubleLoopsPairs(boxes);
}

TEST(Lines, OfOnePointGiveTheDoubleLoopsPairs) {
  expectTheDoubleLoopsPairs(std::vector<Box>(300, test::cube(1, 2, 3)));
  expectTheDoubleLoopsPairs(std::vector<Box>(300, Box{{1, 2, 3}, {1, 2, 3}}));
}

double testsPerBox(const std::vector<Box>& boxes) {
  OverlapSearch search(byHierarchy(Order::Unordered));
  EXPECT_GT(search.count(boxes), 0U);
  return static_cast<double>(search.statistics().boxTests) / static_cast<double>(boxes.size());
}

/// By one coordinate alone a box in a plane or in a volume would be tested against hundreds that are nowhere near.
TEST(Lines, AreSearchedWithFewTestsAndSoIsWhatIsNone) {
  constexpr std::size_t kCount = 20000;
  for (const Direction& direction : kDirections) EXPECT_LT(testsPerBox(alongLine(kCount, direction, 1.5)), 16.0);
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(kCount, 1));
  EXPECT_LT(testsPerBox(boxes), 60.0);
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> place(0.0, 150.0);
  for (Box& box : boxes) {
    const double x = place(generator);
    const double y = place(generator);
    box = test::cube(x, y, 0.5 * (x + y));
  }
  EXPECT_LT(testsPerBox(boxes), 60.0);
}

}  // namespace
}  // namespace allpairs
