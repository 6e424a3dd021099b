// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "allpairs/Executor.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "bvh/RadixSort.h"
#include "kernels/Kernels.h"
#include "order/PairSort.h"
#include "support/Sanitizers.h"

namespace allpairs::engine {
namespace {

std::vector<Pair> randomPairs(std::size_t size, std::uint32_t keys) {
  std::mt19937 generator(static_cast<std::uint32_t>(size) + keys);
  std::vector<Pair> pairs(size);
  for (Pair& pair : pairs) {
    pair.first = static_cast<std::uint32_t>(generator() % keys);
    pair.second = static_cast<std::uint32_t>(generator() % keys);
  }
  return pairs;
}

std::vector<Pair> sortedBy(Order order, std::vector<Pair> pairs) {
  std::sort(pairs.begin(), pairs.end(), [&](Pair a, Pair b) {
    return order == Order::ByFirst ? a < b : Pair{a.second, a.first} < Pair{b.second, b.first};
  });
  return pairs;
}

void expectSorted(std::size_t size, std::uint32_t keys, Order order, Executor& executor) {
  const std::vector<Pair> given = randomPairs(size, keys);
  std::vector<Pair> pairs = given;
  std::vector<Pair> spare(size % 2 == 0 ? size : 0);
  PairSort(defaultMemory()).sortList(pairs, {keys, keys, order}, spare, executor);
  ASSERT_TRUE(sortedBy(order, given) == pairs) << size << " pairs of " << keys;
}

TEST(PairSort, SortsListsOfSparseAndDensePairsByEitherIndex) {
  SerialExecutor serial;
  parallel::TbbExecutor threads(2);
  constexpr std::size_t kMany = test::kIsSanitized ? 70000 : 90000;
  constexpr std::size_t kMost = test::kIsSanitized ? 150001 : 300001;  // more than are sorted as one run
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{51}, std::size_t{3001}, kMany, kMost}) {
    for (const std::uint32_t keys : {1U, 40U, 5000U, 70000U, 3000000U}) {
      for (const Order order : {Order::ByFirst, Order::BySecond}) {
        expectSorted(size, keys, order, serial);
        expectSorted(size, keys, order, threads);
      }
    }
  }
}

TEST(PairSort, SortsListsOfWhichOneIndexHasThousands) {
  std::vector<Pair> given = randomPairs(60000, 90000);
  for (std::size_t i = 0; i < given.size(); i += 13) given[i].first = 4711;
  for (std::size_t i = 1; i < given.size(); i += 13) given[i].second = 815;
  SerialExecutor serial;
  for (const Order order : {Order::ByFirst, Order::BySecond}) {
    std::vector<Pair> pairs = given;
    PairSort(defaultMemory()).sortList(pairs, {90000, 90000, order}, {}, serial);
    ASSERT_TRUE(sortedBy(order, given) == pairs);
  }
}

struct SetSizes {
  std::uint32_t firsts;
  std::uint32_t seconds;
};

