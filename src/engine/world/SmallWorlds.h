// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "allpairs/Executor.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/Pair.h"
#include "allpairs/WorldTypes.h"
#include "kernels/Kernels.h"
#include "memory/Memory.h"
#include "search/PairTest.h"
#include "search/Workers.h"
#include "world/BoxStore.h"
#include "world/WorldMembers.h"

namespace allpairs::engine {

/// The search of small worlds of a store: every box is tested against every other one, from the rows of the
/// store, without a hierarchy (docs/decisions/0031).
class SmallWorlds {
 public:
  SmallWorlds(std::pmr::memory_resource* memory, const WorldOptions& options, const Kernels& kernels,
              const WorldMembers& members)
      : m_options(options), m_kernels(kernels), m_members(members), m_workers(memory) {}

  /// Releases all memory.
  void release() noexcept { m_workers = Workers<Worker>(m_workers.memory()); }

  /// Starts searches by so many threads, of a store that the worlds are up to date with. The search itself is exact:
  /// the test has to filter only. Both must outlive the searches.
  void start(const BoxStore& store, const PairTest& filter, std::size_t threads);

  /// Whether a world is so small that this search is the fastest one.
  [[nodiscard]] bool takes(std::size_t world) const noexcept;

  /// What the search of a world takes, in tests of float32.
  [[nodiscard]] std::size_t testsOf(std::size_t world) const noexcept {
    return (m_isPlain && !m_boxes->isFloat64() ? 1 : 2) * WorldSink::pairsOf(m_members.size(world));
  }

  /// Whether this search is the fastest one for some boxes of the only world with all: see searchChanged().
  [[nodiscard]] bool takesChanged() const noexcept { return m_takesChanged; }

  /// Calls take(pairs, worker) with the pairs of some worlds, those of a world in order, one world's after the other's.
  template <class Take>
  void search(std::span<const std::uint32_t> worlds, const Take& take) {
    m_workers.withOne([&](std::size_t index, Worker& worker) {
      for (std::size_t i = 0; i < worlds.size();) {
        const std::size_t row = listRow(worlds.subspan(i), worker);
        for (std::size_t done = 0; done < row;) take(findInRow(row, done, worker), index);
        if (row == 0) take(find(worlds[i], worker), index);
        i += std::max<std::size_t>(row, 1);
      }
    });
  }

  /// Calls take(pairs, worker) with the pairs of some boxes of the only world, each first in its pairs, and of all
  /// boxes: also with itself, and twice with another one of the same boxes.
  void searchChanged(std::span<const BoxId> changed, FunctionRef<void(std::span<Pair>, std::size_t)> take);

  /// Moves the pairs that are pairs of this world to the front; returns their number.
  std::size_t select(std::size_t world, std::span<Pair> pairs) const;

  /// Of all searches since the start.
  [[nodiscard]] std::uint64_t boxTests() const noexcept;

 private:
  struct Worker {
    explicit Worker(std::pmr::memory_resource* memory)
        : begin(memory), pairEnd(memory), ids(memory), rows(memory, memory), pairs(memory), wide(memory) {}

    Buffer<std::uint64_t> begin;    ///< Of a row of worlds: 0, and where each begins, and the last one ends.
    Buffer<std::uint64_t> pairEnd;  ///< What the kernel says.
    Buffer<BoxId> ids;
    std::tuple<Buffer<float>, Buffer<double>> rows;
    Buffer<Pair> pairs;
    Buffer<WideWorld> wide;
    std::uint64_t boxTests = 0;
    bool hadMany = false;  ///< As the kernel has it.
    std::atomic_flag busy;
  };

  std::size_t listRow(std::span<const std::uint32_t> worlds, Worker& worker) const;
  std::span<const Pair> findInRow(std::size_t row, std::size_t& done, Worker& worker) const;
  template <class T>
  std::span<const Pair> findInRowOf(std::size_t row, std::size_t& done, Worker& worker) const;
  template <class T>
  void searchRun(WorldsRun<T>& run, Worker& worker) const;
  std::span<const Pair> find(std::size_t world, Worker& worker) const;
  std::span<const BoxId> idsOf(std::size_t world, Worker& worker) const;
  [[nodiscard]] WorldSink sinkOf(const Worker& worker) const noexcept;
  template <class T>
  std::uint64_t runPlain(std::span<const BoxId> ids, Worker& worker) const;
  std::uint64_t runWide(std::span<const BoxId> ids, Worker& worker) const;
  template <class T>
  void findChanged(std::span<const BoxId> changed, Worker& worker, FunctionRef<void(std::span<Pair>)> take) const;

  const WorldOptions& m_options;
  const Kernels& m_kernels;
  const WorldMembers& m_members;
  const BoxStore* m_store = nullptr;  ///< From here on: of the searches since the start.
  const PairTest* m_filter = nullptr;
  const BoxView* m_boxes = nullptr;
  std::size_t m_mostBoxes = 0;  ///< Of a world that the kernels search.
  bool m_isPlain = false;       ///< Rows that the kernel takes as they are.
  bool m_takesChanged = false;
  Workers<Worker> m_workers;
};

}  // namespace allpairs::engine
