// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/WorldTypes.h"
#include "kernels/Kernels.h"
#include "search/JoinRunner.h"
#include "search/PairTest.h"
#include "search/StoppableExecutor.h"
#include "world/BoxStore.h"
#include "world/DynamicBvh.h"
#include "world/PairHistory.h"

namespace allpairs::engine {

/// The pairs of a world: hierarchies over its dynamic and its static boxes, and what was found in them.
class WorldSearch {
 public:
  WorldSearch(std::pmr::memory_resource* memory, const WorldOptions& options, const Kernels& kernels)
      : m_options(options),
        m_kernels(kernels),
        m_executor(m_stoppable.over(options.executor, options.stop)),
        m_dynamic(memory, false),
        m_static(memory, true),
        m_changedDynamic(memory),
        m_changedStatic(memory),
        m_runner(memory),
        m_history(memory, options.order) {}

  /// Updates the hierarchies from the store.
  void update(BoxStore& store);

  /// Finds the current pairs.
  StepResult step(BoxStore& store);

  /// Releases all memory except that of the last step's result.
  void shrink() noexcept;

  [[nodiscard]] StepResult result() const noexcept { return m_history.result(); }

  /// The pairs of a box of this world and a box of another, in order. Both must be updated.
  [[nodiscard]] std::vector<Pair> findBetween(const BoxStore& store, const WorldSearch& other,
                                              const BoxStore& otherStore) const;

  [[nodiscard]] const DynamicBvh& dynamicBoxes() const noexcept { return m_dynamic; }
  [[nodiscard]] const DynamicBvh& staticBoxes() const noexcept { return m_static; }
  [[nodiscard]] const WorldStatistics& statistics() const noexcept { return m_statistics; }
  [[nodiscard]] std::pmr::memory_resource* memory() const noexcept { return m_runner.memory(); }
  [[nodiscard]] const Kernels& kernels() const noexcept { return m_kernels; }
  [[nodiscard]] Executor& executor() const noexcept { return m_executor; }

 private:
  [[nodiscard]] bool isExact() const noexcept { return m_dynamic.exact() && m_static.exact(); }
  [[nodiscard]] PairTest testOf(const BoxStore& store, const BoxStore& other, double distance, bool exact) const;
  void joinAll(const BoxStore& store);
  void joinChanged(const BoxStore& store);
  std::uint64_t join(const BvhLevels& first, const BvhLevels& second, JoinRunner& runner) const;
  std::uint64_t join(const JoinRunner::Job& job, JoinRunner& runner) const;
  void noteTotals();

  const WorldOptions& m_options;
  const Kernels& m_kernels;
  StoppableExecutor m_stoppable;
  Executor& m_executor;
  DynamicBvh m_dynamic;
  DynamicBvh m_static;
  ChangedBoxes m_changedDynamic;
  ChangedBoxes m_changedStatic;
  JoinRunner m_runner;
  PairHistory m_history;
  WorldStatistics m_statistics;
};

}  // namespace allpairs::engine
