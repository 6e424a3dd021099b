// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <numeric>
#include <utility>
#include <vector>

#include "allpairs/Executor.h"

namespace allpairs::engine {

/// Runs up to this length are sorted by insertion.
inline constexpr std::size_t kShortRun = 24;

/// The most bits of a digit: its counters then stay in the first-level cache beside the numbers.
inline constexpr unsigned kMaxDigitBits = 11;

/// From this length on the places that a pass writes to, one for each digit, have to lie in the first-level cache.
inline constexpr unsigned kFewDigitBits = 8;
inline constexpr std::size_t kLongRun = 65536;

template <class Number>
void insertionSort(Number* values, std::size_t size, unsigned begin) noexcept {
  for (std::size_t i = 1; i < size; ++i) {
    const Number value = values[i];
    std::size_t hole = i;
    for (; hole > 0 && values[hole - 1] >> begin > value >> begin; --hole) values[hole] = values[hole - 1];
    values[hole] = value;
  }
}

/// How many bits a digit has; with more counters than numbers, a pass would spend its time on those.
[[nodiscard]] inline unsigned digitBits(std::size_t size, unsigned bits) noexcept {
  const unsigned most =
      std::min(static_cast<unsigned>(std::bit_width(size)) - 1, size < kLongRun ? kMaxDigitBits : kFewDigitBits);
  const unsigned passes = (bits + most - 1) / most;
  return (bits + passes - 1) / passes;
}

/// Sorts numbers by their bits [begin, end): a pass for each digit from the lowest up, back and forth between two arrays,
/// which change their names with each. Numbers that agree in those bits keep their order; the bits above `end` are the
/// same in all of them. For fewer than 2^32 numbers.
///
/// The last pass calls write(place, number) for each number. Returns whether there was such a pass: where few numbers, or
/// equal digits, need none, the result is in `from`.
template <class Number, class Write>
bool radixSortTo(Number*& from, Number*& to, std::size_t size, unsigned begin, unsigned end,
                 const Write& write) noexcept {
  if (size <= kShortRun) insertionSort(from, size, begin);
  if (size <= kShortRun || begin >= end) return false;
  const unsigned bits = digitBits(size, end - begin);
  const std::size_t values = std::size_t{1} << bits;
  const auto mask = static_cast<Number>(values - 1);
  std::array<std::uint32_t, std::size_t{1} << kMaxDigitBits>
      memory[2];  // counts by digit, then places; this pass's, the next's
  std::uint32_t* places = memory[0].data();
  std::uint32_t* next = memory[1].data();
  const auto count = [=, &from](unsigned shift, std::uint32_t* counts) {
    std::fill_n(counts, values, 0U);
    for (const Number* number = from; number != from + size; ++number) ++counts[*number >> shift & mask];
  };
  count(begin, places);
  for (unsigned shift = begin;; shift += bits, std::swap(places, next)) {
    const bool isEqual = places[from[0] >> shift & mask] == size;
    std::exclusive_scan(places, places + values, places, 0U);
    const Number* const numbers = from;
    if (shift + bits >= end) {
      for (std::size_t i = 0; i < size && !isEqual; ++i) write(places[numbers[i] >> shift & mask]++, numbers[i]);
      return !isEqual;
    }
    if (isEqual) {
      count(shift + bits, next);
      continue;
    }
    std::fill_n(next, values, 0U);
    Number* const moved = to;
    for (std::size_t i = 0; i < size; ++i) {
      const Number number = numbers[i];
      ++next[number >> (shift + bits) & mask];
      moved[places[number >> shift & mask]++] = number;
    }
    std::swap(from, to);
  }
}

/// Sorts numbers as radixSortTo() does; returns which of the two arrays holds the result. For std::uint32_t and std::uint64_t.
template <class Number>
[[nodiscard]] Number* radixSort(Number* from, Number* to, std::size_t size, unsigned begin, unsigned end) noexcept;

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
