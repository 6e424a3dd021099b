// SPDX-License-Identifier: MIT
#include "world/WorldQueries.h"

#include <algorithm>
#include <tuple>

#include "QueryLanes.h"
#include "world/QueryTests.h"

namespace allpairs::engine {
namespace {

/// Queries that one task answers.
constexpr std::size_t kQueriesPerTask = 64;

bool isNearer(const SweepHit& a, const SweepHit& b) noexcept { return std::tie(a.t, a.id) < std::tie(b.t, b.id); }
bool isCloser(const Neighbor& a, const Neighbor& b) noexcept {
  return std::tie(a.distance, a.id) < std::tie(b.distance, b.id);
}

bool isExactly(const LaneBox& lanes, const Box& box) noexcept {
  bool exact = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    exact = exact && static_cast<double>(lanes.bound[axis]) == box.min[axis] &&
            static_cast<double>(lanes.bound[axis + 3]) == box.max[axis];
  }
  return exact;
}

float asFloat(double value) noexcept {
  constexpr double kMost = 1e30;
  return static_cast<float>(std::clamp(value, -kMost, kMost));
}

/// The `count` nearest of those that are taken, as a heap at the end of a list, with the farthest of them on top.
class NearestHeap {
 public:
  NearestHeap(std::vector<Neighbor>& list, std::size_t count) : m_list(list), m_begin(list.size()), m_count(count) {}

  /// Returns whether it is full and has changed.
  bool take(const Neighbor& found) {
    if (m_list.size() - m_begin == m_count) {
      if (!isCloser(found, m_list[m_begin])) return false;
      std::pop_heap(begin(), m_list.end(), isCloser);
      m_list.pop_back();
    }
    m_list.push_back(found);
    std::push_heap(begin(), m_list.end(), isCloser);
    return m_list.size() - m_begin == m_count;
  }

  [[nodiscard]] double farthest() const { return m_list[m_begin].distance; }
  void sort() { std::sort(begin(), m_list.end(), isCloser); }

 private:
  [[nodiscard]] std::vector<Neighbor>::iterator begin() const {
    return m_list.begin() + static_cast<std::ptrdiff_t>(m_begin);
  }

  std::vector<Neighbor>& m_list;
  std::size_t m_begin;
  std::size_t m_count;
};

}  // namespace

WorldQueries::Rule WorldQueries::ruleOf(const QueryFilter& filter) const noexcept {
  return {filter, !m_target.store->filtered() && filter.mask != 0 && filter.category != 0};
}

bool WorldQueries::passes(BoxId id, const Rule& rule) const noexcept {
  if (rule.everyBox) return true;
  const FilterRow& row = m_target.store->filter(id);
  return (row.category & rule.filter.mask) != 0 && (row.mask & rule.filter.category) != 0;
}

Box WorldQueries::widenedBox(const Arrival& at, bool exact) const noexcept {
  return exact ? at.lanes() : widened(m_target.store->box(at.id), m_target.store->margin(at.id));
}

template <class Visit>
void WorldQueries::eachHierarchy(const QueryFilter& filter, const Visit& visit) const {
  const auto& [dynamicBoxes, staticBoxes] = m_target.hierarchies;
  if (filter.dynamicBoxes && dynamicBoxes.depth != 0) visit(dynamicBoxes, m_target.exact[0]);
  if (filter.staticBoxes && staticBoxes.depth != 0) visit(staticBoxes, m_target.exact[1]);
}

/// Calls answer(task, query) for all queries, those that are near each other in the same task, in their order in space.
template <class Answer>
void WorldQueries::answerInOrder(std::size_t queries, const Answer& answer) {
  m_order.sort(m_points);
  m_target.executor->run((queries + kQueriesPerTask - 1) / kQueriesPerTask, [&](std::size_t task) {
    const std::size_t end = std::min(queries, (task + 1) * kQueriesPerTask);
    for (std::size_t i = task * kQueriesPerTask; i < end; ++i) answer(task, m_order[i]);
  });
}

