// SPDX-License-Identifier: MIT
#include "world/WorldQueries.h"

#include <algorithm>
#include <tuple>

#include "world/QueryTests.h"

namespace allpairs::engine {

bool WorldQueries::looksAt(BoxId id, const QueryFilter& filter) const noexcept {
  if (!m_store->contains(id)) return false;
  const FilterRow& row = m_store->filter(id);
  return (row.category & filter.mask) != 0 && (row.mask & filter.category) != 0 &&
         (m_store->isStatic(id) ? filter.staticBoxes : filter.dynamicBoxes);
}

ResultLists<BoxId> WorldQueries::findOverlapping(const BoxSet& boxes, const QueryFilter& filter) {
  m_boxes.clear();
  m_boxOffsets.assign(1, 0);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (BoxId id = 0; id < m_store->idBound(); ++id) {
      if (looksAt(id, filter) && overlap(m_store->box(id), boxes[i], m_store->margin(id))) m_boxes.push_back(id);
    }
    m_boxOffsets.push_back(m_boxes.size());
  }
  return {m_boxOffsets, m_boxes};
}

void WorldQueries::findFirst(std::span<const BoxSweep> sweeps, std::span<SweepHit> hits, const QueryFilter& filter) {
  const ResultLists<SweepHit> all = findAll(sweeps, filter);
  for (std::size_t i = 0; i < sweeps.size(); ++i) hits[i] = all[i].empty() ? SweepHit{} : all[i].front();
}

ResultLists<SweepHit> WorldQueries::findAll(std::span<const BoxSweep> sweeps, const QueryFilter& filter) {
  m_hits.clear();
  m_hitOffsets.assign(1, 0);
  for (const BoxSweep& sweep : sweeps) {
    const std::size_t begin = m_hits.size();
    for (BoxId id = 0; id < m_store->idBound(); ++id) {
      if (!looksAt(id, filter) || isEmpty(m_store->box(id)) || isEmpty(sweep.box)) continue;
      const double t = meetingTime(sweep, widened(m_store->box(id), m_store->margin(id)));
      if (t < kFar) m_hits.push_back({id, t});
    }
    std::sort(m_hits.begin() + static_cast<std::ptrdiff_t>(begin), m_hits.end(),
              [](const SweepHit& a, const SweepHit& b) { return std::tie(a.t, a.id) < std::tie(b.t, b.id); });
    m_hitOffsets.push_back(m_hits.size());
  }
  return {m_hitOffsets, m_hits};
}

ResultLists<Neighbor> WorldQueries::findNearest(std::span<const std::array<double, 3>> points, std::size_t count,
                                                const QueryFilter& filter) {
  m_neighbors.clear();
  m_neighborOffsets.assign(1, 0);
  for (const std::array<double, 3>& point : points) {
    const std::size_t begin = m_neighbors.size();
    for (BoxId id = 0; id < m_store->idBound(); ++id) {
      if (!looksAt(id, filter) || isEmpty(m_store->box(id))) continue;
      m_neighbors.push_back({id, distanceFrom(point, widened(m_store->box(id), m_store->margin(id)))});
    }
    std::sort(
        m_neighbors.begin() + static_cast<std::ptrdiff_t>(begin), m_neighbors.end(),
        [](const Neighbor& a, const Neighbor& b) { return std::tie(a.distance, a.id) < std::tie(b.distance, b.id); });
    m_neighbors.resize(begin + std::min(count, m_neighbors.size() - begin));
    m_neighborOffsets.push_back(m_neighbors.size());
  }
  return {m_neighborOffsets, m_neighbors};
}

}  // namespace allpairs::engine
