// SPDX-License-Identifier: MIT
// How queries descend a hierarchy: alone, with others, or to what is cheapest first.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>

#include "allpairs/Pair.h"
#include "allpairs/StopFlag.h"
#include "kernels/Kernels.h"
#include "kernels/Lanes.h"

namespace allpairs::engine {

/// Boxes that descend a hierarchy together, and visits of blocks that one call of a kernel makes: as many boxes are
/// tested between two looks at the flag as when one query descends.
inline constexpr std::size_t kTogether = 16;

/// A hierarchy that a query descends, and the flag that ends it.
struct QueryTree {
  const BvhView& view;
  bool isExact;  ///< Whether lanes are the boxes.
  const Kernels& kernels;
  const StopFlag* stop;

  /// Before a block of a level, so that two looks have 256 boxes between them at most.
  void look(std::size_t level) const {
    if (level == 1) checkStop(stop);
  }
};

/// Calls take(id, lanes) for all candidate boxes; lanesOf(block) has a bit for each candidate lane.
template <class LanesOf, class Take>
void descend(const QueryTree& tree, const LanesOf& lanesOf, const Take& take) {
  const BvhView& view = tree.view;
  // As deep as there are levels, at most kMaxLevels.
  const auto visit = [&](const auto& self, std::size_t level, std::size_t block) -> void {
    tree.look(level);
    const LaneBlock& lanes = view.level[level].blocks[block];
    forEachBit(lanesOf(lanes), [&](std::size_t lane) {
      const std::size_t child = block * kFanOut + lane;
      level == 0 ? take(view.ids[child], lanes.get(lane)) : self(self, level - 1, child);
    });
  };
  visit(visit, view.depth - 1, 0);
}

/// Calls take(number of the box, id) for all candidates of at most kTogether boxes, which descend a level at a time and
/// some visits at a time: memory stays small, and all hits of one box come before those of the next.
template <class Take>
void descendTogether(const QueryTree& tree, std::span<const LaneBox> boxes, const Take& take) {
  // As deep as there are levels, at most kMaxLevels.
  const auto visit = [&](const auto& self, std::size_t level, BlockVisits visits) -> void {
    // What the visits find; not initialised.
    std::array<std::uint32_t, kTogether * kFanOut + kVectorSlack> boxOf;
    std::array<std::uint32_t, kTogether * kFanOut + kVectorSlack> places;
    if (level == 0) checkStop(tree.stop);
    visits.blocks = tree.view.level[level].blocks;
    const std::size_t size = tree.kernels.touchingPlaces(visits, boxOf.data(), places.data());
    if (level == 0) {
      for (std::size_t i = 0; i < size; ++i) take(boxOf[i], tree.view.ids[places[i]]);
      return;
    }
    for (std::size_t i = 0; i < size; i += kTogether) {
      self(self, level - 1, {visits.boxes, nullptr, &boxOf[i], &places[i], std::min(size - i, kTogether)});
    }
  };
  std::array<std::uint32_t, kTogether> boxOf;
  std::iota(boxOf.begin(), boxOf.end(), 0U);
  const std::array<std::uint32_t, kTogether> root{};
  visit(visit, tree.view.depth - 1, {boxes.data(), nullptr, boxOf.data(), root.data(), boxes.size()});
}

/// The cheapest of some lanes. Up to four, looking at one after the other takes no longer than a call (query_benchmark).
inline std::size_t cheapestLane(std::uint32_t bits, const std::array<float, kFanOut>& costs, const Kernels& kernels) {
  const auto withoutFirst = [](std::uint32_t some) { return some & (some - 1); };
  std::uint32_t others = withoutFirst(bits);
  if (withoutFirst(withoutFirst(withoutFirst(others))) != 0) return kernels.cheapestLane(bits, costs.data());
  auto best = static_cast<std::size_t>(std::countr_zero(bits));
  for (; others != 0; others = withoutFirst(others)) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(others));
    best = costs[lane] < costs[best] ? lane : best;
  }
  return best;
}

/// Calls take(id, lanes) for boxes in approximate order of cost, up to a limit that take() may lower.
///
/// lanesOf(block, costs) has a bit for each lane of a block that may be within the limit, and writes the costs of the
/// lanes: lower bounds of the costs of their boxes, and not negative.
template <class LanesOf, class Take>
void descendByCost(const QueryTree& tree, const LanesOf& lanesOf, const float& limit, const Take& take) {
  const BvhView& view = tree.view;
  const auto visit = [&](const auto& self, std::size_t level, std::size_t block) -> void {
    tree.look(level);
    std::array<float, kFanOut> costs;
    const LaneBlock& lanes = view.level[level].blocks[block];
    std::uint32_t bits = lanesOf(lanes, costs.data());
    while (bits != 0) {
      const std::size_t lane = cheapestLane(bits, costs, tree.kernels);
      if (costs[lane] > limit) return;
      bits &= ~(1U << lane);
      const std::size_t child = block * kFanOut + lane;
      level == 0 ? take(view.ids[child], lanes.get(lane)) : self(self, level - 1, child);
    }
  };
  visit(visit, view.depth - 1, 0);
}

}  // namespace allpairs::engine
