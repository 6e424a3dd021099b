// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "BoxSpill.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/partition/Cell.h"
#include "allpairs/partition/Partition.h"

namespace allpairs::join {

/// Searches cells whose boxes are on disk. A cell that has more boxes than may be in memory is searched in parts, each
/// part by itself and with each later one.
class CellJoin {
 public:
  /// Receives pairs by index into two sets of records, or twice the same.
  using Receiver = FunctionRef<void(std::span<const Pair>, const Records&, const Records&)>;

  /// `most` is the number of boxes in memory at once.
  CellJoin(const BoxSpill& spill, const partition::Partition& cells, std::size_t most, const OverlapOptions& options);

  /// The pairs of one cell: of its own boxes, and of these with the wide ones. The number after the last cell's means the
  /// pairs among the wide boxes.
  void search(std::size_t task, Receiver receive);

 private:
  void searchWithin(std::size_t part, const partition::Cell& cell, Receiver receive);
  void searchBetween(std::size_t part, const partition::Cell& cell, Receiver receive);
  void searchWithWide(const Records& own, std::size_t room, const partition::Cell& cell, Receiver receive);
  [[nodiscard]] Records room(std::size_t begin, std::uint64_t count);

  const BoxSpill& m_spill;
  const partition::Partition& m_cells;
  RecordType m_type;
  std::size_t m_most;
  partition::CellSearch m_search;
  std::size_t m_capacity = 0;
  std::unique_ptr<std::uint64_t[]> m_words;
};

}  // namespace allpairs::join
