// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <span>
#include <vector>

#include "AllocationCount.h"
#include "CountingMemory.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Worlds.h"
#include "memory/Memory.h"
#include "support/Boxes.h"

namespace {
std::atomic<std::size_t> allocations{0};
std::atomic<std::size_t> bytes{0};

void* counted(std::size_t size, std::size_t alignment) {
  ++allocations;
  bytes += size;
  void* memory = alignment <= alignof(std::max_align_t)
                     ? std::malloc(size)
                     : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace

void* operator new(std::size_t size) { return counted(size, 1); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace allpairs {

std::size_t test::allocationCount() { return allocations; }
std::size_t test::allocatedBytes() { return bytes; }

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
  const std::size_t before = allocations;
  EXPECT_GT(search.find(boxes).size(), 1000U);
  EXPECT_EQ(allocations - before, 0U);
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
    const std::size_t before = allocations;
    EXPECT_EQ(search.find(worlds).pairs.size(), pairs);
    EXPECT_EQ(search.count(worlds).back(), pairs);
    EXPECT_EQ(allocations, before);
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
    const std::size_t before = bytes;
    static_cast<void>(OverlapSearch(options).find(boxes));
    EXPECT_LT(bytes - before, (48 + 128) * kBoxes + 4 * pairs * sizeof(Pair));
  }
}

TEST(Allocation, StreamingAndCountingTakeNoMoreForManyPairs) {
  constexpr std::size_t kBoxes = 4000;
  const std::vector<Box> boxes(kBoxes, Box{{0, 0, 0}, {0.1, 0.1, 0.1}});
  for (const Order order : {Order::ByFirst, Order::Unordered}) {
    OverlapOptions options;
    options.distance = 0.1;  // Each pair is tested again in double.
    options.order = order;
    const std::size_t before = bytes;
    std::size_t streamed = 0;
    streamOverlaps(
        boxes, [&](std::span<const Pair> pairs) { streamed += pairs.size(); }, options);
    EXPECT_EQ(streamed, kBoxes * (kBoxes - 1) / 2);
    EXPECT_EQ(countOverlaps(boxes, options), streamed);
    EXPECT_LT(bytes - before, streamed * sizeof(Pair) / 10);
  }
}

}  // namespace
}  // namespace allpairs
