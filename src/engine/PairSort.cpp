// SPDX-License-Identifier: MIT
#include "PairSort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

namespace allpairs::engine {
namespace {

/// Pairs that a bucket should hold, so that sorting it stays in the second-level cache.
constexpr std::size_t kPairsPerBucket = 32768;
constexpr std::size_t kMaxBuckets = 2048;
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

template <bool kSecond>
void countDigits(const Pair* pairs, std::size_t size, const Digits& digits, std::array<Places, kMaxPasses>& places) {
  for (unsigned pass = 0; pass < digits.passes; ++pass) {
    std::fill_n(places[pass].begin(), std::size_t{digits.mask} + 1, 0U);
    const unsigned shift = pass * digits.bits;
    for (std::size_t i = 0; i < size; ++i) ++places[pass][(indexOf<kSecond>(pairs[i]) >> shift) & digits.mask];
    std::uint32_t place = 0;
    for (std::size_t digit = 0; digit <= digits.mask; ++digit) place += std::exchange(places[pass][digit], place);
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

/// Sorts the pairs of one bucket from `from` into `to`; `from` is lost. Keys of a bucket differ in their low bits only.
template <bool kBySecond>
void sortBucket(Pair* from, Pair* to, std::size_t size, unsigned keyBits, unsigned otherBits) {
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    std::copy_n(from, size, to);
    std::sort(to, to + size, [](Pair a, Pair b) {
      return std::pair(indexOf<kBySecond>(a), indexOf<!kBySecond>(a)) <
             std::pair(indexOf<kBySecond>(b), indexOf<!kBySecond>(b));
    });
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
    for (std::size_t i = size * c / chunks; i < size * (c + 1) / chunks; ++i) {
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
    for (std::size_t i = size * c / chunks; i < size * (c + 1) / chunks; ++i) {
      const Pair pair = from[i];
      to[places[indexOf<kBySecond>(pair) >> shift]++] = pair;
    }
  });
}

template <bool kBySecond>
void PairSort::sortBy(std::span<Pair> pairs, Pair* other, std::size_t keys, std::size_t others, Executor& executor) {
  const std::size_t wanted = std::clamp<std::size_t>(pairs.size() / kPairsPerBucket, 1, kMaxBuckets);
  m_keyBits = static_cast<unsigned>(std::bit_width((keys - 1) / wanted));
  // With a few buckets only, the pass into them would wait for its own counters: they are better than none where the
  // pairs do not fit the cache, and no more than one digit of the key may be left to them.
  if (pairs.size() > kPairsPerBucket) m_keyBits = std::min(m_keyBits, kMaxDigitBits);
  while (((keys - 1) >> m_keyBits) >= kMaxBuckets) ++m_keyBits;
  m_buckets = ((keys - 1) >> m_keyBits) + 1;
  scatter<kBySecond>(pairs.data(), other, pairs.size(), executor);
  const auto otherBits = static_cast<unsigned>(std::bit_width(others - 1));
  executor.run(m_buckets, [&](std::size_t b) {
    const std::size_t begin = m_bucketBegin[b];
    sortBucket<kBySecond>(other + begin, pairs.data() + begin, m_bucketBegin[b + 1] - begin, m_keyBits, otherBits);
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
    sortBy<false>(pairs, other, task.firsts, task.seconds, executor);
  } else {
    sortBy<true>(pairs, other, task.seconds, task.firsts, executor);
  }
}

}  // namespace allpairs::engine
