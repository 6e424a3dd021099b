// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "CountingMemory.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Worlds.h"
#include "memory/Memory.h"
#include "support/AllocationCount.h"
#include "support/Boxes.h"

namespace allpairs {
namespace {

struct AllocationCase {
  Strategy strategy;
  Order order;
};

class Allocation : public ::testing::TestWithParam<AllocationCase> {};

INSTANTIATE_TEST_SUITE_P(EachStrategyAndOrder, Allocation,
                         ::testing::Values(AllocationCase{Strategy::Exhaustive, Order::ByFirst},
                                           AllocationCase{Strategy::Bvh, Order::ByFirst},
                                           AllocationCase{Strategy::Bvh, Order::BySecond},
                                           AllocationCase{Strategy::Bvh, Order::Unordered}));

TEST_P(Allocation, ASecondSearchOfTheSameSizeAllocatesNothing) {
  OverlapOptions options;
  options.strategy = GetParam().strategy;
  options.order = GetParam().order;
  const std::vector<BoxF> boxes = test::randomBoxes(5000, 41);
  OverlapSearch search(options);
  static_cast<void>(search.find(boxes));
  const std::size_t before = test::allocationCount();
  EXPECT_GT(search.find(boxes).size(), 1000U);
  EXPECT_EQ(test::allocationCount() - before, 0U);
}

TEST_P(Allocation, ASecondSearchForNeighborsAllocatesNothing) {
  OverlapOptions options;
  options.strategy = GetParam().strategy;
  for (const float size : {1.0F, 5.0F}) {
    const std::vector<BoxF> boxes = test::randomBoxes(5000, 41, size);
    OverlapSearch search(options);
    static_cast<void>(search.findNeighbors(boxes));
    static_cast<void>(search.findNeighbors(boxes, boxes));
    const std::size_t before = test::allocationCount();
    EXPECT_GT(search.findNeighbors(boxes).indices.size(), 2000U);
    EXPECT_GT(search.findNeighbors(boxes, NeighborRows::Half).indices.size(), 1000U);
    EXPECT_GT(search.findNeighbors(boxes, boxes).indices.size(), 1000U);
    EXPECT_EQ(test::allocationCount() - before, 0U);
  }
}

TEST(Allocation, ASecondSearchOfManyWorldsOfTheSameSizeAllocatesNothing) {
  const std::vector<BoxF> boxes = test::randomBoxes(3000, 3);
  const std::vector<Box> precise = test::toDouble(boxes);
  std::vector<std::uint64_t> begin{0, 1000};
  while (begin.back() != boxes.size()) begin.push_back(begin.back() + 20);
  for (const BoxView& view : {BoxView(boxes), BoxView(precise)}) {
    const Worlds worlds(view, begin);
    WorldsSearch search;
    const std::size_t pairs = search.find(worlds).pairs.size();
    const std::size_t before = test::allocationCount();
    EXPECT_EQ(search.find(worlds).pairs.size(), pairs);
    EXPECT_EQ(search.count(worlds).back(), pairs);
    EXPECT_EQ(test::allocationCount(), before);
  }
}

TEST(Allocation, TakesAtMost48BytesABoxBesideTheOutput) {
  constexpr std::size_t kBoxes = 200000;
  const std::vector<BoxF> boxes = test::randomBoxes(kBoxes, 42);
  for (const Order order : {Order::ByFirst, Order::Unordered}) {
    test::CountingMemory memory;
    OverlapOptions options;
    options.order = order;
    options.memory = &memory;
    const std::size_t pairs = OverlapSearch(options).find(boxes).size();
    // Growing doubles the output's buffer: its blocks, not what is written to them, add up to four times the pairs.
    EXPECT_LT(memory.bytes(), 48 * kBoxes + 4 * pairs * sizeof(Pair));
    // Of the default memory room for denser scenes is asked for, most of which is never touched.
    options.memory = nullptr;
    const std::size_t before = test::allocatedBytes();
    static_cast<void>(OverlapSearch(options).find(boxes));
    EXPECT_LT(test::allocatedBytes() - before, (48 + 128) * kBoxes + 4 * pairs * sizeof(Pair));
  }
}

TEST(Allocation, AOneShotCallAllocatesABlockAndItsResult) {
  for (const std::size_t count : {500U, 5000U, 28000U}) {
    for (const float size : {0.5F, 1.5F}) {
      const std::vector<BoxF> boxes = test::randomBoxes(count, 44, size);
      for (const Order order : {Order::ByFirst, Order::Unordered}) {
        OverlapOptions options;
        options.order = order;
        const std::size_t before = test::allocationCount();
        const std::size_t pairs = overlaps(boxes, options).size();
        EXPECT_LE(test::allocationCount() - before, 3U) << count << " boxes, " << pairs << " pairs";
      }
    }
  }
}

TEST(Allocation, AResultOfFewBoxesOfWhichAllOverlapIsNotCopied) {
  for (const std::size_t count : {70U, 140U, 192U}) {  // few boxes with any instruction set
    const std::vector<BoxF> boxes(count, BoxF{{0, 0, 0}, {1, 1, 1}});
    const std::size_t before = test::allocatedBytes();
    const std::size_t pairs = overlaps(boxes).size();
    EXPECT_EQ(pairs, count * (count - 1) / 2);
    EXPECT_EQ(test::allocatedBytes() - before, pairs * sizeof(Pair)) << count;
  }
}

TEST(Allocation, AResultOfFewBoxesBesideManyGrowsInFewSteps) {
  const std::vector<BoxF> few(8, BoxF{{0, 0, 0}, {1, 1, 1}});
  const std::vector<BoxF> many(500000, BoxF{{0, 0, 0}, {1, 1, 1}});
  for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
    const std::size_t before = test::allocatedBytes();
    const std::size_t pairs = overlaps(many, few, {.order = order}).size();
    EXPECT_EQ(pairs, few.size() * many.size());
    EXPECT_LE(test::allocatedBytes() - before, 4 * pairs * sizeof(Pair));
  }
}

TEST(Allocation, AOneShotCallTakesMemoryOfTheCallerOnly) {
  const std::vector<BoxF> boxes = test::randomBoxes(5000, 45);
  test::CountingMemory memory;
  OverlapOptions options;
  options.memory = &memory;
  const std::size_t before = test::allocatedBytes();
  const std::size_t pairs = overlaps(boxes, options).size();
  EXPECT_GT(memory.bytes(), 24 * boxes.size());
  EXPECT_EQ(test::allocatedBytes() - before, pairs * sizeof(Pair));
}

TEST(Allocation, StreamingAndCountingTakeNoMoreForManyPairs) {
  constexpr std::size_t kBoxes = 4000;
  const std::vector<Box> boxes(kBoxes, Box{{0, 0, 0}, {0.1, 0.1, 0.1}});
  for (const Order order : {Order::ByFirst, Order::Unordered}) {
    OverlapOptions options;
    options.distance = 0.1;  // Each pair is tested again in double.
    options.order = order;
    const std::size_t before = test::allocatedBytes();
    std::size_t streamed = 0;
    streamOverlaps(
        boxes, [&](std::span<const Pair> pairs) { streamed += pairs.size(); }, options);
    EXPECT_EQ(streamed, kBoxes * (kBoxes - 1) / 2);
    EXPECT_EQ(countOverlaps(boxes, options), streamed);
    EXPECT_LT(test::allocatedBytes() - before, streamed * sizeof(Pair) / 10);
  }
}

}  // namespace
}  // namespace allpairs
