// SPDX-License-Identifier: MIT
#include "order/PairBuckets.h"

#include <bit>

namespace allpairs::engine {
namespace {

/// Keys of a bucket, 256: the places of their rows, and two to twenty pairs a key, then fit the first-level cache and
/// the scratch memory (dense_benchmark).
constexpr unsigned kLeastKeyBits = 8;

/// Buckets at most, and boxes whose pairs are counted: where the next pair of each goes stays in the second-level cache
/// (dense_benchmark).
constexpr std::size_t kMostBuckets = 4096;

}  // namespace

PairOrder::PairOrder(std::size_t firsts, std::size_t seconds, Order order, std::size_t threads)
    : bySecond(order == Order::BySecond) {
  const std::size_t keys = std::max<std::size_t>(bySecond ? seconds : firsts, 1);
  const std::size_t others = std::max<std::size_t>(bySecond ? firsts : seconds, 1);
  isCounted = threads == 1 && std::max(keys, others) <= kMostBuckets;
  const auto bitsOf = [](std::size_t size) { return static_cast<unsigned>(std::bit_width(size - 1)); };
  allKeyBits = bitsOf(keys);
  keyBits = isCounted ? allKeyBits : std::max(kLeastKeyBits, bitsOf((keys - 1) / kMostBuckets + 1));
  buckets = ((keys - 1) >> keyBits) + 1;
  otherBits = bitsOf(others);
}

void PairBuckets::start(const PairOrder& rule, std::size_t workers) {
  m_rule = rule;
  m_chunks = rule.buckets;
  m_next.require(rule.buckets);
  m_fullChunks.require(rule.buckets);
  for (std::size_t bucket = 0; bucket < rule.buckets; ++bucket) {
    m_next[bucket] = bucket * kChunk;
    m_fullChunks[bucket] = 0;
  }
  // Of the default memory only what is used is taken: room for dense scenes too, so that no pairs are copied to fresh
  // pages.
  const std::size_t keys = rule.buckets << rule.keyBits;
  const bool isRoomy = m_memory == defaultMemory() && keys <= kMostBuckets << kLeastKeyBits;
  const std::size_t pairs = (isAmple(m_memory, keys) ? 16 : isRoomy ? 4 : 1) * kLikelyPairs * keys / workers;
  const std::size_t chunks = 2 * rule.buckets + pairs / kChunk;
  m_numbers.require(chunks * kChunk);
  m_following.require(chunks);
}

void PairBuckets::makeRoom(std::size_t chunks) {
  m_numbers.grow(chunks * kChunk);
  m_following.grow(chunks);
}

void PairBuckets::add(std::span<const Pair> pairs) { m_rule.bySecond ? put<true>(pairs) : put<false>(pairs); }

void PairBuckets::addBothWays(std::span<const Pair> pairs) {
  put<false>(pairs);
  put<true>(pairs);
}

template <bool kBySecond>
void PairBuckets::put(std::span<const Pair> pairs) {
  m_rule.isCounted ? append<kBySecond>(pairs) : distribute<kBySecond>(pairs);
}

template <bool kBySecond>
void PairBuckets::distribute(std::span<const Pair> pairs) {
  const unsigned shift = m_rule.keyBits;
  const unsigned otherBits = m_rule.otherBits;
  const std::uint32_t keyMask = (std::uint32_t{1} << shift) - 1;
  std::size_t* const next = m_next.data();
  std::uint32_t* to = m_numbers.data();
  for (const Pair pair : pairs) {
    const std::uint32_t key = kBySecond ? pair.second : pair.first;
    const std::size_t bucket = key >> shift;
    const std::size_t place = next[bucket]++;
    to[place] = (key & keyMask) << otherBits | (kBySecond ? pair.first : pair.second);
    if ((place + 1) % kChunk != 0) [[likely]] {
      continue;
    }
    next[bucket] = place;  // If there is no memory for another chunk, the pair has not come.
    next[bucket] = chunkAfter(place / kChunk) * kChunk;
    ++m_fullChunks[bucket];
    to = m_numbers.data();
  }
}

template <bool kBySecond>
void PairBuckets::append(std::span<const Pair> pairs) {
  const std::size_t size = m_next[0] + pairs.size();
  if (size > m_numbers.capacity()) m_numbers.grow(size);
  std::uint32_t* const to = m_numbers.data() + m_next[0];
  const unsigned otherBits = m_rule.otherBits;
  for (std::size_t i = 0; i < pairs.size(); ++i) to[i] = packed<kBySecond, std::uint32_t>(pairs[i], otherBits);
  m_next[0] = size;
}

std::size_t PairBuckets::chunkAfter(std::size_t chunk) {
  const std::size_t fresh = m_chunks;
  if ((fresh + 1) * kChunk > m_numbers.capacity() || fresh + 1 > m_following.capacity()) makeRoom(fresh + 1);
  ++m_chunks;
  m_following[chunk] = static_cast<std::uint32_t>(fresh);
  return fresh;
}

}  // namespace allpairs::engine
