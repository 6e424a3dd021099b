// SPDX-License-Identifier: MIT
// Boxes that reach or lie far away, beside which a world has to see whether all others are still in order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "allpairs/World.h"
#include "support/Boxes.h"
#include "support/Oracle.h"

namespace allpairs {
namespace {

TEST(WorldOrder, IsKeptWhereFewBoxesComeFromFarAway) {
  std::vector<BoxF> boxes = test::randomBoxes(4000, 78);
  const std::vector<BoxF> inScene = boxes;
  constexpr std::size_t kKept = 100;
  for (std::size_t i = 0; i < kKept; ++i) {
    const float x = 1e6F + 2.0F * static_cast<float>(i);
    boxes[i] = {{x, 1e6F, 1e6F}, {x + 1.0F, 1e6F + 1.0F, 1e6F + 1.0F}};
  }
  World world;
  const std::vector<BoxId> ids = world.add(BoxView(boxes));
  (void)world.step();
  for (std::size_t i = 0; i < kKept; i += 20) {
    boxes[i] = inScene[i];
    for (std::size_t k = kKept; k < 2 * kKept; ++k) boxes[k].max[0] += 0.001F;
    world.move(std::span(ids).first(2 * kKept), std::span(boxes).first(2 * kKept));
    (void)world.step();
  }
  EXPECT_EQ(world.statistics().rebuilds, 1U);
  EXPECT_EQ(test::toVector(world.result().pairs), test::oracle(test::toDouble(boxes)));
}

TEST(WorldOrder, IsMadeAnewBesideABoxWithoutEnds) {
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  std::vector<BoxF> boxes = test::randomBoxes(4000, 79);
  boxes.push_back({{-kEndless, -kEndless, -kEndless}, {kEndless, kEndless, 0.0F}});
  World world;
  const std::vector<BoxId> ids = world.add(BoxView(boxes));
  (void)world.step();
  std::mt19937 generator(80);
  std::shuffle(boxes.begin(), boxes.begin() + 400, generator);
  world.move(std::span(ids).first(400), std::span(boxes).first(400));
  EXPECT_EQ(test::toVector(world.step().pairs), test::oracle(test::toDouble(boxes)));
  EXPECT_EQ(world.statistics().rebuilds, 2U);
  EXPECT_FALSE(world.statistics().joinedAll);
}

}  // namespace
}  // namespace allpairs
