// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

#include "allpairs/Executor.h"

namespace allpairs::engine {

/// The passes of a sort of numbers by their bits [begin, end), one for each digit from the lowest up, back and forth between
/// two arrays. Numbers that agree in those bits keep their order. For fewer than 2^32 numbers.
template <class Number>
class RadixPasses {
 public:
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): counters are written before they are read
  RadixPasses(Number* from, Number* to, std::size_t size, unsigned begin, unsigned end) noexcept
      : m_from(from), m_to(to), m_size(size), m_begin(begin), m_end(std::max(begin, end)) {
    // With more counters than numbers, a pass would spend its time on those.
    const unsigned most =
        std::min(static_cast<unsigned>(std::bit_width(size | 2)) - 1, size < kLongRun ? kMaxDigitBits : kFewDigitBits);
    const unsigned passes = std::max(1U, (m_end - begin + most - 1) / most);
    m_digitBits = (m_end - begin + passes - 1) / passes;
    m_digits[0].start(begin, m_digitBits);
  }

  /// Sorts; in the last pass write(to, place, number) puts each number in its place, or to where its caller wants it.
  /// Returns whether there was such a pass: where few numbers or equal digits need none, the result is in from().
  template <class Write>
  bool run(const Write& write) noexcept;

  [[nodiscard]] Number* from() const noexcept { return m_from; }
  [[nodiscard]] Number* to() const noexcept { return m_to; }

 private:
  /// Runs up to this length are sorted by insertion.
  static constexpr std::size_t kShortRun = 24;

  /// Digits are no longer than this, so that their counters stay in the first-level cache beside the numbers.
  static constexpr unsigned kMaxDigitBits = 11;

  /// From this length on the places that a pass writes to, one for each digit, have to lie in the first-level cache.
  static constexpr unsigned kFewDigitBits = 8;
  static constexpr std::size_t kLongRun = 65536;

  /// Counts by the values of a digit; then where numbers with that value go.
  struct Digit {
    unsigned shift = 0;
    Number mask = 0;
    std::array<std::uint32_t, std::size_t{1} << kMaxDigitBits> places;

    void start(unsigned from, unsigned bits) noexcept {
      shift = from;
      mask = (Number{1} << bits) - 1;
      std::fill_n(places.begin(), std::size_t{mask} + 1, 0U);
    }
    [[nodiscard]] std::uint32_t countOf(Number number) const noexcept { return places[number >> shift & mask]; }
    void exclusivePrefixSum() noexcept {
      std::uint32_t place = 0;
      for (std::size_t value = 0; value <= mask; ++value) place += std::exchange(places[value], place);
    }
  };

  /// The counters of a digit with what tells it in registers: stores of numbers may otherwise change it, for all that the
  /// compiler knows.
  class Counters {
   public:
    explicit Counters(Digit& digit) noexcept
        : m_shift(digit.shift), m_mask(digit.mask), m_places(digit.places.data()) {}
    std::uint32_t& operator[](Number number) const noexcept { return m_places[number >> m_shift & m_mask]; }

   private:
    unsigned m_shift;
    Number m_mask;
    std::uint32_t* m_places;
  };

  void count(Digit& digit) const noexcept {
    const Counters counters(digit);
    const Number* const from = m_from;
    for (std::size_t i = 0, size = m_size; i < size; ++i) ++counters[from[i]];
  }

  /// Moves all numbers by a digit, and counts them by the next one.
  void moveAndCount(Digit& digit, Digit& next) noexcept {
    const Counters places(digit);
    const Counters counters(next);
    const Number* const from = m_from;
    Number* const to = m_to;
    for (std::size_t i = 0, size = m_size; i < size; ++i) {
      const Number number = from[i];
      ++counters[number];
      to[places[number]++] = number;
    }
    std::swap(m_from, m_to);
  }

  template <class Write>
  void writeInOrder(Digit& digit, const Write& write) const noexcept {
    const Counters places(digit);
    const Number* const from = m_from;
    Number* const to = m_to;
    for (std::size_t i = 0, size = m_size; i < size; ++i) write(to, places[from[i]]++, from[i]);
  }

  void insertionSort() noexcept {
    for (std::size_t i = 1; i < m_size; ++i) {
      const Number value = m_from[i];
      std::size_t hole = i;
      for (; hole > 0 && m_from[hole - 1] >> m_begin > value >> m_begin; --hole) m_from[hole] = m_from[hole - 1];
      m_from[hole] = value;
    }
  }

  Number* m_from;
  Number* m_to;
  std::size_t m_size;
  unsigned m_begin;
  unsigned m_end;
  unsigned m_digitBits;
  Digit m_digits[2];  ///< Of this pass and the next.
};

template <class Number>
template <class Write>
bool RadixPasses<Number>::run(const Write& write) noexcept {
  if (m_size <= kShortRun) insertionSort();
  if (m_size <= kShortRun || m_begin == m_end) return false;
  Digit* digit = &m_digits[0];
  Digit* next = &m_digits[1];
  count(*digit);
  for (;;) {
    const unsigned shift = digit->shift + m_digitBits;
    const bool isEqual = digit->countOf(m_from[0]) == m_size;
    digit->exclusivePrefixSum();
    if (shift >= m_end) {
      if (!isEqual) writeInOrder(*digit, write);
      return !isEqual;
    }
    next->start(shift, std::min(m_digitBits, m_end - shift));
    isEqual ? count(*next) : moveAndCount(*digit, *next);
    std::swap(digit, next);
  }
}

/// Sorts numbers as RadixPasses does; returns which of the two arrays holds the result. For std::uint32_t and std::uint64_t.
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
