// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/BoxView.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/Neighbors.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Overlaps.h"
#include "bvh/BvhBuilder.h"
#include "input/BoxCull.h"
#include "input/FewValues.h"
#include "input/Options.h"
#include "input/Readers.h"
#include "order/PairSort.h"
#include "search/CallExecutor.h"
#include "search/JoinRunner.h"
#include "search/PairLists.h"

namespace allpairs::engine {

/// Where a result is put, asked for once its size is known: a vector, or memory of the caller, which may be too small
/// and throw.
using PairRoom = FunctionRef<std::span<Pair>(std::uint64_t pairs)>;
using RowRoom = FunctionRef<NeighborsMemory(std::size_t rows, std::uint64_t indices)>;

/// The state of a search, and the memory that it keeps for the next one.
class Search {
 public:
  explicit Search(std::pmr::memory_resource* memory) : m_memory(memory) {}

  std::span<const Pair> find(const Sets& sets, const OverlapOptions& options);

  /// The pairs of find(), of more than a few boxes, as a vector, into which they are put at once: another copy of many
  /// pairs is memory that is touched for the first time.
  [[nodiscard]] std::vector<Pair> take(const Sets& sets, const OverlapOptions& options);

  /// The same in memory of the caller; returns how much of it. Throws LimitExceeded if it is too small.
  std::span<Pair> findInto(const Sets& sets, const OverlapOptions& options, std::span<Pair> memory);

  /// The partners of each box of the first set, whatever the options' order; of two sets the rows are Half ones.
  NeighborsView findNeighbors(const Sets& sets, const OverlapOptions& options, NeighborRows kind, const RowRoom* room);
  [[nodiscard]] Neighbors takeNeighbors(const Sets& sets, const OverlapOptions& options, NeighborRows kind);
  NeighborsView findNeighborsInto(const Sets& sets, const OverlapOptions& options, NeighborRows kind,
                                  const NeighborsMemory& memory);

  std::uint64_t count(const Sets& sets, const OverlapOptions& options);

  /// The same of more than a few boxes.
  std::uint64_t countMany(const Sets& sets, const OverlapOptions& options);

  /// Passes the pairs on in batches of at most so many.
  void stream(const Sets& sets, const OverlapOptions& options, PairVisitor visitor, std::size_t batchSize);

  /// Releases all memory except that of the last result.
  void shrink() noexcept;

  [[nodiscard]] const OverlapStatistics& statistics() const noexcept { return m_statistics; }

 private:
  /// One search of some sets over all rows, or part of them, ready to run.
  struct Plan {
    const Sets& sets;
    Order order;
    SinkOptions sink;
    JoinRunner::Job job = {};
  };

  /// Whether to test all pairs, and an estimate of their number, which is known only if there are many.
  bool choosesFlat(const Readers& readers, const OverlapOptions& options, std::size_t& likelyPairs) const;

  /// Forgets the last result, but for its memory.
  void forget() noexcept;

  /// Checks the options, forgets the last result, and prepares a search.
  Plan planOf(const Sets& sets, const OverlapOptions& options, Order order);

  /// With a room, pairs that have to be put together or in order are put there, and not in memory of this object.
  std::span<const Pair> findPlanned(Plan& plan, const PairRoom* room);
  std::span<const Pair> findAmongFew(const Sets& sets, const OverlapOptions& options, Order order);
  void begin(const Sets& sets, const OverlapOptions& options);
  void planFlat(const Readers& readers, Plan& plan);
  void planJoin(const Readers& readers, Plan& plan);
  void joinBoth(bool one, Plan& plan);

  /// Reserves memory for the pairs of a join that this object has none for: where it grows as they come, most of it is
  /// touched for the first time twice.
  void expectPairs(Plan& plan);

  /// Reserves as much more as makes the pairs' block the largest one, where isAmple().
  void expectAmply(Plan& plan);
  void run(const Plan& plan);
  /// Whether pairs come in the order of the options, on one thread: then they are taken from the nearest cache.
  [[nodiscard]] bool comeInOrder(const Plan& plan) const;
  void runInto(Plan& plan, FunctionRef<void(std::span<const Pair>)> take);
  std::span<Pair> findPlannedInto(Plan& plan, std::span<Pair> memory);
  std::span<Pair> roomForPairs(const PairRoom* room);
  void concatenate(const PairRoom* room);
  void sortPairs(const Plan& plan);

  /// Finds pairs and orders them by buckets if that pays off; else does nothing and returns false.
  bool findInBuckets(Plan& plan, const PairRoom* room);
  [[nodiscard]] PairOrder orderOf(const Plan& plan) const;

  /// Finds pairs and adds them to buckets. Does nothing and returns false where a bucket cannot hold the pairs of this
  /// order.
  bool fillBuckets(Plan& plan, void (PairBuckets::*add)(std::span<const Pair>));

  /// Finds pairs in order by lists of the partners of each box if that pays off; else does nothing and returns false.
  bool findInLists(Plan& plan, const PairRoom* room);

  /// Lists those partners of each box that are kept, in order, if that pays off; else does nothing and returns false.
  bool listPartners(Plan& plan, Columns kept);

  /// How many partners the lists of a job are likely to have, or 0 if buckets are better.
  [[nodiscard]] std::size_t likelyPartners(const JoinRunner::Job& job, std::size_t rows, Columns kept, bool areCounted);

  NeighborsMemory roomForRows(std::size_t rows, std::size_t indices, const RowRoom* room);
  void writePairsAsRows(const Sets& sets, NeighborRows kind, const RowRoom* room);

  /// The pairs once more, by (second, first).
  [[nodiscard]] std::span<const Pair> pairsBySecond(std::size_t boxes);

  /// The two ways to find rows without pairs; where one does not pay off, it does nothing and returns false.
  bool listRows(Plan& plan, NeighborRows kind, const RowRoom* room);
  bool bucketRows(Plan& plan, NeighborRows kind, const RowRoom* room);

  void streamInRanges(const Sets& sets, const OverlapOptions& options, const Readers& readers,
                      FunctionRef<void(std::span<const Pair>)> give);
  bool findRange(const Sets& sets, const OverlapOptions& options, const BoxReader& range);

  std::pmr::memory_resource* m_memory;
  OverlapStatistics m_statistics;
  const Kernels* m_kernels = nullptr;
  CallExecutor m_callExecutor;
  Executor* m_executor = nullptr;

  Buffer<LaneTile> m_rows{m_memory};
  Buffer<LaneTile> m_columns{m_memory};
  FewValues m_fewValues{m_memory};
  BoxCull m_cull{m_memory};
  BvhBuilder m_first{m_memory};
  BvhBuilder m_second{m_memory};
  JoinRunner m_runner{m_memory};
  PairLists m_lists{m_memory};
  Buffer<Pair> m_joined{m_memory};
  Buffer<Pair> m_bySecond{m_memory};
  Buffer<std::uint64_t> m_offsets{m_memory};
  Buffer<std::uint32_t> m_indices{m_memory};
  std::span<Pair> m_pairs;      ///< The result: concatenated from several tasks, or in the memory of a single one.
  NeighborsMemory m_rowsFound;  ///< The result, where it is rows.
  Buffer<std::uint32_t> m_range{m_memory};  ///< Of an ordered stream: the boxes of the range that is searched.
  PairSort m_sort{m_memory};
};

}  // namespace allpairs::engine
