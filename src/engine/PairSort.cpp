// SPDX-License-Identifier: MIT
#include "PairSort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

namespace allpairs::engine {
namespace {

/// Pairs that a bucket should hold, so that sorting it stays in the first-level cache.
constexpr std::size_t kPairsPerBucket = 4096;
constexpr std::size_t kMaxBuckets = 2048;

/// With fewer buckets, neighbouring pairs would often go to the same one and wait for its counter.
constexpr std::size_t kMinBuckets = 256;

/// Up to this many indices there are counters for all of them in the second-level cache, if they are worth clearing.
constexpr std::size_t kMostCounters = std::size_t{1} << 17;
constexpr std::size_t kCountersPerPair = 8;

/// Up to about so many pairs of a key are put in order by insertion.
constexpr std::size_t kFewPairs = 12;

/// More pairs of one key than this are sorted on their own.
constexpr std::size_t kLongRow = 32;
constexpr std::size_t kMinChunk = std::size_t{1} << 15;

/// Bits of a digit, and so how many keys share a bucket at most.
constexpr unsigned kMaxDigitBits = 11;

/// Digits of an index of 32 bits.
constexpr unsigned kMaxPasses = 3;

using Places = std::array<std::uint32_t, std::size_t{1} << kMaxDigitBits>;

template <bool kSecond>
std::uint32_t indexOf(Pair pair) {
  return kSecond ? pair.second : pair.first;
}

/// The digits of one of the two indices, from the lowest up.
struct Digits {
  unsigned passes = 0;
  unsigned bits = 0;
  std::uint32_t mask = 0;
};

/// As few digits for the low `bits` bits as there can be, all of the same length.
Digits digitsFor(unsigned bits) {
  Digits digits;
  digits.passes = (bits + kMaxDigitBits - 1) / kMaxDigitBits;
  digits.bits = digits.passes == 0 ? 0 : (bits + digits.passes - 1) / digits.passes;
  digits.mask = (1U << digits.bits) - 1;
  return digits;
}

/// Turns counts into where each digit begins.
void placesOf(std::uint32_t* counts, std::size_t size) {
  std::uint32_t place = 0;
  for (std::size_t digit = 0; digit < size; ++digit) place += std::exchange(counts[digit], place);
}

template <bool kSecond>
void countDigits(const Pair* pairs, std::size_t size, const Digits& digits, std::array<Places, kMaxPasses>& places) {
  for (unsigned pass = 0; pass < digits.passes; ++pass) {
    std::fill_n(places[pass].begin(), std::size_t{digits.mask} + 1, 0U);
    const unsigned shift = pass * digits.bits;
    for (std::size_t i = 0; i < size; ++i) ++places[pass][(indexOf<kSecond>(pairs[i]) >> shift) & digits.mask];
    placesOf(places[pass].data(), std::size_t{digits.mask} + 1);
  }
}

/// Sorts by the digits of one index, back and forth between the two buffers; returns where the result is.
template <bool kSecond>
std::pair<Pair*, Pair*> sortByDigits(Pair* from, Pair* to, std::size_t size, const Digits& digits) {
  std::array<Places, kMaxPasses> places;
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

/// The two indices as one number that compares as the pair does in the order.
template <bool kBySecond>
std::uint64_t rankOf(Pair pair) {
  return std::uint64_t{indexOf<kBySecond>(pair)} << 32U | indexOf<!kBySecond>(pair);
}

/// Pairs of which few lie far from their place.
template <bool kBySecond>
void sortByInsertion(Pair* pairs, std::size_t size) {
  for (std::size_t i = 1; i < size; ++i) {
    const Pair pair = pairs[i];
    const std::uint64_t rank = rankOf<kBySecond>(pair);
    std::size_t hole = i;
    for (; hole > 0 && rankOf<kBySecond>(pairs[hole - 1]) > rank; --hole) pairs[hole] = pairs[hole - 1];
    pairs[hole] = pair;
  }
}

/// Sorts the pairs of the keys that have many, which insertion would take long for. Each key's pairs end at its place.
template <bool kBySecond>
void sortLongRows(Pair* pairs, const Places& ends, std::size_t keys) {
  std::size_t begin = 0;
  for (std::size_t key = 0; key < keys; ++key) {
    const std::size_t end = ends[key];
    if (end - begin > kLongRow) {
      std::sort(pairs + begin, pairs + end,
                [](Pair a, Pair b) { return indexOf<!kBySecond>(a) < indexOf<!kBySecond>(b); });
    }
    begin = end;
  }
}

/// Sorts a bucket in which a key has a few pairs: each goes to its key's, in any order, and is then put in its place.
template <bool kBySecond>
void sortByKeys(const Kernels& kernels, const Pair* from, Pair* to, std::size_t size, unsigned keyBits) {
  Places places;
  const std::uint32_t mask = (1U << keyBits) - 1;
  std::fill_n(places.begin(), std::size_t{mask} + 1, 0U);
  for (std::size_t i = 0; i < size; ++i) ++places[indexOf<kBySecond>(from[i]) & mask];
  const std::uint32_t longest = *std::max_element(places.begin(), places.begin() + mask + 1);
  placesOf(places.data(), std::size_t{mask} + 1);
  for (std::size_t i = 0; i < size; ++i) to[places[indexOf<kBySecond>(from[i]) & mask]++] = from[i];
  if (longest > kLongRow) sortLongRows<kBySecond>(to, places, std::size_t{mask} + 1);
  kernels.exchangeNeighbours(to, size, kBySecond);
  sortByInsertion<kBySecond>(to, size);
}

/// Sorts the pairs of one bucket from `from` into `to`; `from` is lost. Keys of a bucket differ in their low bits only.
template <bool kBySecond>
void sortBucket(const Kernels& kernels, Pair* from, Pair* to, std::size_t size, unsigned keyBits, unsigned otherBits) {
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    std::copy_n(from, size, to);
    std::sort(to, to + size, [](Pair a, Pair b) { return rankOf<kBySecond>(a) < rankOf<kBySecond>(b); });
    return;
  }
  if (keyBits <= kMaxDigitBits && size < (kFewPairs << keyBits)) {
    sortByKeys<kBySecond>(kernels, from, to, size, keyBits);
    return;
  }
  const auto byOther = sortByDigits<!kBySecond>(from, to, size, digitsFor(otherBits));
  const auto byBoth = sortByDigits<kBySecond>(byOther.first, byOther.second, size, digitsFor(keyBits));
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
  if (pairs.size() > kPairsPerBucket) wanted = std::clamp(pairs.size() / kPairsPerBucket, kMinBuckets, kMaxBuckets);
  m_keyBits = static_cast<unsigned>(std::bit_width((keys - 1) / wanted));
  while (((keys - 1) >> m_keyBits) >= kMaxBuckets) ++m_keyBits;
  m_buckets = ((keys - 1) >> m_keyBits) + 1;
  scatter<kBySecond>(pairs.data(), other, pairs.size(), executor);
  const auto otherBits = static_cast<unsigned>(std::bit_width(others - 1));
  executor.run(m_buckets, [&](std::size_t b) {
    const std::size_t begin = m_bucketBegin[b];
    sortBucket<kBySecond>(kernels, other + begin, pairs.data() + begin, m_bucketBegin[b + 1] - begin, m_keyBits,
                          otherBits);
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
