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
#include "world/SmallWorlds.h"
#include "world/WorldForest.h"
#include "world/WorldLists.h"
#include "world/WorldMembers.h"

namespace allpairs::engine {

/// If at least one box in this many has changed, all boxes are joined: the join of changed boxes finds pairs from both
/// sides (moving_benchmark --scene one-percent, and the others, in which all move).
inline constexpr std::size_t kShareOfChanged = 4;

/// The pairs of a world: hierarchies over its dynamic and its static boxes, and what was found in them. If boxes have world
/// numbers, each world of the store has hierarchies of its own instead.
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
        m_members(memory),
        m_dynamicTrees(memory, false),
        m_staticTrees(memory, true),
        m_small(memory, options, kernels, m_members),
        m_isChosen(memory),
        m_chosen(memory),
        m_large(memory),
        m_partly(memory),
        m_touchedIn(memory),
        m_runs(memory),
        m_runner(memory),
        m_history(memory, options.order, options.stop),
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

  [[nodiscard]] const DynamicBvh& dynamicBoxes() const noexcept { return m_dynamic; }
  [[nodiscard]] const DynamicBvh& staticBoxes() const noexcept { return m_static; }

  /// Those of a numbered store, by world, and the worlds.
  [[nodiscard]] const WorldMembers& members() const noexcept { return m_members; }
  [[nodiscard]] const WorldForest& dynamicTrees() const noexcept { return m_dynamicTrees; }
  [[nodiscard]] const WorldForest& staticTrees() const noexcept { return m_staticTrees; }
  [[nodiscard]] const WorldStatistics& statistics() const noexcept { return m_statistics; }
  [[nodiscard]] std::pmr::memory_resource* memory() const noexcept { return m_runner.memory(); }
  [[nodiscard]] const Kernels& kernels() const noexcept { return m_kernels; }
  [[nodiscard]] Executor& executor() const noexcept { return m_executor; }

 private:
  /// Either the hierarchies of all boxes are empty, or those of single worlds.
  [[nodiscard]] bool isExact() const noexcept {
    return m_dynamic.exact() && m_static.exact() && m_dynamicTrees.exact() && m_staticTrees.exact();
  }
  [[nodiscard]] PairTest testOf(const BoxStore& store, double distance, bool exact) const;
  void joinAll(const BoxStore& store);
  void joinChanged(const BoxStore& store);
  void joinChangedTrees(const BoxStore& store);
  template <class Use>
  void withTouchedSink(const BoxStore& store, const Use& use);
  void joinWorlds(BoxStore& store);
  void joinTrees();
  void joinPartly(const BoxStore& store);
  void joinTouched(const BoxStore& store, std::size_t world);
  template <class JoinOne>
  void joinWorld(std::size_t world, const JoinOne& joinOne);
  void followNumbering(const BoxStore& store) noexcept;
  void releaseTrees() noexcept;
  void updateTrees(const BoxStore& store, const BoxReader& reader);
  void countTouched(const BoxStore& store);
  [[nodiscard]] bool chooseWorlds(const BoxStore& store);
  void moveLarge();
  [[nodiscard]] bool isLookedFor(const BoxStore& store, Pair pair) const noexcept;
  template <class Visit>
  void eachTree(const BoxStore& store, const Visit& visit) const;
  template <class Visit>
  void treesOf(const BoxStore& store, std::uint32_t number, const Visit& visit) const;
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
  bool m_isNumbered = false;  ///< Whether the store was when this was last updated.
  WorldMembers m_members;
  WorldForest m_dynamicTrees;
  WorldForest m_staticTrees;
  SmallWorlds m_small;
  std::pmr::vector<std::uint8_t> m_isChosen;  ///< By world: whether this step searches it.
  std::pmr::vector<std::uint32_t> m_chosen;   ///< Those worlds, by ascending number,
  std::pmr::vector<std::uint32_t> m_large;   ///< and those of them that have moved here, to be searched in hierarchies.
  std::pmr::vector<std::uint32_t> m_partly;  ///< Large worlds in which only the changed boxes are joined with all.
  std::pmr::vector<std::uint32_t> m_touchedIn;  ///< By world: its boxes that have changed.
  std::pmr::vector<std::size_t> m_runs;
  JoinRunner m_runner;
  PairHistory m_history;
  WorldLists m_lists;
  WorldStatistics m_statistics;
};

}  // namespace allpairs::engine
