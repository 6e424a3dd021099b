// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "Hits.h"
#include "Join.h"
#include "Kernels.h"
#include "Memory.h"
#include "allpairs/Executor.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/Pair.h"

namespace allpairs::engine {

/// Joins hierarchies on all threads of an executor and hands the pairs over in batches.
class PairFinder {
 public:
  /// Takes pairs, which it may change, from one of the finders that work side by side.
  using Taker = FunctionRef<void(std::span<Pair> pairs, std::size_t finder)>;

  struct Job {
    Hierarchy first;
    Hierarchy second;
    bool withItself = false;
    PairSide side = PairSide::RowFirst;
  };

  struct Counts {
    std::uint64_t boxTests = 0;
    std::uint64_t groupTests = 0;
  };

  /// Makes finders for all threads of the executor, and says how many there are.
  std::size_t prepare(Executor& executor);

  /// Runs a join; both hierarchies are of the same depth, or empty.
  Counts run(const Job& job, const Kernels& kernels, Executor& executor, Taker taker);

 private:
  struct Finder {
    std::atomic_flag busy;
    JoinScratch scratch;
    Buffer<std::uint32_t> memory;
    Buffer<Pair> pairs;
    Hits hits;
  };

  std::size_t claim();
  static void start(Finder& finder);

  std::vector<std::unique_ptr<Finder>> m_finders;
};

}  // namespace allpairs::engine
