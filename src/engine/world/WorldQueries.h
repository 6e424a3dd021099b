// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "allpairs/WorldTypes.h"
#include "world/BoxStore.h"

namespace allpairs::engine {

/// Queries against the boxes of a world, and the memory of their results.
class WorldQueries {
 public:
  /// Queries look at these boxes until the next call.
  void lookAt(const BoxStore& store) { m_store = &store; }

  ResultLists<BoxId> findOverlapping(const BoxSet& boxes, const QueryFilter& filter);
  void findFirst(std::span<const BoxSweep> sweeps, std::span<SweepHit> hits, const QueryFilter& filter);
  ResultLists<SweepHit> findAll(std::span<const BoxSweep> sweeps, const QueryFilter& filter);
  ResultLists<Neighbor> findNearest(std::span<const std::array<double, 3>> points, std::size_t count,
                                    const QueryFilter& filter);

 private:
  [[nodiscard]] bool looksAt(BoxId id, const QueryFilter& filter) const noexcept;

  const BoxStore* m_store = nullptr;
  std::vector<std::size_t> m_boxOffsets;
  std::vector<BoxId> m_boxes;
  std::vector<std::size_t> m_hitOffsets;
  std::vector<SweepHit> m_hits;
  std::vector<std::size_t> m_neighborOffsets;
  std::vector<Neighbor> m_neighbors;
};

}  // namespace allpairs::engine
