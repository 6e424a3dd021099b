// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "Distribution.h"
#include "LocalSet.h"
#include "PairExchange.h"
#include "Ranks.h"
#include "Tuning.h"
#include "allpairs/mpi/DistributedOverlaps.h"
#include "allpairs/partition/Cell.h"

namespace allpairs::mpi {

/// One search on several ranks: distributes boxes, searches cells, and sends pairs to the rank of their first box.
class DistributedSearch {
 public:
  DistributedSearch(const Ranks& ranks, const DistributedOptions& options, const Tuning& tuning)
      : m_ranks(ranks), m_options(options), m_tuning(tuning), m_pairs(ranks) {}

  /// The pairs whose first box is this rank's, of one set or two.
  [[nodiscard]] std::vector<IdPair> find(std::span<const LocalBoxes> given);

  /// The pairs of all ranks.
  [[nodiscard]] std::uint64_t count(std::span<const LocalBoxes> given);

 private:
  /// The boxes of one cell, and what is kept from one cell to the next.
  struct CellBoxes {
    std::vector<std::vector<std::uint64_t>> bounds;  ///< On their way, by rank.
    std::vector<std::vector<std::uint64_t>> others;
    BoxRecords records;
  };

  void search(std::span<const LocalBoxes> given);
  void takeSets(std::span<const LocalBoxes> given);
  void checkSets() const;
  void checkAgreement() const;
  void measureSets();
  void searchHere();
  void searchCells(const Distribution& distribution);
  void searchCell(std::span<CellBoxes> sets, const partition::Cell& cell, partition::CellSearch& search);
  void searchWide(const Distribution& distribution, std::size_t set);
  void searchChunk(const BoxRecords& wide, std::size_t set, std::span<const char> isWideHere);
  template <class Take>
  void searchBetween(OverlapOptions options, const BoxView& first, const BoxView& second, const Take& take) const;
  void fetchCell(const Distribution& distribution, std::size_t round, std::size_t set, CellBoxes& boxes) const;
  [[nodiscard]] OverlapOptions optionsFor(const FilterBits& first, const FilterBits& second) const;
  template <class FirstId, class SecondId>
  void add(std::span<const Pair> pairs, const FirstId& firstId, const SecondId& secondId);
  void sendPairs();

  const Ranks& m_ranks;
  const DistributedOptions& m_options;
  const Tuning& m_tuning;
  bool m_isCount = false;
  std::vector<LocalSet> m_sets;
  RecordLayout m_layout;
  std::uint64_t m_count = 0;  ///< Found by this rank.
  PairExchange m_pairs;
  std::vector<IdPair> m_here;  ///< Of one rank alone, in order.
};

}  // namespace allpairs::mpi
