// SPDX-License-Identifier: MIT
// Linked with AllocationTest.cpp, which counts.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "allpairs/World.h"
#include "memory/Memory.h"
#include "support/AllocationCount.h"
#include "support/Boxes.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

/// Boxes that go to and fro, so that a steady state can be.
std::vector<BoxF> swung(std::vector<BoxF> boxes, std::size_t frame) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const float by = 0.2F * std::sin(0.3F * static_cast<float>(frame) + static_cast<float>(i));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      boxes[i].min[axis] += by;
      boxes[i].max[axis] += by;
    }
  }
  return boxes;
}

class WorldAllocation : public ::testing::TestWithParam<std::size_t> {};

INSTANTIATE_TEST_SUITE_P(OfSoManyMoving, WorldAllocation, ::testing::Values(5000, 200));

TEST_P(WorldAllocation, StepsInASteadyStateAllocateNothing) {
  const std::vector<BoxF> boxes = test::randomBoxes(5000, 41);
  World world;
  std::vector<BoxId> ids = world.add(boxes);
  ids.resize(GetParam());
  std::size_t before = 0;
  for (std::size_t frame = 0; frame < 200; ++frame) {
    const std::vector<BoxF> now =
        swung({boxes.begin(), boxes.begin() + static_cast<std::ptrdiff_t>(ids.size())}, frame);
    before = test::allocationCount();
    world.move(ids, now);
    ASSERT_GT(world.step().pairs.size(), 1000U);
    if (frame >= 100) {
      ASSERT_EQ(test::allocationCount() - before, 0U) << "frame " << frame;
    }
  }
}

TEST_P(WorldAllocation, StepsOfManyWorldsInASteadyStateAllocateNothing) {
  if (test::kIsThreadSanitized) GTEST_SKIP() << "one thread, for a minute then";
  // Under a sanitizer the same frames come again and again, so that fewer make the state steady: 21 are a full swing.
  constexpr std::size_t kFrames = test::kIsSanitized ? 63 : 200;
  constexpr std::size_t kSteady = test::kIsSanitized ? 42 : 100;
  constexpr std::size_t kSwing = test::kIsSanitized ? 21 : kFrames;
  for (const std::size_t worlds : {std::size_t{3}, std::size_t{100}}) {
    const std::vector<BoxF> boxes = test::randomBoxes(5000, 43, 4.0F);
    std::vector<BoxProperties> properties(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) properties[i].world = static_cast<std::uint32_t>(i % worlds);
    World world;
    std::vector<BoxId> ids(boxes.size());
    world.add(boxes, properties, ids);
    ids.resize(GetParam());
    for (std::size_t frame = 0; frame < kFrames; ++frame) {
      const std::vector<BoxF> now =
          swung({boxes.begin(), boxes.begin() + static_cast<std::ptrdiff_t>(ids.size())}, frame % kSwing);
      const std::size_t before = test::allocationCount();
      world.move(ids, now);
      static_cast<void>(world.step());
      static_cast<void>(world.result(1));
      if (frame >= kSteady) {
        ASSERT_EQ(test::allocationCount() - before, 0U) << "frame " << frame;
      }
    }
  }
}

TEST(WorldAllocation, ComingAndGoingKeepsTheMemoryFlat) {
  const std::vector<BoxF> boxes = test::randomBoxes(2000, 42);
  World world;
  std::vector<BoxId> ids = world.add(boxes);
  static_cast<void>(world.step());
  std::size_t bytes = 0;
  for (std::size_t frame = 0; frame < 3000; ++frame) {
    if (frame == 1000) bytes = test::allocatedBytes();
    const std::size_t i = frame * 7 % ids.size();
    world.remove(ids[i]);
    ids[i] = world.add(test::toDouble(boxes[i]));
    static_cast<void>(world.step());
  }
  EXPECT_EQ(test::allocatedBytes(), bytes);
  EXPECT_LE(world.idBound(), 2001U);
}

}  // namespace
}  // namespace allpairs
