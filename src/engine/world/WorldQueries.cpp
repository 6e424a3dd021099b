// SPDX-License-Identifier: MIT
#include "world/WorldQueries.h"

#include <algorithm>
#include <tuple>

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

LaneBox lanesOf(const Box& box) noexcept {
  LaneBox lanes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lanes.bound[axis] = roundDown(box.min[axis]);
    lanes.bound[axis + 3] = roundUp(box.max[axis]);
  }
  return lanes;
}

}  // namespace

bool WorldQueries::passes(BoxId id, const QueryFilter& filter) const noexcept {
  const FilterRow& row = m_target.store->filter(id);
  return (row.category & filter.mask) != 0 && (row.mask & filter.category) != 0;
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

/// Answers query after query, each by find(i, values), which appends to the values; in parts, and then all in one.
template <class T, class Find>
ResultLists<T> WorldQueries::findEach(std::size_t queries, Lists<T>& lists, const Find& find) {
  const std::size_t tasks = (queries + kQueriesPerTask - 1) / kQueriesPerTask;
  if (lists.parts.size() < tasks) lists.parts.resize(tasks);
  m_target.executor->run(tasks, [&](std::size_t task) {
    auto& part = lists.parts[task];
    part.values.clear();
    part.sizes.clear();
    const std::size_t end = std::min(queries, (task + 1) * kQueriesPerTask);
    for (std::size_t i = task * kQueriesPerTask; i < end; ++i) {
      const std::size_t before = part.values.size();
      find(i, part.values);
      part.sizes.push_back(part.values.size() - before);
    }
  });
  lists.values.clear();
  lists.offsets.assign(1, 0);
  for (std::size_t task = 0; task < tasks; ++task) {
    const auto& part = lists.parts[task];
    lists.values.insert(lists.values.end(), part.values.begin(), part.values.end());
    for (const std::size_t size : part.sizes) lists.offsets.push_back(lists.offsets.back() + size);
  }
  return {lists.offsets, lists.values};
}

void WorldQueries::overlapping(const Box& query, const QueryFilter& filter, std::vector<BoxId>& ids) const {
  const auto begin = static_cast<std::ptrdiff_t>(ids.size());
  const LaneBox lanes = lanesOf(query);
  const auto take = [&](BoxId id) {
    if (passes(id, filter) && overlap(m_target.store->box(id), query, m_target.store->margin(id))) ids.push_back(id);
  };
  eachHierarchy(filter, [&](const Hierarchy& hierarchy) { TouchingDescent(hierarchy, lanes, take).run(); });
  std::sort(ids.begin() + begin, ids.end());
}

SweepHit WorldQueries::first(const BoxSweep& sweep, const QueryFilter& filter) const {
  SweepHit best;
  if (isEmpty(sweep.box)) return best;
  const auto cost = [&](const Box& box) { return meetingTime(sweep, box); };
  const auto take = [&](BoxId id) {
    if (!passes(id, filter)) return;
    const SweepHit hit{id, meetingTime(sweep, widenedBox(id))};
    if (hit.t < kFar && isNearer(hit, best)) best = hit;
  };
  eachHierarchy(filter, [&](const Hierarchy& hierarchy) { CheapestDescent(hierarchy, cost, best.t, take).run(); });
  return best;
}

void WorldQueries::all(const BoxSweep& sweep, const QueryFilter& filter, std::vector<SweepHit>& hits) const {
  if (isEmpty(sweep.box)) return;
  const auto begin = static_cast<std::ptrdiff_t>(hits.size());
  const auto cost = [&](const Box& box) { return meetingTime(sweep, box); };
  const auto take = [&](BoxId id) {
    if (!passes(id, filter)) return;
    const double t = meetingTime(sweep, widenedBox(id));
    if (t < kFar) hits.push_back({id, t});
  };
  eachHierarchy(filter, [&](const Hierarchy& hierarchy) { CheapestDescent(hierarchy, cost, kFar, take).run(); });
  std::sort(hits.begin() + begin, hits.end(), isNearer);
}

/// The last part of the list is a heap of the nearest so far, the farthest of them on top, until it is sorted.
void WorldQueries::nearest(const std::array<double, 3>& point, std::size_t count, const QueryFilter& filter,
                           std::vector<Neighbor>& neighbors) const {
  if (count == 0) return;
  const auto begin = static_cast<std::ptrdiff_t>(neighbors.size());
  double limit = kFar;
  const auto cost = [&](const Box& box) { return distanceFrom(point, box); };
  const auto take = [&](BoxId id) {
    if (!passes(id, filter)) return;
    const Neighbor found{id, distanceFrom(point, widenedBox(id))};
    const auto heap = neighbors.begin() + begin;
    if (static_cast<std::size_t>(neighbors.end() - heap) == count) {
      if (!isCloser(found, *heap)) return;
      std::pop_heap(heap, neighbors.end(), isCloser);
      neighbors.pop_back();
    }
    neighbors.push_back(found);
    std::push_heap(neighbors.begin() + begin, neighbors.end(), isCloser);
    if (neighbors.size() - static_cast<std::size_t>(begin) == count)
      limit = neighbors[static_cast<std::size_t>(begin)].distance;
  };
  eachHierarchy(filter, [&](const Hierarchy& hierarchy) { CheapestDescent(hierarchy, cost, limit, take).run(); });
  std::sort(neighbors.begin() + begin, neighbors.end(), isCloser);
}

ResultLists<BoxId> WorldQueries::findOverlapping(const BoxSet& boxes, const QueryFilter& filter) {
  return findEach(boxes.size(), m_boxes,
                  [&](std::size_t i, std::vector<BoxId>& ids) { overlapping(boxes[i], filter, ids); });
}

void WorldQueries::findFirst(std::span<const BoxSweep> sweeps, std::span<SweepHit> hits, const QueryFilter& filter) {
  m_target.executor->run((sweeps.size() + kQueriesPerTask - 1) / kQueriesPerTask, [&](std::size_t task) {
    const std::size_t end = std::min(sweeps.size(), (task + 1) * kQueriesPerTask);
    for (std::size_t i = task * kQueriesPerTask; i < end; ++i) hits[i] = first(sweeps[i], filter);
  });
}

ResultLists<SweepHit> WorldQueries::findAll(std::span<const BoxSweep> sweeps, const QueryFilter& filter) {
  return findEach(sweeps.size(), m_hits,
                  [&](std::size_t i, std::vector<SweepHit>& hits) { all(sweeps[i], filter, hits); });
}

ResultLists<Neighbor> WorldQueries::findNearest(std::span<const std::array<double, 3>> points, std::size_t count,
                                                const QueryFilter& filter) {
  return findEach(points.size(), m_neighbors, [&](std::size_t i, std::vector<Neighbor>& neighbors) {
    nearest(points[i], count, filter, neighbors);
  });
}

}  // namespace allpairs::engine
