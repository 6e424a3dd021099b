// SPDX-License-Identifier: MIT
#include "SceneMaker.h"

#include <gtest/gtest.h>

#include "allpairs/Overlaps.h"

namespace allpairs::bench {
namespace {

// A scene that measures one has one point there, in float32.
TEST(SceneMaker, AFamilyWhoseBoxesWouldBeOnePointLosesItsOffset) {
  constexpr std::size_t kBoxes = 20000;
  const SceneMaker maker({.seed = 1, .first = kBoxes, .offset = 1e9, .pairs = 1.0});
  EXPECT_EQ(maker.family().offset, 0.0);
  const Scene<float> scene = maker.make<float>(0);
  const std::uint64_t pairs = OverlapSearch().count(BoxView::fromRows(scene.first));
  EXPECT_GT(pairs, kBoxes / 2);
  EXPECT_LT(pairs, 2 * kBoxes);
}

TEST(SceneMaker, OneWhoseBoxesAreApartKeepsIt) {
  const SceneMaker maker({.seed = 1, .first = 20000, .isFloat64 = true, .offset = 1e7, .pairs = 1.0});
  EXPECT_EQ(maker.family().offset, 1e7);
}

}  // namespace
}  // namespace allpairs::bench
