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
#include "world/QueryTests.h"

namespace allpairs::engine {

/// A bit for each lane of the block that touches the query.
[[nodiscard]] inline std::uint32_t touchingLanes(const LaneBlock& block, const LaneBox& query) noexcept {
  std::array<std::uint8_t, kFanOut> touches;
  touches.fill(1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t lane = 0; lane < kFanOut; ++lane) {
      touches[lane] &= static_cast<std::uint8_t>((block.bound[axis][lane] <= query.bound[axis + 3]) &
                                                 (query.bound[axis] <= block.bound[axis + 3][lane]));
    }
  }
  std::uint32_t mask = 0;
  for (std::size_t lane = 0; lane < kFanOut; ++lane) mask |= std::uint32_t{touches[lane]} << lane;
  return mask;
}

/// Calls take(id) for all boxes whose lanes touch the query.
template <class Take>
class TouchingDescent {
 public:
  TouchingDescent(const Hierarchy& hierarchy, const LaneBox& query, const Take& take)
      : m_hierarchy(hierarchy), m_query(query), m_take(take) {}

  void run() const { descend(m_hierarchy.depth - 1, 0); }

 private:
  // Depth is at most kMaxLevels, whatever the input.
  // NOLINTNEXTLINE(misc-no-recursion)
  void descend(std::size_t level, std::size_t block) const {
    for (std::uint32_t mask = touchingLanes(m_hierarchy.level[level].blocks[block], m_query); mask != 0;
         mask &= mask - 1) {
      const std::size_t child = block * kFanOut + static_cast<std::size_t>(std::countr_zero(mask));
      if (level == 0) {
        m_take(m_hierarchy.ids[child]);
      } else {
        descend(level - 1, child);
      }
    }
  }

  const Hierarchy& m_hierarchy;
  const LaneBox& m_query;
  const Take& m_take;
};

/// Calls take(id) for the boxes in about the order of a cost, as far as it is within a limit that take() may lower.
///
/// cost(box) is no greater for a box that holds another one; infinity means never.
template <class Cost, class Take>
class CheapestDescent {
 public:
  CheapestDescent(const Hierarchy& hierarchy, const Cost& cost, const double& limit, const Take& take)
      : m_hierarchy(hierarchy), m_cost(cost), m_limit(limit), m_take(take) {}

  void run() const { descend(m_hierarchy.depth - 1, 0); }

 private:
  struct Child {
    double cost;
    std::uint32_t lane;
  };

  // Depth is at most kMaxLevels, whatever the input.
  // NOLINTNEXTLINE(misc-no-recursion)
  void descend(std::size_t level, std::size_t block) const {
    std::array<Child, kFanOut> children;
    std::size_t count = 0;
    const LaneBlock& lanes = m_hierarchy.level[level].blocks[block];
    for (std::uint32_t lane = 0; lane < kFanOut; ++lane) {
      const double cost = m_cost(unbounded(lanes.get(lane)));
      if (cost < kFar && cost <= m_limit) children[count++] = {cost, lane};
    }
    std::sort(children.begin(), children.begin() + static_cast<std::ptrdiff_t>(count),
              [](const Child& a, const Child& b) { return a.cost < b.cost || (a.cost == b.cost && a.lane < b.lane); });
    for (std::size_t i = 0; i < count && children[i].cost <= m_limit; ++i) {
      const std::size_t child = block * kFanOut + children[i].lane;
      if (level == 0) {
        m_take(m_hierarchy.ids[child]);
      } else {
        descend(level - 1, child);
      }
    }
  }

  const Hierarchy& m_hierarchy;
  const Cost& m_cost;
  const double& m_limit;
  const Take& m_take;
};

}  // namespace allpairs::engine
