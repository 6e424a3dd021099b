// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "allpairs/Executor.h"

namespace allpairs::engine {

/// Sorts numbers by their bits [begin, end): a pass for each digit from the lowest up, back and forth between two
/// arrays. Numbers that agree in those bits keep their order; the bits above `end` are the same in all of them. For
/// fewer than 2^32 numbers. Returns which of the two arrays holds the result. For std::uint32_t and std::uint64_t.
template <class Number>
[[nodiscard]] Number* radixSort(Number* from, Number* to, std::size_t size, unsigned begin, unsigned end) noexcept;

/// How many chunks so many boxes or numbers are cut into: several for each thread, none too small to be worth a task.
[[nodiscard]] std::size_t chunksFor(std::size_t size, const Executor& executor) noexcept;

/// Sorts any number of 64-bit numbers, and keeps the memory of its counters: many are first cut into buckets by their
/// highest digit, so that a bucket fits a cache near the core, or so that threads share them.
///
/// Cost:    one pass over all numbers, and about three over each bucket.
/// Threads: parallel over the executor; the result is the same for any.
class RadixSort {
 public:
  explicit RadixSort(std::pmr::memory_resource* memory) : m_places(memory), m_bucketBegin(memory) {}

  /// Sorts by the bits [begin, end) from `from`, whose contents are lost, into `to`; higher bits are 0.
  void sort(std::uint64_t* from, std::uint64_t* to, std::size_t size, unsigned begin, unsigned end, Executor& executor);

 private:
  void scatter(const std::uint64_t* from, std::uint64_t* to, std::size_t size, unsigned shift, Executor& executor);

  std::pmr::vector<std::pmr::vector<std::size_t>> m_places;  ///< By chunk and bucket: where its next number goes.
  std::pmr::vector<std::size_t> m_bucketBegin;
};

}  // namespace allpairs::engine
