// SPDX-License-Identifier: MIT
// Each place where the float32 lanes alone would decide wrongly, one bound of one box at a time.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "allpairs/Overlaps.h"
#include "support/Boxes.h"
#include "support/Oracle.h"

namespace allpairs {
namespace {

constexpr Strategy kBothStrategies[] = {Strategy::Exhaustive, Strategy::Bvh};

class EachInstructionSet : public ::testing::TestWithParam<std::string_view> {};

INSTANTIATE_TEST_SUITE_P(Exactness, EachInstructionSet,
                         ::testing::ValuesIn(instructionSets().begin(), instructionSets().end()),
                         [](const auto& test) { return std::string(test.param); });

/// Unit cubes in a row along an axis, a face's breadth of float64 apart; float32 sees them touch.
std::vector<Box> rowOfCubes(std::size_t n, std::size_t axis) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    Box box = test::cube(0, 0, 0);
    box.min[axis] = 2.0 * static_cast<double>(i);
    box.max[axis] = 2.0 * static_cast<double>(i) + 1.0;
    boxes.push_back(box);
  }
  return boxes;
}

TEST_P(EachInstructionSet, OneBoundThatIsNoFloat32IsTestedInDouble) {
  constexpr double kGap = 0x1p-40;
  for (const std::size_t n : {18U, 40U, 300U}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t i = 0; i + 1 < n; i += n / 18) {
        for (const bool atMax : {false, true}) {
          std::vector<Box> boxes = rowOfCubes(n, axis);
          // Box i ends, or box i + 1 begins, just so far away that they don't touch; all other bounds are float32.
          boxes[i].max[axis] = boxes[i + 1].min[axis];
          if (atMax) boxes[i].max[axis] -= kGap;
          if (!atMax) boxes[i + 1].min[axis] += kGap;
          for (const Strategy strategy : kBothStrategies) {
            OverlapOptions options;
            options.strategy = strategy;
            options.instructionSet = GetParam();
            ASSERT_EQ(overlaps(boxes, options), std::vector<Pair>{})
                << n << " boxes, box " << i << ", axis " << axis << (atMax ? ", max" : ", min");
            ASSERT_EQ(countOverlaps(boxes, options), 0U);
          }
        }
      }
    }
  }
}

TEST_P(EachInstructionSet, OneInexactBoxOfTheSecondSetIsTestedInDouble) {
  std::vector<Box> first = rowOfCubes(300, 0);
  for (const std::size_t i : {0U, 15U, 16U, 150U, 299U}) {
    std::vector<Box> second = rowOfCubes(300, 0);
    for (Box& box : second) {
      box.min[1] = 1.0;
      box.max[1] = 2.0;
    }
    second[i].min[1] += 0x1p-40;
    const std::vector<Pair> expected = test::oracleBetween(first, second);
    for (const Strategy strategy : kBothStrategies) {
      OverlapOptions options;
      options.strategy = strategy;
      options.instructionSet = GetParam();
      ASSERT_EQ(overlaps(first, second, options), expected) << "box " << i;
      // A pair lies in (first, second) here, and in (second, first) there.
      ASSERT_EQ(countOverlaps(second, first, options), expected.size()) << "box " << i;
    }
  }
}

/// Boxes on a lattice, so that regions and margins end where others begin.
Box latticeBox() {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = 0.5 * *rc::gen::inRange(-12, 13);
    box.max[axis] = box.min[axis] + 0.5 * *rc::gen::inRange(0, 4);
  }
  return box;
}

RC_GTEST_PROP(ExactnessProperty, ARegionIsWidenedByEachBoxesOwnMargin, ()) {
  std::vector<Box> boxes;
  std::vector<double> margins;
  const int n = *rc::gen::weightedOneOf<int>({{3, rc::gen::inRange(1, 40)}, {1, rc::gen::inRange(280, 330)}});
  for (int i = 0; i < n; ++i) {
    boxes.push_back(latticeBox());
    margins.push_back(0.25 * *rc::gen::inRange(-2, 5));
  }
  const double d = 0.25 * *rc::gen::inRange(-2, 5);
  const Box region = latticeBox();

  // A box meets the region as it would meet a box without a margin: the region goes last, and its pairs say who is in.
  std::vector<Box> withRegion = boxes;
  withRegion.push_back(region);
  std::vector<double> withMargin = margins;
  withMargin.push_back(0.0);
  std::vector<bool> inside(boxes.size());
  for (const Pair& pair : test::oracle(withRegion, d, withMargin)) {
    if (pair.second == boxes.size()) inside[pair.first] = true;
  }
  std::vector<Pair> expected;
  for (const Pair& pair : test::oracle(boxes, d, margins)) {
    if (inside[pair.first] && inside[pair.second]) expected.push_back(pair);
  }

  BoxView set(boxes);
  set.setMargins(margins);
  for (const Strategy strategy : kBothStrategies) {
    OverlapOptions options;
    options.strategy = strategy;
    options.distance = d;
    options.region = region;
    RC_ASSERT(overlaps(set, options) == expected);
  }
}

}  // namespace
}  // namespace allpairs
