// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "Kernels.h"
#include "Memory.h"
#include "PairSort.h"
#include "allpairs/WorldTypes.h"
#include "world/BoxStore.h"
#include "world/ChangedBoxes.h"
#include "world/KeptHierarchy.h"
#include "world/PairFinder.h"
#include "world/PairHistory.h"
#include "world/PairSelect.h"

namespace allpairs::engine {

/// The pairs of a world: hierarchies over its dynamic and its static boxes, and what was found in them.
class WorldSearch {
 public:
  WorldSearch(const WorldOptions& options, const Kernels& kernels) : m_options(options), m_kernels(kernels) {}

  /// Brings the hierarchies up to date with the store.
  void update(BoxStore& store);

  /// Finds the pairs of the boxes as they are now.
  StepResult step(BoxStore& store);

  [[nodiscard]] StepResult result() const noexcept { return m_history.result(); }

  /// The pairs of a box of this world and a box of another, in order. Both are up to date.
  std::span<const Pair> findBetween(const BoxStore& store, WorldSearch& other, const BoxStore& otherStore);

  [[nodiscard]] KeptHierarchy& dynamicBoxes() noexcept { return m_dynamic; }
  [[nodiscard]] KeptHierarchy& staticBoxes() noexcept { return m_static; }
  [[nodiscard]] const WorldStatistics& statistics() const noexcept { return m_statistics; }
  [[nodiscard]] const Kernels& kernels() const noexcept { return m_kernels; }
  [[nodiscard]] Executor& executor() noexcept { return m_options.executor != nullptr ? *m_options.executor : m_serial; }

 private:
  [[nodiscard]] bool isExact() const noexcept { return m_dynamic.exact() && m_static.exact(); }
  void joinAll(const BoxStore& store);
  void joinChanged(const BoxStore& store);
  std::uint64_t join(const PairFinder::Job& job, PairFinder::Taker taker);
  std::uint64_t joinChangedWith(LevelStack& changed, KeptHierarchy& with, PairFinder::Taker taker);
  void noteTests(std::uint64_t pairs, bool exact);

  const WorldOptions& m_options;
  const Kernels& m_kernels;
  SerialExecutor m_serial;
  KeptHierarchy m_dynamic{false};
  KeptHierarchy m_static{true};
  ChangedBoxes m_changedDynamic;
  ChangedBoxes m_changedStatic;
  PairFinder m_finder;
  PairHistory m_history;
  WorldStatistics m_statistics;
  Buffer<Pair> m_between;
  PairSort m_betweenSort;
};

}  // namespace allpairs::engine
