// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/Neighbors.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"
#include "kernels/Hits.h"
#include "memory/Memory.h"

namespace allpairs::engine {

/// The partners of each box as a join lists them, by worker, and what they are put together to: pairs in order, or rows.
class PairLists {
 public:
  explicit PairLists(std::pmr::memory_resource* memory)
      : m_ofWorkers(memory), m_partners(memory), m_begin(memory), m_length(memory), m_places(memory) {}

  /// Empties the lists of so many rows, for a search with so many workers, and sets what of theirs concerns memory and order;
  /// memory is kept.
  void start(std::size_t rows, std::size_t columns, std::size_t workers);

  [[nodiscard]] std::span<NeighborLists> ofWorkers() noexcept { return m_ofWorkers; }

  /// Provides more memory for the lists of a worker; keeps what is there. Calls look() now and then, which may throw.
  void grow(NeighborLists& lists, std::size_t more, FunctionRef<void()> look);

  /// The length of all lists.
  [[nodiscard]] std::size_t size() const noexcept;

  /// Writes the pairs in the order of the rows, of which each is first in its pairs, or second.
  void expand(std::span<Pair> to, bool bySecond, Executor& executor);

  /// Copies all lists, in the order of the rows.
  void gather(const NeighborsMemory& to, Executor& executor);

 private:
  template <class Use>
  void forEachList(Executor& executor, const Use& use);

  std::pmr::vector<NeighborLists> m_ofWorkers;
  std::pmr::vector<Buffer<std::uint32_t>> m_partners;  ///< By worker.
  Buffer<std::uint64_t> m_begin;
  Buffer<std::uint32_t> m_length;
  std::pmr::vector<std::size_t> m_places;
  std::size_t m_rows = 0;
};

}  // namespace allpairs::engine
