// SPDX-License-Identifier: MIT
#include "PairBuckets.h"

namespace allpairs::engine {

void PairBuckets::start(const BucketRule& rule) {
  m_keyBits = rule.keyBits;
  m_bySecond = rule.bySecond;
  m_chunks = rule.buckets;
  m_next.require(rule.buckets);
  m_fullChunks.require(rule.buckets);
  for (std::size_t bucket = 0; bucket < rule.buckets; ++bucket) {
    m_next[bucket] = bucket * kChunk;
    m_fullChunks[bucket] = 0;
  }
  // A few for each bucket, of which only what is used takes memory.
  makeRoom(4 * rule.buckets);
}

void PairBuckets::makeRoom(std::size_t chunks) {
  m_pairs.grow(chunks * kChunk);
  m_following.grow(chunks);
}

void PairBuckets::add(std::span<const Pair> pairs) { m_bySecond ? distribute<true>(pairs) : distribute<false>(pairs); }

template <bool kBySecond>
void PairBuckets::distribute(std::span<const Pair> pairs) {
  const unsigned shift = m_keyBits;
  std::size_t* const next = m_next.data();
  Pair* to = m_pairs.data();
  for (const Pair pair : pairs) {
    const std::size_t bucket = (kBySecond ? pair.second : pair.first) >> shift;
    const std::size_t place = next[bucket]++;
    to[place] = pair;
    if ((place + 1) % kChunk != 0) [[likely]] {
      continue;
    }
    ++m_fullChunks[bucket];
    next[bucket] = chunkAfter(place / kChunk) * kChunk;
    to = m_pairs.data();
  }
}

std::size_t PairBuckets::chunkAfter(std::size_t chunk) {
  const std::size_t fresh = m_chunks++;
  if (m_chunks * kChunk > m_pairs.capacity() || m_chunks > m_following.capacity()) makeRoom(m_chunks);
  m_following[chunk] = static_cast<std::uint32_t>(fresh);
  return fresh;
}

}  // namespace allpairs::engine