/// Answers each query by find(i, values), which appends to the values; in parts, and then all in one.
template <class T, class Find>
ResultLists<T> WorldQueries::findEach(std::size_t queries, Lists<T>& lists, const Find& find) {
  const std::size_t tasks = (queries + kQueriesPerTask - 1) / kQueriesPerTask;
  if (lists.parts.size() < tasks) lists.parts.resize(tasks);
  for (std::size_t task = 0; task < tasks; ++task) lists.parts[task].values.clear();
  lists.offsets.assign(queries + 1, 0);
  answerInOrder(queries, [&](std::size_t task, std::size_t query) {
    std::vector<T>& values = lists.parts[task].values;
    const std::size_t before = values.size();
    find(query, values);
    lists.offsets[query + 1] = values.size() - before;
  });
  return join(queries, lists);
}

/// Brings the values from the order in which they were found into that of the queries, whose numbers they are given.
template <class T>
ResultLists<T> WorldQueries::join(std::size_t queries, Lists<T>& lists) const {
  for (std::size_t i = 0; i < queries; ++i) lists.offsets[i + 1] += lists.offsets[i];
  lists.values.resize(lists.offsets[queries]);
  m_target.executor->run((queries + kQueriesPerTask - 1) / kQueriesPerTask, [&](std::size_t task) {
    const std::size_t end = std::min(queries, (task + 1) * kQueriesPerTask);
    const T* from = lists.parts[task].values.data();
    for (std::size_t i = task * kQueriesPerTask; i < end; ++i) {
      const std::size_t query = m_order[i];
      const std::size_t size = lists.offsets[query + 1] - lists.offsets[query];
      std::copy_n(from, size, lists.values.data() + lists.offsets[query]);
      from += size;
    }
  });
  return {lists.offsets, lists.values};
}

void WorldQueries::overlapping(const Box& query, const Rule& rule, std::vector<BoxId>& ids) const {
  if (isEmpty(query)) return;
  const auto begin = static_cast<std::ptrdiff_t>(ids.size());
  const LaneBox lanes = lanesOf(query);
  const bool queryIsExact = isExactly(lanes, query);
  const auto lanesIn = [&](const LaneBlock& block) { return m_target.kernels->touchingLanes(block, lanes); };
  eachHierarchy(rule.filter, [&](const Hierarchy& hierarchy, bool exact) {
    const auto take = [&](const Arrival& at) {
      if (!passes(at.id, rule)) return;
      const BoxStore& store = *m_target.store;
      if ((exact && queryIsExact) || overlap(store.box(at.id), query, store.margin(at.id))) ids.push_back(at.id);
    };
    Descent(hierarchy, lanesIn, take).run();
  });
  std::sort(ids.begin() + begin, ids.end());
}

SweepHit WorldQueries::first(const BoxSweep& sweep, const Rule& rule) const {
  SweepHit best;
  if (isEmpty(sweep.box)) return best;
  const SweepLanes lanes = lanesOf(sweep);
  float limit = roundUpFar(sweep.length);
  const auto lanesIn = [&](const LaneBlock& block, float* times) {
    return m_target.kernels->meetingLanes(block, lanes, limit, times);
  };
  eachHierarchy(rule.filter, [&](const Hierarchy& hierarchy, bool exact) {
    const auto take = [&](const Arrival& at) {
      if (!passes(at.id, rule)) return;
      const SweepHit hit{at.id, meetingTime(sweep, widenedBox(at, exact))};
      if (hit.t >= kFar || !isNearer(hit, best)) return;
      best = hit;
      limit = roundUpFar(hit.t);
    };
    CheapestDescent(hierarchy, lanesIn, limit, take).run();
  });
  return best;
}

void WorldQueries::all(const BoxSweep& sweep, const Rule& rule, std::vector<SweepHit>& hits) const {
  if (isEmpty(sweep.box)) return;
  const auto begin = static_cast<std::ptrdiff_t>(hits.size());
  const SweepLanes lanes = lanesOf(sweep);
  const float limit = roundUpFar(sweep.length);
  const auto lanesIn = [&](const LaneBlock& block) {
    std::array<float, kFanOut> times;
    return m_target.kernels->meetingLanes(block, lanes, limit, times.data());
  };
  eachHierarchy(rule.filter, [&](const Hierarchy& hierarchy, bool exact) {
    const auto take = [&](const Arrival& at) {
      if (!passes(at.id, rule)) return;
      const double t = meetingTime(sweep, widenedBox(at, exact));
      if (t < kFar) hits.push_back({at.id, t});
    };
    Descent(hierarchy, lanesIn, take).run();
  });
  std::sort(hits.begin() + begin, hits.end(), isNearer);
}

