// SPDX-License-Identifier: MIT
#include "CellJoin.h"

#include <algorithm>

namespace allpairs::join {
CellJoin::CellJoin(const BoxSpill& spill, const partition::Partition& cells, std::size_t most,
                   const OverlapOptions& options)
    : m_spill(spill), m_cells(cells), m_type(spill.type()), m_most(std::max<std::size_t>(most, 2)), m_search(options) {
  std::uint64_t needed = 0;
  const std::uint64_t wide = spill.extents().back().count;
  for (const Extent& extent : spill.extents()) needed = std::max(needed, extent.count + wide);
  m_capacity = static_cast<std::size_t>(std::min<std::uint64_t>(needed, m_most));
  m_words = std::make_unique_for_overwrite<std::uint64_t[]>(m_capacity * m_type.words());
}

Records CellJoin::room(std::size_t begin, std::uint64_t count) {
  return {m_type, {m_words.get() + begin * m_type.words(), static_cast<std::size_t>(count) * m_type.words()}};
}

void CellJoin::search(std::size_t task, Receiver receive) {
  const bool isWide = task == m_cells.size();
  const partition::Cell cell = isWide ? partition::Cell() : m_cells.cell(task);
  searchWithin(task, cell, receive);
  if (!isWide) searchBetween(task, cell, receive);
}

void CellJoin::searchWithin(std::size_t part, const partition::Cell& cell, Receiver receive) {
  const std::uint64_t count = m_spill.extents()[part].count;
  const std::uint64_t step = count <= m_most ? count : m_most / 2;
  for (std::uint64_t begin = 0; begin < count; begin += step) {
    const Records own = room(0, std::min(step, count - begin));
    m_spill.read(part, begin, own);
    m_search.stream(own.boxes(), cell, [&](std::span<const Pair> pairs) { receive(pairs, own, own); });
    for (std::uint64_t next = begin + step; next < count; next += step) {
      const Records other = room(own.size(), std::min(step, count - next));
      m_spill.read(part, next, other);
      m_search.stream(own.boxes(), other.boxes(), cell,
                      [&](std::span<const Pair> pairs) { receive(pairs, own, other); });
    }
  }
}

/// Own boxes take at most half of the room.
void CellJoin::searchBetween(std::size_t part, const partition::Cell& cell, Receiver receive) {
  const std::uint64_t count = m_spill.extents()[part].count;
  const std::uint64_t wide = m_spill.extents().back().count;
  if (wide == 0) return;
  const std::uint64_t step = count + wide <= m_most ? count : m_most / 2;
  for (std::uint64_t begin = 0; begin < count; begin += step) {
    const Records own = room(0, std::min(step, count - begin));
    m_spill.read(part, begin, own);
    searchWithWide(own, m_most - own.size(), cell, receive);
  }
}

void CellJoin::searchWithWide(const Records& own, std::size_t room, const partition::Cell& cell, Receiver receive) {
  const std::size_t wide = m_spill.extents().size() - 1;
  const std::uint64_t count = m_spill.extents()[wide].count;
  for (std::uint64_t begin = 0; begin < count; begin += room) {
    const Records others = this->room(own.size(), std::min<std::uint64_t>(room, count - begin));
    m_spill.read(wide, begin, others);
    m_search.stream(own.boxes(), others.boxes(), cell,
                    [&](std::span<const Pair> pairs) { receive(pairs, own, others); });
  }
}

}  // namespace allpairs::join
