// SPDX-License-Identifier: MIT
#include "RadixRun.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace allpairs::engine {
namespace {

/// Runs up to this length are sorted by insertion.
constexpr std::size_t kShortRun = 24;

/// Numbers that a bucket should hold: an eighth of a run's length in buckets.
constexpr unsigned kBucketBits = 3;
constexpr unsigned kMaxDigitBits = 10;

/// From this length on the counters of three or four passes are worth their while.
constexpr std::size_t kLongRun = 1536;

/// Digits of this many bits for runs of this length: fewer passes, more counters.
constexpr unsigned kLongDigitBits = 11;
constexpr std::size_t kVeryLongRun = 8192;

/// From this length on the places that a pass writes to, one for each digit, had better lie in the first-level cache.
constexpr unsigned kFewDigitBits = 8;
constexpr std::size_t kLongestRun = 65536;

using Places = std::array<std::uint32_t, std::size_t{1} << kLongDigitBits>;

/// Digits of a key, from the lowest up, all of the same length.
struct Digits {
  static constexpr unsigned kMaxPasses = 4;

  unsigned begin;
  unsigned bits;
  unsigned passes;

  Digits(unsigned keyBegin, unsigned keyEnd, std::size_t size) : begin(keyBegin) {
    unsigned most = size < kVeryLongRun ? kMaxDigitBits : kLongDigitBits;
    if (size >= kLongestRun && keyEnd - keyBegin <= kMaxPasses * kFewDigitBits) most = kFewDigitBits;
    passes = (keyEnd - keyBegin + most - 1) / most;
    bits = (keyEnd - keyBegin + passes - 1) / passes;
  }

  [[nodiscard]] std::size_t of(std::uint64_t value, unsigned pass) const {
    return (value >> (begin + pass * bits)) & ((std::uint64_t{1} << bits) - 1);
  }
};

/// Where each digit's numbers go, for all passes at once.
void countDigits(const std::uint64_t* values, std::size_t size, const Digits& digits,
                 std::array<Places, Digits::kMaxPasses>& places) {
  const std::size_t counters = std::size_t{1} << digits.bits;
  for (unsigned pass = 0; pass < digits.passes; ++pass) std::fill_n(places[pass].begin(), counters, 0U);
  for (std::size_t i = 0; i < size; ++i) {
    for (unsigned pass = 0; pass < digits.passes; ++pass) ++places[pass][digits.of(values[i], pass)];
  }
}

/// Moves the numbers by one digit; returns whether there was more than one to tell them apart by.
bool moveByDigit(const std::uint64_t* from, std::uint64_t* to, std::size_t size, const Digits& digits, unsigned pass,
                 Places& places) {
  if (places[digits.of(from[0], pass)] == size) return false;
  std::uint32_t place = 0;
  for (std::size_t digit = 0; digit < std::size_t{1} << digits.bits; ++digit) {
    place += std::exchange(places[digit], place);
  }
  for (std::size_t i = 0; i < size; ++i) to[places[digits.of(from[i], pass)]++] = from[i];
  return true;
}

void sortByDigits(std::uint64_t* from, std::uint64_t* to, std::size_t size, const Digits& digits) {
  std::array<Places, Digits::kMaxPasses> places;
  countDigits(from, size, digits, places);
  std::uint64_t* home = to;
  for (unsigned pass = 0; pass < digits.passes; ++pass) {
    if (moveByDigit(from, to, size, digits, pass, places[pass])) std::swap(from, to);
  }
  if (from != home) std::copy_n(from, size, home);
}

void insertionSort(const std::uint64_t* from, std::uint64_t* to, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint64_t value = from[i];
    std::size_t hole = i;
    for (; hole > 0 && to[hole - 1] > value; --hole) to[hole] = to[hole - 1];
    to[hole] = value;
  }
}

/// How many bits a pass over `size` numbers should look at.
unsigned digitBits(std::size_t size, unsigned bits, unsigned keyEnd) {
  const auto wanted = static_cast<unsigned>(std::bit_width(size)) - kBucketBits;
  return std::min(std::clamp(wanted, 2U, kMaxDigitBits), bits - keyEnd);
}

}  // namespace

// Each level of recursion uses up bits of the key.
// NOLINTNEXTLINE(misc-no-recursion)
void sortRun(std::uint64_t* from, std::uint64_t* to, std::size_t size, unsigned bits, unsigned keyEnd) {
  if (size <= kShortRun) {
    insertionSort(from, to, size);
    return;
  }
  if (bits <= keyEnd) {
    std::copy_n(from, size, to);
    return;
  }
  if (size >= kLongRun && bits - keyEnd <= Digits::kMaxPasses * kMaxDigitBits) {
    sortByDigits(from, to, size, Digits(keyEnd, bits, size));
    return;
  }
  const unsigned digit = digitBits(size, bits, keyEnd);
  const unsigned shift = bits - digit;
  const std::uint64_t mask = (std::uint64_t{1} << digit) - 1;
  std::array<std::uint32_t, (std::size_t{1} << kMaxDigitBits) + 1> ends;
  std::fill_n(ends.begin(), mask + 2, 0U);
  for (std::size_t i = 0; i < size; ++i) ++ends[((from[i] >> shift) & mask) + 1];
  for (std::size_t b = 1; b <= mask; ++b) ends[b] += ends[b - 1];
  for (std::size_t i = 0; i < size; ++i) to[ends[(from[i] >> shift) & mask]++] = from[i];
  std::size_t begin = 0;
  for (std::size_t b = 0; b <= mask; ++b) {
    const std::size_t end = ends[b];
    // Sorted there and back again: the bucket goes on from `to` into `from`, and home.
    if (end - begin > 1) {
      if (end - begin <= kShortRun) {
        insertionSort(to + begin, to + begin, end - begin);
      } else {
        sortRun(to + begin, from + begin, end - begin, shift, keyEnd);
        std::copy_n(from + begin, end - begin, to + begin);
      }
    }
    begin = end;
  }
}

}  // namespace allpairs::engine
