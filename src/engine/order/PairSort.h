// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "allpairs/Executor.h"
#include "allpairs/Pair.h"
#include "bvh/RadixSort.h"
#include "memory/Memory.h"
#include "order/PairBuckets.h"

namespace allpairs::engine {

/// Compares pairs in an order.
[[nodiscard]] inline std::uint64_t keyOf(Pair pair, Order order) noexcept {
  const std::uint64_t byFirst = (std::uint64_t{pair.first} << 32U) | pair.second;
  return order == Order::BySecond ? std::rotl(byFirst, 32) : byFirst;
}

/// Orders pairs by (first, second) or (second, first): as numbers of 64 bits, by a radix sort.
///
/// Cost:    about five passes over all pairs; as much memory again as the pairs.
/// Threads: parallel over the executor; the result is the same for any.
class PairSort {
 public:
  explicit PairSort(std::pmr::memory_resource* memory) : m_own(memory), m_radix(memory) {}

  /// `spare` may be overwritten: if the pairs fit there, the sort allocates no memory.
  void sort(std::span<Pair> pairs, const PairOrder& order, std::span<Pair> spare, Executor& executor);

 private:
  Buffer<Pair> m_own;
  RadixSort m_radix;
};

}  // namespace allpairs::engine
