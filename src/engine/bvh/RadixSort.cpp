// SPDX-License-Identifier: MIT
#include "bvh/RadixSort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace allpairs::engine {
namespace {

/// Runs up to this length are sorted by insertion.
constexpr std::size_t kShortRun = 24;

/// The maximum length of a digit, so that its counters stay in the first-level cache together with the numbers.
constexpr unsigned kMaxDigitBits = 11;

/// From this length on digits are short enough for the destinations of a pass, one per digit value, to stay in the
/// first-level cache.
constexpr unsigned kFewDigitBits = 8;
constexpr std::size_t kLongRun = 65536;

/// Up to this size numbers are sorted as one run: source and destination then fit a second-level cache. With threads,
/// less.
constexpr std::size_t kMostInOneRun = std::size_t{1} << 17;
constexpr std::size_t kMostForOneThread = std::size_t{1} << 14;

/// A first pass leaves buckets of about 2^kRunBits numbers, in no more than 2^kMaxDigitBits buckets.
constexpr unsigned kRunBits = 12;

/// A chunk smaller than this is not worth a task.
constexpr std::size_t kMinChunk = std::size_t{1} << 13;

template <class Number>
void insertionSort(Number* values, std::size_t size, unsigned begin) noexcept {
  for (std::size_t i = 1; i < size; ++i) {
    const Number value = values[i];
    std::size_t hole = i;
    for (; hole > 0 && values[hole - 1] >> begin > value >> begin; --hole) values[hole] = values[hole - 1];
    values[hole] = value;
  }
}

/// The maximum length of a digit: with more counters than numbers, the counters would dominate a pass.
unsigned digitBits(std::size_t size) noexcept {
  const unsigned most = size < kLongRun ? kMaxDigitBits : kFewDigitBits;
  return std::min(static_cast<unsigned>(std::bit_width(size)) - 1, most);
}

/// Turns counts into the beginning of each digit value.
void exclusivePrefixSum(std::uint32_t* counts, std::size_t size) noexcept {
  std::uint32_t place = 0;
  for (std::size_t digit = 0; digit < size; ++digit) place += std::exchange(counts[digit], place);
}

/// Moves numbers by one digit; returns whether the digit had more than one value.
template <class Number>
bool moveByDigit(const Number* from, Number* to, std::size_t size, unsigned shift, unsigned bits) noexcept {
  const Number mask = (Number{1} << bits) - 1;
  std::array<std::uint32_t, std::size_t{1} << kMaxDigitBits> places;
  std::fill_n(places.begin(), std::size_t{mask} + 1, 0U);
  for (std::size_t i = 0; i < size; ++i) ++places[from[i] >> shift & mask];
  if (places[from[0] >> shift & mask] == size) return false;
  exclusivePrefixSum(places.data(), std::size_t{mask} + 1);
  for (std::size_t i = 0; i < size; ++i) to[places[from[i] >> shift & mask]++] = from[i];
  return true;
}

}  // namespace

template <class Number>
Number* radixSort(Number* from, Number* to, std::size_t size, unsigned begin, unsigned end) noexcept {
  if (size <= kShortRun) {
    insertionSort(from, size, begin);
    return from;
  }
  if (begin >= end) return from;
  const unsigned most = digitBits(size);
  const unsigned passes = (end - begin + most - 1) / most;
  const unsigned bits = (end - begin + passes - 1) / passes;
  for (unsigned shift = begin; shift < end; shift += bits) {
    if (moveByDigit(from, to, size, shift, std::min(bits, end - shift))) std::swap(from, to);
  }
  return from;
}

template std::uint32_t* radixSort(std::uint32_t*, std::uint32_t*, std::size_t, unsigned, unsigned) noexcept;
template std::uint64_t* radixSort(std::uint64_t*, std::uint64_t*, std::size_t, unsigned, unsigned) noexcept;

/// Splits all numbers into buckets by the bits from `shift` on.
void RadixSort::scatter(const std::uint64_t* from, std::uint64_t* to, std::size_t size, unsigned shift,
                        Executor& executor) {
  const std::size_t most = executor.concurrency() == 1 ? 1 : 8 * executor.concurrency();
  const std::size_t chunks = std::clamp<std::size_t>(std::min(most, size / kMinChunk), 1, 256);
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
  if (size <= (executor.concurrency() == 1 ? kMostInOneRun : kMostForOneThread)) {
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
