// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "Kernels.h"
#include "Memory.h"
#include "allpairs/Executor.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"

namespace allpairs::engine {

/// Orders pairs by (first, second) or (second, first).
///
/// Where there are few indices, two passes with a counter for each of them. Else a pass cuts the pairs into buckets of
/// neighbouring keys that fit the first-level cache; in each of those, pairs go to their key and are then put in order
/// there, or, if a key has many, are radix sorted from the lowest digit.
/// Cost:    two passes over all pairs, or one and about three within the cache; as much memory again as the pairs.
/// Threads: parallel over the executor; the result is the same for any.
class PairSort {
 public:
  /// What a sort is told besides where the pairs are.
  struct Task {
    std::size_t firsts = 0;   ///< All first indices are below.
    std::size_t seconds = 0;  ///< All second indices are below.
    Order order = Order::ByFirst;
    const Kernels* kernels = nullptr;

    /// Memory that may be overwritten: where the pairs fit in there, the sort needs none of its own.
    std::span<Pair> spare;
  };

  void sort(std::span<Pair> pairs, const Task& task, Executor& executor);

 private:
  template <bool kBySecond>
  void sortBy(std::span<Pair> pairs, Pair* other, std::size_t keys, std::size_t others, const Kernels& kernels,
              Executor& executor);
  template <bool kBySecond>
  void sortWhole(std::span<Pair> pairs, Pair* other, std::size_t keys, std::size_t others);
  template <bool kBySecond>
  void scatter(const Pair* from, Pair* to, std::size_t size, Executor& executor);

  Buffer<Pair> m_own;
  Buffer<std::uint32_t> m_counters;
  std::vector<std::vector<std::size_t>> m_places;  ///< By chunk and bucket: where its next pair goes.
  std::vector<std::size_t> m_bucketBegin;
  unsigned m_keyBits = 0;  ///< Keys that share a bucket differ in these low bits only.
  std::size_t m_buckets = 1;
};

}  // namespace allpairs::engine
