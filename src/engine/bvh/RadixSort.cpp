// SPDX-License-Identifier: MIT
#include "bvh/RadixSort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include "input/Parts.h"

namespace allpairs::engine {
namespace {

/// Up to this size one thread sorts numbers as one run: there and back they fill a second-level cache
/// (allpairs bench uniform -n 100000, and -n 200000).
constexpr std::size_t kMostInOneRun = std::size_t{1} << 17;

/// A first pass leaves buckets of about 2^kRunBits numbers, 64 KiB there and back, in no more than 2^kMaxDigitBits
/// buckets.
constexpr unsigned kRunBits = 12;

/// Runs up to this length are sorted by insertion (docs/decisions/0019, allpairs bench clusters -n
/// 100000).
constexpr std::size_t kShortRun = 24;

/// The most bits of a digit: its counters then stay in the first-level cache beside the numbers.
constexpr unsigned kMaxDigitBits = 11;

/// From this length on the places that a pass writes to, one for each digit, have to lie in the first-level cache
/// (docs/decisions/0019, dense_benchmark).
constexpr unsigned kFewDigitBits = 8;
constexpr std::size_t kLongRun = 65536;

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
unsigned digitBits(std::size_t size, unsigned bits) noexcept {
  const unsigned most =
      std::min(static_cast<unsigned>(std::bit_width(size)) - 1, size < kLongRun ? kMaxDigitBits : kFewDigitBits);
  const unsigned passes = (bits + most - 1) / most;
  return (bits + passes - 1) / passes;
}

}  // namespace

template <class Number>
Number* radixSort(Number* from, Number* to, std::size_t size, unsigned begin, unsigned end) noexcept {
  if (size <= kShortRun) insertionSort(from, size, begin);
  if (size <= kShortRun || begin >= end) return from;
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
      if (isEqual) return from;
      for (std::size_t i = 0; i < size; ++i) to[places[numbers[i] >> shift & mask]++] = numbers[i];
      return to;
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

template std::uint32_t* radixSort(std::uint32_t*, std::uint32_t*, std::size_t, unsigned, unsigned) noexcept;
template std::uint64_t* radixSort(std::uint64_t*, std::uint64_t*, std::size_t, unsigned, unsigned) noexcept;

std::size_t chunksFor(std::size_t size, const Executor& executor) noexcept {
  // On one thread, so many that the executor looks at a flag every few hundredths of a second.
  const std::size_t most = executor.concurrency() == 1 ? size >> 20U : 8 * executor.concurrency();
  return std::clamp<std::size_t>(std::min(most, size / (2 * kPartSize)), 1, 256);
}

/// Cuts all numbers into buckets by the bits from `shift` on.
void RadixSort::scatter(const std::uint64_t* from, std::uint64_t* to, std::size_t size, unsigned shift,
                        Executor& executor) {
  const std::size_t chunks = chunksFor(size, executor);
  const std::size_t buckets = m_bucketBegin.size() - 1;
  if (m_places.size() != chunks) m_places.resize(chunks);
  executor.run(chunks, [&](std::size_t c) {
    m_places[c].assign(buckets, 0);
    std::size_t* const counts = m_places[c].data();
    const std::size_t end = size * (c + 1) / chunks;
    for (std::size_t i = size * c / chunks; i < end; ++i) ++counts[from[i] >> shift];
  });
  std::size_t place = 0;
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    m_bucketBegin[bucket] = place;
    for (std::pmr::vector<std::size_t>& places : m_places) place += std::exchange(places[bucket], place);
  }
  m_bucketBegin[buckets] = place;
  executor.run(chunks, [&](std::size_t c) {
    std::size_t* const places = m_places[c].data();
    const std::size_t end = size * (c + 1) / chunks;
    for (std::size_t i = size * c / chunks; i < end; ++i) to[places[from[i] >> shift]++] = from[i];
  });
}

void RadixSort::sort(std::uint64_t* from, std::uint64_t* to, std::size_t size, unsigned begin, unsigned end,
                     Executor& executor) {
  if (size <= kMostInOneRun && chunksFor(size, executor) == 1) {
    const std::uint64_t* sorted = radixSort(from, to, size, begin, end);
    if (sorted != to) std::copy_n(sorted, size, to);
    return;
  }
  const unsigned width = static_cast<unsigned>(std::bit_width(size));
  const unsigned digit = std::clamp(width, kRunBits + 4, kRunBits + kMaxDigitBits) - kRunBits;
  const unsigned shift = std::max(begin, end - std::min(end, digit));
  const std::size_t buckets = std::size_t{1} << (end - shift);
  m_bucketBegin.resize(buckets + 1);
  scatter(from, to, size, shift, executor);
  executor.run(buckets, [&](std::size_t b) {
    const std::size_t first = m_bucketBegin[b];
    const std::size_t length = m_bucketBegin[b + 1] - first;
    const std::uint64_t* sorted = radixSort(to + first, from + first, length, begin, shift);
    if (sorted != to + first) std::copy_n(sorted, length, to + first);
  });
}

}  // namespace allpairs::engine
