// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"
#include "memory/Memory.h"
#include "memory/Platform.h"

namespace allpairs::engine {

/// Pairs of a box in a scene as most are.
inline constexpr std::size_t kLikelyPairs = 4;

/// The order of pairs as numbers, the key above the other index, and how it cuts them into buckets of neighbouring
/// keys. The key is the index that they are ordered by first.
struct PairOrder {
  bool bySecond = false;
  unsigned allKeyBits = 0;
  unsigned keyBits = 0;  ///< Keys of a bucket differ in these low bits only.
  std::size_t buckets = 0;
  unsigned otherBits = 0;
  bool isCounted = false;  ///< One bucket has all pairs, which are so few boxes' that those of each index are counted.

  /// For sets of so many boxes, whose pairs go to buckets as so many threads find them.
  PairOrder(std::size_t firsts, std::size_t seconds, Order order, std::size_t threads = 0);
  PairOrder() = default;

  /// Whether what the keys of a bucket differ in, above the other index, make a number of 31 bits.
  [[nodiscard]] bool packs() const noexcept { return otherBits < 31 && keyBits + otherBits <= 31; }
};

/// A pair as a number: the key above the other index.
template <bool kBySecond, class Number>
[[nodiscard]] Number packed(Pair pair, unsigned otherBits) noexcept {
  return kBySecond ? Number{pair.second} << otherBits | pair.first : Number{pair.first} << otherBits | pair.second;
}

/// The pair of a number, whose key is this much less than the pair's.
template <bool kBySecond, class Number>
[[nodiscard]] Pair unpacked(Number number, unsigned otherBits, std::uint32_t firstKey = 0) noexcept {
  const auto key = static_cast<std::uint32_t>(firstKey + (number >> otherBits));
  const auto other = static_cast<std::uint32_t>(number & ((Number{1} << otherBits) - 1));
  return kBySecond ? Pair{other, key} : Pair{key, other};
}

/// Pairs in buckets of neighbouring keys, in the order in which they come: the first pass of a sort, made while they
/// are found, so that they need not be written and read once more. Within a bucket, 31 bits tell a pair.
///
/// A bucket is a chain of chunks from a common store, since nobody knows how many pairs it will have; only one alone is
/// a list.
class PairBuckets {
 public:
  explicit PairBuckets(std::pmr::memory_resource* memory)
      : m_memory(memory), m_numbers(memory), m_following(memory), m_next(memory), m_fullChunks(memory) {}

  /// Empties all buckets for a search with so many workers; memory is kept.
  void start(const PairOrder& rule, std::size_t workers);

  void add(std::span<const Pair> pairs);

  /// Adds each pair by both its indices; the rule is of one set, by first.
  void addBothWays(std::span<const Pair> pairs);

  [[nodiscard]] std::size_t size(std::size_t bucket) const noexcept {
    return m_rule.isCounted ? m_next[0] : m_fullChunks[bucket] * kChunk + m_next[bucket] % kChunk;
  }

  /// Calls use(numbers) for each stretch of pairs of a bucket: what their keys differ in above the other index.
  template <class Use>
  void forEachChunk(std::size_t bucket, const Use& use) const {
    std::size_t rest = size(bucket);
    for (std::size_t chunk = bucket; rest > 0; chunk = m_following[chunk]) {
      const std::size_t length = m_rule.isCounted ? rest : std::min(rest, kChunk);
      if (rest > length) {
        const std::uint32_t* const next = m_numbers.data() + m_following[chunk] * kChunk;
        for (std::size_t i = 0; i < kChunk; i += 16) prefetchLine(next + i);
      }
      use(std::span<const std::uint32_t>(m_numbers.data() + chunk * kChunk, length));
      rest -= length;
    }
  }

 private:
  /// Pairs of a chunk: eight cache lines of numbers.
  static constexpr std::size_t kChunk = 128;

  template <bool kBySecond>
  void put(std::span<const Pair> pairs);
  template <bool kBySecond>
  void distribute(std::span<const Pair> pairs);
  template <bool kBySecond>
  void append(std::span<const Pair> pairs);
  std::size_t chunkAfter(std::size_t chunk);
  void makeRoom(std::size_t chunks);

  std::pmr::memory_resource* m_memory;
  PairOrder m_rule;          ///< Where it counts, there is one bucket, a list without chunks.
  std::size_t m_chunks = 0;  ///< Those in use; the first one of each bucket has the bucket's number.
  Buffer<std::uint32_t> m_numbers;
  Buffer<std::uint32_t> m_following;   ///< By chunk: the next one of its bucket.
  Buffer<std::size_t> m_next;          ///< By bucket: where its next pair goes.
  Buffer<std::uint32_t> m_fullChunks;  ///< By bucket.
};

}  // namespace allpairs::engine
