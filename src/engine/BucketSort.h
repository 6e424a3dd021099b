// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "Kernels.h"
#include "PackedBucket.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"

namespace allpairs::engine {

/// How pairs are cut into buckets of neighbouring keys. The key is the index that they are ordered by first.
struct BucketRule {
  static constexpr unsigned kMostKeyBits = 11;
  static constexpr std::size_t kMostBuckets = 2048;

  const Kernels* kernels = nullptr;
  unsigned keyBits = 0;  ///< Keys of a bucket differ in these low bits only.
  std::size_t buckets = 0;
  unsigned otherBits = 0;
  bool bySecond = false;

  /// Cuts `keys` keys into about `wanted` buckets.
  BucketRule(std::size_t keys, std::size_t others, std::size_t wanted, Order order, const Kernels& used);

  /// Whether what the keys of a bucket differ in and the other index make a number of 32 bits.
  [[nodiscard]] bool packs() const noexcept {
    return keyBits <= kMostKeyBits && otherBits < 32 && keyBits + otherBits <= 32;
  }

  [[nodiscard]] std::uint32_t keyOf(Pair pair) const noexcept { return bySecond ? pair.second : pair.first; }
  [[nodiscard]] std::uint32_t otherOf(Pair pair) const noexcept { return bySecond ? pair.first : pair.second; }
  [[nodiscard]] std::uint64_t rankOf(Pair pair) const noexcept {
    return std::uint64_t{keyOf(pair)} << 32U | otherOf(pair);
  }
};

/// Turns counts into where each digit begins.
void placesOf(std::uint32_t* counts, std::size_t size);

/// Sorts the pairs of one bucket into their place, by a rule that packs. They come in as many parts as there are.
///
/// The place is all the memory that it needs: twice as many numbers fit in there as there are pairs. The parts go to its
/// second half, from there each number to its key's in the first half, and from the first half pairs are written.
class BucketSort {
 public:
  BucketSort(const BucketRule& rule, std::span<Pair> place);

  void add(std::span<const Pair> part);

  /// To be called when all parts have been added.
  void finish();

 private:
  static constexpr std::size_t kMostKeys = std::size_t{1} << BucketRule::kMostKeyBits;

  template <bool kBySecond>
  void pack(std::span<const Pair> part);
  std::size_t sortLongRows();

  const BucketRule& m_rule;
  std::span<Pair> m_place;
  std::uint32_t* m_values;
  std::uint32_t* m_added;  ///< Where the next number goes; those before it are in the order in which they came.
  std::size_t m_keys;
  std::uint32_t m_firstKey = 0;
  std::array<std::uint32_t, kMostKeys> m_ends;  ///< By key: how many pairs it has, then where they end.
  std::array<PackedBucket::Row, kMostKeys> m_rows;
};

}  // namespace allpairs::engine
