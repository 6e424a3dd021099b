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
#include "order/PairSort.h"
#include "search/JoinRunner.h"

namespace allpairs::engine {

/// The pairs of the last step in order, and those of this one as they are found.
///
/// After a join of all boxes, the pairs are put in order, by buckets unless they come in order, and compared with the
/// old list. After a join of changed boxes only, each pair is looked up among the old ones and marked, and new ones are
/// sorted: an unmarked pair has ended, or neither of its boxes changed.
/// Memory: until a step completes, the pairs are those of the last completed step.
class PairHistory {
 public:
  PairHistory(std::pmr::memory_resource* memory, const WorldOptions& options, const Kernels& kernels)
      : m_memory(memory), m_options(&options), m_kernels(&kernels) {}

  /// Leaves of the result the pairs without changes, until a step completes.
  void dropChanges() noexcept { m_result = {m_result.pairs, {}, m_result.pairs, {}}; }

  /// Starts a step, without pairs. All ids are below the bound. `workers` is the number of concurrent workers.
  void begin(std::size_t idBound, std::size_t workers, bool looksForAll);

  /// Adds pairs that were found, each with first < second and once per step; those of a call may be known to be in
  /// order.
  ///
  /// Threads: one call at a time per worker.
  void take(std::span<const Pair> found, std::size_t worker, bool areInOrder = false) {
    if (!m_looksForAll) {
      tickOff(found, m_fresh[worker]);
    } else if (m_usesBuckets) {
      m_sort.ofWorker(worker).add(found);
    } else {
      gather(found, m_fresh[worker], areInOrder);
    }
  }

  /// Ends a step that has searched for all pairs, with the memory of the workers that have found them.
  void finishAll(Executor& executor, JoinRunner& memory);

  /// Ends a step that has searched for the pairs of changed boxes: those for which `lookedFor(pair)` is true.
  template <class LookedFor>
  void finishChanged(const LookedFor& lookedFor, Executor& executor) {
    if (freshSize() == 0 && !hasAnyEnded(lookedFor)) return;  // All persist, as begin() left them.
    makeRoomForChanges();
    sortFresh(m_began, {m_persisted.data(), m_persisted.capacity()}, executor);
    // Nothing below throws.
    split(lookedFor);
    m_result.began = {m_began.data(), freshSize()};
    mergeFresh();
  }

  /// Releases all memory except that of the result.
  void shrink() noexcept;

  [[nodiscard]] const StepResult& result() const noexcept { return m_result; }

 private:
  struct Fresh {
    explicit Fresh(std::pmr::memory_resource* memory) : pairs(memory) {}

    Buffer<Pair> pairs;
    std::size_t size = 0;
    bool isInOrder = true;
  };

  /// Whether an old pair was looked for and not found.
  template <class LookedFor>
  [[nodiscard]] bool hasAnyEnded(const LookedFor& lookedFor) const {
    const std::span<const Pair> old = m_result.pairs;
    for (std::size_t begin = 0; begin < old.size(); begin += kLinePairs) {
      const std::size_t end = std::min(begin + kLinePairs, old.size());
      if (end == begin + kLinePairs && isNoneOf(old.subspan(begin).first<kLinePairs>(), lookedFor)) continue;
      for (std::size_t i = begin; i < end; ++i) {
        if (m_seen[i] == 0 && lookedFor(old[i])) return true;
      }
    }
    return false;
  }

  /// Splits the old pairs into those that persist and those that ended, in order: a cache line of pairs at a time where
  /// none was looked for, and else without branches (moving_benchmark --scene one-percent).
  template <class LookedFor>
  void split(const LookedFor& lookedFor) {
    const std::span<const Pair> old = m_result.pairs;
    Pair* persisted = m_persisted.data();
    Pair* ended = m_ended.data();
    for (std::size_t begin = 0; begin < old.size(); begin += kLinePairs) {
      const std::size_t end = std::min(begin + kLinePairs, old.size());
      if (end == begin + kLinePairs && isNoneOf(old.subspan(begin).first<kLinePairs>(), lookedFor)) {
        persisted = std::copy_n(&old[begin], kLinePairs, persisted);
        continue;
      }
      for (std::size_t i = begin; i < end; ++i) {
        const bool stays = (m_seen[i] != 0) | !lookedFor(old[i]);
        *persisted = old[i];
        *ended = old[i];
        persisted += stays ? 1 : 0;
        ended += stays ? 0 : 1;
      }
    }
    m_result.persisted = {m_persisted.data(), persisted};
    m_result.ended = {m_ended.data(), ended};
  }

  template <class LookedFor>
  static bool isNoneOf(std::span<const Pair, kLinePairs> pairs, const LookedFor& lookedFor) {
    bool any = false;
    for (const Pair& pair : pairs) any |= lookedFor(pair);
    return !any;
  }

  void gather(std::span<const Pair> found, Fresh& fresh, bool areInOrder);
  void tickOff(std::span<const Pair> found, Fresh& fresh);
  /// The place of an old pair, or the number of old pairs.
  [[nodiscard]] std::size_t find(Pair pair) const noexcept;
  [[nodiscard]] std::size_t freshSize() const noexcept;
  [[nodiscard]] bool takeOrdered() noexcept;
  void sortFresh(Buffer<Pair>& to, std::span<Pair> spare, Executor& executor);
  void makeRoomForChanges();
  [[nodiscard]] Pair* copyAll(std::span<const Pair> pairs, Pair* to) const;
  void compare(std::span<const Pair> now);
  void mergeFresh() noexcept;
  void findRows();
  void shiftRows() noexcept;

  /// The box whose row a pair is in.
  [[nodiscard]] BoxId rowOf(Pair pair) const noexcept {
    return m_options->order == Order::ByFirst ? pair.first : pair.second;
  }

  /// Compares pairs in the order of the options.
  [[nodiscard]] std::uint64_t keyOf(Pair pair) const noexcept { return engine::keyOf(pair, m_options->order); }

  std::pmr::memory_resource* m_memory;
  const WorldOptions* m_options;
  const Kernels* m_kernels;
  bool m_looksForAll = true;
  std::size_t m_idBound = 0;
  std::pmr::vector<Fresh> m_fresh{m_memory};  ///< By worker.
  /// By id: where the pairs of its row begin; one more at the end.
  std::pmr::vector<std::size_t> m_rowBegin{m_memory};
  bool m_rowsAreCurrent = false;
  Buffer<std::uint8_t> m_seen{m_memory};  ///< By old pair: whether it was found again.
  Buffer<Pair> m_pairs{m_memory};
  Buffer<Pair> m_next{m_memory};  ///< The pairs of a step that has searched for all, until they become the old ones.
  Buffer<Pair> m_began{m_memory};
  Buffer<Pair> m_persisted{m_memory};
  Buffer<Pair> m_ended{m_memory};
  bool m_comeInOrder = true;   ///< Of all worlds, as those of small ones do: until a step has shown that they do not.
  bool m_usesBuckets = false;  ///< In this step.
  PairSort m_sort{m_memory};
  StepResult m_result;
};

}  // namespace allpairs::engine
