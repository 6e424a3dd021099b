// SPDX-License-Identifier: MIT
#include "order/PairSort.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "input/Parts.h"

namespace allpairs::engine {
namespace {

/// The pairs of a bucket, which each worker has some of.
struct Bucket {
  const PairOrder& rule;
  std::size_t number;
  std::span<const PairBuckets> ofWorkers;

  [[nodiscard]] std::size_t size() const noexcept {
    std::size_t size = 0;
    for (const PairBuckets& buckets : ofWorkers) size += buckets.size(number);
    return size;
  }
  [[nodiscard]] std::size_t keys() const noexcept { return std::size_t{1} << rule.keyBits; }
  [[nodiscard]] std::uint32_t firstKey() const noexcept { return static_cast<std::uint32_t>(number << rule.keyBits); }
};

/// Writes numbers as pairs where they and others have been that were read before: from the end if they begin the place.
template <bool kBySecond>
void unpackAll(const std::uint32_t* numbers, std::uint32_t firstKey, unsigned otherBits,
               std::span<Pair> place) noexcept {
  if (static_cast<const void*>(numbers) == place.data()) {
    for (std::size_t i = place.size(); i > 0; --i) {
      place[i - 1] = unpacked<kBySecond>(numbers[i - 1], otherBits, firstKey);
    }
  } else {
    for (std::size_t i = 0; i < place.size(); ++i) place[i] = unpacked<kBySecond>(numbers[i], otherBits, firstKey);
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

/// Where the row of each key begins: in `next`, which has room for one more than the keys. Returns the length of the
/// longest.
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

/// Calls begin(rows) with where the row of each key begins, and then write(place, number) for each number. Counts the
/// pairs of each key and of each other index, and moves all pairs to where those of their other index begin: the moves
/// to their key's row keep that order.
template <class Begin, class Write>
void placeCounted(const Bucket& bucket, std::uint32_t* scratch, const Begin& begin, const Write& write) noexcept {
  const unsigned otherBits = bucket.rule.otherBits;
  const std::size_t others = std::size_t{1} << otherBits;
  const auto otherMask = static_cast<std::uint32_t>(others - 1);
  std::uint32_t* const nextOfKey = scratch;
  std::uint32_t* const nextOfOther = nextOfKey + bucket.keys();
  std::uint32_t* const numbers = nextOfOther + others;
  std::fill(nextOfKey, numbers, 0U);
  forEachNumber(bucket, [=](std::uint32_t number) {
    ++nextOfKey[number >> otherBits];
    ++nextOfOther[number & otherMask];
  });
  std::exclusive_scan(nextOfKey, nextOfOther, nextOfKey, 0U);
  std::exclusive_scan(nextOfOther, numbers, nextOfOther, 0U);
  forEachNumber(bucket, [=](std::uint32_t number) { numbers[nextOfOther[number & otherMask]++] = number; });
  begin(nextOfKey);
  const std::size_t size = bucket.size();
  for (std::size_t i = 0; i < size; ++i) write(nextOfKey[numbers[i] >> otherBits]++, numbers[i]);
}

std::size_t scratchToCount(const Bucket& bucket) noexcept {
  return bucket.keys() + (std::size_t{1} << bucket.rule.otherBits) + bucket.size();
}

template <bool kBySecond>
void sortCounted(const Bucket& bucket, Pair* to, std::uint32_t* scratch) noexcept {
  const unsigned otherBits = bucket.rule.otherBits;
  placeCounted(
      bucket, scratch, [](const std::uint32_t*) {},
      [=](std::size_t place, std::uint32_t number) { to[place] = unpacked<kBySecond>(number, otherBits); });
}

/// Sorts all numbers of a bucket, in two arrays for as many; returns which of them holds the result.
std::uint32_t* radixSortBucket(const Bucket& bucket, std::size_t size, std::uint32_t* from,
                               std::uint32_t* to) noexcept {
  std::uint32_t* next = from;
  forEachNumber(bucket, [&](std::uint32_t number) { *next++ = number; });
  return radixSort(from, to, size, 0, bucket.rule.keyBits + bucket.rule.otherBits);
}

/// The rows of a bucket in scratch memory, to be measured and filled: where each begins, and behind that their numbers.
/// While they are filled, where the next number of a key goes stands where the row of the following key will begin.
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

template <bool kBySecond>
void sortListBy(std::span<Pair> pairs, Pair* spare, const PairOrder& order, RadixSort& radix, Executor& executor) {
  static_assert(sizeof(Pair) == sizeof(std::uint64_t));
  const unsigned otherBits = order.otherBits;
  runInParts(pairs.size(), kPartSize, executor, [=](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      spare[i] = std::bit_cast<Pair>(packed<kBySecond, std::uint64_t>(pairs[i], otherBits));
  });
  radix.sort(reinterpret_cast<std::uint64_t*>(spare), reinterpret_cast<std::uint64_t*>(pairs.data()), pairs.size(), 0,
             otherBits + order.allKeyBits, executor);
  runInParts(pairs.size(), kPartSize, executor, [=](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      pairs[i] = unpacked<kBySecond>(std::bit_cast<std::uint64_t>(pairs[i]), otherBits);
  });
}

}  // namespace

void PairSort::start(const PairOrder& order, std::size_t workers, const Kernels& kernels) {
  m_order = order;
  m_kernels = &kernels;
  while (m_ofWorkers.size() < workers) m_ofWorkers.emplace_back(m_places.get_allocator().resource());
  for (PairBuckets& buckets : m_ofWorkers) buckets.start(order, m_ofWorkers.size());
}

std::size_t PairSort::finish() {
  m_places.resize(m_order.buckets + 1);
  m_places[0] = 0;
  for (std::size_t b = 0; b < m_order.buckets; ++b) {
    m_places[b + 1] = m_places[b] + Bucket{m_order, b, m_ofWorkers}.size();
  }
  return m_places.back();
}

std::size_t PairSort::scratchToSort(std::size_t bucket) const noexcept {
  const Bucket pairs{m_order, bucket, m_ofWorkers};
  const bool areFew = pairs.size() <= kLongestRow * pairs.keys();
  return m_order.isCounted && areFew ? scratchToCount(pairs) : 0;
}

std::size_t PairSort::scratchToList(std::size_t bucket) const noexcept {
  const Bucket pairs{m_order, bucket, m_ofWorkers};
  return std::max(scratchFor(pairs, pairs.size()), scratchToSort(bucket));
}

void PairSort::sort(std::size_t bucket, std::span<Pair> to, std::span<std::uint32_t> scratch) const noexcept {
  const Bucket pairs{m_order, bucket, m_ofWorkers};
  const bool bySecond = m_order.bySecond;
  const std::span<Pair> place = to.subspan(m_places[bucket], m_places[bucket + 1] - m_places[bucket]);
  if (m_order.isCounted && scratchToCount(pairs) <= scratch.size()) {
    bySecond ? sortCounted<true>(pairs, place.data(), scratch.data())
             : sortCounted<false>(pairs, place.data(), scratch.data());
    return;
  }
  if (scratchFor(pairs, place.size()) <= scratch.size()) {
    const NumberRows rows = emptyRows(pairs, scratch, place.size());
    std::uint32_t* const next = scratch.data() + 1;
    if (measureRows(pairs, next) <= kLongestRow) {
      putInRows(pairs, next, rows.numbers);
      m_kernels->orderRows(rows, place.data());
      return;
    }
  }
  static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
  auto* const numbers = reinterpret_cast<std::uint32_t*>(place.data());
  const std::uint32_t* const sorted = radixSortBucket(pairs, place.size(), numbers + place.size(), numbers);
  bySecond ? unpackAll<true>(sorted, pairs.firstKey(), m_order.otherBits, place)
           : unpackAll<false>(sorted, pairs.firstKey(), m_order.otherBits, place);
}

void PairSort::list(std::size_t bucket, const NeighborsMemory& to, std::span<std::uint32_t> scratch) const noexcept {
  const Bucket pairs{m_order, bucket, m_ofWorkers};
  const std::size_t before = m_places[bucket];
  const std::size_t size = m_places[bucket + 1] - before;
  const std::size_t keys = std::min(pairs.keys(), to.offsets.size() - 1 - pairs.firstKey());
  std::uint64_t* const offsets = to.offsets.data() + pairs.firstKey();
  std::uint32_t* const indices = to.indices.data() + before;
  const std::uint32_t otherMask = (std::uint32_t{1} << m_order.otherBits) - 1;
  if (m_order.isCounted && scratchToCount(pairs) <= scratch.size()) {
    placeCounted(
        pairs, scratch.data(),
        [=](const std::uint32_t* rows) {
          std::transform(rows, rows + keys, offsets, [=](auto at) { return before + at; });
        },
        [=](std::size_t place, std::uint32_t number) { indices[place] = number & otherMask; });
    return;
  }
  const NumberRows rows = emptyRows(pairs, scratch, size);
  std::uint32_t* const next = scratch.data() + 1;
  const std::size_t longest = measureRows(pairs, next);
  for (std::size_t key = 0; key < keys; ++key) offsets[key] = before + next[key];
  if (longest <= kLongestRow) {
    putInRows(pairs, next, rows.numbers);
    m_kernels->orderPartners(rows, indices);
    return;
  }
  const std::uint32_t* const sorted = radixSortBucket(pairs, size, rows.numbers, indices);
  std::transform(sorted, sorted + size, indices, [=](std::uint32_t number) { return number & otherMask; });
}

void PairSort::sortList(std::span<Pair> pairs, const PairOrder& order, std::span<Pair> spare, Executor& executor) {
  if (pairs.size() < 2) return;
  if (spare.size() < pairs.size()) m_spare.require(pairs.size());
  Pair* const other = spare.size() < pairs.size() ? m_spare.data() : spare.data();
  order.bySecond ? sortListBy<true>(pairs, other, order, m_radix, executor)
                 : sortListBy<false>(pairs, other, order, m_radix, executor);
}

}  // namespace allpairs::engine
