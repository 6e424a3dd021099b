// SPDX-License-Identifier: MIT
#include "world/WorldQueries.h"

#include <algorithm>
#include <tuple>

#include "QueryLanes.h"
#include "world/Descent.h"
#include "world/QueryTests.h"

namespace allpairs::engine {
namespace {

/// Queries that one task answers.
constexpr std::size_t kQueriesPerTask = 64;

bool isNearer(const SweepHit& a, const SweepHit& b) noexcept { return std::tie(a.t, a.id) < std::tie(b.t, b.id); }
bool isCloser(const Neighbor& a, const Neighbor& b) noexcept {
  return std::tie(a.distance, a.id) < std::tie(b.distance, b.id);
}

float asFloat(double value) noexcept {
  constexpr double kMost = 1e30;
  return static_cast<float>(std::clamp(value, -kMost, kMost));
}

}  // namespace

WorldQueries::Rule WorldQueries::ruleOf(const QueryFilter& filter) const noexcept {
  return {filter, !m_target.store->filtered() && filter.mask != 0 && filter.category != 0};
}

bool WorldQueries::passes(BoxId id, const Rule& rule) const noexcept {
  if (rule.everyBox) return true;
  const FilterRow& row = m_target.store->filter(id);
  return (row.category & rule.filter.mask) != 0 && (row.mask & rule.filter.category) != 0;
}

Box WorldQueries::widenedBox(BoxId id) const noexcept {
  return widened(m_target.store->box(id), m_target.store->margin(id));
}

template <class Visit>
void WorldQueries::eachHierarchy(const QueryFilter& filter, const Visit& visit) const {
  const auto& [dynamicBoxes, staticBoxes] = m_target.hierarchies;
  if (filter.dynamicBoxes && dynamicBoxes.depth != 0) visit(dynamicBoxes);
  if (filter.staticBoxes && staticBoxes.depth != 0) visit(staticBoxes);
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
  const auto begin = static_cast<std::ptrdiff_t>(ids.size());
  const LaneBox lanes = lanesOf(query);
  const auto lanesIn = [&](const LaneBlock& block) { return m_target.kernels->touchingLanes(block, lanes); };
  const auto take = [&](BoxId id) {
    if (passes(id, rule) && overlap(m_target.store->box(id), query, m_target.store->margin(id))) ids.push_back(id);
  };
  eachHierarchy(rule.filter, [&](const Hierarchy& hierarchy) { Descent(hierarchy, lanesIn, take).run(); });
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
  const auto take = [&](BoxId id) {
    if (!passes(id, rule)) return;
    const SweepHit hit{id, meetingTime(sweep, widenedBox(id))};
    if (hit.t >= kFar || !isNearer(hit, best)) return;
    best = hit;
    limit = roundUpFar(hit.t);
  };
  eachHierarchy(rule.filter,
                [&](const Hierarchy& hierarchy) { CheapestDescent(hierarchy, lanesIn, limit, take).run(); });
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
  const auto take = [&](BoxId id) {
    if (!passes(id, rule)) return;
    const double t = meetingTime(sweep, widenedBox(id));
    if (t < kFar) hits.push_back({id, t});
  };
  eachHierarchy(rule.filter, [&](const Hierarchy& hierarchy) { Descent(hierarchy, lanesIn, take).run(); });
  std::sort(hits.begin() + begin, hits.end(), isNearer);
}

/// The last part of the list is a heap of the nearest so far, the farthest of them on top, until it is sorted.
void WorldQueries::nearest(const std::array<double, 3>& point, std::size_t count, const Rule& rule,
                           std::vector<Neighbor>& neighbors) const {
  if (count == 0) return;
  const auto begin = static_cast<std::ptrdiff_t>(neighbors.size());
  const PointLanes lanes = lanesOf(point);
  float limit = kNever;
  const auto lanesIn = [&](const LaneBlock& block, float* squares) {
    return m_target.kernels->nearLanes(block, lanes, limit, squares);
  };
  const auto take = [&](BoxId id) {
    if (!passes(id, rule)) return;
    const Neighbor found{id, distanceFrom(point, widenedBox(id))};
    const auto heap = neighbors.begin() + begin;
    if (static_cast<std::size_t>(neighbors.end() - heap) == count) {
      if (!isCloser(found, *heap)) return;
      std::pop_heap(heap, neighbors.end(), isCloser);
      neighbors.pop_back();
    }
    neighbors.push_back(found);
    std::push_heap(neighbors.begin() + begin, neighbors.end(), isCloser);
    if (neighbors.size() - static_cast<std::size_t>(begin) < count) return;
    const double farthest = neighbors[static_cast<std::size_t>(begin)].distance;
    limit = roundUpFar(farthest * farthest);
  };
  eachHierarchy(rule.filter,
                [&](const Hierarchy& hierarchy) { CheapestDescent(hierarchy, lanesIn, limit, take).run(); });
  std::sort(neighbors.begin() + begin, neighbors.end(), isCloser);
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
