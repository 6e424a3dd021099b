// SPDX-License-Identifier: MIT
#include "memory/Memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory_resource>
#include <new>
#include <thread>
#include <utility>

namespace allpairs::engine {
namespace {

struct Numbers : Buffer<std::uint64_t> {
  explicit Numbers(std::pmr::memory_resource* memory = defaultMemory()) : Buffer(memory) {}
};

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

TEST(Memory, TwoBuffersThatGrowByTurnsKeepWhatIsTheirs) {
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

TEST(Memory, ABufferThatGrowsAtLeastDoubles) {
  Numbers numbers;
  numbers.grow(1000);
  numbers.grow(1001);
  EXPECT_GE(numbers.capacity(), 2000U);
  numbers.grow(2000);
  EXPECT_GE(numbers.capacity(), 2000U);
}

/// Refuses blocks of more than so many bytes.
class BoundedMemory final : public std::pmr::memory_resource {
 public:
  explicit BoundedMemory(std::size_t largest) : m_largest(largest) {}

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    if (bytes > m_largest) throw std::bad_alloc();
    return std::pmr::new_delete_resource()->allocate(bytes, alignment);
  }
  void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override {
    std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
  }
  [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  std::size_t m_largest;
};

TEST(Memory, ABufferThatCannotGrowIsAsItWas) {
  BoundedMemory memory(1000 * sizeof(std::uint64_t));
  Numbers numbers(&memory);
  numbers.grow(1000);
  for (std::size_t i = 0; i < 1000; ++i) numbers[i] = numberAt(i, 3);
  EXPECT_THROW(numbers.grow(1001), std::bad_alloc);
  EXPECT_EQ(numbers.capacity(), 1000U);
  EXPECT_TRUE(holds(numbers, 1000, 3));
}

TEST(Memory, ABufferOfManyValuesLooksUpAsItGrowsAndIsAsItWasIfThatThrows) {
  constexpr std::size_t kSize = std::size_t{4} << 20;
  Numbers numbers;
  numbers.grow(kSize);
  for (std::size_t i = 0; i < kSize; ++i) numbers[i] = numberAt(i, 4);
  int looks = 0;
  const auto stop = [&] {
    if (++looks == 3) throw std::bad_alloc();
  };
  EXPECT_THROW(numbers.grow(kSize + 1, stop), std::bad_alloc);
  EXPECT_EQ(numbers.capacity(), kSize);
  EXPECT_TRUE(holds(numbers, kSize, 4));
  numbers.grow(kSize + 1, stop);
  EXPECT_GT(looks, 5);
  EXPECT_TRUE(holds(numbers, kSize, 4));
}

TEST(Memory, ABufferThatCannotBeReplacedIsEmptyAndMayBeUsedAgain) {
  BoundedMemory memory(1000 * sizeof(std::uint64_t));
  Numbers numbers(&memory);
  numbers.require(500);
  EXPECT_THROW(numbers.require(1001), std::bad_alloc);
  EXPECT_EQ(numbers.capacity(), 0U);
  numbers.require(1000);
  EXPECT_EQ(numbers.capacity(), 1000U);
}

/// Knows the blocks that have not been given back, and that each is given back as it was taken.
class CountedMemory final : public std::pmr::memory_resource {
 public:
  [[nodiscard]] std::size_t blocks() const { return m_blocks.size(); }

 private:
  using Block = std::pair<std::size_t, std::size_t>;

  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    void* const memory = std::pmr::new_delete_resource()->allocate(bytes, alignment);
    m_blocks[memory] = {bytes, alignment};
    return memory;
  }
  void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override {
    const Block block(bytes, alignment);
    EXPECT_EQ(m_blocks[memory], block);
    m_blocks.erase(memory);
    std::pmr::new_delete_resource()->deallocate(memory, bytes, alignment);
  }
  [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  std::map<void*, Block> m_blocks;
};

TEST(Memory, ABufferThatIsMovedTakesItsResourceAlong) {
  CountedMemory first;
  CountedMemory second;
  {
    Numbers one(&first);
    one.require(10);
    Numbers other(&second);
    other.require(20);
    other = std::move(one);
    EXPECT_EQ(other.capacity(), 10U);
    const Numbers last(std::move(other));
    EXPECT_EQ(last.capacity(), 10U);
    EXPECT_EQ(other.capacity(), 0U);  // NOLINT(bugprone-use-after-move): it may be used again
    other.require(30);
    EXPECT_EQ(first.blocks(), 2U);
    EXPECT_EQ(second.blocks(), 1U);
  }
  EXPECT_EQ(first.blocks(), 0U);
  EXPECT_EQ(second.blocks(), 0U);
}

TEST(Memory, SizesBeyondTheAddressSpaceAreOutOfMemory) {
  Numbers numbers;
  EXPECT_THROW(numbers.grow(std::numeric_limits<std::size_t>::max() / 2), std::bad_alloc);
  EXPECT_THROW(numbers.require(std::numeric_limits<std::size_t>::max() / 8 + 2), std::bad_alloc);
}

TEST(Memory, OfTheDefaultIsGivenBackToTheDefaultOnly) {
  EXPECT_TRUE(defaultMemory()->is_equal(*defaultMemory()));
  EXPECT_FALSE(defaultMemory()->is_equal(*std::pmr::new_delete_resource()));
}

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
