// SPDX-License-Identifier: MIT
// Linked with AllocationTest.cpp, which counts what operator new is asked for.
#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "CountingMemory.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/World.h"
#include "support/AllocationCount.h"
#include "support/Boxes.h"

namespace allpairs {
namespace {

using test::CountingMemory;

std::vector<Pair> listOf(std::span<const Pair> pairs) { return {pairs.begin(), pairs.end()}; }

struct ResourceCase {
  std::size_t boxes;
  Strategy strategy;
  Order order;
};

class Resource : public ::testing::TestWithParam<ResourceCase> {
 protected:
  [[nodiscard]] static OverlapOptions optionsWith(CountingMemory& memory) {
    OverlapOptions options;
    options.strategy = GetParam().strategy;
    options.order = GetParam().order;
    options.memory = &memory;
    return options;
  }
};

INSTANTIATE_TEST_SUITE_P(OfSizesStrategiesAndOrders, Resource,
                         ::testing::Values(ResourceCase{3000, Strategy::Exhaustive, Order::ByFirst},
                                           ResourceCase{3000, Strategy::Bvh, Order::ByFirst},
                                           ResourceCase{40000, Strategy::Automatic, Order::ByFirst},
                                           ResourceCase{40000, Strategy::Automatic, Order::BySecond},
                                           ResourceCase{40000, Strategy::Automatic, Order::Unordered}));

TEST_P(Resource, AllThatASearchAllocatesComesFromItAndGoesBack) {
  const std::vector<BoxF> boxes = test::randomBoxes(GetParam().boxes, 43);
  CountingMemory memory;
  {
    OverlapSearch search(optionsWith(memory));
    const std::size_t before = test::allocationCount();
    EXPECT_GT(search.find(boxes).size(), 1000U);
    EXPECT_GT(search.count(boxes), 1000U);
    search.stream(boxes, [](std::span<const Pair>) {});
    EXPECT_GT(search.find(boxes, boxes).size(), 1000U);
    EXPECT_EQ(test::allocationCount(), before);
    EXPECT_GT(memory.held(), 8U * 1000U);
  }
  EXPECT_EQ(memory.held(), 0U);
}

TEST_P(Resource, AResultPointsIntoItAndOutlivesAShrink) {
  const std::vector<BoxF> boxes = test::randomBoxes(GetParam().boxes, 43);
  CountingMemory memory;
  OverlapSearch search(optionsWith(memory));
  const std::span<const Pair> pairs = search.find(boxes);
  const std::vector<Pair> copy = listOf(pairs);
  const std::size_t before = memory.held();
  search.shrink();
  EXPECT_LT(memory.held(), before);
  EXPECT_LE(memory.held(), 4 * pairs.size_bytes() + 65536);
  EXPECT_EQ(listOf(pairs), copy);
  EXPECT_EQ(search.statistics().pairs, copy.size());
  EXPECT_EQ(listOf(search.find(boxes)), copy);
  static_cast<void>(search.count(boxes));
  search.shrink();
  EXPECT_EQ(memory.held(), 0U);
}

TEST(Resource, StaysThatOfTheConstructor) {
  CountingMemory memory;
  CountingMemory other;
  OverlapOptions options;
  options.memory = &memory;
  OverlapSearch search(options);
  options.memory = &other;
  EXPECT_THROW(search.setOptions(options), InvalidArgument);
  options.memory = nullptr;
  search.setOptions(options);
  EXPECT_EQ(search.options().memory, &memory);
  EXPECT_GT(search.find(test::lent(test::randomBoxes(3000, 43))).size(), 1000U);
  EXPECT_EQ(other.allocations(), 0U);
}

TEST(Resource, OneThatIsUsedUpIsOutOfMemoryAndTheSearchGoesOnAfterwards) {
  const std::vector<BoxF> boxes = test::randomBoxes(3000, 43);
  CountingMemory memory;
  OverlapOptions options;
  options.memory = &memory;
  OverlapSearch search(options);
  memory.setUsedUp(true);
  EXPECT_THROW(static_cast<void>(search.find(boxes)), std::bad_alloc);
  memory.setUsedUp(false);
  EXPECT_EQ(listOf(search.find(boxes)), overlaps(boxes));
}

class WorldResource : public ::testing::Test {
 protected:
  WorldResource() : world(options()) {}

  [[nodiscard]] WorldOptions options() {
    WorldOptions options;
    options.memory = &memory;
    return options;
  }

