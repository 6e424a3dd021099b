// SPDX-License-Identifier: MIT
#include "order/PairBuckets.h"

#include <bit>
#include <numeric>

#include "bvh/RadixSort.h"

namespace allpairs::engine {
namespace {

/// Keys of a bucket, 256: the places of their rows, and two to twenty pairs a key, then fit the first-level cache and the
/// scratch memory (dense_benchmark).
constexpr unsigned kLeastKeyBits = 8;

/// Pairs are written to all buckets in turn: the places where the next ones go stay in the second-level cache.
constexpr std::size_t kMostBuckets = 4096;

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

/// A row of more pairs than this is not ordered by ranks, which compares each with all of them
/// (dense_benchmark).
constexpr std::size_t kLongestRow = 64;

/// All numbers of a bucket.
template <class Use>
void forEachNumber(std::size_t bucket, std::span<const PairBuckets> ofWorkers, const Use& use) {
  for (const PairBuckets& buckets : ofWorkers) {
    buckets.forEachChunk(bucket, [&](std::span<const std::uint32_t> numbers) {
      for (const std::uint32_t number : numbers) use(number);
    });
  }
}

/// Puts the pairs of a bucket into rows, one for each key. `begin` has room for two more than the keys, and has where each row
/// begins at the end. Returns the length of the longest, and writes no rows if that is too long.
std::size_t putInRows(const BucketRule& rule, std::size_t bucket, std::span<const PairBuckets> ofWorkers,
                      std::uint32_t* begin, std::uint32_t* rows) noexcept {
  const unsigned otherBits = rule.otherBits;
  const std::size_t keys = std::size_t{1} << rule.keyBits;
  std::fill_n(begin, keys + 2, 0U);
  std::uint32_t* const lengths = begin + 2;  // Only sums stand before the length that is added next.
  forEachNumber(bucket, ofWorkers, [=](std::uint32_t number) { ++lengths[number >> otherBits]; });
  const std::size_t longest = *std::max_element(lengths, lengths + keys);
  if (longest > kLongestRow) return longest;
  std::partial_sum(lengths, lengths + keys, lengths);
  std::uint32_t* const next = begin + 1;
  forEachNumber(bucket, ofWorkers, [=](std::uint32_t number) { rows[next[number >> otherBits]++] = number; });
  return longest;
}

template <bool kBySecond>
void radixSortBucket(const BucketRule& rule, std::size_t bucket, std::span<const PairBuckets> ofWorkers,
                     std::span<Pair> place) noexcept {
  static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
  const std::size_t size = place.size();
  auto* const first = reinterpret_cast<std::uint32_t*>(place.data());
  std::uint32_t* to = first + size;
  forEachNumber(bucket, ofWorkers, [&](std::uint32_t number) { *to++ = number; });
  unpackAll<kBySecond>(radixSort(first + size, first, size, 0, rule.keyBits + rule.otherBits),
                       static_cast<std::uint32_t>(bucket << rule.keyBits), rule.otherBits, place);
}

}  // namespace

BucketRule::BucketRule(std::size_t firsts, std::size_t seconds, Order order) : bySecond(order == Order::BySecond) {
  const std::size_t keys = bySecond ? seconds : firsts;
  const std::size_t others = bySecond ? firsts : seconds;
  keyBits = std::max(kLeastKeyBits, static_cast<unsigned>(std::bit_width((keys - 1) / kMostBuckets)));
  buckets = ((keys - 1) >> keyBits) + 1;
  otherBits = static_cast<unsigned>(std::bit_width(others - 1));
}

void sortBucket(const BucketRule& rule, std::size_t bucket, std::span<const PairBuckets> ofWorkers,
                std::span<Pair> place, std::span<std::uint32_t> scratch, const Kernels& kernels) noexcept {
  const std::size_t keys = std::size_t{1} << rule.keyBits;
  if (keys + 2 + place.size() + kVectorSlack <= scratch.size()) {
    std::uint32_t* const begin = scratch.data();
    std::uint32_t* const rows = begin + keys + 2;
    if (putInRows(rule, bucket, ofWorkers, begin, rows) <= kLongestRow) {
      const auto firstKey = static_cast<std::uint32_t>(bucket << rule.keyBits);
      kernels.orderRows({rows, place.size(), begin, rule.otherBits, firstKey, rule.bySecond}, place.data());
      return;
    }
  }
  rule.bySecond ? radixSortBucket<true>(rule, bucket, ofWorkers, place)
                : radixSortBucket<false>(rule, bucket, ofWorkers, place);
}

void PairBuckets::start(const BucketRule& rule, std::size_t workers) {
  m_keyBits = rule.keyBits;
  m_otherBits = rule.otherBits;
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
  const bool isAmple = m_isDefaultMemory && keys <= kMostBuckets << kLeastKeyBits;
  const std::size_t likelyPairs = (isAmple ? 4 : 1) * kLikelyPairs * keys / workers;
  const std::size_t chunks = 2 * rule.buckets + likelyPairs / kChunk;
  m_numbers.require(chunks * kChunk);
  m_following.require(chunks);
}

void PairBuckets::makeRoom(std::size_t chunks) {
  m_numbers.grow(chunks * kChunk);
  m_following.grow(chunks);
}

void PairBuckets::add(std::span<const Pair> pairs) { m_bySecond ? distribute<true>(pairs) : distribute<false>(pairs); }

template <bool kBySecond>
void PairBuckets::distribute(std::span<const Pair> pairs) {
  const unsigned shift = m_keyBits;
  const unsigned otherBits = m_otherBits;
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

std::size_t PairBuckets::chunkAfter(std::size_t chunk) {
  const std::size_t fresh = m_chunks;
  if ((fresh + 1) * kChunk > m_numbers.capacity() || fresh + 1 > m_following.capacity()) makeRoom(fresh + 1);
  ++m_chunks;
  m_following[chunk] = static_cast<std::uint32_t>(fresh);
  return fresh;
}

}  // namespace allpairs::engine