/// The square of the distance within which all of some boxes are, rounded up.
float WorldQueries::limitFrom(const std::array<double, 3>& point, std::span<const Neighbor> others) const {
  double farthest = 0.0;
  for (const Neighbor& other : others) {
    const Box box = widened(m_target.store->box(other.id), m_target.store->margin(other.id));
    farthest = std::max(farthest, distanceFrom(point, box));
  }
  return roundUpFar(farthest * farthest);
}

/// What is nearest to the query before, which is near in space, can't be far: a limit before any box has been met.
void WorldQueries::nearest(const std::array<double, 3>& point, std::size_t count, const Rule& rule,
                           std::vector<Neighbor>& neighbors) const {
  if (count == 0) return;
  const PointLanes lanes = lanesOf(point);
  float limit = kNever;
  if (neighbors.size() >= count) limit = limitFrom(point, std::span<const Neighbor>(neighbors).last(count));
  const auto lanesIn = [&](const LaneBlock& block, float* squares) {
    return m_target.kernels->nearLanes(block, lanes, limit, squares);
  };
  NearestHeap heap(neighbors, count);
  eachHierarchy(rule.filter, [&](const Hierarchy& hierarchy, bool exact) {
    const auto take = [&](const Arrival& at) {
      if (!passes(at.id, rule)) return;
      if (!heap.take({at.id, distanceFrom(point, widenedBox(at, exact))})) return;
      limit = std::min(limit, roundUpFar(heap.farthest() * heap.farthest()));
    };
    CheapestDescent(hierarchy, lanesIn, limit, take).run();
  });
  heap.sort();
}

void WorldQueries::orderSweeps(std::span<const BoxSweep> sweeps) {
  m_points.clear();
  for (const BoxSweep& sweep : sweeps) {
    m_points.push_back({asFloat(sweep.box.min[0]), asFloat(sweep.box.min[1]), asFloat(sweep.box.min[2])});
  }
}

ResultLists<BoxId> WorldQueries::findOverlapping(const BoxSet& boxes, const QueryFilter& filter) {
  m_points.clear();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box box = boxes[i];
    m_points.push_back({asFloat(box.min[0]), asFloat(box.min[1]), asFloat(box.min[2])});
  }
  const Rule rule = ruleOf(filter);
  return findEach(boxes.size(), m_boxes,
                  [&](std::size_t i, std::vector<BoxId>& ids) { overlapping(boxes[i], rule, ids); });
}

void WorldQueries::findFirst(std::span<const BoxSweep> sweeps, std::span<SweepHit> hits, const QueryFilter& filter) {
  orderSweeps(sweeps);
  const Rule rule = ruleOf(filter);
  answerInOrder(sweeps.size(), [&](std::size_t, std::size_t query) { hits[query] = first(sweeps[query], rule); });
}

ResultLists<SweepHit> WorldQueries::findAll(std::span<const BoxSweep> sweeps, const QueryFilter& filter) {
  orderSweeps(sweeps);
  const Rule rule = ruleOf(filter);
  return findEach(sweeps.size(), m_hits,
                  [&](std::size_t i, std::vector<SweepHit>& hits) { all(sweeps[i], rule, hits); });
}

ResultLists<Neighbor> WorldQueries::findNearest(std::span<const std::array<double, 3>> points, std::size_t count,
                                                const QueryFilter& filter) {
  m_points.clear();
  for (const auto& point : points) m_points.push_back({asFloat(point[0]), asFloat(point[1]), asFloat(point[2])});
  const Rule rule = ruleOf(filter);
  return findEach(points.size(), m_neighbors,
                  [&](std::size_t i, std::vector<Neighbor>& neighbors) { nearest(points[i], count, rule, neighbors); });
}

}  // namespace allpairs::engine
