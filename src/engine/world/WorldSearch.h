// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/WorldTypes.h"
#include "kernels/Kernels.h"
#include "search/CallExecutor.h"
#include "search/JoinRunner.h"
#include "search/PairTest.h"
#include "world/BoxStore.h"
#include "world/ChangedBoxes.h"
#include "world/PairHistory.h"
#include "world/SmallWorlds.h"
#include "world/WorldForest.h"
#include "world/WorldLists.h"
#include "world/WorldMembers.h"

namespace allpairs::engine {

/// If at least one box in this many has changed, all boxes are joined: the join of changed boxes finds pairs from both
/// sides (moving_benchmark --scene one-percent, and the others, in which all move).
inline constexpr std::size_t kShareOfChanged = 4;

/// The pairs of a world, or of each world of a store with world numbers (docs/decisions/0031): the hierarchies over its
/// boxes, and what was found in them.
class WorldSearch {
 public:
  WorldSearch(std::pmr::memory_resource* memory, const WorldOptions& options, const Kernels& kernels)
      : m_options(options),
        m_kernels(kernels),
        m_members(memory),
        m_forest(memory),
        m_changedDynamic(memory, kernels),
        m_changedStatic(memory, kernels),
        m_small(memory, options, kernels, m_members),
        m_isChosen(memory),
        m_chosen(memory),
        m_large(memory),
        m_partly(memory),
        m_touchedIn(memory),
        m_touched(memory),
        m_runs(memory),
        m_runner(memory),
        m_history(memory, options, kernels),
        m_lists(memory, options.order) {}

  /// Updates the hierarchies from the store.
  void update(BoxStore& store);

  /// Finds the current pairs.
  StepResult step(BoxStore& store);

  /// Releases all memory except that of the last step's result.
  void shrink() noexcept;

  [[nodiscard]] StepResult result() const noexcept { return m_history.result(); }

  /// The lists of a step by world: groupLists() before resultOf().
  void groupLists() { m_lists.group(m_history.result()); }
  [[nodiscard]] StepResult resultOf(std::uint32_t world) const noexcept { return m_lists.of(world); }

  /// The pairs of a box of this world and a box of another, in order. Both must be updated.
  [[nodiscard]] std::vector<Pair> findBetween(const BoxStore& store, const WorldSearch& other,
                                              const BoxStore& otherStore) const;

  [[nodiscard]] const WorldMembers& members() const noexcept { return m_members; }

  /// Calls visit(hierarchy, isStatic) for those of a world that are not empty.
  template <class Visit>
  void eachTree(std::size_t world, const Visit& visit) const {
    for (const bool isStatic : {false, true}) {
      const DynamicBvh& tree = m_forest.tree(world, isStatic);
      if (tree.size() != 0) visit(tree, isStatic);
    }
  }

  [[nodiscard]] const WorldStatistics& statistics() const noexcept { return m_statistics; }
  [[nodiscard]] std::pmr::memory_resource* memory() const noexcept { return m_runner.memory(); }
  /// Begins a call on the executor of the options.
  [[nodiscard]] Executor& begin(CallExecutor& call) const noexcept {
    return call.over(m_options.executor, m_options.stop);
  }
  [[nodiscard]] const Kernels& kernels() const noexcept { return m_kernels; }

 private:
  [[nodiscard]] PairTest testOf(const BoxStore& store, double distance, bool exact) const;
  void countTouched(const BoxStore& store);
  [[nodiscard]] bool chooseWorlds(const BoxStore& store);
  [[nodiscard]] std::size_t chooseChanged(const BoxStore& store);
  void moveLarge();
  [[nodiscard]] bool isLookedFor(const BoxStore& store, Pair pair) const noexcept;
  void join(const BoxStore& store);
  void joinTrees(const BoxStore& store);
  template <class JoinOne>
  void joinWorld(std::size_t world, const JoinOne& joinOne);
  void listTouched(const BoxStore& store);
  void searchChanged(const BoxStore& store);
  void joinPartly(const BoxStore& store);
  void joinTouched(std::size_t world, std::span<const BoxId> touched);
  std::uint64_t run(const JoinRunner::Job& job);
  void noteTotals();

  const WorldOptions& m_options;
  const Kernels& m_kernels;
  CallExecutor m_stepExecutor;  ///< Of a step; calls that are const have one of their own.
  WorldMembers m_members;
  WorldForest m_forest;
  ChangedBoxes m_changedDynamic;
  ChangedBoxes m_changedStatic;
  SmallWorlds m_small;
  std::pmr::vector<std::uint8_t> m_isChosen;  ///< By world: whether this step searches it.
  std::pmr::vector<std::uint32_t> m_chosen;   ///< Those worlds, by ascending number,
  std::pmr::vector<std::uint32_t> m_large;   ///< and those of them that have moved here, to be searched in hierarchies.
  std::pmr::vector<std::uint32_t> m_partly;  ///< Large worlds in which only the changed boxes are joined with all.
  std::pmr::vector<std::uint32_t> m_touchedIn;  ///< By world: its boxes that have changed.
  std::pmr::vector<BoxId> m_touched;            ///< Those of the worlds in m_partly, one after the other.
  std::pmr::vector<std::size_t> m_runs;
  JoinRunner m_runner;
  PairHistory m_history;
  WorldLists m_lists;
  WorldStatistics m_statistics;
  std::uint64_t m_rebuilds = 0;  ///< Also by queries since the last step, while others may read the statistics.
};

}  // namespace allpairs::engine
