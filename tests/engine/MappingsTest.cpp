// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "allpairs/World.h"

// What a search does with its memory must not touch what other threads map meanwhile. Moving pages did on Linux 6.1:
// there a failed mremap() to a fixed address leaves a hole, into which another thread's mmap() falls.

namespace allpairs {
namespace {

/// Memory that a thread maps for itself, with a mark in every page.
class MarkedMapping {
 public:
  MarkedMapping() : m_data(mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)) {
    if (m_data == MAP_FAILED) throw std::bad_alloc();
    for (std::size_t i = 0; i < kBytes; i += kPage) at(i) = kMark;
  }
  MarkedMapping(MarkedMapping&& other) noexcept : m_data(std::exchange(other.m_data, nullptr)) {}
  MarkedMapping(const MarkedMapping&) = delete;
  MarkedMapping& operator=(const MarkedMapping&) = delete;
  MarkedMapping& operator=(MarkedMapping&&) = delete;
  ~MarkedMapping() {
    if (m_data != nullptr) munmap(m_data, kBytes);
  }

  [[nodiscard]] bool isIntact() const {
    for (std::size_t i = 0; i < kBytes; i += kPage) {
      if (at(i) != kMark) return false;
    }
    return true;
  }

 private:
  static constexpr std::size_t kBytes = std::size_t{2} << 20;
  static constexpr std::size_t kPage = 4096;
  static constexpr std::uint64_t kMark = 0xB0B0B0B0B0B0B0B0U;

  [[nodiscard]] std::uint64_t& at(std::size_t offset) const {
    return *reinterpret_cast<std::uint64_t*>(static_cast<char*>(m_data) + offset);
  }

  void* m_data;
};

/// Maps and unmaps until it is stopped; returns how many mappings somebody else wrote to.
std::size_t countBrokenMappings(const std::stop_token& stop) {
  std::size_t broken = 0;
  while (!stop.stop_requested()) {
    std::vector<MarkedMapping> mappings(50);
    for (const MarkedMapping& mapping : mappings) broken += mapping.isIntact() ? 0U : 1U;
  }
  return broken;
}

constexpr BoxId kCrowd = 1200;

/// As many boxes that all overlap each other, with the even indices, as boxes that overlap nothing: the results grow by
/// and by over several megabytes.
std::vector<Box> halfCrowd() {
  std::vector<Box> boxes;
  for (BoxId i = 0; i < kCrowd; ++i) {
    boxes.push_back({{-1, -1, -1}, {1.0 + i, 1, 1}});
    boxes.push_back({{1e4 + 10.0 * i, 0, 0}, {1e4 + 10.0 * i + 1, 1, 1}});
  }
  return boxes;
}

std::vector<Pair> pairsOfHalfCrowd() {
  std::vector<Pair> pairs;
  for (BoxId i = 0; i < kCrowd; ++i) {
    for (BoxId j = i + 1; j < kCrowd; ++j) pairs.push_back({2 * i, 2 * j});
  }
  return pairs;
}

TEST(Mappings, OfOtherThreadsStayAsTheyAreWhileAWorldSteps) {
  const std::vector<Box> boxes = halfCrowd();
  const std::vector<Pair> expected = pairsOfHalfCrowd();
  std::size_t broken = 0;
  {
    const std::jthread neighbour([&broken](const std::stop_token& stop) { broken = countBrokenMappings(stop); });
    for (int round = 0; round < 6; ++round) {
      World world;
      static_cast<void>(world.add(boxes));
      const auto pairs = world.step().pairs;
      EXPECT_TRUE(std::ranges::equal(pairs, expected));
    }
  }
  EXPECT_EQ(broken, 0U);
}

}  // namespace
}  // namespace allpairs
