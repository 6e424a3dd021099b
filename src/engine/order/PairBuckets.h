// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"
#include "memory/Memory.h"

namespace allpairs::engine {

/// How pairs are divided into buckets of neighbouring keys. The key is the index by which they are ordered first.
struct BucketRule {
  unsigned keyBits = 0;  ///< Keys of a bucket differ in these low bits only.
  std::size_t buckets = 0;
  unsigned otherBits = 0;
  bool bySecond = false;

  BucketRule(std::size_t firsts, std::size_t seconds, Order order);

  /// Whether the low bits of a bucket's keys and the other index fit a number of 32 bits.
  [[nodiscard]] bool packs() const noexcept { return otherBits < 32 && keyBits + otherBits <= 32; }
};

/// Sorts the pairs of a bucket, which are stored as numbers of 32 bits in the second half of their place.
void sortBucket(const BucketRule& rule, std::size_t bucket, std::span<Pair> place) noexcept;

/// Pairs in buckets of neighbouring keys, in the order in which they are found: the first pass of a sort, done during
/// the search, so that pairs need not be written and read once more.
///
/// A bucket is a chain of chunks from a common store, since its size is not known in advance.
class PairBuckets {
 public:
  explicit PairBuckets(std::pmr::memory_resource* memory)
      : m_pairs(memory), m_following(memory), m_next(memory), m_fullChunks(memory) {}

  /// Clears all buckets, and keeps their memory. `workers` is the number of workers.
  void start(const BucketRule& rule, std::size_t workers);

  void add(std::span<const Pair> pairs);

  [[nodiscard]] std::size_t size(std::size_t bucket) const noexcept {
    return m_fullChunks[bucket] * kChunk + m_next[bucket] % kChunk;
  }

  /// Writes the pairs of a bucket as numbers of 32 bits, the low bits of the key above the other index; returns the
  /// end.
  std::uint32_t* pack(const BucketRule& rule, std::size_t bucket, std::uint32_t* to) const noexcept;

 private:
  static constexpr std::size_t kChunk = 128;

  template <bool kBySecond>
  void distribute(std::span<const Pair> pairs);
  std::size_t chunkAfter(std::size_t chunk);
  void makeRoom(std::size_t chunks);

  unsigned m_keyBits = 0;
  bool m_bySecond = false;
  std::size_t m_chunks = 0;  ///< Those in use; the first one of each bucket has the bucket's number.
  Buffer<Pair> m_pairs;
  Buffer<std::uint32_t> m_following;   ///< By chunk: the next one of its bucket.
  Buffer<std::size_t> m_next;          ///< By bucket: where its next pair goes.
  Buffer<std::uint32_t> m_fullChunks;  ///< By bucket.
};

}  // namespace allpairs::engine
