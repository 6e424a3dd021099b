// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "FlatSearch.h"
#include "HierarchyBuilder.h"
#include "Join.h"
#include "PairBuckets.h"
#include "PairReceiver.h"
#include "PairSort.h"
#include "allpairs/BoxSet.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Overlaps.h"

namespace allpairs::engine {

/// The boxes to search: one set against itself, or two against each other.
struct Sets {
  const BoxSet& first;
  const BoxSet& second;
  bool one = true;
};

/// Everything that a search needs between its start and its end, and the memory that it keeps for the next one.
class Search {
 public:
  std::span<const Pair> find(const Sets& sets, const OverlapOptions& options);
  std::uint64_t count(const Sets& sets, const OverlapOptions& options);
  void stream(const Sets& sets, const OverlapOptions& options, PairVisitor visitor);

  [[nodiscard]] const OverlapStatistics& statistics() const noexcept { return m_statistics; }

 private:
  /// What a thread works with; as many as there are threads.
  struct Worker : InBlock {
    PairReceiver receiver;
    PairBuckets buckets;
    JoinScratch scratch;
    std::atomic_flag busy;
  };

  /// Where the pairs of a task are.
  struct Segment {
    std::size_t worker = 0;
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  /// One search over part of the rows, ready to run.
  struct Plan {
    bool blocked = false;
    bool withItself = true;
    FlatSearch flat;
    std::size_t units = 0;
    std::size_t firstLarge = 0;  ///< Rows, or leaf blocks: what tasks are cut from.
    PairRules rules;
    const BucketRule* buckets = nullptr;  ///< If set, pairs go to the workers' buckets.
  };

  /// Whether to test all pairs, and about how many there will be, which is known only where they are many.
  struct Choice {
    bool flat = false;
    std::size_t likelyPairs = 0;
  };

  void begin(const Sets& sets, const OverlapOptions& options);
  Plan plan(const Sets& sets, const OverlapOptions& options, PairTest& test);
  void planFlat(const Sets& sets, const OverlapOptions& options, PairTest& test, Plan& plan);
  void planBlocked(const Sets& sets, const OverlapOptions& options, PairTest& test, Plan& plan);

  void runPart(const Plan& plan, std::size_t begin, std::size_t end, Worker& worker);
  void runAll(const Plan& plan);
  std::size_t claimWorker();
  void startWorkers(std::size_t count, const Plan& plan);
  void collect();
  void join(const Plan& plan);
  void sortPairs(const Sets& sets, Order order);

  /// Finds pairs and orders them by buckets, where that pays; else false, and nothing is done.
  bool findInBuckets(const Sets& sets, const OverlapOptions& options, Plan plan);
  void sortBuckets(const BucketRule& rule);

  static Choice choose(const Sets& sets, const OverlapOptions& options);
  void streamAll(const Plan& plan, std::size_t batchSize, PairVisitor visitor);
  void streamInRanges(const Sets& sets, const OverlapOptions& options, PairVisitor visitor);
  bool findRange(const Sets& sets, const OverlapOptions& options, std::size_t begin, std::size_t end);

  OverlapStatistics m_statistics;
  const Kernels* m_kernels = nullptr;
  SerialExecutor m_serial;
  Executor* m_executor = &m_serial;

  Buffer<LaneTile> m_rows;
  Buffer<LaneTile> m_columns;
  HierarchyBuilder m_firstHierarchy;
  HierarchyBuilder m_secondHierarchy;
  std::vector<std::unique_ptr<Worker>> m_workers;
  std::vector<Segment> m_segments;
  Buffer<Pair> m_joined;
  std::vector<std::size_t> m_places;
  std::span<Pair> m_pairs;  ///< The result: joined from several tasks, or where the only one left it.
  PairSort m_sort;
};

}  // namespace allpairs::engine
