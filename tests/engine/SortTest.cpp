// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "CheckOptions.h"
#include "PairSort.h"
#include "RadixRun.h"
#include "allpairs/Overlaps.h"
#include "allpairs/parallel/TbbExecutor.h"

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

class PairSortOf : public testing::TestWithParam<std::string> {
 protected:
  PairSortOf() { m_options.instructionSet = GetParam(); }

  void expectSorted(std::size_t size, std::uint32_t keys, Order order, Executor& executor) {
    const std::vector<Pair> given = randomPairs(size, keys);
    std::vector<Pair> pairs = given;
    std::vector<Pair> spare(size % 2 == 0 ? size : 0);
    PairSort().sort(pairs, {keys, keys, order, &chooseKernels(m_options), spare}, executor);
    ASSERT_TRUE(sortedBy(order, given) == pairs) << size << " pairs of " << keys;
  }

  OverlapOptions m_options;
};

TEST_P(PairSortOf, SortsSparseAndDensePairsByEitherIndex) {
  SerialExecutor serial;
  parallel::TbbExecutor threads(2);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{51}, std::size_t{3001}, std::size_t{90000}}) {
    for (const std::uint32_t keys : {1U, 40U, 5000U, 70000U, 3000000U}) {
      for (const Order order : {Order::ByFirst, Order::BySecond}) {
        expectSorted(size, keys, order, serial);
        expectSorted(size, keys, order, threads);
      }
    }
  }
}

TEST_P(PairSortOf, SortsPairsOfWhichOneIndexHasThousands) {
  std::vector<Pair> given = randomPairs(60000, 90000);
  for (std::size_t i = 0; i < given.size(); i += 13) given[i].first = 4711;
  for (std::size_t i = 1; i < given.size(); i += 13) given[i].second = 815;
  SerialExecutor serial;
  for (const Order order : {Order::ByFirst, Order::BySecond}) {
    std::vector<Pair> pairs = given;
    PairSort().sort(pairs, {90000, 90000, order, &chooseKernels(m_options), {}}, serial);
    ASSERT_TRUE(sortedBy(order, given) == pairs);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryInstructionSet, PairSortOf, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const std::string_view name : instructionSets()) names.emplace_back(name);
                           return names;
                         }()));

TEST(RadixRun, SortsRunsOfAnyLengthByTheBitsAboveTheIndex) {
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
      sortRun(from.data(), to.data(), size, bits, 32);
      ASSERT_TRUE(expected == to) << size << " numbers of " << bits << " bits";
    }
  }
}

}  // namespace
}  // namespace allpairs::engine
