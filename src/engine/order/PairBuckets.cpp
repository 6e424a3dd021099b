// SPDX-License-Identifier: MIT
#include "order/PairBuckets.h"

#include <bit>

#include "bvh/RadixSort.h"

namespace allpairs::engine {
namespace {

/// Keys of a bucket: its numbers, two to six pairs a key, there and back, then fit the first-level cache
/// (docs/decisions/0019).
constexpr std::size_t kKeysPerBucket = 512;

/// Pairs are written to all buckets in turn: the places where the next ones go stay in the second-level cache.
constexpr std::size_t kMostBuckets = 2048;

/// Pairs per key in a typical scene.
constexpr std::size_t kPairsPerKey = 4;

/// The pairs of a bucket as numbers of 32 bits; returns their end.
template <bool kBySecond>
std::uint32_t* packAll(const Pair* pairs, std::size_t size, std::uint32_t keyMask, unsigned otherBits,
                       std::uint32_t* to) noexcept {
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t key = kBySecond ? pairs[i].second : pairs[i].first;
    to[i] = (key & keyMask) << otherBits | (kBySecond ? pairs[i].first : pairs[i].second);
  }
  return to + size;
}

template <bool kBySecond>
Pair unpacked(std::uint32_t number, std::uint32_t firstKey, unsigned otherBits) noexcept {
  const std::uint32_t key = firstKey + (number >> otherBits);
  const std::uint32_t other = number & ((std::uint32_t{1} << otherBits) - 1);
  return kBySecond ? Pair{other, key} : Pair{key, other};
}

/// Writes numbers as pairs where they and others have been that were read before: from the end if they begin the place.
template <bool kBySecond>
void unpackAll(const std::uint32_t* numbers, std::uint32_t firstKey, unsigned otherBits,
               std::span<Pair> place) noexcept {
  if (static_cast<const void*>(numbers) == place.data()) {
    for (std::size_t i = place.size(); i > 0; --i) {
      place[i - 1] = unpacked<kBySecond>(numbers[i - 1], firstKey, otherBits);
    }
  } else {
    for (std::size_t i = 0; i < place.size(); ++i) place[i] = unpacked<kBySecond>(numbers[i], firstKey, otherBits);
  }
}

}  // namespace

BucketRule::BucketRule(std::size_t firsts, std::size_t seconds, Order order) : bySecond(order == Order::BySecond) {
  const std::size_t keys = bySecond ? seconds : firsts;
  const std::size_t others = bySecond ? firsts : seconds;
  const std::size_t wanted = std::clamp<std::size_t>(keys / kKeysPerBucket, 1, kMostBuckets);
  keyBits = static_cast<unsigned>(std::bit_width((keys - 1) / wanted));
  buckets = ((keys - 1) >> keyBits) + 1;
  otherBits = static_cast<unsigned>(std::bit_width(others - 1));
}

std::uint32_t* PairBuckets::pack(const BucketRule& rule, std::size_t bucket, std::uint32_t* to) const noexcept {
  const std::uint32_t keyMask = (std::uint32_t{1} << rule.keyBits) - 1;
  std::size_t rest = size(bucket);
  for (std::size_t chunk = bucket; rest > 0; chunk = m_following[chunk]) {
    const std::size_t length = std::min(rest, kChunk);
    const Pair* const pairs = m_pairs.data() + chunk * kChunk;
    to = rule.bySecond ? packAll<true>(pairs, length, keyMask, rule.otherBits, to)
                       : packAll<false>(pairs, length, keyMask, rule.otherBits, to);
    rest -= length;
  }
  return to;
}

void sortBucket(const BucketRule& rule, std::size_t bucket, std::span<Pair> place) noexcept {
  static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
  const std::size_t size = place.size();
  auto* const first = reinterpret_cast<std::uint32_t*>(place.data());
  const std::uint32_t* const sorted = radixSort(first + size, first, size, 0, rule.keyBits + rule.otherBits);
  const auto firstKey = static_cast<std::uint32_t>(bucket << rule.keyBits);
  rule.bySecond ? unpackAll<true>(sorted, firstKey, rule.otherBits, place)
                : unpackAll<false>(sorted, firstKey, rule.otherBits, place);
}

void PairBuckets::start(const BucketRule& rule, std::size_t workers) {
  m_keyBits = rule.keyBits;
  m_bySecond = rule.bySecond;
  m_chunks = rule.buckets;
  m_next.require(rule.buckets);
  m_fullChunks.require(rule.buckets);
  for (std::size_t bucket = 0; bucket < rule.buckets; ++bucket) {
    m_next[bucket] = bucket * kChunk;
    m_fullChunks[bucket] = 0;
  }
  // Only the used part of this address space takes memory.
  const std::size_t likelyPairs = kPairsPerKey * (rule.buckets << rule.keyBits) / workers;
  makeRoom(2 * rule.buckets + likelyPairs / kChunk);
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
    next[bucket] = place;  // If allocating a chunk throws, the pair is not counted.
    next[bucket] = chunkAfter(place / kChunk) * kChunk;
    ++m_fullChunks[bucket];
    to = m_pairs.data();
  }
}

std::size_t PairBuckets::chunkAfter(std::size_t chunk) {
  const std::size_t fresh = m_chunks;
  if ((fresh + 1) * kChunk > m_pairs.capacity() || fresh + 1 > m_following.capacity()) makeRoom(fresh + 1);
  ++m_chunks;
  m_following[chunk] = static_cast<std::uint32_t>(fresh);
  return fresh;
}

}  // namespace allpairs::engine
