// SPDX-License-Identifier: MIT
// Searches whose result is the partners of each box, in rows.
#include <algorithm>

#include "order/PairRows.h"
#include "search/FewBoxes.h"
#include "search/Search.h"

namespace allpairs::engine {

NeighborsView Search::findNeighbors(const Sets& sets, const OverlapOptions& options, NeighborRows kind,
                                    const RowRoom* room) {
  m_rowRoom = room;
  if (areFew(sets, options)) {
    findAmongFew(sets, options, Order::ByFirst);
    writePairsAsRows(sets, kind);
    return {m_rowsFound.offsets, m_rowsFound.indices};
  }
  begin(sets, options);
  Plan plan{PairTest::of(sets, options), Order::ByFirst};
  makePlan(sets, options, plan);
  if (!listRows(sets, kind, plan) && (plan.job.isFlat || !bucketRows(sets, kind, plan))) {
    run(plan, *m_executor);
    concatenate();
    if (!plan.job.isFlat) sortPairs(sets, plan.order);
    writePairsAsRows(sets, kind);
  }
  return {m_rowsFound.offsets, m_rowsFound.indices};
}

Neighbors Search::takeNeighbors(const Sets& sets, const OverlapOptions& options, NeighborRows kind) {
  Neighbors taken;
  const auto resized = [&](std::size_t rows, std::uint64_t indices) -> NeighborsMemory {
    taken.offsets.resize(rows + 1);
    taken.indices.resize(indices);
    return {taken.offsets, taken.indices};
  };
  const RowRoom room(resized);
  findNeighbors(sets, options, kind, &room);
  return taken;
}

NeighborsMemory Search::roomForRows(std::size_t rows, std::size_t indices) {
  if (m_rowRoom != nullptr) return (*m_rowRoom)(rows, indices);
  m_offsets.require(rows + 1);
  m_indices.require(indices);
  return {{m_offsets.data(), rows + 1}, {m_indices.data(), indices}};
}

void Search::writePairsAsRows(const Sets& sets, NeighborRows kind) {
  m_rowsFound = roomForRows(sets.first.size(), (kind == NeighborRows::Full ? 2 : 1) * m_pairs.size());
  writeRows(m_pairs, kind, m_rowsFound);
  m_pairs = {};
}

bool Search::listRows(const Sets& sets, NeighborRows kind, Plan& plan) {
  const Columns inOneSet = kind == NeighborRows::Full ? Columns::Others : Columns::Following;
  if (!listPartners(sets, plan, sets.one ? inOneSet : Columns::All)) return false;
  m_rowsFound = roomForRows(sets.first.size(), m_lists.size());
  m_lists.gather(m_rowsFound, *m_executor);
  return true;
}

bool Search::bucketRows(const Sets& sets, NeighborRows kind, Plan& plan) {
  const std::size_t rows = sets.first.size();
  const BucketRule rule(rows, sets.second.size(), Order::ByFirst);
  if (!fillBuckets(rule, plan, kind == NeighborRows::Full ? &PairBuckets::addBothWays : &PairBuckets::add)) {
    return false;
  }
  m_rowsFound = roomForRows(rows, m_places.back());
  m_rowsFound.offsets.back() = m_places.back();
  m_executor->run(rule.buckets, [&](std::size_t b) {
    const Bucket bucket{rule, b, m_buckets, *m_kernels};
    const std::size_t firstRow = bucket.firstKey();
    const NeighborsMemory place{m_rowsFound.offsets.subspan(firstRow, std::min(bucket.keys(), rows - firstRow)),
                                m_rowsFound.indices.subspan(m_places[b], m_places[b + 1] - m_places[b])};
    m_runner.withScratch(scratchToList(bucket),
                         [&](std::span<std::uint32_t> scratch) { listBucket(bucket, place, m_places[b], scratch); });
  });
  return true;
}

}  // namespace allpairs::engine
