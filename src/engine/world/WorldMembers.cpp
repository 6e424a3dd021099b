// SPDX-License-Identifier: MIT
#include "world/WorldMembers.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "bvh/CurveKey.h"
#include "world/DynamicBvh.h"
#include "world/RebuildRule.h"

namespace allpairs::engine {
namespace {

/// The part of an ordered list of world numbers above ids that is of one world; removes it from the list.
std::span<const std::uint64_t> takeWorld(std::span<const std::uint64_t>& keys, std::uint32_t number) {
  std::size_t size = 0;
  while (size < keys.size() && keys[size] >> kIndexBits == number) ++size;
  const std::span<const std::uint64_t> part = keys.first(size);
  keys = keys.subspan(size);
  return part;
}

}  // namespace

void WorldMembers::update(const BoxStore& store, Executor& executor) {
  const bool wasWhole = std::exchange(m_isWhole, false);
  const bool isListed = store.isNumbered() || (store.size() != 0 && store.size() <= kMostAlone);
  m_unlisted = isListed ? 0 : store.size();
  if (!isListed) {
    m_numbers.assign(1, 0);
    m_begin.clear();
    m_worldOf.clear();
    return;
  }
  if (!wasWhole || (m_membership != store.membership() && !follow(store))) list(store, executor);
  m_membership = store.membership();
  m_isWhole = true;
}

/// Lists all boxes.
void WorldMembers::list(const BoxStore& store, Executor& executor) {
  m_boxes.resize(store.size());
  m_worldOf.assign(store.idBound(), BoxHome::kNowhere);
  m_keyed.require(store.size());
  m_spare.require(store.size());
  const std::size_t own = listBoxes(store);
  std::uint32_t highest = 0;
  for (std::size_t i = 0; i < own; ++i) highest = std::max(highest, store.worldOf(indexOf(m_spare[i])));
  const unsigned bits = static_cast<unsigned>(std::bit_width(highest));
  m_radix.sort(m_spare.data(), m_keyed.data(), own, kIndexBits, kIndexBits + bits, executor);
  m_numbers.clear();
  m_begin.clear();
  for (std::size_t i = 0; i < own; ++i) {
    const auto number = static_cast<std::uint32_t>(m_keyed[i] >> kIndexBits);
    if (m_numbers.empty() || m_numbers.back() != number) {
      m_numbers.push_back(number);
      m_begin.push_back(i);
    }
    m_boxes[i] = indexOf(m_keyed[i]);
    m_worldOf[m_boxes[i]] = static_cast<std::uint32_t>(m_numbers.size() - 1);
  }
  m_begin.push_back(own);
  m_begin.push_back(store.size());
  for (std::size_t i = own; i < store.size(); ++i) m_worldOf[m_boxes[i]] = static_cast<std::uint32_t>(everyWorld());
}

/// Copies the lists without boxes that have gone and with those that have come, all of which have been touched since
/// the last step. Does nothing, and returns false, if they are many.
bool WorldMembers::follow(const BoxStore& store) {
  m_worldOf.resize(std::max(m_worldOf.size(), store.idBound()), BoxHome::kNowhere);
  m_keyed.require(store.touched().size());
  m_spare.require(store.touched().size());
  std::size_t gone = 0;
  std::size_t come = 0;
  for (const BoxId id : store.touched()) {
    const bool was = m_worldOf[id] != BoxHome::kNowhere;
    const std::uint32_t before = was ? numberOf(m_worldOf[id]) : 0;
    const std::uint32_t now = store.worldOf(id);
    const bool is = store.contains(id);
    if (was == is && (before == now || !is)) continue;
    if (was) m_keyed[gone++] = std::uint64_t{before} << kIndexBits | id;
    if (is) m_spare[come++] = std::uint64_t{now} << kIndexBits | id;
  }
  if ((gone + come) * kShareOfChange > store.size()) return false;
  std::sort(m_keyed.data(), m_keyed.data() + gone);
  std::sort(m_spare.data(), m_spare.data() + come);
  m_nextBoxes.resize(store.size());
  copyWorlds({m_keyed.data(), gone}, {m_spare.data(), come});
  return true;
}

void WorldMembers::copyWorlds(std::span<const std::uint64_t> gone, std::span<const std::uint64_t> come) {
  m_nextNumbers.clear();
  m_nextBegin.clear();
  for (const std::uint64_t key : gone) m_worldOf[indexOf(key)] = BoxHome::kNowhere;
  BoxId* to = m_nextBoxes.data();
  for (std::size_t old = 0; old <= everyWorld();) {
    const std::uint32_t next = numberOf(old);
    const auto number = come.empty() ? next : std::min(next, static_cast<std::uint32_t>(come.front() >> kIndexBits));
    const std::span<const BoxId> boxes = number == next ? this->boxes(old) : std::span<const BoxId>();
    const auto world = static_cast<std::uint32_t>(m_nextNumbers.size());
    const bool isMoved = number == next && old != world;
    old += number == next ? 1U : 0U;
    std::span<const std::uint64_t> leave = takeWorld(gone, number);
    std::span<const std::uint64_t> enter = takeWorld(come, number);
    BoxId* const begin = to;
    const BoxId* from = boxes.data();
    const BoxId* const end = from + boxes.size();
    while (!leave.empty() || !enter.empty()) {
      // Never in both: a box that is in the same world again has not gone.
      const bool isLeaving = enter.empty() || (!leave.empty() && leave.front() < enter.front());
      std::span<const std::uint64_t>& edits = isLeaving ? leave : enter;
      const BoxId id = indexOf(edits.front());
      const BoxId* const at = std::lower_bound(from, end, id);
      to = std::copy(from, at, to);
      from = at + (isLeaving ? 1 : 0);
      if (!isLeaving) *to++ = id;
      if (!isLeaving) m_worldOf[id] = world;
      edits = edits.subspan(1);
    }
    to = std::copy(from, end, to);
    if (number != kEveryWorld && to == begin) continue;
    m_nextBegin.push_back(static_cast<std::size_t>(begin - m_nextBoxes.data()));
    if (number != kEveryWorld) m_nextNumbers.push_back(number);
    if (isMoved) std::for_each(begin, to, [&](BoxId id) { m_worldOf[id] = world; });
  }
  m_nextBegin.push_back(m_nextBoxes.size());
  std::swap(m_numbers, m_nextNumbers);
  std::swap(m_begin, m_nextBegin);
  std::swap(m_boxes, m_nextBoxes);
}

/// Lists the boxes of one world each with their keys, and those of every world at the end of m_boxes; returns how many
/// there are of the former.
std::size_t WorldMembers::listBoxes(const BoxStore& store) {
  std::size_t own = 0;
  for (BoxId id = 0; id < store.idBound(); ++id) {
    if (!store.contains(id) || store.worldOf(id) == kEveryWorld) continue;
    m_spare[own++] = std::uint64_t{store.worldOf(id)} << kIndexBits | id;
  }
  std::size_t end = own;
  for (BoxId id = 0; end < store.size(); ++id) {
    if (store.contains(id) && store.worldOf(id) == kEveryWorld) m_boxes[end++] = id;
  }
  return own;
}

std::size_t WorldMembers::find(std::uint32_t number) const noexcept {
  if (number == kEveryWorld) return everyWorld();
  const auto at = std::lower_bound(m_numbers.begin(), m_numbers.end(), number);
  if (at == m_numbers.end() || *at != number) return everyWorld() + 1;
  return static_cast<std::size_t>(at - m_numbers.begin());
}

}  // namespace allpairs::engine
