// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "BoxSpill.h"
#include "Divider.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/partition/Cell.h"
#include "allpairs/partition/Partition.h"

namespace allpairs::join {

/// Searches cells whose boxes are on disk. A cell that has more boxes than may be in memory is searched in parts, each
/// part by itself and with each later one.
class CellJoin {
 public:
  /// Receives pairs by index into two sets of records, or twice the same. Of two sets of boxes the first records are of
  /// the first.
  using Receiver = FunctionRef<void(std::span<const Pair>, const Records&, const Records&)>;

  /// `most` is the number of boxes in memory at once.
  CellJoin(const BoxSpill& spill, const partition::Partition& cells, std::size_t most, const OverlapOptions& options);

  /// The pairs of one cell: of its own boxes, and of these with the wide ones; of two sets, those of a box of the first
  /// and a box of the second. The number after the last cell's means the pairs among the wide boxes.
  void search(std::size_t task, Receiver receive);

 private:
  // A part is one of the spill; see partOf().
  void searchWithin(std::size_t part, const partition::Cell& cell, Receiver receive);
  void searchBetween(std::size_t first, std::size_t second, const partition::Cell& cell, Receiver receive);
  void searchWithPart(const Records& own, std::size_t part, const partition::Cell& cell, Receiver receive);
  [[nodiscard]] std::uint64_t countOf(std::size_t part) const { return m_spill.extents()[part].count; }
  [[nodiscard]] std::size_t wide(std::size_t set) const { return partOf(m_cells, set, m_cells.size()); }
  [[nodiscard]] Records room(std::size_t begin, std::uint64_t count) const {
    return m_room->at(begin, static_cast<std::size_t>(count));
  }

  void stream(const Records& first, const Records& second, const partition::Cell& cell, Receiver receive);
  void streamUpwards(const Records& first, const Records& second, const partition::Cell& cell, Receiver receive);

  const BoxSpill& m_spill;
  const partition::Partition& m_cells;
  RecordType m_type;
  std::size_t m_most;
  std::size_t m_sets = 1;
  partition::CellSearch m_search;
  std::optional<RecordRoom> m_room;
  std::vector<Pair> m_kept;
};

}  // namespace allpairs::join
