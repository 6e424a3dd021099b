// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "allpairs/Pair.h"
#include "allpairs/WorldTypes.h"
#include "kernels/Kernels.h"
#include "memory/Memory.h"
#include "search/PairTest.h"
#include "search/Workers.h"
#include "world/BoxStore.h"
#include "world/WorldMembers.h"

namespace allpairs::engine {

/// The search of small worlds of a numbered store: every box is tested against every other one, from the rows of the
/// store, without a hierarchy (docs/decisions/0031).
class SmallWorlds {
 public:
  /// What a search reads. The test's part is to filter: the search itself is exact.
  struct Input {
    const BoxStore& store;
    const WorldMembers& members;
    const WorldOptions& options;
    const Kernels& kernels;
    PairTest test;
  };

  explicit SmallWorlds(std::pmr::memory_resource* memory) : m_workers(memory) {}

  /// Releases all memory.
  void release() noexcept { m_workers = Workers<Worker>(m_workers.memory()); }

  /// Whether a world is so small that this search is the fastest one.
  [[nodiscard]] static bool takes(const Input& input, std::size_t world) noexcept;

  /// Makes workers, for so many threads.
  void start(std::size_t threads);

  /// Calls take(pairs, worker) with the pairs of some worlds, those of a world in order, one world's after the other's.
  template <class Take>
  void search(const Input& input, std::span<const std::uint32_t> worlds, const Take& take) {
    m_workers.withOne([&](std::size_t index, Worker& worker) {
      for (std::size_t i = 0; i < worlds.size();) {
        const std::size_t row = listRow(input, worlds.subspan(i), worker);
        for (std::size_t done = 0; done < row;) take(findInRow(input, row, done, worker), index);
        if (row == 0) take(find(input, worlds[i], worker), index);
        i += std::max<std::size_t>(row, 1);
      }
    });
  }

  /// Of all searches since the start.
  [[nodiscard]] std::uint64_t boxTests() const noexcept;

 private:
  struct Worker {
    explicit Worker(std::pmr::memory_resource* memory)
        : begin(memory), pairEnd(memory), ids(memory), rows(memory), pairs(memory), wide(memory) {}

    Buffer<std::uint64_t> begin;    ///< Of a row of worlds: 0, and where each begins, and the last one ends.
    Buffer<std::uint64_t> pairEnd;  ///< What the kernel says.
    Buffer<BoxId> ids;
    Buffer<float> rows;
    Buffer<Pair> pairs;
    Buffer<WideWorld> wide;
    std::uint64_t boxTests = 0;
  };

  static std::size_t listRow(const Input& input, std::span<const std::uint32_t> worlds, Worker& worker);
  static std::span<const Pair> findInRow(const Input& input, std::size_t row, std::size_t& done, Worker& worker);
  static std::span<const Pair> find(const Input& input, std::size_t world, Worker& worker);
  static std::span<const BoxId> idsOf(const WorldMembers& members, std::size_t world, Worker& worker);
  static WorldsRun runOf(const Input& input, const Worker& worker);
  static std::uint64_t runPlain(const Input& input, std::span<const BoxId> ids, Worker& worker);
  static std::uint64_t runWide(const Input& input, std::span<const BoxId> ids, Worker& worker);
  static std::size_t select(const Input& input, std::size_t world, std::span<Pair> pairs);

  Workers<Worker> m_workers;
};

}  // namespace allpairs::engine
