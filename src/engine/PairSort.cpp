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
constexpr std::size_t kPairsPerBucket = 16384;
constexpr std::size_t kMaxBuckets = 2048;
constexpr std::size_t kMinChunk = std::size_t{1} << 15;

/// Digits of a pass, and how many of them two indices of 32 bits can have.
constexpr unsigned kMaxDigitBits = 11;
constexpr unsigned kMaxPasses = 6;

template <bool kBySecond>
std::uint32_t keyOf(Pair pair) {
  return kBySecond ? pair.second : pair.first;
}

/// Which bits of a pair a bucket is sorted by: the low ones of its key above those of its other index.
template <bool kBySecond>
struct BucketOrder {
  unsigned keyBits = 0;
  unsigned otherBits = 0;

  [[nodiscard]] std::uint64_t valueOf(Pair pair) const {
    const std::uint64_t key = keyOf<kBySecond>(pair) & ((std::uint64_t{1} << keyBits) - 1);
    return key << otherBits | keyOf<!kBySecond>(pair);
  }
};

template <class Places, bool kBySecond>
void countDigits(const Pair* pairs, std::size_t size, const BucketOrder<kBySecond>& order, unsigned passes,
                 unsigned bits, Places& places) {
  const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
  for (unsigned pass = 0; pass < passes; ++pass) std::fill_n(places[pass].begin(), mask + 1, 0U);
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint64_t value = order.valueOf(pairs[i]);
    for (unsigned pass = 0; pass < passes; ++pass) ++places[pass][(value >> (pass * bits)) & mask];
  }
  for (unsigned pass = 0; pass < passes; ++pass) {
    std::uint32_t place = 0;
    for (std::uint64_t digit = 0; digit <= mask; ++digit) place += std::exchange(places[pass][digit], place);
  }
}

/// Sorts the pairs of one bucket from `from` into `to`, from the lowest digit up; `from` is lost.
template <bool kBySecond>
void sortBucket(Pair* from, Pair* to, std::size_t size, const BucketOrder<kBySecond>& order) {
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    std::copy_n(from, size, to);
    std::sort(to, to + size, [&](Pair a, Pair b) { return order.valueOf(a) < order.valueOf(b); });
    return;
  }
  const unsigned total = order.keyBits + order.otherBits;
  const unsigned passes = std::max(1U, (total + kMaxDigitBits - 1) / kMaxDigitBits);
  const unsigned bits = (total + passes - 1) / passes;
  const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
  std::array<std::array<std::uint32_t, std::size_t{1} << kMaxDigitBits>, kMaxPasses> places;
  countDigits(from, size, order, passes, bits, places);
  Pair* target = to;
  for (unsigned pass = 0; pass < passes; ++pass) {
    const unsigned shift = pass * bits;
    for (std::size_t i = 0; i < size; ++i) {
      target[places[pass][(order.valueOf(from[i]) >> shift) & mask]++] = from[i];
    }
    std::swap(from, target);
  }
  if (from != to) std::copy_n(from, size, to);
}

}  // namespace

template <bool kBySecond>
void PairSort::scatter(const Pair* from, Pair* to, std::size_t size, Executor& executor) {
  const std::size_t most = executor.concurrency() == 1 ? 1 : 4 * executor.concurrency();
  const std::size_t chunks = std::clamp<std::size_t>(std::min(most, size / kMinChunk), 1, 256);
  if (m_places.size() != chunks) m_places.resize(chunks);
  executor.run(chunks, [&](std::size_t c) {
    m_places[c].assign(m_buckets, 0);
    for (std::size_t i = size * c / chunks; i < size * (c + 1) / chunks; ++i) {
      ++m_places[c][keyOf<kBySecond>(from[i]) >> m_keyBits];
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
    for (std::size_t i = size * c / chunks; i < size * (c + 1) / chunks; ++i) {
      to[places[keyOf<kBySecond>(from[i]) >> m_keyBits]++] = from[i];
    }
  });
}

template <bool kBySecond>
void PairSort::sortBy(Buffer<Pair>& pairs, std::size_t size, std::size_t keys, std::size_t others, Executor& executor) {
  m_other.require(pairs.capacity());
  const std::size_t wanted = std::clamp<std::size_t>(size / kPairsPerBucket, 1, kMaxBuckets);
  m_keyBits = static_cast<unsigned>(std::bit_width((keys - 1) / wanted));
  m_buckets = ((keys - 1) >> m_keyBits) + 1;
  Pair* from = pairs.data();
  Pair* to = m_other.data();
  if (m_buckets == 1) {
    m_bucketBegin.assign({0, size});
  } else {
    scatter<kBySecond>(from, to, size, executor);
    std::swap(from, to);
  }
  const BucketOrder<kBySecond> order{m_keyBits, static_cast<unsigned>(std::bit_width(others - 1))};
  executor.run(m_buckets, [&](std::size_t b) {
    const std::size_t begin = m_bucketBegin[b];
    sortBucket(from + begin, to + begin, m_bucketBegin[b + 1] - begin, order);
  });
  // A single bucket was sorted from the pairs into the other buffer.
  if (to == m_other.data()) std::swap(pairs, m_other);
}

void PairSort::sort(Buffer<Pair>& pairs, std::size_t size, std::size_t firsts, std::size_t seconds, Order order,
                    Executor& executor) {
  if (size < 2) return;
  if (order == Order::ByFirst) sortBy<false>(pairs, size, firsts, seconds, executor);
  if (order == Order::BySecond) sortBy<true>(pairs, size, seconds, firsts, executor);
}

}  // namespace allpairs::engine
