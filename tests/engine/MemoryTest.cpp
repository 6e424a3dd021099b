// SPDX-License-Identifier: MIT
#include "Memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <utility>
#include <vector>

namespace allpairs::engine {
namespace {

using Numbers = Buffer<std::uint64_t>;

std::uint64_t numberAt(std::size_t i, std::uint64_t seed) { return (i + seed) * 0x9E3779B97F4A7C15U; }

/// Grows a buffer in steps of that factor, and writes what has been added each time.
Numbers grown(std::size_t size, double factor, std::uint64_t seed) {
  Numbers numbers;
  std::size_t written = 0;
  for (double next = 100.0; written < size; next *= factor) {
    numbers.grow(std::min(size, static_cast<std::size_t>(next)));
    for (; written < std::min(size, numbers.capacity()); ++written) numbers[written] = numberAt(written, seed);
  }
  return numbers;
}

bool holds(const Numbers& numbers, std::size_t size, std::uint64_t seed) {
  for (std::size_t i = 0; i < size; ++i) {
    if (numbers[i] != numberAt(i, seed)) return false;
  }
  return true;
}

TEST(Memory, WhatIsThereStaysWhenABufferGrowsOverAllSizesOfBlocks) {
  constexpr std::size_t kSize = std::size_t{10} << 20;
  for (const double factor : {1.5, 2.0, 5.0}) EXPECT_TRUE(holds(grown(kSize, factor, 1), kSize, 1)) << factor;
}

TEST(Memory, BlocksThatHaveGrownAreUsedAgainAndGrowAgain) {
  constexpr std::size_t kSize = std::size_t{3} << 20;
  for (std::uint64_t round = 0; round < 6; ++round) {
    const Numbers first = grown(kSize, 2.0, round);
    const Numbers second = grown(kSize / 2, 3.0, round + 100);
    EXPECT_TRUE(holds(first, kSize, round));
    EXPECT_TRUE(holds(second, kSize / 2, round + 100));
  }
}

TEST(Memory, ABlockOfOneThreadMayBeFreedByAnother) {
  constexpr std::size_t kSize = std::size_t{1} << 20;
  Numbers numbers;
  std::thread([&] { numbers = grown(kSize, 2.0, 7); }).join();
  EXPECT_TRUE(holds(numbers, kSize, 7));
  std::thread([taken = std::move(numbers)]() mutable { EXPECT_TRUE(holds(grown(kSize, 2.0, 8), kSize, 8)); }).join();
}

#if defined(__linux__)
// Fresh memory is zero; that of a block which was kept is as it was left.
TEST(Memory, WhatSearchesOfOtherSizesLeftMakesRoom) {
  constexpr std::size_t kOther = std::size_t{3} << 20;
  constexpr std::size_t kSize = std::size_t{2} << 20;
  constexpr std::uint64_t kMark = 0x5EED;
  {
    std::vector<Numbers> others(12);
    for (Numbers& numbers : others) numbers.require(kOther);
  }
  bool isKept = false;
  for (int round = 0; round < 1000 && !isKept; ++round) {
    Numbers numbers;
    numbers.require(kSize);
    isKept = numbers[kSize - 1] == kMark;
    numbers[kSize - 1] = kMark;
  }
  EXPECT_TRUE(isKept);
}
#endif

TEST(Memory, IsAlignedToACacheLine) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{1000}, std::size_t{100000}, std::size_t{10000000}}) {
    Numbers numbers;
    numbers.require(size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % 64, 0U) << size;
    numbers.grow(2 * size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(numbers.data()) % 64, 0U) << size;
  }
}

}  // namespace
}  // namespace allpairs::engine
