// SPDX-License-Identifier: MIT
// Ways down a hierarchy.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "Join.h"
#include "Lanes.h"

namespace allpairs::engine {

/// Calls take(id) for all boxes that may be met, where lanesOf(block) has a bit for each lane of a block that may be.
template <class LanesOf, class Take>
class Descent {
 public:
  Descent(const Hierarchy& hierarchy, const LanesOf& lanesOf, const Take& take)
      : m_hierarchy(hierarchy), m_lanesOf(lanesOf), m_take(take) {}

  void run() const { descend(m_hierarchy.depth - 1, 0); }

 private:
  // Depth is at most kMaxLevels, whatever the input.
  // NOLINTNEXTLINE(misc-no-recursion)
  void descend(std::size_t level, std::size_t block) const {
    for (std::uint32_t bits = m_lanesOf(m_hierarchy.level[level].blocks[block]); bits != 0; bits &= bits - 1) {
      const std::size_t child = block * kFanOut + static_cast<std::size_t>(std::countr_zero(bits));
      if (level == 0) {
        m_take(m_hierarchy.ids[child]);
      } else {
        descend(level - 1, child);
      }
    }
  }

  const Hierarchy& m_hierarchy;
  const LanesOf& m_lanesOf;
  const Take& m_take;
};

/// Calls take(id) for the boxes in about the order of a cost, as far as it is within a limit that take() may lower.
///
/// lanesOf(block, costs) has a bit for each lane of a block that may be within the limit, and writes the costs of the
/// lanes: no more than those of whatever they hold, and not negative.
template <class LanesOf, class Take>
class CheapestDescent {
 public:
  CheapestDescent(const Hierarchy& hierarchy, const LanesOf& lanesOf, const float& limit, const Take& take)
      : m_hierarchy(hierarchy), m_lanesOf(lanesOf), m_limit(limit), m_take(take) {}

  void run() const { descend(m_hierarchy.depth - 1, 0); }

 private:
  /// Lanes by their costs: floats that are not negative compare as their bits do, and the lane is below them.
  struct Children {
    std::array<std::uint64_t, kFanOut> sorted;
    std::size_t count = 0;

    void insert(float cost, std::uint64_t lane) {
      const std::uint64_t key = std::uint64_t{std::bit_cast<std::uint32_t>(cost)} << 32U | lane;
      std::size_t i = count++;
      for (; i > 0 && sorted[i - 1] > key; --i) sorted[i] = sorted[i - 1];
      sorted[i] = key;
    }
    [[nodiscard]] float cost(std::size_t i) const {
      return std::bit_cast<float>(static_cast<std::uint32_t>(sorted[i] >> 32U));
    }
    [[nodiscard]] std::size_t lane(std::size_t i) const { return sorted[i] & 0xFFU; }
  };

  // Depth is at most kMaxLevels, whatever the input.
  // NOLINTNEXTLINE(misc-no-recursion)
  void descend(std::size_t level, std::size_t block) const {
    std::array<float, kFanOut> costs;
    Children children;
    for (std::uint32_t bits = m_lanesOf(m_hierarchy.level[level].blocks[block], costs.data()); bits != 0;
         bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      children.insert(costs[lane], lane);
    }
    for (std::size_t i = 0; i < children.count && children.cost(i) <= m_limit; ++i) {
      const std::size_t child = block * kFanOut + children.lane(i);
      if (level == 0) {
        m_take(m_hierarchy.ids[child]);
      } else {
        descend(level - 1, child);
      }
    }
  }

  const Hierarchy& m_hierarchy;
  const LanesOf& m_lanesOf;
  const float& m_limit;
  const Take& m_take;
};

}  // namespace allpairs::engine