  /// Adds boxes, asks everything, and moves some.
  void live() {
    const std::vector<BoxF> boxes = test::randomBoxes(5000, 44);
    ids.resize(boxes.size());
    world.add(boxes, {}, ids);
    static_cast<void>(world.step());
    world.move(std::span(ids).first(100), test::lent(test::randomBoxes(100, 45)));
    world.moveSwept(std::span(ids).first(10), test::lent(test::randomBoxes(10, 46)),
                    test::lent(test::randomBoxes(10, 47)));
    static_cast<void>(world.step());
    static_cast<void>(world.findOverlapping(boxes));
    static_cast<void>(world.findNearest({0.5, 0.5, 0.5}, 20));
    static_cast<void>(world.findAll(Ray{{0, 0, 0}, {1, 1, 1}}));
  }

  CountingMemory memory;
  World world;
  std::vector<BoxId> ids;
};

TEST_F(WorldResource, AllThatAWorldAllocatesComesFromItAndGoesBack) {
  live();
  World other;
  std::swap(world, other);
  EXPECT_GT(memory.held(), 24U * 5000U);
  other = World();
  EXPECT_EQ(memory.held(), 0U);
}

TEST_F(WorldResource, ASteadyStateAsksOperatorNewForNothing) {
  live();
  const std::vector<BoxF> boxes = test::randomBoxes(5000, 44);
  const std::size_t before = test::allocationCount();
  world.remove(ids);
  world.add(boxes, {}, ids);
  static_cast<void>(world.step());
  EXPECT_EQ(test::allocationCount(), before);
}

TEST_F(WorldResource, StepsTakeNoMoreForEachBoxThanIsPromised) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < 30000; ++i) boxes.push_back(test::cube(2.0 * static_cast<double>(i), 0, 0));
  world.reserve(boxes.size());
  ids = world.add(boxes);
  static_cast<void>(world.step());
  std::vector<BoxId> chosen;  // Nearly as many as are joined by themselves, some of each block.
  for (const BoxId id : ids) {
    if (id % 100 < 24) chosen.push_back(id);
  }
  std::vector<Box> moved;
  for (const BoxId id : chosen) moved.push_back(test::cube(2.0 * static_cast<double>(id), 1, 0));
  world.move(chosen, moved);
  static_cast<void>(world.step());
  ASSERT_FALSE(world.statistics().joinedAll);
  EXPECT_LT(memory.held(), 200 * boxes.size() + 200'000);
}

TEST_F(WorldResource, AShrunkWorldKeepsItsBoxesAndPairsAndGoesOn) {
  live();
  const StepResult result = world.result();
  const std::vector<Pair> pairs = listOf(result.pairs);
  const std::vector<Pair> began = listOf(result.began);
  const std::size_t before = memory.held();
  world.shrink();
  EXPECT_LT(2 * memory.held(), before);
  EXPECT_EQ(listOf(result.pairs), pairs);
  EXPECT_EQ(listOf(world.result().began), began);
  const StepResult next = world.step();
  EXPECT_EQ(listOf(next.pairs), pairs);
  EXPECT_TRUE(next.began.empty() && next.ended.empty());
  world.move(ids[0], Box{{0, 0, 0}, {1000, 1000, 1000}});
  EXPECT_GT(world.step().pairs.size(), pairs.size());
}

TEST_F(WorldResource, AShrunkWorldAnswersQueriesBeforeItsNextStep) {
  live();
  const auto listNear = [&] {
    const auto found = world.findNearest({0.5, 0.5, 0.5}, 20);
    return std::vector<Neighbor>(found.begin(), found.end());
  };
  const std::vector<Neighbor> neighbors = listNear();
  world.shrink();
  EXPECT_EQ(listNear(), neighbors);
}

TEST_F(WorldResource, IdsBeyondTheLastBoxAreGivenAnewAfterAShrink) {
  live();
  world.remove(std::span(ids).subspan(3));
  world.shrink();
  EXPECT_EQ(world.idBound(), 5000U);  // Their pairs are yet to end.
  EXPECT_GT(world.step().ended.size(), 1000U);
  world.shrink();
  EXPECT_EQ(world.idBound(), 3U);
  EXPECT_LT(memory.held(), 3U << 17U);
  EXPECT_EQ(world.add(test::toDouble(test::randomBoxes(1, 48)[0])), 3U);
  static_cast<void>(world.step());
  world.clear();
  static_cast<void>(world.step());
  static_cast<void>(world.step());
  world.shrink();
  EXPECT_EQ(world.idBound(), 0U);
  EXPECT_EQ(world.add(test::toDouble(test::randomBoxes(1, 48)[0])), 0U);
}

}  // namespace
}  // namespace allpairs
