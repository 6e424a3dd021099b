// SPDX-License-Identifier: MIT
#include "bvh/RadixSort.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace allpairs::engine {
namespace {

/// Up to this size numbers are sorted as one run: there and back they fill a second-level cache. Threads share fewer.
constexpr std::size_t kMostInOneRun = std::size_t{1} << 17;
constexpr std::size_t kMostForOneThread = std::size_t{1} << 14;

/// A first pass leaves buckets of about 2^kRunBits numbers, in no more than 2^kMaxDigitBits buckets.
constexpr unsigned kRunBits = 12;

/// A chunk smaller than this is not worth a task.
constexpr std::size_t kMinChunk = std::size_t{1} << 13;

}  // namespace

template <class Number>
Number* radixSort(Number* from, Number* to, std::size_t size, unsigned begin, unsigned end) noexcept {
  const bool isWritten =
      radixSortTo(from, to, size, begin, end, [&to](std::size_t place, Number number) { to[place] = number; });
  return isWritten ? to : from;
}

template std::uint32_t* radixSort(std::uint32_t*, std::uint32_t*, std::size_t, unsigned, unsigned) noexcept;
template std::uint64_t* radixSort(std::uint64_t*, std::uint64_t*, std::size_t, unsigned, unsigned) noexcept;

/// Cuts all numbers into buckets by the bits from `shift` on.
void RadixSort::scatter(const std::uint64_t* from, std::uint64_t* to, std::size_t size, unsigned shift,
                        Executor& executor) {
  const std::size_t most = executor.concurrency() == 1 ? 1 : 8 * executor.concurrency();
  const std::size_t chunks = std::clamp<std::size_t>(std::min(most, size / kMinChunk), 1, 256);
  const std::size_t buckets = m_bucketBegin.size() - 1;
  if (m_places.size() != chunks) m_places.resize(chunks);
  executor.run(chunks, [&](std::size_t c) {
    m_places[c].assign(buckets, 0);
    std::size_t* const counts = m_places[c].data();
    const std::size_t end = size * (c + 1) / chunks;
    for (std::size_t i = size * c / chunks; i < end; ++i) ++counts[from[i] >> shift];
  });
  std::size_t place = 0;
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    m_bucketBegin[bucket] = place;
    for (std::pmr::vector<std::size_t>& places : m_places) place += std::exchange(places[bucket], place);
  }
  m_bucketBegin[buckets] = place;
  executor.run(chunks, [&](std::size_t c) {
    std::size_t* const places = m_places[c].data();
    const std::size_t end = size * (c + 1) / chunks;
    for (std::size_t i = size * c / chunks; i < end; ++i) to[places[from[i] >> shift]++] = from[i];
  });
}

void RadixSort::sort(std::uint64_t* from, std::uint64_t* to, std::size_t size, unsigned begin, unsigned end,
                     Executor& executor) {
  if (size <= (executor.concurrency() == 1 ? kMostInOneRun : kMostForOneThread)) {
    const std::uint64_t* sorted = radixSort(from, to, size, begin, end);
    if (sorted != to) std::copy_n(sorted, size, to);
    return;
  }
  const unsigned width = static_cast<unsigned>(std::bit_width(size));
  const unsigned digit = std::clamp(width, kRunBits + 4, kRunBits + kMaxDigitBits) - kRunBits;
  const unsigned shift = std::max(begin, end - std::min(end, digit));
  const std::size_t buckets = std::size_t{1} << (end - shift);
  m_bucketBegin.resize(buckets + 1);
  scatter(from, to, size, shift, executor);
  executor.run(buckets, [&](std::size_t b) {
    const std::size_t first = m_bucketBegin[b];
    const std::size_t length = m_bucketBegin[b + 1] - first;
    const std::uint64_t* sorted = radixSort(to + first, from + first, length, begin, shift);
    if (sorted != to + first) std::copy_n(sorted, length, to + first);
  });
}

}  // namespace allpairs::engine
