// SPDX-License-Identifier: MIT
// Random boxes of every awkward kind, against the double loop. RapidCheck prints the seed and the smallest failing
// case.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "allpairs/Overlaps.h"
#include "support/AnyBoxes.h"
#include "support/Boxes.h"
#include "support/Oracle.h"

namespace allpairs {
namespace {

using test::anyBox;
using test::distance;
using test::scene;

OverlapOptions optionsWith(Strategy strategy, double d) {
  OverlapOptions options;
  options.strategy = strategy;
  options.distance = d;
  return options;
}

constexpr Strategy kStrategies[] = {Strategy::Automatic, Strategy::Exhaustive, Strategy::Bvh};

void showBoxes(const std::vector<Box>& boxes) {
  RC_CLASSIFY(boxes.size() > 16, "more than a block");
  RC_CLASSIFY(boxes.size() > 64, "more than four blocks");
}

RC_GTEST_PROP(OverlapsProperty, AnyBoxesAtAnyDistanceGiveTheOraclesPairs, ()) {
  const auto boxes = *scene();
  const double d = *distance();
  showBoxes(boxes);
  const std::vector<Pair> expected = test::oracle(boxes, d);
  for (const Strategy strategy : kStrategies) RC_ASSERT(overlaps(boxes, optionsWith(strategy, d)) == expected);
}

RC_GTEST_PROP(OverlapsProperty, AnyFloat32BoxesGiveTheOraclesPairs, ()) {
  std::vector<BoxF> boxes;
  for (const Box& box : *scene()) {
    BoxF& rounded = boxes.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rounded.min[axis] = static_cast<float>(box.min[axis]);
      rounded.max[axis] = static_cast<float>(box.max[axis]);
    }
  }
  const double d = *distance();
  const std::vector<Pair> expected = test::oracle(test::toDouble(boxes), d);
  for (const Strategy strategy : kStrategies) RC_ASSERT(overlaps(boxes, optionsWith(strategy, d)) == expected);
}

RC_GTEST_PROP(OverlapsProperty, BoxesFarFromTheOriginGiveTheOraclesPairs, ()) {
  auto boxes = *scene();
  auto others = *scene();
  const double place = *rc::gen::element(1e3, -1e7, 1.0 / 3.0 * 1e9, 0x1p52, -1e15, 1e30, 3.4e38, 1e300);
  for (std::vector<Box>* set : {&boxes, &others}) {
    for (Box& box : *set) {
      box.min[0] += place;
      box.max[0] += place;
      box.min[2] -= 3.0 * place;
      box.max[2] -= 3.0 * place;
    }
  }
  const std::vector<Pair> expected = test::oracle(boxes);
  const std::vector<Pair> between = test::oracleBetween(boxes, others);
  for (const Strategy strategy : kStrategies) {
    RC_ASSERT(overlaps(boxes, optionsWith(strategy, 0.0)) == expected);
    RC_ASSERT(overlaps(boxes, others, optionsWith(strategy, 0.0)) == between);
  }
}

RC_GTEST_PROP(OverlapsProperty, AnyMarginsGiveTheOraclesPairs, ()) {
  const auto boxes = *scene();
  const auto margins = *rc::gen::container<std::vector<double>>(boxes.size(), distance());
  const double d = *distance();
  BoxView set(boxes);
  set.setMargins(margins);
  const std::vector<Pair> expected = test::oracle(boxes, d, margins);
  for (const Strategy strategy : kStrategies) RC_ASSERT(overlaps(set, optionsWith(strategy, d)) == expected);
}

RC_GTEST_PROP(OverlapsProperty, TwoSetsGiveTheOraclesPairs, ()) {
  const auto first = *scene();
  const auto second = *scene();
  const double d = *distance();
  const std::vector<Pair> expected = test::oracleBetween(first, second, d);
  for (const Strategy strategy : kStrategies) {
    RC_ASSERT(overlaps(first, second, optionsWith(strategy, d)) == expected);
    RC_ASSERT(countOverlaps(first, second, optionsWith(strategy, d)) == expected.size());
  }
}

RC_GTEST_PROP(OverlapsProperty, ARegionLeavesOutWhatIsOutsideOfIt, ()) {
  const auto boxes = *scene();
  const double d = *distance();
  const Box region = *rc::gen::suchThat(anyBox(), [](const Box& box) { return !isEmpty(box); });
  // A box meets the region as it would meet another box: the region goes last, and its pairs say who is in.
  std::vector<Box> withRegion = boxes;
  withRegion.push_back(region);
  std::vector<bool> inside(boxes.size());
  for (const Pair& pair : test::oracle(withRegion, d)) {
    if (pair.second == boxes.size()) inside[pair.first] = true;
  }
  std::vector<Pair> expected;
  for (const Pair& pair : test::oracle(boxes, d)) {
    if (inside[pair.first] && inside[pair.second]) expected.push_back(pair);
  }
  for (const Strategy strategy : kStrategies) {
    OverlapOptions options = optionsWith(strategy, d);
    options.region = region;
    RC_ASSERT(overlaps(boxes, options) == expected);
  }
}

}  // namespace
}  // namespace allpairs
