// SPDX-License-Identifier: MIT
#include "PairSort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

#include "BucketSort.h"

namespace allpairs::engine {
namespace {

/// Pairs that a bucket should hold, so that sorting it stays in the first-level cache.
constexpr std::size_t kPairsPerBucket = 4096;

/// With fewer buckets, neighbouring pairs would often go to the same one and wait for its counter.
constexpr std::size_t kMinBuckets = 256;

/// Up to this many indices there are counters for all of them in the second-level cache, if they are worth clearing.
constexpr std::size_t kMostCounters = std::size_t{1} << 17;
constexpr std::size_t kCountersPerPair = 8;

constexpr std::size_t kMinChunk = std::size_t{1} << 15;

/// Bits of a digit, and so how many keys share a bucket at most.
constexpr unsigned kMaxPairDigitBits = 11;

/// Digits of an index of 32 bits.
constexpr unsigned kMaxPairPasses = 3;

using PairPlaces = std::array<std::uint32_t, std::size_t{1} << kMaxPairDigitBits>;

template <bool kSecond>
std::uint32_t indexOf(Pair pair) {
  return kSecond ? pair.second : pair.first;
}

/// The digits of one of the two indices, from the lowest up.
struct PairDigits {
  unsigned passes = 0;
  unsigned bits = 0;
  std::uint32_t mask = 0;
};

/// As few digits for the low `bits` bits as there can be, all of the same length.
PairDigits digitsFor(unsigned bits) {
  PairDigits digits;
  digits.passes = (bits + kMaxPairDigitBits - 1) / kMaxPairDigitBits;
  digits.bits = digits.passes == 0 ? 0 : (bits + digits.passes - 1) / digits.passes;
  digits.mask = (1U << digits.bits) - 1;
  return digits;
}

template <bool kSecond>
void countDigits(const Pair* pairs, std::size_t size, const PairDigits& digits,
                 std::array<PairPlaces, kMaxPairPasses>& places) {
  for (unsigned pass = 0; pass < digits.passes; ++pass) {
    std::fill_n(places[pass].begin(), std::size_t{digits.mask} + 1, 0U);
    const unsigned shift = pass * digits.bits;
    for (std::size_t i = 0; i < size; ++i) ++places[pass][(indexOf<kSecond>(pairs[i]) >> shift) & digits.mask];
    placesOf(places[pass].data(), std::size_t{digits.mask} + 1);
  }
}

/// Sorts by the digits of one index, back and forth between the two buffers; returns where the result is.
template <bool kSecond>
std::pair<Pair*, Pair*> sortByDigits(Pair* from, Pair* to, std::size_t size, const PairDigits& digits) {
  std::array<PairPlaces, kMaxPairPasses> places;
  countDigits<kSecond>(from, size, digits, places);
  for (unsigned pass = 0; pass < digits.passes; ++pass) {
    const unsigned shift = pass * digits.bits;
    const std::uint32_t mask = digits.mask;
    std::uint32_t* next = places[pass].data();
    for (std::size_t i = 0; i < size; ++i) {
      const Pair pair = from[i];
      to[next[(indexOf<kSecond>(pair) >> shift) & mask]++] = pair;
    }
    std::swap(from, to);
  }
  return {from, to};
}

/// Sorts the pairs of one bucket from `from` into `to`; `from` is lost.
template <bool kBySecond>
void sortBucket(const BucketRule& rule, Pair* from, Pair* to, std::size_t size) {
  if (size <= kMostInNetwork || size > std::numeric_limits<std::uint32_t>::max()) {
    std::copy_n(from, size, to);
    std::sort(to, to + size, [&](Pair a, Pair b) { return rule.rankOf(a) < rule.rankOf(b); });
    return;
  }
  if (rule.packs()) {
    BucketSort sort(rule, {to, size});
    sort.add({from, size});
    sort.finish();
    return;
  }
  const auto byOther = sortByDigits<!kBySecond>(from, to, size, digitsFor(rule.otherBits));
  const auto byBoth = sortByDigits<kBySecond>(byOther.first, byOther.second, size, digitsFor(rule.keyBits));
  if (byBoth.first != to) std::copy_n(byBoth.first, size, to);
}

}  // namespace

template <bool kBySecond>
void PairSort::scatter(const Pair* from, Pair* to, std::size_t size, Executor& executor) {
  if (m_buckets == 1) {
    std::copy_n(from, size, to);
    m_bucketBegin.assign({0, size});
    return;
  }
  const std::size_t most = executor.concurrency() == 1 ? 1 : 4 * executor.concurrency();
  const std::size_t chunks = std::clamp<std::size_t>(std::min(most, size / kMinChunk), 1, 256);
  if (m_places.size() != chunks) m_places.resize(chunks);
  executor.run(chunks, [&](std::size_t c) {
    m_places[c].assign(m_buckets, 0);
    std::size_t* counts = m_places[c].data();
    const unsigned shift = m_keyBits;
    const std::size_t end = size * (c + 1) / chunks;
    for (std::size_t i = size * c / chunks; i < end; ++i) {
      ++counts[indexOf<kBySecond>(from[i]) >> shift];
    }
  });
  std::size_t place = 0;
  m_bucketBegin.assign(m_buckets + 1, 0);
  for (std::size_t bucket = 0; bucket < m_buckets; ++bucket) {
    m_bucketBegin[bucket] = place;
    for (std::vector<std::size_t>& places : m_places) place += std::exchange(places[bucket], place);
  }
  m_bucketBegin[m_buckets] = place;
  executor.run(chunks, [&](std::size_t c) {
    std::size_t* places = m_places[c].data();
    const unsigned shift = m_keyBits;
    const std::size_t end = size * (c + 1) / chunks;
    for (std::size_t i = size * c / chunks; i < end; ++i) {
      const Pair pair = from[i];
      to[places[indexOf<kBySecond>(pair) >> shift]++] = pair;
    }
  });
}

/// Two passes, each with a counter for every index.
template <bool kBySecond>
void PairSort::sortWhole(std::span<Pair> pairs, Pair* other, std::size_t keys, std::size_t others) {
  m_counters.require(keys + others);
  std::uint32_t* const byKey = m_counters.data();
  std::uint32_t* const byOther = byKey + keys;
  std::fill_n(byKey, keys + others, 0U);
  for (const Pair pair : pairs) {
    ++byKey[indexOf<kBySecond>(pair)];
    ++byOther[indexOf<!kBySecond>(pair)];
  }
  placesOf(byKey, keys);
  placesOf(byOther, others);
  for (const Pair pair : pairs) other[byOther[indexOf<!kBySecond>(pair)]++] = pair;
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[byKey[indexOf<kBySecond>(other[i])]++] = other[i];
}

template <bool kBySecond>
void PairSort::sortBy(std::span<Pair> pairs, Pair* other, std::size_t keys, std::size_t others, const Kernels& kernels,
                      Executor& executor) {
  const bool worthCounters = keys + others <= kMostCounters && pairs.size() >= (keys + others) / kCountersPerPair &&
                             pairs.size() <= std::numeric_limits<std::uint32_t>::max();
  if (worthCounters && executor.concurrency() == 1) {
    sortWhole<kBySecond>(pairs, other, keys, others);
    return;
  }
  std::size_t wanted = 1;
  if (pairs.size() > kPairsPerBucket) {
    wanted = std::clamp(pairs.size() / kPairsPerBucket, kMinBuckets, BucketRule::kMostBuckets);
  }
  const BucketRule rule(keys, others, wanted, kBySecond ? Order::BySecond : Order::ByFirst, kernels);
  m_keyBits = rule.keyBits;
  m_buckets = rule.buckets;
  scatter<kBySecond>(pairs.data(), other, pairs.size(), executor);
  executor.run(m_buckets, [&](std::size_t b) {
    const std::size_t begin = m_bucketBegin[b];
    sortBucket<kBySecond>(rule, other + begin, pairs.data() + begin, m_bucketBegin[b + 1] - begin);
  });
}

void PairSort::sort(std::span<Pair> pairs, const Task& task, Executor& executor) {
  if (pairs.size() < 2 || task.order == Order::Unordered) return;
  Pair* other = task.spare.data();
  if (task.spare.size() < pairs.size()) {
    m_own.require(pairs.size());
    other = m_own.data();
  }
  if (task.order == Order::ByFirst) {
    sortBy<false>(pairs, other, task.firsts, task.seconds, *task.kernels, executor);
  } else {
    sortBy<true>(pairs, other, task.seconds, task.firsts, *task.kernels, executor);
  }
}

}  // namespace allpairs::engine
