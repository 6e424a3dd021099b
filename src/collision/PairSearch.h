// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "KeptSearch.h"
#include "ModelTable.h"
#include "PairRules.h"
#include "allpairs/Overlaps.h"
#include "allpairs/StopFlag.h"
#include "allpairs/collision/BruteForceBroadPhase.h"

namespace allpairs::collision {

/// Finds the pairs of the newest rows of a table: the engine gives those whose boxes are near, the rules decide.
class PairSearch {
 public:
  PairSearch(const ModelTable& models, PairRules& rules) : m_models(models), m_rules(rules) {}

  /// Strategy::Exhaustive asks the models about all pairs: the plain double loop.
  void setStrategy(Strategy strategy) { m_strategy = strategy; }
  [[nodiscard]] Strategy strategy() const { return m_strategy; }

  void setExecutor(Executor* executor) { m_executor = executor; }
  void setStop(const StopFlag* stop) { m_stop = stop; }
  [[nodiscard]] const StopFlag* stop() const { return m_stop; }

  /// Whether a search may be kept from step to step; if not, its memory is given back.
  void setKept(bool kept);
  [[nodiscard]] bool isKept() const { return m_kept.has_value(); }

  /// Appends the pairs of rows `begin` and up, each with itself and with all rows before it, in the double loop's
  /// order.
  void addPairs(std::size_t begin, std::vector<CollisionModelPair>& pairs, BroadPhaseStatistics& statistics);

 private:
  /// The candidates of several rows, by row; a row's are taken off the front.
  struct Candidates {
    std::span<const Pair> left;
    std::size_t firstOffset = 0;   // added to the older's index
    std::size_t secondOffset = 0;  // added to the newer's index
  };

  template <class Ask>
  void askAll(std::size_t begin, std::vector<CollisionModelPair>& pairs, BroadPhaseStatistics& statistics,
              const Ask& ask) const;
  void askFound(std::size_t begin, std::vector<CollisionModelPair>& pairs, BroadPhaseStatistics& statistics);
  void askAllOf(std::span<const Pair> found, const Candidates& offsets, std::vector<CollisionModelPair>& pairs);
  void askPlain(std::span<const Pair> found, const Candidates& offsets, std::vector<CollisionModelPair>& pairs) const;
  void askEach(std::span<const Pair> found, const Candidates& offsets, std::vector<CollisionModelPair>& pairs);
  [[nodiscard]] static std::span<const Pair> takeRow(std::size_t newer, Candidates& candidates);
  [[nodiscard]] BoxView boxSet(std::size_t begin, std::size_t end) const;
  [[nodiscard]] Candidates searchOlder(std::size_t begin, BroadPhaseStatistics& statistics);
  [[nodiscard]] Candidates searchNewer(std::size_t begin, BroadPhaseStatistics& statistics);
  [[nodiscard]] Candidates searchAll(BroadPhaseStatistics& statistics);
  [[nodiscard]] double searchDistance() const;
  [[nodiscard]] OverlapOptions options() const;

  const ModelTable& m_models;
  PairRules& m_rules;
  Strategy m_strategy = Strategy::Automatic;
  Executor* m_executor = nullptr;
  const StopFlag* m_stop = nullptr;
  OverlapSearch m_amongNewer;
  OverlapSearch m_betweenNewerAndOlder;
  std::optional<KeptSearch> m_kept{std::in_place};
};

}  // namespace allpairs::collision
