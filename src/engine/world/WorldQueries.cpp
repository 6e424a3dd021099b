// SPDX-License-Identifier: MIT
#include "world/WorldQueries.h"

#include <algorithm>
#include <bit>
#include <tuple>

#include "bvh/HilbertSort.h"
#include "world/QueryTests.h"

namespace allpairs::engine {
namespace {

/// Queries that one task answers: some ten microseconds of work (query_benchmark).
constexpr std::size_t kQueriesPerTask = 64;

bool isNearer(const SweepHit& a, const SweepHit& b) noexcept { return std::tie(a.t, a.id) < std::tie(b.t, b.id); }
bool isCloser(const Neighbor& a, const Neighbor& b) noexcept {
  return std::tie(a.distance, a.id) < std::tie(b.distance, b.id);
}

/// Keeps the `count` nearest boxes found, from position `begin` of the list on, as a heap with the farthest on top;
/// returns whether it is full and has changed.
bool keepNearest(std::vector<Neighbor>& list, std::size_t begin, std::size_t count, const Neighbor& found) {
  const auto first = [&] { return list.begin() + static_cast<std::ptrdiff_t>(begin); };
  if (list.size() - begin == count) {
    if (!isCloser(found, list[begin])) return false;
    std::pop_heap(first(), list.end(), isCloser);
    list.pop_back();
  }
  list.push_back(found);
  std::push_heap(first(), list.end(), isCloser);
  return list.size() - begin == count;
}

/// A hierarchy that a query descends, and the flag that ends it.
struct Tree {
  const BvhView& view;
  bool isExact;  ///< Whether lanes are the boxes.
  const StopFlag* stop;

