// SPDX-License-Identifier: MIT
// Descents of a hierarchy.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernels/Lanes.h"

namespace allpairs::engine {

/// Calls take(id, lanes) for all candidate boxes; lanesOf(block) has a bit for each candidate lane.
template <class LanesOf, class Take>
void descend(const BvhView& view, const LanesOf& lanesOf, const Take& take) {
  // As deep as there are levels, at most kMaxLevels.
  const auto visit = [&](const auto& self, std::size_t level, std::size_t block) -> void {
    const LaneBlock& lanes = view.level[level].blocks[block];
    for (std::uint32_t bits = lanesOf(lanes); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      const std::size_t child = block * kFanOut + lane;
      level == 0 ? take(view.ids[child], lanes.get(lane)) : self(self, level - 1, child);
    }
  };
  visit(visit, view.depth - 1, 0);
}

/// The cheapest of some lanes. Most often few are visited before the limit excludes the rest: sorting all takes longer.
[[nodiscard]] inline std::size_t cheapestLane(std::uint32_t bits, const std::array<float, kFanOut>& costs) noexcept {
  auto best = static_cast<std::size_t>(std::countr_zero(bits));
  for (bits &= bits - 1; bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    best = costs[lane] < costs[best] ? lane : best;
  }
  return best;
}

/// Calls take(id, lanes) for boxes in approximate order of cost, up to a limit that take() may lower.
///
/// lanesOf(block, costs) has a bit for each lane of a block that may be within the limit, and writes the costs of the
/// lanes: lower bounds of the costs of their boxes, and not negative.
template <class LanesOf, class Take>
void descendByCost(const BvhView& view, const LanesOf& lanesOf, const float& limit, const Take& take) {
  const auto visit = [&](const auto& self, std::size_t level, std::size_t block) -> void {
    std::array<float, kFanOut> costs;
    const LaneBlock& lanes = view.level[level].blocks[block];
    std::uint32_t bits = lanesOf(lanes, costs.data());
    while (bits != 0) {
      const std::size_t lane = cheapestLane(bits, costs);
      if (costs[lane] > limit) return;
      bits &= ~(1U << lane);
      const std::size_t child = block * kFanOut + lane;
      level == 0 ? take(view.ids[child], lanes.get(lane)) : self(self, level - 1, child);
    }
  };
  visit(visit, view.depth - 1, 0);
}

}  // namespace allpairs::engine
