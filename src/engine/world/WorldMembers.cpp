// SPDX-License-Identifier: MIT
#include "world/WorldMembers.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "bvh/CurveKey.h"

namespace allpairs::engine {

void WorldMembers::update(const BoxStore& store, Executor& executor) {
  if (std::exchange(m_isWhole, false) && m_membership == store.membership()) {
    m_isWhole = true;
    return;
  }
  m_membership = store.membership();
  m_boxes.resize(store.size());
  m_worldOf.resize(store.idBound());
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
  m_isWhole = true;
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
