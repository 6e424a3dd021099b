// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "Memory.h"
#include "PairSort.h"
#include "allpairs/Executor.h"
#include "allpairs/Pair.h"
#include "allpairs/WorldTypes.h"

namespace allpairs::engine {

/// The pairs of the last step in order, and those of this one as they are found.
///
/// A pair that is found is looked up among the old ones and ticked off; only those that are new are gathered and sorted.
/// What was not ticked off has ended, or was not looked for because neither of its boxes changed.
class PairHistory {
 public:
  /// Starts a step: nothing found. All ids are below the bound. There are `finders` that work side by side.
  void begin(std::size_t idBound, std::size_t finders);

  /// Takes pairs that have been found, each with first < second and once in a step.
  ///
  /// Threads: one call at a time per finder.
  void take(std::span<const Pair> found, std::size_t finder);

  /// Ends the step. A pair that was not found has ended if `lookedFor(pair)` says that it was looked for.
  template <class LookedFor>
  void finish(const LookedFor& lookedFor, Executor& executor) {
    split(lookedFor);
    gatherFresh(executor);
    mergeFresh();
  }

  [[nodiscard]] const StepResult& result() const noexcept { return m_result; }

 private:
  struct Fresh {
    Buffer<Pair> pairs;
    std::size_t size = 0;
  };

  /// Cuts the old pairs into those that persist and those that ended, in order, without branches.
  template <class LookedFor>
  void split(const LookedFor& lookedFor) {
    const std::span<const Pair> old = m_result.pairs;
    m_persisted.require(old.size() + 1);
    m_ended.require(old.size() + 1);
    std::size_t persisted = 0;
    std::size_t ended = 0;
    for (std::size_t i = 0; i < old.size(); ++i) {
      const bool stays = (m_seen[i] != 0) | !lookedFor(old[i]);
      m_persisted[persisted] = old[i];
      m_ended[ended] = old[i];
      persisted += stays ? 1U : 0U;
      ended += stays ? 0U : 1U;
    }
    m_result.persisted = {m_persisted.data(), persisted};
    m_result.ended = {m_ended.data(), ended};
  }

  [[nodiscard]] std::size_t find(Pair pair) const noexcept;
  void gatherFresh(Executor& executor);
  void mergeFresh();
  void shiftRows();

  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

  std::size_t m_idBound = 0;
  std::vector<Fresh> m_fresh;           ///< By finder.
  std::vector<std::size_t> m_rowBegin;  ///< By id: where the pairs of which it is the first begin; one more at the end.
  Buffer<std::uint8_t> m_seen;          ///< By old pair: whether it was found again.
  Buffer<Pair> m_pairs;
  Buffer<Pair> m_began;
  Buffer<Pair> m_persisted;
  Buffer<Pair> m_ended;
  PairSort m_sort;
  StepResult m_result;
};

}  // namespace allpairs::engine
