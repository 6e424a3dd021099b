// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "Kernels.h"
#include "allpairs/Executor.h"
#include "allpairs/WorldTypes.h"
#include "world/BoxStore.h"
#include "world/Descent.h"
#include "world/KeptHierarchy.h"
#include "world/QueryOrder.h"

namespace allpairs::engine {

/// What queries look at: the boxes, and the hierarchies over them, up to date.
struct QueryTarget {
  const BoxStore* store = nullptr;
  std::array<Hierarchy, 2> hierarchies;  ///< Of the dynamic boxes and of the static ones.
  std::array<bool, 2> exact{};  ///< Whether the lanes of a hierarchy are exactly the boxes, which have no margin.
  const Kernels* kernels = nullptr;
  Executor* executor = nullptr;
};

/// Queries against the boxes of a world, and the memory of their results.
///
/// A query goes down the hierarchies, whose blocks the kernels test in float32, and decides in double what comes of it.
/// Batches are answered in the order of space, in tasks.
class WorldQueries {
 public:
  /// Queries look at these boxes until the next call.
  void lookAt(const QueryTarget& target) { m_target = target; }

  ResultLists<BoxId> findOverlapping(const BoxSet& boxes, const QueryFilter& filter);
  void findFirst(std::span<const BoxSweep> sweeps, std::span<SweepHit> hits, const QueryFilter& filter);
  ResultLists<SweepHit> findAll(std::span<const BoxSweep> sweeps, const QueryFilter& filter);
  ResultLists<Neighbor> findNearest(std::span<const std::array<double, 3>> points, std::size_t count,
                                    const QueryFilter& filter);

 private:
  /// The results of a batch of queries, at first in parts that tasks write.
  template <class T>
  struct Lists {
    struct Part {
      std::vector<T> values;
    };
    std::vector<Part> parts;
    std::vector<T> values;
    std::vector<std::size_t> offsets;
  };

  /// What a filter asks of boxes.
  struct Rule {
    QueryFilter filter;
    bool everyBox = false;  ///< All boxes pass, so that none need be asked.
  };

  [[nodiscard]] Rule ruleOf(const QueryFilter& filter) const noexcept;
  void orderSweeps(std::span<const BoxSweep> sweeps);
  template <class Answer>
  void answerInOrder(std::size_t queries, const Answer& answer);
  template <class T, class Find>
  ResultLists<T> findEach(std::size_t queries, Lists<T>& lists, const Find& find);
  template <class T>
  ResultLists<T> join(std::size_t queries, Lists<T>& lists) const;

  void overlapping(const Box& query, const Rule& rule, std::vector<BoxId>& ids) const;
  [[nodiscard]] SweepHit first(const BoxSweep& sweep, const Rule& rule) const;
  void all(const BoxSweep& sweep, const Rule& rule, std::vector<SweepHit>& hits) const;
  void nearest(const std::array<double, 3>& point, std::size_t count, const Rule& rule,
               std::vector<Neighbor>& neighbors) const;

  /// Calls visit(hierarchy, exact) for those of the two that the filter looks at and that are not empty.
  template <class Visit>
  void eachHierarchy(const QueryFilter& filter, const Visit& visit) const;
  [[nodiscard]] bool passes(BoxId id, const Rule& rule) const noexcept;
  [[nodiscard]] Box widenedBox(const Arrival& at, bool exact) const noexcept;
  [[nodiscard]] float limitFrom(const std::array<double, 3>& point, std::span<const Neighbor> others) const;

  QueryTarget m_target;
  QueryOrder m_order;
  std::vector<std::array<float, 3>> m_points;  ///< Where the queries of a batch begin.
  Lists<BoxId> m_boxes;
  Lists<SweepHit> m_hits;
  Lists<Neighbor> m_neighbors;
};

}  // namespace allpairs::engine
