// SPDX-License-Identifier: MIT
// Searches whose result is the partners of each box, in rows.
#include <algorithm>
#include <numeric>

#include "search/FewBoxes.h"
#include "search/Search.h"

namespace allpairs::engine {
namespace {

/// Writes pairs that are ordered by (first, second) as rows, in memory for exactly these.
void writeHalfRows(std::span<const Pair> pairs, const NeighborsMemory& place) noexcept {
  std::size_t row = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (; row <= pairs[i].first; ++row) place.offsets[row] = i;
    place.indices[i] = pairs[i].second;
  }
  std::fill(place.offsets.begin() + static_cast<std::ptrdiff_t>(row), place.offsets.end(), pairs.size());
}

/// The same with each pair in both rows. In the order of the pairs a box comes second to all that are less before it
/// comes first to those that are greater: what is appended to its row ascends.
void writeFullRows(std::span<const Pair> pairs, const NeighborsMemory& place) noexcept {
  const std::span<std::uint64_t> offsets = place.offsets;
  std::fill(offsets.begin(), offsets.end(), 0);
  // Only sums of what stands before stay between a row's offset and the next but one: the latter counts.
  const auto count = [&](std::size_t row) {
    if (row + 2 < offsets.size()) ++offsets[row + 2];
  };
  for (const Pair pair : pairs) {
    count(pair.first);
    count(pair.second);
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  for (const Pair pair : pairs) {
    place.indices[offsets[pair.first + std::size_t{1}]++] = pair.second;
    place.indices[offsets[pair.second + std::size_t{1}]++] = pair.first;
  }
}

}  // namespace

NeighborsView Search::findNeighbors(const Sets& sets, const OverlapOptions& options, NeighborRows kind,
                                    const RowRoom* room) {
  if (areFew(sets, options)) {
    findAmongFew(sets, options, Order::ByFirst);
    writePairsAsRows(sets, kind, room);
    return {m_rowsFound.offsets, m_rowsFound.indices};
  }
  Plan plan = planOf(sets, options, Order::ByFirst);
  if (!listRows(plan, kind, room) && (plan.job.isFlat || !bucketRows(plan, kind, room))) {
    run(plan, *m_executor);
    concatenate(nullptr);
    if (!plan.job.isFlat) sortPairs(plan);
    writePairsAsRows(sets, kind, room);
  }
  return {m_rowsFound.offsets, m_rowsFound.indices};
}

Neighbors Search::takeNeighbors(const Sets& sets, const OverlapOptions& options, NeighborRows kind) {
  Neighbors taken;
  const auto resized = [&](std::size_t rows, std::uint64_t indices) -> NeighborsMemory {
    reserve(taken.offsets, rows + 1);
    reserve(taken.indices, indices);
    taken.offsets.resize(rows + 1);
    taken.indices.resize(indices);
    return {taken.offsets, taken.indices};
  };
  const RowRoom room(resized);
  findNeighbors(sets, options, kind, &room);
  return taken;
}

NeighborsMemory Search::roomForRows(std::size_t rows, std::size_t indices, const RowRoom* room) {
  if (room != nullptr) return (*room)(rows, indices);
  m_offsets.require(rows + 1);
  m_indices.require(indices);
  return {{m_offsets.data(), rows + 1}, {m_indices.data(), indices}};
}

void Search::writePairsAsRows(const Sets& sets, NeighborRows kind, const RowRoom* room) {
  m_rowsFound = roomForRows(sets.first.size(), (kind == NeighborRows::Full ? 2 : 1) * m_pairs.size(), room);
  kind == NeighborRows::Full ? writeFullRows(m_pairs, m_rowsFound) : writeHalfRows(m_pairs, m_rowsFound);
  m_pairs = {};
}

bool Search::listRows(Plan& plan, NeighborRows kind, const RowRoom* room) {
  const Columns inOneSet = kind == NeighborRows::Full ? Columns::Others : Columns::Following;
  if (!listPartners(plan, plan.sets.one ? inOneSet : Columns::All)) return false;
  m_rowsFound = roomForRows(plan.sets.first.size(), m_lists.size(), room);
  m_lists.gather(m_rowsFound, *m_executor);
  return true;
}

bool Search::bucketRows(Plan& plan, NeighborRows kind, const RowRoom* room) {
  const bool isFull = kind == NeighborRows::Full;
  if (!fillBuckets(plan, isFull ? &PairBuckets::addBothWays : &PairBuckets::add)) return false;
  m_rowsFound = roomForRows(plan.sets.first.size(), (isFull ? 2 : 1) * m_statistics.pairs, room);
  m_sort.list(m_rowsFound, *m_executor, m_runner);
  return true;
}

}  // namespace allpairs::engine
