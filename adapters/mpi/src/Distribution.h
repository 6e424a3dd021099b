// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "LocalSet.h"
#include "Ranks.h"
#include "Tuning.h"
#include "allpairs/mpi/DistributedOverlaps.h"
#include "allpairs/partition/Partition.h"

namespace allpairs::mpi {

/// Which boxes of this rank go to which cells, and which rank searches each cell. Making it is collective; all ranks
/// have the same cells.
///
/// A box that reaches many cells is wide, and so is one in a crowded cell: one that holds more than a rank's share of
/// all boxes, and that no cut divides. Wide boxes go to no cell.
class Distribution {
 public:
  /// The options are those of the search; one set, or two.
  Distribution(const Ranks& ranks, std::span<const LocalSet> sets, const DistributedOptions& options,
               const Tuning& tuning);

  /// In each round a rank searches at most one cell.
  [[nodiscard]] std::size_t rounds() const noexcept { return m_rounds; }

  /// The cell that a rank searches in a round.
  [[nodiscard]] std::optional<std::uint32_t> cellOf(std::size_t round, int rank) const;

  [[nodiscard]] partition::Cell bounds(std::uint32_t cell) const { return m_cells.cell(cell); }

  /// The boxes of this rank that go to a cell, ascending.
  [[nodiscard]] std::span<const std::uint32_t> boxesOf(std::size_t set, std::uint32_t cell) const;

  /// The wide boxes of this rank, ascending.
  [[nodiscard]] std::span<const std::uint32_t> wide(std::size_t set) const {
    return boxesOf(set, static_cast<std::uint32_t>(m_cells.size()));
  }

 private:
  /// Boxes by cell, those of the wide ones behind the last: the form of a compressed sparse row.
  struct Rows {
    std::vector<std::uint32_t> cells{};  ///< Of each box, one after the other; the last of a box is marked.
    std::vector<std::uint64_t> begins{};
    std::vector<std::uint32_t> boxes{};
  };

  /// Empty of a box that is, and of one that the region leaves out: these are sent nowhere.
  [[nodiscard]] Box reachOf(const LocalSet& set, std::size_t i) const;

  void takeSample(std::size_t set);
  void shareCells();
  void findCells(std::size_t set);
  void countBoxes();
  bool cutAgain();
  void spreadCrowded();
  void fillRows(std::size_t set);
  void deal();
  [[nodiscard]] std::vector<double> estimatePairs() const;
  [[nodiscard]] std::vector<std::uint32_t> dealByWork() const;

  const Ranks& m_ranks;
  std::span<const LocalSet> m_sets;
  const DistributedOptions& m_options;
  const Tuning& m_tuning;
  std::uint64_t m_allBoxes = 0;
  std::size_t m_wanted = 1;       ///< Cells.
  std::vector<Box> m_sample;      ///< Reaches of boxes of all ranks; on rank 0 only.
  std::size_t m_firstSample = 0;  ///< How many of these are of the first set.
  partition::Partition m_cells;
  std::array<Rows, 2> m_rows;
  std::vector<std::uint64_t> m_counts;  ///< Boxes of all ranks in each cell, and wide ones.
  std::vector<std::uint32_t> m_dealt;   ///< The cell of each round and rank.
  std::size_t m_rounds = 0;
};

}  // namespace allpairs::mpi
