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

/// The counts of so many boxes, and the places of their next pairs, stay in the second-level cache (dense_benchmark).
constexpr unsigned kCountedBits = 12;

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
void forEachNumber(const Bucket& bucket, const Use& use) {
  for (const PairBuckets& buckets : bucket.ofWorkers) {
    buckets.forEachChunk(bucket.number, [&](std::span<const std::uint32_t> numbers) {
      for (const std::uint32_t number : numbers) use(number);
    });
  }
}

/// Where the row of each key begins: in `next`, which has room for one more than the keys. Returns the length of the longest.
std::size_t measureRows(const Bucket& bucket, std::uint32_t* next) noexcept {
  const unsigned otherBits = bucket.rule.otherBits;
  std::fill_n(next, bucket.keys() + 1, 0U);
  std::uint32_t* const lengths = next + 1;  // Only sums stand before the length that is added next.
  forEachNumber(bucket, [=](std::uint32_t number) { ++lengths[number >> otherBits]; });
  const std::size_t longest = *std::max_element(lengths, lengths + bucket.keys());
  std::partial_sum(lengths, lengths + bucket.keys(), lengths);
  return longest;
}

/// Puts the pairs of a bucket into rows, one for each key; `next`, where they begin, then has where they end.
void putInRows(const Bucket& bucket, std::uint32_t* next, std::uint32_t* rows) noexcept {
  const unsigned otherBits = bucket.rule.otherBits;
  forEachNumber(bucket, [=](std::uint32_t number) { rows[next[number >> otherBits]++] = number; });
}

/// Scratch memory in which a bucket is counted: where the pairs of each key and of each other index begin, and the numbers.
struct Counts {
  std::uint32_t* beginOfKey;
  std::uint32_t* beginOfOther;
  std::uint32_t* numbers;

  Counts(const Bucket& bucket, std::uint32_t* scratch) noexcept
      : beginOfKey(scratch),
        beginOfOther(scratch + bucket.keys()),
        numbers(beginOfOther + (std::size_t{1} << bucket.rule.otherBits)) {}
};

/// Counts the pairs of each key and of each other index, and moves all pairs to where those of their other index begin.
void countPairs(const Bucket& bucket, const Counts& counts) noexcept {
  const unsigned otherBits = bucket.rule.otherBits;
  const std::uint32_t otherMask = (std::uint32_t{1} << otherBits) - 1;
  std::fill(counts.beginOfKey, counts.numbers, 0U);
  forEachNumber(bucket, [=](std::uint32_t number) {
    ++counts.beginOfKey[number >> otherBits];
    ++counts.beginOfOther[number & otherMask];
  });
  std::exclusive_scan(counts.beginOfKey, counts.beginOfOther, counts.beginOfKey, 0U);
  std::exclusive_scan(counts.beginOfOther, counts.numbers, counts.beginOfOther, 0U);
  forEachNumber(bucket,
                [=](std::uint32_t number) { counts.numbers[counts.beginOfOther[number & otherMask]++] = number; });
}

/// Calls write(place, number) for each number: the moves to where its key's row begins keep the order of the other index.
template <class Write>
void placeByKey(const Bucket& bucket, const Counts& counts, const Write& write) noexcept {
  const std::size_t size = bucket.size();
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t number = counts.numbers[i];
    write(counts.beginOfKey[number >> bucket.rule.otherBits]++, number);
  }
}

std::size_t scratchToCount(const Bucket& bucket) noexcept {
  return bucket.keys() + (std::size_t{1} << bucket.rule.otherBits) + bucket.size();
}

template <bool kBySecond>
void sortCounted(const Bucket& bucket, Pair* to, std::uint32_t* scratch) noexcept {
  const Counts counts(bucket, scratch);
  countPairs(bucket, counts);
  const unsigned otherBits = bucket.rule.otherBits;
  placeByKey(bucket, counts,
             [=](std::size_t place, std::uint32_t number) { to[place] = unpacked<kBySecond>(number, 0, otherBits); });
}

/// Sorts all numbers of a bucket, in two arrays for as many; returns which of them holds the result.
std::uint32_t* radixSortBucket(const Bucket& bucket, std::size_t size, std::uint32_t* from,
                               std::uint32_t* to) noexcept {
  std::uint32_t* next = from;
  forEachNumber(bucket, [&](std::uint32_t number) { *next++ = number; });
  return radixSort(from, to, size, 0, bucket.rule.keyBits + bucket.rule.otherBits);
}

/// The rows of a bucket in scratch memory, to be measured and filled: where each begins, and behind that their numbers. While
/// they are filled, where the next number of a key goes stands where the row of the following key will begin.
NumberRows emptyRows(const Bucket& bucket, std::span<std::uint32_t> scratch, std::size_t size) noexcept {
  scratch[0] = 0;
  return {scratch.data() + bucket.keys() + 2,
          size,
          scratch.data(),
          bucket.rule.otherBits,
          bucket.firstKey(),
          bucket.rule.bySecond};
}

std::size_t scratchFor(const Bucket& bucket, std::size_t size) noexcept {
  return bucket.keys() + 2 + size + kVectorSlack;
}

}  // namespace

