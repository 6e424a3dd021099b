// SPDX-License-Identifier: MIT
#include "world/WorldLists.h"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

#include "allpairs/Error.h"
#include "input/Parts.h"
#include "order/PairSort.h"
#include "search/CallExecutor.h"

namespace allpairs::engine {

void WorldLists::prepareStep(const BoxStore& store) {
  m_isSame = true;  // Until the step completes, it leaves the pairs without changes.
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
  m_keyed = Buffer<std::uint64_t>(m_memory);
  m_spare = Buffer<std::uint64_t>(m_memory);
  m_radix = RadixSort(m_memory);
  if (m_isSame) m_before = Numbers(m_memory);
  for (Grouped* list : {&m_pairs, &m_began, &m_persisted, &m_ended}) {
    if (list->pairs.data() != list->own.data()) list->own = Buffer<Pair>(m_memory);
    if (list->kept.empty()) list->kept.shrink_to_fit();
  }
}

/// The world of a pair: that of the box that is not of every world.
std::uint32_t WorldLists::numberOf(const Numbers& numbers, Pair pair) noexcept {
  const auto of = [&](BoxId id) { return id < numbers.size() ? numbers[id] : 0; };
  const std::uint32_t first = of(pair.first);
  return first == kEveryWorld ? of(pair.second) : first;
}

void WorldLists::group(const StepResult& result) {
  groupOne(m_pairs, result.pairs, m_now);
  for (Grouped* list : {&m_began, &m_persisted, &m_ended}) list->kept.clear();
  if (m_isSame) {
    groupOne(m_began, result.began, m_now);
    groupOne(m_persisted, result.persisted, m_now);
    groupOne(m_ended, result.ended, m_now);
    return;
  }
  moveChanged(result);
  groupOne(m_began, m_began.kept, m_now);
  groupOne(m_persisted, m_persisted.kept, m_now);
  groupOne(m_ended, m_ended.kept, m_before);
}

/// Calls use(i) for each of so many pairs, and looks at the flag before each part of them.
template <class Use>
void WorldLists::eachIndex(std::size_t pairs, const Use& use) const {
  for (std::size_t begin = 0; begin < pairs; begin += kPartSize) {
    checkStop(m_options.stop);
    const std::size_t end = std::min(begin + kPartSize, pairs);
    for (std::size_t i = begin; i < end; ++i) use(i);
  }
}

/// The lists with the pairs that persist in another world among those that ended and began.
void WorldLists::moveChanged(const StepResult& result) {
  std::pmr::vector<Pair>& persisted = m_persisted.kept;
  std::pmr::vector<Pair> moved(persisted.get_allocator());
  eachIndex(result.persisted.size(), [&](std::size_t i) {
    const Pair pair = result.persisted[i];
    (numberOf(m_now, pair) == numberOf(m_before, pair) ? persisted : moved).push_back(pair);
  });
  const auto isBefore = [this](Pair a, Pair b) { return keyOf(a, m_options.order) < keyOf(b, m_options.order); };
  const auto mergeInto = [&](std::pmr::vector<Pair>& list, std::span<const Pair> with) {
    list.resize(moved.size() + with.size());
    std::merge(moved.begin(), moved.end(), with.begin(), with.end(), list.begin(), isBefore);
  };
  mergeInto(m_began.kept, result.began);
  mergeInto(m_ended.kept, result.ended);
}

void WorldLists::groupOne(Grouped& list, std::span<const Pair> pairs, const Numbers& numbers) {
  list.numbers = &numbers;
  list.pairs = pairs;
  std::uint32_t all = 0;
  std::uint32_t last = 0;
  bool isGrouped = true;
  eachIndex(pairs.size(), [&](std::size_t i) {
    const std::uint32_t number = numberOf(numbers, pairs[i]);
    isGrouped = isGrouped && last <= number;
    last = number;
    all |= number;
  });
  if (isGrouped) return;
  if (pairs.size() > std::uint64_t{1} << 32U) {  // A key has 32 bits for the place of a pair.
    throw LimitExceeded(pairs.size(),
                        std::to_string(pairs.size()) + " pairs are too many to be sorted by their worlds");
  }
  m_keyed.requireAmply(pairs.size());
  m_spare.requireAmply(pairs.size());
  list.own.requireAmply(pairs.size());
  eachIndex(pairs.size(), [&](std::size_t i) { m_keyed[i] = std::uint64_t{numberOf(numbers, pairs[i])} << 32U | i; });
  const unsigned end = 32 + static_cast<unsigned>(std::bit_width(all));
  CallExecutor call;
  m_radix.sort(m_keyed.data(), m_spare.data(), pairs.size(), 32, end, call.over(nullptr, m_options.stop));
  eachIndex(pairs.size(), [&](std::size_t i) { list.own[i] = pairs[static_cast<std::uint32_t>(m_spare[i])]; });
  list.pairs = {list.own.data(), pairs.size()};
}

std::span<const Pair> WorldLists::part(const Grouped& list, std::uint32_t world) noexcept {
  const auto isBelow = [&](Pair pair, std::uint64_t number) { return numberOf(*list.numbers, pair) < number; };
  const auto begin = std::lower_bound(list.pairs.begin(), list.pairs.end(), std::uint64_t{world}, isBelow);
  return {begin, std::lower_bound(begin, list.pairs.end(), std::uint64_t{world} + 1, isBelow)};
}

StepResult WorldLists::of(std::uint32_t world) const noexcept {
  return {part(m_pairs, world), part(m_began, world), part(m_persisted, world), part(m_ended, world)};
}

}  // namespace allpairs::engine