/// So many different pairs, or about a half of all, in any order.
std::vector<Pair> randomPairsOf(std::size_t size, SetSizes sets) {
  size = std::min<std::size_t>(size, std::size_t{sets.firsts} * sets.seconds / 2 + 1);
  std::mt19937 generator(static_cast<std::uint32_t>(size) + sets.firsts);
  std::vector<Pair> pairs(size);
  for (Pair& pair : pairs) {
    pair.first = static_cast<std::uint32_t>(generator() % sets.firsts);
    pair.second = static_cast<std::uint32_t>(generator() % sets.seconds);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::shuffle(pairs.begin(), pairs.end(), generator);
  return pairs;
}

/// Scratch memory of what is asked for, and not more.
struct ScratchMemory {
  template <class Use>
  void withScratch(std::size_t size, const Use& use) {
    std::vector<std::uint32_t> scratch(size);
    use(std::span<std::uint32_t>(scratch));
  }
};

void expectSortedInBuckets(const std::vector<Pair>& given, SetSizes sets, Order order, std::size_t threads) {
  const std::size_t size = given.size();
  PairSort sort(defaultMemory());
  sort.start({sets.firsts, sets.seconds, order, threads}, 2, *findKernels(""));
  for (std::size_t i = 0; i < size;) {
    const std::size_t worker = i < size / 2 ? 0 : 1;
    const std::size_t end = std::min(i + 1000, worker == 0 ? size / 2 : size);
    sort.ofWorker(worker).add(std::span(given).subspan(i, end - i));
    i = end;
  }
  const std::vector<Pair> expected = sortedBy(order, given);
  const std::size_t keys = order == Order::ByFirst ? sets.firsts : sets.seconds;
  std::vector<Pair> pairs(size);
  std::vector<std::uint64_t> offsets(keys + 1);
  std::vector<std::uint32_t> indices(size);
  ScratchMemory memory;
  SerialExecutor executor;
  ASSERT_EQ(sort.finish(), size);
  sort.sort(pairs, executor, memory);
  sort.list({offsets, indices}, executor, memory);
  ASSERT_EQ(offsets.back(), size);
  ASSERT_TRUE(pairs == expected) << size << " pairs of " << sets.firsts << " x " << sets.seconds;
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t key = order == Order::ByFirst ? expected[i].first : expected[i].second;
    ASSERT_EQ(indices[i], order == Order::ByFirst ? expected[i].second : expected[i].first)
        << size << " pairs of " << sets.firsts << " x " << sets.seconds << ", " << threads << " threads";
    ASSERT_TRUE(offsets[key] <= i && i < offsets[key + 1]) << size << " pairs, " << key;
  }
}

TEST(PairSort, SortsAndListsPairsOfFewBoxesAndOfMany) {
  for (const SetSizes sets : {SetSizes{1, 1}, SetSizes{1, 4096}, SetSizes{4096, 1}, SetSizes{300, 4096},
                              SetSizes{4096, 4096}, SetSizes{4097, 10}, SetSizes{257, 256}, SetSizes{90000, 5000}}) {
    for (const std::size_t size : {0U, 1U, 127U, 3001U, 40000U, test::kIsSanitized ? 100000U : 300000U}) {
      const std::vector<Pair> given = randomPairsOf(size, sets);
      for (const Order order : {Order::ByFirst, Order::BySecond}) {
        for (const std::size_t threads : {1U, 2U}) expectSortedInBuckets(given, sets, order, threads);
      }
    }
  }
}

TEST(PairSort, CountsPairsOfOneThreadAndOfFewBoxes) {
  EXPECT_TRUE(PairOrder(4096, 4096, Order::ByFirst, 1).isCounted);
  EXPECT_FALSE(PairOrder(4097, 4096, Order::ByFirst, 1).isCounted);
  EXPECT_FALSE(PairOrder(4096, 4097, Order::BySecond, 1).isCounted);
  EXPECT_FALSE(PairOrder(4096, 4096, Order::ByFirst, 2).isCounted);
}

TEST(RadixSort, OneThreadLooksAtAFlagBetweenChunksOfAMillion) {
  SerialExecutor one;
  EXPECT_EQ(chunksFor(std::size_t{1} << 20U, one), 1U);
  EXPECT_EQ(chunksFor(std::size_t{30} << 20U, one), 30U);
}

TEST(RadixSort, SortsRunsOfAnyLengthByTheBitsAboveTheIndex) {
  std::mt19937_64 generator(11);
  for (const std::size_t size : {0U, 1U, 2U, 24U, 25U, 500U, 1535U, 1536U, 8191U, 8192U, 40000U}) {
    for (const unsigned bits : {32U, 33U, 40U, 50U, 62U}) {
      std::vector<std::uint64_t> from(size);
      const std::uint64_t few = bits % 2 == 0 ? ~std::uint64_t{0} : 5;  // Or all keys nearly equal.
      for (std::size_t i = 0; i < size; ++i) {
        from[i] = ((generator() & few) << 32U & ((std::uint64_t{1} << bits) - 1)) | i;
      }
      std::vector<std::uint64_t> expected = from;
      std::sort(expected.begin(), expected.end());
      std::vector<std::uint64_t> to(size);
      if (radixSort(from.data(), to.data(), size, 32, bits) == from.data()) std::swap(from, to);
      ASSERT_TRUE(expected == to) << size << " numbers of " << bits << " bits";
    }
  }
}

}  // namespace
}  // namespace allpairs::engine
