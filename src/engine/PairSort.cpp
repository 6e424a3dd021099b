// SPDX-License-Identifier: MIT
#include "PairSort.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace allpairs::engine {
namespace {

/// Pairs that a bucket should hold, so that its second pass stays in the second-level cache.
constexpr std::size_t kPairsPerBucket = 16384;
constexpr std::size_t kMaxBuckets = 1024;
constexpr std::size_t kMinChunk = std::size_t{1} << 15;

/// Rows up to this length are sorted by insertion.
constexpr std::ptrdiff_t kShortRow = 24;

template <bool kBySecond>
std::uint32_t keyOf(Pair pair) {
  return kBySecond ? pair.second : pair.first;
}

template <bool kBySecond>
std::uint32_t otherOf(Pair pair) {
  return kBySecond ? pair.first : pair.second;
}

template <bool kBySecond>
void sortRow(Pair* begin, Pair* end) {
  const auto before = [](Pair a, Pair b) { return otherOf<kBySecond>(a) < otherOf<kBySecond>(b); };
  if (end - begin > kShortRow) {
    std::sort(begin, end, before);
    return;
  }
  for (Pair* i = begin + 1; i < end; ++i) {
    const Pair pair = *i;
    Pair* hole = i;
    for (; hole != begin && before(pair, hole[-1]); --hole) *hole = hole[-1];
    *hole = pair;
  }
}

/// Sorts the pairs of one bucket, whose keys are in [firstKey, firstKey + counts.size() - 1), by key and then by row.
template <bool kBySecond>
void sortBucket(const Pair* from, Pair* to, std::size_t size, std::uint32_t firstKey,
                std::vector<std::uint32_t>& counts) {
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    std::copy_n(from, size, to);
    std::sort(to, to + size, [](Pair a, Pair b) {
      return std::pair(keyOf<kBySecond>(a), otherOf<kBySecond>(a)) <
             std::pair(keyOf<kBySecond>(b), otherOf<kBySecond>(b));
    });
    return;
  }
  std::fill(counts.begin(), counts.end(), 0U);
  for (std::size_t i = 0; i < size; ++i) ++counts[keyOf<kBySecond>(from[i]) - firstKey + 1];
  for (std::size_t k = 1; k < counts.size(); ++k) counts[k] += counts[k - 1];
  for (std::size_t i = 0; i < size; ++i) to[counts[keyOf<kBySecond>(from[i]) - firstKey]++] = from[i];
  // Each counter has moved on to where the next row begins.
  std::uint32_t begin = 0;
  for (const std::uint32_t end : counts) {
    if (end - begin > 1) sortRow<kBySecond>(to + begin, to + end);
    begin = std::max(begin, end);
  }
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
      ++m_places[c][keyOf<kBySecond>(from[i]) >> m_shift];
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
    for (std::size_t i = size * c / chunks; i < size * (c + 1) / chunks; ++i) {
      to[m_places[c][keyOf<kBySecond>(from[i]) >> m_shift]++] = from[i];
    }
  });
}

template <bool kBySecond>
void PairSort::sortBy(Buffer<Pair>& pairs, std::size_t size, std::size_t keys, Executor& executor) {
  m_other.require(pairs.capacity());
  const std::size_t wanted = std::clamp<std::size_t>(size / kPairsPerBucket, 1, kMaxBuckets);
  const std::size_t perBucket = std::bit_ceil((keys + wanted - 1) / wanted);
  m_shift = static_cast<unsigned>(std::countr_zero(perBucket));
  m_buckets = (keys + perBucket - 1) / perBucket;
  if (m_buckets == 1) {
    m_bucketBegin.assign({0, size});
  } else {
    scatter<kBySecond>(pairs.data(), m_other.data(), size, executor);
  }
  // With a single bucket nothing was scattered: the pairs themselves are the source, and the other buffer the result.
  const Pair* from = m_buckets == 1 ? pairs.data() : m_other.data();
  Pair* to = m_buckets == 1 ? m_other.data() : pairs.data();
  const std::size_t tasks = std::min(m_buckets, 4 * executor.concurrency());
  if (m_counts.size() < tasks) m_counts.resize(tasks);
  executor.run(tasks, [&](std::size_t task) {
    m_counts[task].resize(perBucket + 1);
    for (std::size_t b = m_buckets * task / tasks; b < m_buckets * (task + 1) / tasks; ++b) {
      const std::size_t begin = m_bucketBegin[b];
      sortBucket<kBySecond>(from + begin, to + begin, m_bucketBegin[b + 1] - begin,
                            static_cast<std::uint32_t>(b * perBucket), m_counts[task]);
    }
  });
  if (m_buckets == 1) std::swap(pairs, m_other);
}

void PairSort::sort(Buffer<Pair>& pairs, std::size_t size, std::size_t keys, Order order, Executor& executor) {
  if (size < 2) return;
  if (order == Order::ByFirst) sortBy<false>(pairs, size, keys, executor);
  if (order == Order::BySecond) sortBy<true>(pairs, size, keys, executor);
}

}  // namespace allpairs::engine
