// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "allpairs/WorldTypes.h"
#include "bvh/CurveKey.h"
#include "kernels/Lanes.h"
#include "world/BoxStore.h"
#include "world/WorldSearch.h"

namespace allpairs::engine {

/// Queries against the boxes of a world.
///
/// A query descends the hierarchies, whose blocks the kernels test in float32, and tests the candidates in double.
/// Batches are answered in spatial order, in tasks.
/// Threads: const; nothing is kept between queries.
class WorldQueries {
 public:
  /// The hierarchies of the search are up to date with the store; both outlive the queries.
  WorldQueries(const BoxStore& store, const WorldSearch& search, const QueryFilter& filter) noexcept;

  // Single queries: they append their results.
  void overlapping(const Box& query, std::vector<BoxId>& ids) const;
  [[nodiscard]] SweepHit first(const BoxSweep& sweep) const;
  void all(const BoxSweep& sweep, std::vector<SweepHit>& hits) const;
  void nearest(const Box& query, std::size_t count, std::vector<Neighbor>& neighbors) const;
  void near(const Box& query, double distance, FunctionRef<double(BoxId)> visit) const;

  [[nodiscard]] ResultLists<BoxId> overlapping(const BoxView& boxes) const;
  template <class Query>  // Ray or BoxSweep
  void first(std::span<const Query> queries, std::span<SweepHit> hits) const;
  template <class Query>
  [[nodiscard]] ResultLists<SweepHit> all(std::span<const Query> queries) const;
  [[nodiscard]] ResultLists<Neighbor> nearest(std::span<const std::array<double, 3>> points, std::size_t count) const;
  [[nodiscard]] ResultLists<Neighbor> nearest(const BoxView& boxes, std::size_t count) const;

 private:
  template <class Input>
  [[nodiscard]] std::vector<CurveKey> orderOf(const Input& input) const;
  template <class Answer>
  void answerInOrder(std::span<const CurveKey> order, const Answer& answer) const;
  template <class T, class Input, class Find>
  [[nodiscard]] ResultLists<T> findEach(const Input& input, const Find& find) const;

  struct Askers;
  [[nodiscard]] bool canAskTogether() const;
  void overlapping(const Askers& askers, std::vector<BoxId>& ids) const;

  /// Calls visit(tree) for each hierarchy that is not empty, of those that the filter includes.
  template <class Visit>
  void eachBvh(const Visit& visit) const;
  [[nodiscard]] bool passes(BoxId id) const noexcept;
  [[nodiscard]] Box widenedBox(BoxId id, const LaneBox& lanes, bool exact) const noexcept;
  [[nodiscard]] float limitFrom(const Box& query, std::span<const Neighbor> others) const;

  const BoxStore& m_store;
  const WorldSearch& m_search;
  QueryFilter m_filter;
  bool m_everyBox;  ///< All boxes pass the filter, so that none need be tested.
};

}  // namespace allpairs::engine
