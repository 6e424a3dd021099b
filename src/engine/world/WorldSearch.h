// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
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
inline constexpr std::size_t kShareToJoinAll = 4;

/// The pairs of a world, or of each world of a store with world numbers (docs/decisions/0031): the hierarchies over its
/// boxes, and what was found in them.
class WorldSearch {
 public:
  WorldSearch(std::pmr::memory_resource* memory, const WorldOptions& options, const Kernels& kernels)
      : m_memory(memory), m_options(options), m_kernels(kernels) {}

  /// Updates the hierarchies from the store, with tasks whose threads are counted among those that work, if these are
  /// given.
  void update(BoxStore& store, WorkingThreads* working = nullptr);

  /// A step: finds the current pairs, and says from when on queries may be asked, if it updates the hierarchies.
  void findPairs(BoxStore& store, std::atomic<bool>& isUpdated);

  /// The rest of it: lists them, which changes the lists of the last step.
  StepResult listPairs(BoxStore& store);

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
  [[nodiscard]] std::pmr::memory_resource* memory() const noexcept { return m_memory; }
  /// Begins a call on the executor of the options.
  [[nodiscard]] Executor& begin(CallExecutor& call) const noexcept {
    return call.over(m_options.executor, m_options.stop);
  }
  [[nodiscard]] const StopFlag* stop() const noexcept { return m_options.stop; }
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

  std::pmr::memory_resource* m_memory;
  const WorldOptions& m_options;
  const Kernels& m_kernels;
  CallExecutor m_stepExecutor;  ///< Of a step; calls that are const have one of their own.
  WorldMembers m_members{m_memory};
  WorldForest m_forest{m_memory};
  ChangedBoxes m_changedDynamic{m_memory, m_kernels};
  ChangedBoxes m_changedStatic{m_memory, m_kernels};
  SmallWorlds m_small{m_memory, m_options, m_kernels, m_members};
  std::pmr::vector<std::uint8_t> m_isChosen{m_memory};  ///< By world: whether this step searches it.
  std::pmr::vector<std::uint32_t> m_chosen{m_memory};   ///< Those worlds, by ascending number.
  /// Those of them that have moved here, to be searched in hierarchies.
  std::pmr::vector<std::uint32_t> m_large{m_memory};
  /// Large worlds in which only the changed boxes are joined with all.
  std::pmr::vector<std::uint32_t> m_partly{m_memory};
  std::pmr::vector<std::uint32_t> m_touchedIn{m_memory};  ///< By world: its boxes that have changed.
  std::pmr::vector<BoxId> m_touched{m_memory};            ///< Those of the worlds in m_partly, one after the other.
  std::pmr::vector<std::size_t> m_runs{m_memory};
  JoinRunner m_runner{m_memory};
  PairHistory m_history{m_memory, m_options, m_kernels};
  WorldLists m_lists{m_memory, m_options};
  WorldStatistics m_statistics;
  std::uint64_t m_rebuilds = 0;  ///< Also by queries since the last step, while others may read the statistics.
};

}  // namespace allpairs::engine
