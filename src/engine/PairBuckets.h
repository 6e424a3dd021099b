// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "BucketSort.h"
#include "Memory.h"
#include "allpairs/Pair.h"

namespace allpairs::engine {

/// Pairs in buckets of neighbouring keys, in the order in which they come: the first pass of a sort, made while they are
/// found, so that they need not be written and read once more.
///
/// A bucket is a chain of chunks from a common store, since nobody knows how many pairs it will have.
class PairBuckets {
 public:
  /// Starts anew; memory is kept.
  void start(const BucketRule& rule);

  void add(std::span<const Pair> pairs);

  [[nodiscard]] std::size_t size(std::size_t bucket) const noexcept {
    return m_fullChunks[bucket] * kChunk + m_next[bucket] % kChunk;
  }

  /// Calls take(span of pairs) for the parts of a bucket.
  template <class Take>
  void forEachPart(std::size_t bucket, Take&& take) const {
    std::size_t rest = size(bucket);
    for (std::size_t chunk = bucket; rest > 0; chunk = m_following[chunk]) {
      const std::size_t length = std::min(rest, kChunk);
      take(std::span<const Pair>(m_pairs.data() + chunk * kChunk, length));
      rest -= length;
    }
  }

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
