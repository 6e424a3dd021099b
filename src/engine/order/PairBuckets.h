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

/// How pairs are cut into buckets of neighbouring keys. The key is the index that they are ordered by first.
struct BucketRule {
  unsigned keyBits = 0;  ///< Keys of a bucket differ in these low bits only.
  std::size_t buckets = 0;
  unsigned otherBits = 0;
  bool bySecond = false;

  BucketRule(std::size_t firsts, std::size_t seconds, Order order);

  /// Whether what the keys of a bucket differ in and the other index make a number of 32 bits.
  [[nodiscard]] bool packs() const noexcept { return otherBits < 32 && keyBits + otherBits <= 32; }
};

/// Pairs in buckets of neighbouring keys, in the order in which they come: the first pass of a sort, made while they are
/// found, so that they need not be written and read once more.
///
/// A bucket is a chain of chunks from a common store, since nobody knows how many pairs it will have.
class PairBuckets {
 public:
  explicit PairBuckets(std::pmr::memory_resource* memory)
      : m_isDefaultMemory(memory == defaultMemory()),
        m_pairs(memory),
        m_following(memory),
        m_next(memory),
        m_fullChunks(memory) {}

  /// Empties all buckets for a search with so many workers; memory is kept.
  void start(const BucketRule& rule, std::size_t workers);

  void add(std::span<const Pair> pairs);

  [[nodiscard]] std::size_t size(std::size_t bucket) const noexcept {
    return m_fullChunks[bucket] * kChunk + m_next[bucket] % kChunk;
  }

  /// Calls use(pairs) for each stretch of pairs of a bucket.
  template <class Use>
  void forEachChunk(std::size_t bucket, const Use& use) const {
    std::size_t rest = size(bucket);
    for (std::size_t chunk = bucket; rest > 0; chunk = m_following[chunk]) {
      const std::size_t length = std::min(rest, kChunk);
      use(std::span(m_pairs.data() + chunk * kChunk, length));
      rest -= length;
    }
  }

 private:
  static constexpr std::size_t kChunk = 128;

  template <bool kBySecond>
  void distribute(std::span<const Pair> pairs);
  std::size_t chunkAfter(std::size_t chunk);
  void makeRoom(std::size_t chunks);

  bool m_isDefaultMemory;
  unsigned m_keyBits = 0;
  bool m_bySecond = false;
  std::size_t m_chunks = 0;  ///< Those in use; the first one of each bucket has the bucket's number.
  Buffer<Pair> m_pairs;
  Buffer<std::uint32_t> m_following;   ///< By chunk: the next one of its bucket.
  Buffer<std::size_t> m_next;          ///< By bucket: where its next pair goes.
  Buffer<std::uint32_t> m_fullChunks;  ///< By bucket.
};

/// Puts the pairs of a bucket, which each worker has some of, in order into their place in the result. Where they fit twice
/// into the scratch memory as numbers of 32 bits, they are sorted there and written as pairs in the last pass.
void sortBucket(const BucketRule& rule, std::size_t bucket, std::span<const PairBuckets> ofWorkers,
                std::span<Pair> place, std::span<std::uint32_t> scratch) noexcept;

}  // namespace allpairs::engine
