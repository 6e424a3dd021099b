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

/// Pairs of a key in a scene as most are.
constexpr std::size_t kPairsPerKey = 4;

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

/// Writes the pairs of a bucket as numbers of 32 bits: what their keys differ in above the other index.
template <bool kBySecond>
void packAll(const BucketRule& rule, std::size_t bucket, std::span<const PairBuckets> ofWorkers, std::uint32_t* to) {
  const std::uint32_t keyMask = (std::uint32_t{1} << rule.keyBits) - 1;
  const unsigned otherBits = rule.otherBits;
  for (const PairBuckets& buckets : ofWorkers) {
    buckets.forEachChunk(bucket, [&](std::span<const Pair> pairs) {
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const std::uint32_t key = kBySecond ? pairs[i].second : pairs[i].first;
        to[i] = (key & keyMask) << otherBits | (kBySecond ? pairs[i].first : pairs[i].second);
      }
      to += pairs.size();
    });
  }
}

template <bool kBySecond>
void sortBucketBy(const BucketRule& rule, std::size_t bucket, std::span<const PairBuckets> ofWorkers,
                  std::span<Pair> place, std::span<std::uint32_t> scratch) noexcept {
  static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
  const unsigned bits = rule.keyBits + rule.otherBits;
  const unsigned otherBits = rule.otherBits;
  const auto firstKey = static_cast<std::uint32_t>(bucket << rule.keyBits);
  const std::size_t size = place.size();
  if (2 * size > scratch.size()) {
    auto* const first = reinterpret_cast<std::uint32_t*>(place.data());
    packAll<kBySecond>(rule, bucket, ofWorkers, first + size);
    unpackAll<kBySecond>(radixSort(first + size, first, size, 0, bits), firstKey, otherBits, place);
    return;
  }
  std::uint32_t* numbers = scratch.data();
  std::uint32_t* others = scratch.data() + size;
  packAll<kBySecond>(rule, bucket, ofWorkers, numbers);
  const bool isWritten = radixSortTo(numbers, others, size, 0, bits, [=](std::size_t at, std::uint32_t number) {
    place[at] = unpacked<kBySecond>(number, firstKey, otherBits);
  });
  if (!isWritten) unpackAll<kBySecond>(numbers, firstKey, otherBits, place);
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

void sortBucket(const BucketRule& rule, std::size_t bucket, std::span<const PairBuckets> ofWorkers,
                std::span<Pair> place, std::span<std::uint32_t> scratch) noexcept {
  rule.bySecond ? sortBucketBy<true>(rule, bucket, ofWorkers, place, scratch)
                : sortBucketBy<false>(rule, bucket, ofWorkers, place, scratch);
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
  // Of the default memory only what is used is taken: room for dense scenes too, so that no pairs are copied to fresh pages.
  const std::size_t keys = rule.buckets << rule.keyBits;
  const bool isAmple = m_isDefaultMemory && keys <= kMostBuckets * kKeysPerBucket;
  const std::size_t likelyPairs = (isAmple ? 4 : 1) * kPairsPerKey * keys / workers;
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
    next[bucket] = place;  // If there is no memory for another chunk, the pair has not come.
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
