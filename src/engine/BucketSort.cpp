// SPDX-License-Identifier: MIT
#include "BucketSort.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace allpairs::engine {
namespace {

/// Sorts a long row of other indices; `spare` has as much room.
void sortLongRow(std::uint32_t* values, std::uint32_t* spare, std::size_t size, unsigned bits) {
  constexpr unsigned kMostDigitBits = 9;
  const unsigned passes = std::max(1U, (bits + kMostDigitBits - 1) / kMostDigitBits);
  const unsigned digitBits = std::max(1U, (bits + passes - 1) / passes);
  const std::uint32_t mask = (1U << digitBits) - 1;
  std::uint32_t* from = values;
  std::uint32_t* to = spare;
  for (unsigned shift = 0; shift < bits; shift += digitBits) {
    std::array<std::uint32_t, std::size_t{1} << kMostDigitBits> places;
    std::fill_n(places.begin(), std::size_t{mask} + 1, 0U);
    for (std::size_t i = 0; i < size; ++i) ++places[(from[i] >> shift) & mask];
    placesOf(places.data(), std::size_t{mask} + 1);
    for (std::size_t i = 0; i < size; ++i) to[places[(from[i] >> shift) & mask]++] = from[i];
    std::swap(from, to);
  }
  if (from != values) std::copy_n(from, size, values);
}

}  // namespace

void placesOf(std::uint32_t* counts, std::size_t size) {
  std::uint32_t place = 0;
  for (std::size_t digit = 0; digit < size; ++digit) place += std::exchange(counts[digit], place);
}

BucketRule::BucketRule(std::size_t keys, std::size_t others, std::size_t wanted, Order order, const Kernels& used)
    : kernels(&used), bySecond(order == Order::BySecond) {
  keyBits = static_cast<unsigned>(std::bit_width((keys - 1) / wanted));
  while (((keys - 1) >> keyBits) >= kMostBuckets) ++keyBits;
  buckets = ((keys - 1) >> keyBits) + 1;
  otherBits = static_cast<unsigned>(std::bit_width(others - 1));
}

// The rows are written before they are read.
// NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init)
BucketSort::BucketSort(const BucketRule& rule, std::span<Pair> place)
    : m_rule(rule),
      m_place(place),
      m_values(reinterpret_cast<std::uint32_t*>(place.data())),
      m_added(m_values + place.size()),
      m_keys(std::size_t{1} << rule.keyBits) {
  static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
  std::fill_n(m_ends.begin(), m_keys, 0U);
}

void BucketSort::add(std::span<const Pair> part) {
  if (part.empty()) return;
  m_firstKey = m_rule.keyOf(part[0]) & ~static_cast<std::uint32_t>(m_keys - 1);
  m_rule.bySecond ? pack<true>(part) : pack<false>(part);
}

template <bool kBySecond>
void BucketSort::pack(std::span<const Pair> part) {
  const auto mask = static_cast<std::uint32_t>(m_keys - 1);
  const unsigned shift = m_rule.otherBits;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const std::uint32_t key = (kBySecond ? part[i].second : part[i].first) & mask;
    m_added[i] = key << shift | (kBySecond ? part[i].first : part[i].second);
    ++m_ends[key];
  }
  m_added += part.size();
}

/// Sorts the rows that are longer than most, and lists those that a network is to sort; returns how many these are.
std::size_t BucketSort::sortLongRows() {
  std::uint32_t* const spare = m_values + m_place.size();
  std::size_t listed = 0;
  std::uint32_t begin = 0;
  for (std::size_t key = 0; key < m_keys; ++key) {
    const std::uint32_t size = m_ends[key] - begin;
    m_rows[listed] = {begin, size};
    listed += size > kMostExchanged && size <= kMostInNetwork ? 1U : 0U;
    if (size > kMostInNetwork) sortLongRow(m_values + begin, spare, size, m_rule.otherBits);
    begin = m_ends[key];
  }
  return listed;
}

void BucketSort::finish() {
  const std::size_t size = m_place.size();
  std::uint32_t* const packed = m_values + size;
  PackedBucket bucket;
  bucket.values = m_values;
  bucket.size = size;
  bucket.pairs = m_place.data();
  bucket.firstKey = m_firstKey;
  bucket.otherBits = m_rule.otherBits;
  bucket.bySecond = m_rule.bySecond;
  if (size <= kMostInNetwork) {
    // Too few for the room that networks need.
    std::copy_n(packed, size, m_values);
    std::sort(m_values, m_values + size);
    bucket.isOrdered = true;
  } else {
    placesOf(m_ends.data(), m_keys);
    for (std::size_t i = 0; i < size; ++i) m_values[m_ends[packed[i] >> m_rule.otherBits]++] = packed[i];
    bucket.rows = {m_rows.data(), sortLongRows()};
  }
  m_rule.kernels->finishBucket(bucket);
}

}  // namespace allpairs::engine
