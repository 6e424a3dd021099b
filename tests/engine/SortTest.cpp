// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "allpairs/parallel/TbbExecutor.h"
#include "bvh/RadixSort.h"
#include "order/PairSort.h"

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
  PairSort(defaultMemory()).sort(pairs, {keys, keys, order, spare}, executor);
  ASSERT_TRUE(sortedBy(order, given) == pairs) << size << " pairs of " << keys;
}

TEST(PairSort, SortsSparseAndDensePairsByEitherIndex) {
  SerialExecutor serial;
  parallel::TbbExecutor threads(2);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{51}, std::size_t{3001}, std::size_t{90000}, std::size_t{300001}}) {
    for (const std::uint32_t keys : {1U, 40U, 5000U, 70000U, 3000000U}) {
      for (const Order order : {Order::ByFirst, Order::BySecond}) {
        expectSorted(size, keys, order, serial);
        expectSorted(size, keys, order, threads);
      }
    }
  }
}

TEST(PairSort, SortsPairsOfWhichOneIndexHasThousands) {
  std::vector<Pair> given = randomPairs(60000, 90000);
  for (std::size_t i = 0; i < given.size(); i += 13) given[i].first = 4711;
  for (std::size_t i = 1; i < given.size(); i += 13) given[i].second = 815;
  SerialExecutor serial;
  for (const Order order : {Order::ByFirst, Order::BySecond}) {
    std::vector<Pair> pairs = given;
    PairSort(defaultMemory()).sort(pairs, {90000, 90000, order, {}}, serial);
    ASSERT_TRUE(sortedBy(order, given) == pairs);
  }
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
