// SPDX-License-Identifier: MIT
// Searches whose result is the partners of each box, in rows.
#include <algorithm>
#include <numeric>

#include "input/Parts.h"
#include "search/FewBoxes.h"
#include "search/Search.h"

namespace allpairs::engine {
namespace {

/// Writes rows [begin, end): the partners of each box that are less, from pairs by (second, first), then those that are
/// greater, from pairs by (first, second). Without the former these are rows of half the pairs.
void writeRows(std::size_t begin, std::size_t end, std::span<const Pair> firsts, std::span<const Pair> seconds,
               const NeighborsMemory& to) noexcept {
  const auto placeOf = [=](std::span<const Pair> pairs, std::uint32_t Pair::*box) {
    return std::partition_point(pairs.begin(), pairs.end(), [=](Pair pair) { return pair.*box < begin; });
  };
  auto first = placeOf(firsts, &Pair::first);
  auto second = placeOf(seconds, &Pair::second);
  auto at = static_cast<std::size_t>(first - firsts.begin() + (second - seconds.begin()));
  for (std::size_t row = begin; row < end; ++row) {
    to.offsets[row] = at;
    for (; second != seconds.end() && second->second == row; ++second) to.indices[at++] = second->first;
    for (; first != firsts.end() && first->first == row; ++first) to.indices[at++] = first->second;
  }
}

/// Writes each pair in both rows, in one pass over few pairs that are ordered by (first, second): there a box comes
/// second to all that are less before it comes first to those that are greater.
void writeBothRows(std::span<const Pair> pairs, const NeighborsMemory& to) noexcept {
  const std::span<std::uint64_t> offsets = to.offsets;
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
    to.indices[offsets[pair.first + std::size_t{1}]++] = pair.second;
    to.indices[offsets[pair.second + std::size_t{1}]++] = pair.first;
  }
}

}  // namespace

NeighborsView Search::findNeighbors(const Sets& sets, const OverlapOptions& options, NeighborRows kind,
                                    const RowRoom* room) {
  if (areFew(sets, options)) {
    findAmongFew(sets, options, Order::ByFirst);
    m_executor = &m_callExecutor.over(options.executor, options.stop);
    writePairsAsRows(sets, kind, room);
    return {m_rowsFound.offsets, m_rowsFound.indices};
  }
  Plan plan = planOf(sets, options, Order::ByFirst);
  if (!listRows(plan, kind, room) && (plan.job.flat || !bucketRows(plan, kind, room))) {
    run(plan);
    concatenate(nullptr);
    if (!plan.job.flat) sortPairs(plan);
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
  const bool isFull = kind == NeighborRows::Full;
  const std::size_t rows = sets.first.size();
  m_rowsFound = roomForRows(rows, (isFull ? 2 : 1) * m_pairs.size(), room);
  m_rowsFound.offsets.back() = m_rowsFound.indices.size();
  if (rows > kPartSize) {
    const std::span<const Pair> seconds = isFull ? pairsBySecond(rows) : std::span<const Pair>();
    runInParts(rows, kPartSize, *m_executor,
               [&](std::size_t begin, std::size_t end) { writeRows(begin, end, m_pairs, seconds, m_rowsFound); });
  } else if (isFull) {
    writeBothRows(m_pairs, m_rowsFound);
  } else {
    writeRows(0, rows, m_pairs, {}, m_rowsFound);
  }
  m_pairs = {};
}

/// The hierarchy is no longer needed: its memory is that of the copy, if there is enough, and the sort's.
std::span<const Pair> Search::pairsBySecond(std::size_t boxes) {
  const std::size_t size = m_pairs.size();
  const std::span<Pair> idle = m_first.levels().memory<Pair>();
  const bool fits = idle.size() >= 2 * size;
  if (!fits) m_bySecond.require(size);
  const std::span<Pair> copy(fits ? idle.data() : m_bySecond.data(), size);
  std::copy(m_pairs.begin(), m_pairs.end(), copy.begin());
  m_sort.sortList(copy, PairOrder(boxes, boxes, Order::BySecond), fits ? idle.subspan(size) : idle, *m_executor);
  return copy;
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
