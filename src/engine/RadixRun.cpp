// SPDX-License-Identifier: MIT
#include "RadixRun.h"

#include <algorithm>
#include <array>
#include <bit>

namespace allpairs::engine {
namespace {

/// Runs up to this length are sorted by insertion.
constexpr std::size_t kShortRun = 24;

/// Numbers that a bucket should hold: an eighth of a run's length in buckets.
constexpr unsigned kBucketBits = 3;
constexpr unsigned kMaxDigitBits = 10;

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
