// SPDX-License-Identifier: MIT
#include "world/WorldLists.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "bvh/RadixSort.h"

namespace allpairs::engine {
namespace {

/// More than there are, so that a fluctuating number of pairs soon allocates nothing.
std::size_t roomForPairs(std::size_t pairs) { return pairs + pairs / 4 + 64; }

}  // namespace

void WorldLists::prepareStep(const BoxStore& store) {
  if (m_membership == store.membership()) return;
  m_before.reserve(store.worlds().size());
}

void WorldLists::noteStep(const BoxStore& store) noexcept {
  m_isSame = m_membership == store.membership();
  if (m_isSame) return;
  m_membership = store.membership();
  std::swap(m_before, m_now);
  m_now.assign(store.worlds().begin(), store.worlds().end());
}

void WorldLists::shrink() noexcept {
  std::pmr::memory_resource* const from = m_now.get_allocator().resource();
  m_keyed = Buffer<std::uint64_t>(from);
  m_spare = Buffer<std::uint64_t>(from);
  if (m_isSame) m_before = Numbers(from);
  for (Grouped& grouped : m_lists) {
    if (grouped.own.empty()) grouped.own.shrink_to_fit();
    if (grouped.kept.empty()) grouped.kept.shrink_to_fit();
  }
}

/// The world of a pair: that of the box that is not of every world.
std::uint32_t WorldLists::numberOf(const Numbers& numbers, Pair pair) noexcept {
  const auto of = [&](BoxId id) { return id < numbers.size() ? numbers[id] : 0; };
  const std::uint32_t first = of(pair.first);
  return first == kEveryWorld ? of(pair.second) : first;
}

void WorldLists::group(const StepResult& result) {
  groupOne(Current, result.pairs, m_now);
  for (Grouped& grouped : m_lists) grouped.kept.clear();
  if (m_isSame) {
    groupOne(Began, result.began, m_now);
    groupOne(Persisted, result.persisted, m_now);
    groupOne(Ended, result.ended, m_now);
    return;
  }
  moveChanged(result);
  groupOne(Began, m_lists[Began].kept, m_now);
  groupOne(Persisted, m_lists[Persisted].kept, m_now);
  groupOne(Ended, m_lists[Ended].kept, m_before);
}

/// The lists with the pairs that persist in another world among those that ended and began.
void WorldLists::moveChanged(const StepResult& result) {
  std::pmr::vector<Pair>& persisted = m_lists[Persisted].kept;
  persisted.clear();
  std::pmr::vector<Pair> moved(persisted.get_allocator());
  for (const Pair pair : result.persisted) {
    (numberOf(m_now, pair) == numberOf(m_before, pair) ? persisted : moved).push_back(pair);
  }
  const auto keyOf = [this](Pair pair) {
    const std::uint64_t byFirst = (std::uint64_t{pair.first} << 32U) | pair.second;
    return std::rotl(byFirst, m_order == Order::ByFirst ? 0 : 32);
  };
  const auto isBefore = [&](Pair a, Pair b) { return keyOf(a) < keyOf(b); };
  const auto mergeInto = [&](std::pmr::vector<Pair>& list, std::span<const Pair> with) {
    list.resize(moved.size() + with.size());
    std::merge(moved.begin(), moved.end(), with.begin(), with.end(), list.begin(), isBefore);
  };
  mergeInto(m_lists[Began].kept, result.began);
  mergeInto(m_lists[Ended].kept, result.ended);
}

void WorldLists::groupOne(List list, std::span<const Pair> pairs, const Numbers& numbers) {
  Grouped& grouped = m_lists[list];
  grouped.numbers = &numbers;
  grouped.pairs = pairs;
  grouped.own.clear();
  std::uint32_t all = 0;
  std::uint32_t last = 0;
  bool isGrouped = true;
  for (const Pair pair : pairs) {
    const std::uint32_t number = numberOf(numbers, pair);
    isGrouped = isGrouped && last <= number;
    last = number;
    all |= number;
  }
  if (isGrouped) return;
  const std::size_t room = roomForPairs(pairs.size());
  if (pairs.size() > std::min(m_keyed.capacity(), m_spare.capacity())) {
    m_keyed.require(room);
    m_spare.require(room);
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    m_keyed[i] = std::uint64_t{numberOf(numbers, pairs[i])} << 32U | i;
  }
  const unsigned end = 32 + static_cast<unsigned>(std::bit_width(all));
  const std::uint64_t* const sorted = radixSort(m_keyed.data(), m_spare.data(), pairs.size(), 32, end);
  if (pairs.size() > grouped.own.capacity()) grouped.own.reserve(room);
  grouped.own.resize(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) grouped.own[i] = pairs[static_cast<std::uint32_t>(sorted[i])];
  grouped.pairs = grouped.own;
}

std::span<const Pair> WorldLists::part(List list, std::uint32_t world) const noexcept {
  const Grouped& grouped = m_lists[list];
  const auto isBelow = [&](Pair pair, std::uint64_t number) { return numberOf(*grouped.numbers, pair) < number; };
  const auto begin = std::lower_bound(grouped.pairs.begin(), grouped.pairs.end(), std::uint64_t{world}, isBelow);
  return {begin, std::lower_bound(begin, grouped.pairs.end(), std::uint64_t{world} + 1, isBelow)};
}

StepResult WorldLists::of(std::uint32_t world) const noexcept {
  return {part(Current, world), part(Began, world), part(Persisted, world), part(Ended, world)};
}

}  // namespace allpairs::engine