  /// Before a block of a level, so that two looks have 256 boxes between them at most.
  void look(std::size_t level) const {
    if (level == 1) checkStop(stop);
  }
};

/// Calls take(id, lanes) for all candidate boxes; lanesOf(block) has a bit for each candidate lane.
template <class LanesOf, class Take>
void descend(const Tree& tree, const LanesOf& lanesOf, const Take& take) {
  const BvhView& view = tree.view;
  // As deep as there are levels, at most kMaxLevels.
  const auto visit = [&](const auto& self, std::size_t level, std::size_t block) -> void {
    tree.look(level);
    const LaneBlock& lanes = view.level[level].blocks[block];
    forEachBit(lanesOf(lanes), [&](std::size_t lane) {
      const std::size_t child = block * kFanOut + lane;
      level == 0 ? take(view.ids[child], lanes.get(lane)) : self(self, level - 1, child);
    });
  };
  visit(visit, view.depth - 1, 0);
}

/// The cheapest of some lanes. Most often few are visited before the limit excludes the rest: sorting all takes longer.
std::size_t cheapestLane(std::uint32_t bits, const std::array<float, kFanOut>& costs) noexcept {
  auto best = static_cast<std::size_t>(std::countr_zero(bits));
  for (bits &= bits - 1; bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
    best = costs[lane] < costs[best] ? lane : best;
  }
  return best;
}

/// Calls take(id, lanes) for boxes in approximate order of cost, up to a limit that take() may lower.
///
/// lanesOf(block, costs) has a bit for each lane of a block that may be within the limit, and writes the costs of the
/// lanes: lower bounds of the costs of their boxes, and not negative.
template <class LanesOf, class Take>
void descendByCost(const Tree& tree, const LanesOf& lanesOf, const float& limit, const Take& take) {
  const BvhView& view = tree.view;
  const auto visit = [&](const auto& self, std::size_t level, std::size_t block) -> void {
    tree.look(level);
    std::array<float, kFanOut> costs;
    const LaneBlock& lanes = view.level[level].blocks[block];
    std::uint32_t bits = lanesOf(lanes, costs.data());
    while (bits != 0) {
      const std::size_t lane = cheapestLane(bits, costs);
      if (costs[lane] > limit) return;
      bits &= ~(1U << lane);
      const std::size_t child = block * kFanOut + lane;
      level == 0 ? take(view.ids[child], lanes.get(lane)) : self(self, level - 1, child);
    }
  };
  visit(visit, view.depth - 1, 0);
}

}  // namespace

WorldQueries::WorldQueries(const BoxStore& store, const WorldSearch& search, const QueryFilter& filter) noexcept
    : m_store(store),
      m_search(search),
      m_filter(filter),
      m_everyBox(!store.filtered() && filter.mask != 0 && filter.category != 0) {}

bool WorldQueries::passes(BoxId id) const noexcept {
  if (m_everyBox) return true;
  const FilterRow& row = m_store.filter(id);
  return acceptEachOther(row.category, row.mask, m_filter.category, m_filter.mask);
}

Box WorldQueries::widenedBox(BoxId id, const LaneBox& lanes, bool exact) const noexcept {
  return exact ? boxOf(lanes) : widened(m_store.box(id), m_store.margin(id));
}

template <class Visit>
void WorldQueries::eachBvh(const Visit& visit) const {
  const auto show = [&](std::size_t world) {
    m_search.eachTree(world, [&](const DynamicBvh& tree, bool isStatic) {
      if (isStatic ? m_filter.staticBoxes : m_filter.dynamicBoxes)
        visit(Tree{tree.view(), tree.exact(), m_search.stop()});
    });
  };
  // Those of all worlds, or of the filter's and of the boxes of every world.
  const WorldMembers& members = m_search.members();
  if (m_filter.world != kEveryWorld) {
    show(members.find(m_filter.world));
  } else {
    for (std::size_t world = 0; world < members.everyWorld(); ++world) show(world);
  }
  show(members.everyWorld());
}

/// The order in which a batch is answered: queries that start near each other are consecutive, for cache locality.
template <class PointOf>
std::vector<CurveKey> WorldQueries::orderOf(std::size_t queries, const PointOf& pointOf) const {
  std::vector<BoxF> starts(queries);
  for (std::size_t i = 0; i < queries; ++i) {
    const std::array<double, 3> point = pointOf(i);
    starts[i].min = starts[i].max = {roundDown(point[0]), roundDown(point[1]), roundDown(point[2])};
  }
  const BoxView boxes(starts);
  std::vector<CurveKey> spare(queries);
  HilbertSort sort(defaultMemory());
  CallExecutor call;
  const std::span<const CurveKey> order = sort.sort({boxes, {}, m_search.kernels()}, spare, m_search.begin(call));
  return {order.begin(), order.end()};
}

/// Calls answer(task, query) for all queries, in spatial order: the same task answers neighbours.
template <class Answer>
void WorldQueries::answerInOrder(std::span<const CurveKey> order, const Answer& answer) const {
  CallExecutor call;
  m_search.begin(call).run((order.size() + kQueriesPerTask - 1) / kQueriesPerTask, [&](std::size_t task) {
    const std::size_t end = std::min(order.size(), (task + 1) * kQueriesPerTask);
    for (std::size_t i = task * kQueriesPerTask; i < end; ++i) answer(task, indexOf(order[i]));
  });
}

/// Answers each query by find(i, values), which appends to the values of its task; then gathers them by query.
template <class T, class PointOf, class Find>
ResultLists<T> WorldQueries::findEach(std::size_t queries, const PointOf& pointOf, const Find& find) const {
  const std::vector<CurveKey> order = orderOf(queries, pointOf);
  std::vector<std::vector<T>> parts((queries + kQueriesPerTask - 1) / kQueriesPerTask);
  ResultLists<T> lists;
  lists.offsets.assign(queries + 1, 0);
  answerInOrder(order, [&](std::size_t task, std::size_t query) {
    const std::size_t before = parts[task].size();
    find(query, parts[task]);
    lists.offsets[query + 1] = parts[task].size() - before;
  });
  for (std::size_t i = 0; i < queries; ++i) lists.offsets[i + 1] += lists.offsets[i];
  lists.values.resize(lists.offsets[queries]);
  std::vector<std::size_t> read(parts.size(), 0);
  answerInOrder(order, [&](std::size_t task, std::size_t query) {
    const std::size_t size = lists.offsets[query + 1] - lists.offsets[query];
    std::copy_n(parts[task].data() + read[task], size, lists.values.data() + lists.offsets[query]);
    read[task] += size;
  });
  return lists;
}

void WorldQueries::overlapping(const Box& query, std::vector<BoxId>& ids) const {
  if (isEmpty(query)) return;
  const auto begin = static_cast<std::ptrdiff_t>(ids.size());
  const LaneBox lanes = lanesOf(query);
  const bool queryIsExact = boxOf(lanes) == query;
  const auto lanesIn = [&](const LaneBlock& block) { return m_search.kernels().touchingLanes(block, lanes); };
  eachBvh([&](const Tree& tree) {
    const auto take = [&](BoxId id, const LaneBox&) {
      if (!passes(id)) return;
      if ((tree.isExact && queryIsExact) || overlap(m_store.box(id), query, m_store.margin(id))) ids.push_back(id);
    };
    descend(tree, lanesIn, take);
  });
  std::sort(ids.begin() + begin, ids.end());
}

SweepHit WorldQueries::first(const BoxSweep& sweep) const {
  SweepHit best;
  if (isEmpty(sweep.box)) return best;
  const SweepLanes lanes = lanesOf(sweep);
  float limit = roundUpFar(sweep.length);
  const auto lanesIn = [&](const LaneBlock& block, float* times) {
    return m_search.kernels().meetingLanes(block, lanes, limit, times);
  };
  eachBvh([&](const Tree& tree) {
    const auto take = [&](BoxId id, const LaneBox& at) {
      if (!passes(id)) return;
      const SweepHit hit{id, meetingTime(sweep, widenedBox(id, at, tree.isExact))};
      if (hit.t >= kFar || !isNearer(hit, best)) return;
      best = hit;
      limit = roundUpFar(hit.t);
    };
    descendByCost(tree, lanesIn, limit, take);
  });
  return best;
}

void WorldQueries::all(const BoxSweep& sweep, std::vector<SweepHit>& hits) const {
  if (isEmpty(sweep.box)) return;
  const auto begin = static_cast<std::ptrdiff_t>(hits.size());
  const SweepLanes lanes = lanesOf(sweep);
  const float limit = roundUpFar(sweep.length);
  const auto lanesIn = [&](const LaneBlock& block) {
    std::array<float, kFanOut> times;
    return m_search.kernels().meetingLanes(block, lanes, limit, times.data());
  };
  eachBvh([&](const Tree& tree) {
    const auto take = [&](BoxId id, const LaneBox& at) {
      if (!passes(id)) return;
      const double t = meetingTime(sweep, widenedBox(id, at, tree.isExact));
      if (t < kFar) hits.push_back({id, t});
    };
    descend(tree, lanesIn, take);
  });
  std::sort(hits.begin() + begin, hits.end(), isNearer);
}

/// The square of a distance within which all given boxes are, rounded up.
float WorldQueries::limitFrom(const std::array<double, 3>& point, std::span<const Neighbor> others) const {
  double farthest = 0.0;
  for (const Neighbor& other : others) {
    const Box box = widened(m_store.box(other.id), m_store.margin(other.id));
    farthest = std::max(farthest, distanceFrom(point, box));
  }
  return roundUpFar(farthest * farthest);
}

/// The boxes nearest to the previous query, which is close in space, cannot be far: they give an initial limit.
void WorldQueries::nearest(const std::array<double, 3>& point, std::size_t count,
                           std::vector<Neighbor>& neighbors) const {
  if (count == 0) return;
  const LaneBox lanes = lanesOf(Box{point, point});
  float limit = kNever;
  if (neighbors.size() >= count) limit = limitFrom(point, std::span<const Neighbor>(neighbors).last(count));
  const auto lanesIn = [&](const LaneBlock& block, float* squares) {
    return m_search.kernels().nearLanes(block, lanes, limit, squares);
  };
  const std::size_t begin = neighbors.size();
  eachBvh([&](const Tree& tree) {
    const auto take = [&](BoxId id, const LaneBox& at) {
      if (!passes(id)) return;
      const Neighbor found{id, distanceFrom(point, widenedBox(id, at, tree.isExact))};
      if (!keepNearest(neighbors, begin, count, found)) return;
      const double farthest = neighbors[begin].distance;
      limit = std::min(limit, roundUpFar(farthest * farthest));
    };
    descendByCost(tree, lanesIn, limit, take);
  });
  std::sort(neighbors.begin() + static_cast<std::ptrdiff_t>(begin), neighbors.end(), isCloser);
}

ResultLists<BoxId> WorldQueries::overlapping(const BoxView& boxes) const {
  return findEach<BoxId>(
      boxes.size(), [&](std::size_t i) { return boxes[i].min; },
      [&](std::size_t i, std::vector<BoxId>& ids) { overlapping(boxes[i], ids); });
}

void WorldQueries::first(std::span<const BoxSweep> sweeps, std::span<SweepHit> hits) const {
  const auto order = orderOf(sweeps.size(), [&](std::size_t i) { return sweeps[i].box.min; });
  answerInOrder(order, [&](std::size_t, std::size_t query) { hits[query] = first(sweeps[query]); });
}

ResultLists<SweepHit> WorldQueries::all(std::span<const BoxSweep> sweeps) const {
  return findEach<SweepHit>(
      sweeps.size(), [&](std::size_t i) { return sweeps[i].box.min; },
      [&](std::size_t i, std::vector<SweepHit>& hits) { all(sweeps[i], hits); });
}

ResultLists<Neighbor> WorldQueries::nearest(std::span<const std::array<double, 3>> points, std::size_t count) const {
  return findEach<Neighbor>(
      points.size(), [&](std::size_t i) { return points[i]; },
      [&](std::size_t i, std::vector<Neighbor>& neighbors) { nearest(points[i], count, neighbors); });
}

}  // namespace allpairs::engine
