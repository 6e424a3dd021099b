// SPDX-License-Identifier: MIT
// The lists of one world of many, after a step or a look at them that has failed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "allpairs/Error.h"
#include "allpairs/World.h"
#include "support/Boxes.h"

namespace allpairs {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(WorldLists, AStepThatFailsLeavesThePairsOfEachWorldWithoutChanges) {
  StopFlag stop;
  WorldOptions options;
  options.stop = &stop;
  World world(options);
  const BoxId a = world.add(test::cube(0, 0, 0), {.world = 1});
  const BoxId ground = world.add(test::cube(0, 0, 0), {.world = kEveryWorld});
  world.step();
  world.setProperties(a, {.world = 2});
  world.step();
  ASSERT_THAT(world.result(2).began, ElementsAre(Pair{a, ground}));
  world.invalidate({&a, 1});
  stop.set();
  EXPECT_THROW(world.step(), Stopped);
  stop.clear();
  EXPECT_THAT(world.result(1).ended, IsEmpty());
  EXPECT_THAT(world.result(2).began, IsEmpty());
  EXPECT_THAT(world.result(2).persisted, ElementsAre(Pair{a, ground}));
  EXPECT_THAT(world.result(2).pairs, ElementsAre(Pair{a, ground}));
  world.setProperties(a, {.world = 3});
  world.step();
  EXPECT_THAT(world.result(2).ended, ElementsAre(Pair{a, ground}));
  EXPECT_THAT(world.result(3).began, ElementsAre(Pair{a, ground}));
}

TEST(WorldLists, TheListsOfAWorldCanBeStoppedAtAnyLook) {
  std::size_t looks = 0;
  std::size_t stopsAt = 0;
  const auto ask = [&] { return ++looks == stopsAt; };
  const StopFlag stop(ask);
  WorldOptions options;
  options.stop = &stop;
  for (std::size_t look = 1;; ++look) {
    World world(options);
    for (std::uint32_t i = 0; i < 300; ++i) world.add(test::cube(0, 0, 0), {.world = i % 2});
    world.step();
    for (std::uint32_t i = 0; i < 2; ++i) world.setProperties(i, {.world = 3});
    world.step();
    looks = 0;
    stopsAt = look;
    bool isStopped = false;
    try {
      static_cast<void>(world.result(0));
    } catch (const Stopped&) {
      isStopped = true;
    }
    stopsAt = 0;
    EXPECT_EQ(world.result(0).pairs.size(), 149U * 148U / 2U);
    EXPECT_EQ(world.result(1).ended.size(), 149U);
    ASSERT_EQ(isStopped, looks >= look);
    if (isStopped) continue;
    EXPECT_GT(look, 10U);
    return;
  }
}

}  // namespace
}  // namespace allpairs
