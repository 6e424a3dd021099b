// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "Memory.h"
#include "allpairs/Executor.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"

namespace allpairs::engine {

/// Orders pairs by (first, second) or (second, first).
///
/// Cost:    two passes over the pairs, and a sort of each row; as much memory again as the pairs take, kept.
/// Threads: parallel over the executor; the result is the same for any.
class PairSort {
 public:
  /// Sorts the first `size` pairs; `keys` is greater than every index that the pairs are ordered by first.
  void sort(Buffer<Pair>& pairs, std::size_t size, std::size_t keys, Order order, Executor& executor);

 private:
  template <bool kBySecond>
  void sortBy(Buffer<Pair>& pairs, std::size_t size, std::size_t keys, Executor& executor);
  template <bool kBySecond>
  void scatter(const Pair* from, Pair* to, std::size_t size, Executor& executor);

  Buffer<Pair> m_other;
  std::vector<std::vector<std::size_t>> m_places;  ///< By chunk and bucket.
  std::vector<std::size_t> m_bucketBegin;
  std::vector<std::vector<std::uint32_t>> m_counts;  ///< By bucket task: counters of the keys of a bucket.
  unsigned m_shift = 0;
  std::size_t m_buckets = 1;
};

}  // namespace allpairs::engine