PairOrder::PairOrder(std::size_t firsts, std::size_t seconds, Order order, std::size_t threads)
    : bySecond(order == Order::BySecond) {
  const std::size_t keys = std::max<std::size_t>(bySecond ? seconds : firsts, 1);
  const std::size_t others = std::max<std::size_t>(bySecond ? firsts : seconds, 1);
  isCounted = threads == 1 && std::max(keys, others) <= std::size_t{1} << kCountedBits;
  const auto bitsOf = [](std::size_t size) { return static_cast<unsigned>(std::bit_width(size - 1)); };
  allKeyBits = bitsOf(keys);
  keyBits = isCounted ? allKeyBits : std::max(kLeastKeyBits, bitsOf((keys - 1) / kMostBuckets + 1));
  buckets = ((keys - 1) >> keyBits) + 1;
  otherBits = bitsOf(others);
}

void sortBucket(const Bucket& bucket, std::span<Pair> place, std::span<std::uint32_t> scratch) noexcept {
  const PairOrder& rule = bucket.rule;
  if (rule.isCounted && scratchToCount(bucket) <= scratch.size()) {
    rule.bySecond ? sortCounted<true>(bucket, place.data(), scratch.data())
                  : sortCounted<false>(bucket, place.data(), scratch.data());
    return;
  }
  if (scratchFor(bucket, place.size()) <= scratch.size()) {
    const NumberRows rows = emptyRows(bucket, scratch, place.size());
    std::uint32_t* const next = scratch.data() + 1;
    if (measureRows(bucket, next) <= kLongestRow) {
      putInRows(bucket, next, rows.numbers);
      bucket.kernels.orderRows(rows, place.data());
      return;
    }
  }
  static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
  auto* const numbers = reinterpret_cast<std::uint32_t*>(place.data());
  const std::uint32_t* const sorted = radixSortBucket(bucket, place.size(), numbers + place.size(), numbers);
  rule.bySecond ? unpackAll<true>(sorted, bucket.firstKey(), rule.otherBits, place)
                : unpackAll<false>(sorted, bucket.firstKey(), rule.otherBits, place);
}

std::size_t scratchToSort(const Bucket& bucket) noexcept {
  const bool areFew = bucket.size() <= kLongestRow * bucket.keys();
  return bucket.rule.isCounted && areFew ? scratchToCount(bucket) : 0;
}

std::size_t scratchToList(const Bucket& bucket) noexcept {
  return std::max(scratchFor(bucket, bucket.size()), scratchToSort(bucket));
}

void listBucket(const Bucket& bucket, const NeighborsMemory& place, std::uint64_t before,
                std::span<std::uint32_t> scratch) noexcept {
  const std::size_t size = place.indices.size();
  const std::uint32_t otherMask = (std::uint32_t{1} << bucket.rule.otherBits) - 1;
  if (bucket.rule.isCounted && scratchToCount(bucket) <= scratch.size()) {
    const Counts counts(bucket, scratch.data());
    countPairs(bucket, counts);
    for (std::size_t key = 0; key < place.offsets.size(); ++key) place.offsets[key] = before + counts.beginOfKey[key];
    placeByKey(bucket, counts, [&](std::size_t to, std::uint32_t number) { place.indices[to] = number & otherMask; });
    return;
  }
  const NumberRows rows = emptyRows(bucket, scratch, size);
  std::uint32_t* const next = scratch.data() + 1;
  const std::size_t longest = measureRows(bucket, next);
  for (std::size_t key = 0; key < place.offsets.size(); ++key) place.offsets[key] = before + next[key];
  if (longest <= kLongestRow) {
    putInRows(bucket, next, rows.numbers);
    bucket.kernels.orderPartners(rows, place.indices.data());
    return;
  }
  const std::uint32_t* const sorted = radixSortBucket(bucket, size, rows.numbers, place.indices.data());
  std::transform(sorted, sorted + size, place.indices.data(), [=](std::uint32_t number) { return number & otherMask; });
}

void PairBuckets::start(const PairOrder& rule, std::size_t workers) {
  m_keyBits = rule.keyBits;
  m_otherBits = rule.otherBits;
  m_bySecond = rule.bySecond;
  m_isOne = rule.isCounted;
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

void PairBuckets::add(std::span<const Pair> pairs) { m_bySecond ? put<true>(pairs) : put<false>(pairs); }

void PairBuckets::addBothWays(std::span<const Pair> pairs) {
  put<false>(pairs);
  put<true>(pairs);
}

template <bool kBySecond>
void PairBuckets::put(std::span<const Pair> pairs) {
  m_isOne ? append<kBySecond>(pairs) : distribute<kBySecond>(pairs);
}

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

template <bool kBySecond>
void PairBuckets::append(std::span<const Pair> pairs) {
  const std::size_t size = m_next[0] + pairs.size();
  if (size > m_numbers.capacity()) m_numbers.grow(size);
  std::uint32_t* const to = m_numbers.data() + m_next[0];
  const unsigned otherBits = m_otherBits;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Pair pair = pairs[i];
    to[i] = kBySecond ? pair.second << otherBits | pair.first : pair.first << otherBits | pair.second;
  }
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
