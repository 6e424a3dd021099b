// SPDX-License-Identifier: MIT
#include "CellJoin.h"

#include <algorithm>

namespace allpairs::join {

CellJoin::CellJoin(const BoxSpill& spill, const partition::Partition& cells, std::size_t most,
                   const OverlapOptions& options)
    : m_spill(spill), m_cells(cells), m_type(spill.type()), m_most(std::max<std::size_t>(most, 2)), m_search(options) {
  const std::size_t tasks = cells.size() + 1;
  m_sets = spill.extents().size() / tasks;
  std::uint64_t needed = 0;
  for (std::size_t task = 0; task < tasks; ++task) {
    std::uint64_t boxes = 0;
    for (std::size_t set = 0; set < m_sets; ++set) boxes += countOf(partOf(cells, set, task)) + countOf(wide(set));
    needed = std::max(needed, boxes);
  }
  m_room.emplace(m_type, static_cast<std::size_t>(std::min<std::uint64_t>(needed, m_most)));
}

/// Pairs of a box of the first records and one of the second.
void CellJoin::stream(const Records& first, const Records& second, const partition::Cell& cell, Receiver receive) {
  if (m_type.labels() != 0) m_search.setFilter({.first = first.bits(), .second = second.bits()});
  m_search.stream(first.boxes(), second.boxes(), cell,
                  [&](std::span<const Pair> pairs) { receive(pairs, first, second); });
}

/// Those of them whose first box has the lower number.
void CellJoin::streamUpwards(const Records& first, const Records& second, const partition::Cell& cell,
                             Receiver receive) {
  const auto keep = [&](std::span<const Pair> pairs, const Records&, const Records&) {
    m_kept.clear();
    for (const Pair pair : pairs) {
      if (first.id(pair.first) < second.id(pair.second)) m_kept.push_back(pair);
    }
    if (!m_kept.empty()) receive(m_kept, first, second);
  };
  stream(first, second, cell, keep);
}

void CellJoin::search(std::size_t task, Receiver receive) {
  const bool isWide = task == m_cells.size();
  const partition::Cell cell = isWide ? partition::Cell() : m_cells.cell(task);
  if (m_sets == 1) {
    searchWithin(task, cell, receive);
    if (!isWide) searchBetween(task, wide(0), cell, receive);
    return;
  }
  const std::size_t second = partOf(m_cells, 1, task);
  searchBetween(task, second, cell, receive);
  if (isWide) return;
  searchBetween(task, wide(1), cell, receive);
  searchBetween(wide(0), second, cell, receive);
}

void CellJoin::searchWithin(std::size_t part, const partition::Cell& cell, Receiver receive) {
  const std::uint64_t count = countOf(part);
  const std::uint64_t step = count <= m_most ? count : m_most / 2;
  for (std::uint64_t begin = 0; begin < count; begin += step) {
    const Records own = room(0, std::min(step, count - begin));
    m_spill.read(part, begin, own);
    if (m_type.labels() != 0) m_search.setFilter({.first = own.bits()});
    m_search.stream(own.boxes(), cell, [&](std::span<const Pair> pairs) { receive(pairs, own, own); });
    for (std::uint64_t next = begin + step; next < count; next += step) {
      const Records other = room(own.size(), std::min(step, count - next));
      m_spill.read(part, next, other);
      stream(own, other, cell, receive);
    }
  }
}

/// Boxes of the first part take half of the room, or what the second leaves where that is more.
void CellJoin::searchBetween(std::size_t first, std::size_t second, const partition::Cell& cell, Receiver receive) {
  const std::uint64_t count = countOf(first);
  const std::uint64_t others = countOf(second);
  if (others == 0) return;
  const std::uint64_t step = std::max<std::uint64_t>(m_most / 2, others < m_most ? m_most - others : 0);
  for (std::uint64_t begin = 0; begin < count; begin += step) {
    const Records own = room(0, std::min(step, count - begin));
    m_spill.read(first, begin, own);
    searchWithPart(own, second, cell, receive);
  }
}

void CellJoin::searchWithPart(const Records& own, std::size_t part, const partition::Cell& cell, Receiver receive) {
  const std::uint64_t count = countOf(part);
  const std::uint64_t step = m_most - own.size();
  for (std::uint64_t begin = 0; begin < count; begin += step) {
    const Records others = room(own.size(), std::min(step, count - begin));
    m_spill.read(part, begin, others);
    if (m_sets == 1 && m_type.hasMargins) {  // margins are added in the order of the numbers
      streamUpwards(own, others, cell, receive);
      streamUpwards(others, own, cell, receive);
    } else {
      stream(own, others, cell, receive);
    }
  }
}

}  // namespace allpairs::join
