// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "allpairs/Worlds.h"
#include "memory/Memory.h"
#include "search/Search.h"
#include "worlds/WorldsFilter.h"

namespace allpairs::engine {

/// Searches the boxes of many worlds against boxes that are in every world: all of them at once, since it does not
/// matter for such a pair which world a box is of.
class SharedSearcher {
 public:
  explicit SharedSearcher(std::pmr::memory_resource* memory)
      : m_search(memory), m_categories(memory), m_masks(memory), m_groups(memory), m_pairs(memory), m_begin(memory) {}

  WorldPairsView find(const Worlds& worlds, const BoxView& shared, const OverlapOptions& options);
  std::span<const std::uint64_t> count(const Worlds& worlds, const BoxView& shared, const OverlapOptions& options);

  [[nodiscard]] const OverlapStatistics& statistics() const noexcept { return m_search.statistics(); }

 private:
  using Values = std::pmr::vector<std::uint32_t>;

  [[nodiscard]] OverlapOptions optionsForAll(const Worlds& worlds, const OverlapOptions& options);

  Search m_search;
  Values m_categories;  ///< Filters that were given for one world, for all.
  Values m_masks;
  Values m_groups;
  Buffer<Pair> m_pairs;
  std::pmr::vector<std::uint64_t> m_begin;
};

}  // namespace allpairs::engine
