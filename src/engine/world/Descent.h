// SPDX-License-Identifier: MIT
// Ways down a hierarchy.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "Join.h"
#include "Lanes.h"
#include "allpairs/Box.h"
#include "allpairs/WorldTypes.h"

namespace allpairs::engine {

/// A box at which a descent has arrived.
struct Arrival {
  BoxId id = kNoBox;
  const LaneBlock& block;
  std::size_t lane = 0;

  /// The bounds that the lane holds, in double.
  [[nodiscard]] Box lanes() const noexcept {
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = static_cast<double>(block.bound[axis][lane]);
      box.max[axis] = static_cast<double>(block.bound[axis + 3][lane]);
    }
    return box;
  }
};

/// Calls take(arrival) for all boxes that may be met, where lanesOf(block) has a bit for each lane that may be.
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
    const LaneBlock& lanes = m_hierarchy.level[level].blocks[block];
    for (std::uint32_t bits = m_lanesOf(lanes); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      const std::size_t child = block * kFanOut + lane;
      if (level == 0) {
        m_take(Arrival{m_hierarchy.ids[child], lanes, lane});
      } else {
        descend(level - 1, child);
      }
    }
  }

  const Hierarchy& m_hierarchy;
  const LanesOf& m_lanesOf;
  const Take& m_take;
};

/// Calls take(arrival) for the boxes in about the order of a cost, as far as it is within a limit that take() may lower.
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
  /// The cheapest of some lanes. Most often few are visited before the limit excludes the rest: sorting all takes longer.
  static std::size_t cheapest(std::uint32_t bits, const std::array<float, kFanOut>& costs) {
    auto best = static_cast<std::size_t>(std::countr_zero(bits));
    for (bits &= bits - 1; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      best = costs[lane] < costs[best] ? lane : best;
    }
    return best;
  }

  // Depth is at most kMaxLevels, whatever the input.
  // NOLINTNEXTLINE(misc-no-recursion)
  void descend(std::size_t level, std::size_t block) const {
    std::array<float, kFanOut> costs;
    const LaneBlock& lanes = m_hierarchy.level[level].blocks[block];
    std::uint32_t bits = m_lanesOf(lanes, costs.data());
    while (bits != 0) {
      const std::size_t lane = cheapest(bits, costs);
      if (costs[lane] > m_limit) return;
      bits &= ~(1U << lane);
      const std::size_t child = block * kFanOut + lane;
      if (level == 0) {
        m_take(Arrival{m_hierarchy.ids[child], lanes, lane});
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
