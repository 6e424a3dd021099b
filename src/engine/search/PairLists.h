// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "allpairs/Neighbors.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"
#include "kernels/Hits.h"
#include "memory/Memory.h"
#include "search/PairSink.h"

namespace allpairs::engine {

/// The partners of each box as a join lists them, by worker, and what they are put together to: pairs in order, or
/// rows. What PairSink does with hits this does with lists: it applies the exact test and the filters, and keeps to the
/// limit.
class PairLists {
 public:
  explicit PairLists(std::pmr::memory_resource* memory)
      : m_ofWorkers(memory), m_partners(memory), m_begin(memory), m_length(memory), m_places(memory) {}

  /// Empties the lists of so many rows, for a search with so many workers that is likely to find so many partners;
  /// memory is kept.
  void start(std::size_t rows, std::size_t columns, std::size_t workers, std::size_t likely);

  /// Which partners the lists have: by their ids, and by the test of pairs, in which rows are on that side if a pair is
  /// listed once. The options must outlive the search.
  void select(Columns kept, PairSide side, const SinkOptions& options);

  [[nodiscard]] std::span<NeighborLists> ofWorkers() noexcept { return m_ofWorkers; }

  /// The length of all lists, and of how many pairs they are.
  [[nodiscard]] std::size_t size() const noexcept;
  [[nodiscard]] std::size_t pairs() const noexcept { return size() / m_timesListed; }

  /// Writes the pairs in the order of the rows, of which each is first in its pairs, or second.
  void expand(std::span<Pair> to, bool bySecond, Executor& executor);

  /// Copies all lists, in the order of the rows.
  void gather(const NeighborsMemory& to, Executor& executor);

 private:
  void grow(NeighborLists& lists, std::size_t more);
  [[nodiscard]] Pair pairOf(std::uint32_t row, std::uint32_t partner) const noexcept;
  std::size_t select(NeighborLists& lists, std::uint32_t row, std::span<std::uint32_t> partners,
                     bool areDoubtful) const;
  std::size_t findApart(NeighborLists& lists, std::span<const Pair> pairs, std::uint32_t* apart) const;
  template <class Use>
  void forEachList(Executor& executor, const Use& use);

  const SinkOptions* m_options = nullptr;
  PairSide m_side = PairSide::RowFirst;
  std::size_t m_timesListed = 1;  ///< Each pair.

  std::pmr::vector<NeighborLists> m_ofWorkers;
  std::pmr::vector<Buffer<std::uint32_t>> m_partners;  ///< By worker.
  Buffer<std::uint64_t> m_begin;
  Buffer<std::uint32_t> m_length;
  std::pmr::vector<std::size_t> m_places;
  std::size_t m_rows = 0;
};

}  // namespace allpairs::engine
