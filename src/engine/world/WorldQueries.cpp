// SPDX-License-Identifier: MIT
#include "world/WorldQueries.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "bvh/HilbertSort.h"
#include "input/BoxReader.h"
#include "kernels/Kernels.h"
#include "memory/Platform.h"
#include "world/QueryDescent.h"
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

/// Sorts ids, of which no two are the same. Many that are close together are sorted as bits, in a fraction of the time.
void sortIds(std::span<BoxId> ids) {
  constexpr std::size_t kFew = 16;
  constexpr std::size_t kMostWords = 1024;
  if (ids.size() < kFew) return std::sort(ids.begin(), ids.end());
  const auto [least, most] = std::minmax_element(ids.begin(), ids.end());
  const BoxId first = *least;
  const std::size_t words = (*most - first) / 64 + 1;
  if (words > std::min(ids.size(), kMostWords)) return std::sort(ids.begin(), ids.end());
  std::array<std::uint64_t, kMostWords> bits;
  std::fill_n(bits.begin(), words, 0);
  for (const BoxId id : ids) bits[(id - first) / 64] |= std::uint64_t{1} << ((id - first) % 64);
  auto to = ids.begin();
  forEachBit(std::span<const std::uint64_t>(bits).first(words),
             [&](std::size_t bit) { *to++ = first + static_cast<BoxId>(bit); });
}

/// Queries of a batch, by their indices.
using Queries = std::span<const CurveKey>;

// What a batch asks about: boxes, points, rays or sweeps. Where query i starts, and a prefetch of its memory.

std::array<double, 3> startOf(const BoxView& boxes, std::size_t i) { return boxes[i].min; }
std::array<double, 3> startOf(std::span<const std::array<double, 3>> points, std::size_t i) { return points[i]; }
template <class Query>
std::array<double, 3> startOf(std::span<const Query> queries, std::size_t i) {
  return sweepOf(queries[i]).box.min;
}

/// Its first and its last line.
template <class T>
void prefetchObject(const T& object) noexcept {
  prefetchLine(&object);
  prefetchLine(reinterpret_cast<const std::byte*>(&object + 1) - 1);
}

void prefetchQuery(const BoxView& boxes, std::uint32_t i) noexcept { prefetchBox(boxes, i); }
template <class T>
void prefetchQuery(std::span<const T> queries, std::uint32_t i) noexcept {
  prefetchObject(queries[i]);
}

/// Calls use(query) for some queries, which lie in no order; prefetch(query) comes kPrefetchDistance queries before.
template <class Prefetch, class Use>
void eachQuery(Queries queries, const Prefetch& prefetch, const Use& use) {
  for (std::size_t i = 0; i < queries.size() + kPrefetchDistance; ++i) {
    if (i < queries.size()) prefetch(indexOf(queries[i]));
    if (i >= kPrefetchDistance) use(indexOf(queries[i - kPrefetchDistance]));
  }
}

/// Finds the values of some queries one after the other: find(query, values) appends those of one.
template <class Input, class Find>
auto oneByOne(const Input& input, const Find& find) {
  return [&input, find](Queries queries, auto& values, std::size_t* sizes) {
    const auto prefetch = [&](std::uint32_t query) { prefetchQuery(input, query); };
    eachQuery(queries, prefetch, [&](std::uint32_t query) {
      const std::size_t before = values.size();
      find(query, values);
      sizes[query] = values.size() - before;
    });
  };
}

/// Sizes, behind a zero, become offsets.
void sumUp(std::span<std::size_t> offsets) { std::partial_sum(offsets.begin(), offsets.end(), offsets.begin()); }

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
        visit(QueryTree{tree.view(), tree.exact(), m_search.kernels(), m_search.stop()});
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
template <class Input>
std::vector<CurveKey> WorldQueries::orderOf(const Input& input) const {
  std::vector<BoxF> starts(input.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const std::array<double, 3> point = startOf(input, i);
    starts[i].min = starts[i].max = {roundDown(point[0]), roundDown(point[1]), roundDown(point[2])};
  }
  const BoxView boxes(starts);
  std::vector<CurveKey> spare(starts.size());
  HilbertSort sort(defaultMemory());
  CallExecutor call;
  const std::span<const CurveKey> order = sort.sort({boxes, {}, m_search.kernels()}, spare, m_search.begin(call));
  return {order.begin(), order.end()};
}

/// Calls answer(task, queries) for all queries, some at a time, in spatial order: the same task answers neighbours.
template <class Answer>
void WorldQueries::answerInOrder(std::span<const CurveKey> order, const Answer& answer) const {
  CallExecutor call;
  m_search.begin(call).run((order.size() + kQueriesPerTask - 1) / kQueriesPerTask, [&](std::size_t task) {
    const std::size_t begin = task * kQueriesPerTask;
    answer(task, order.subspan(begin, std::min(order.size() - begin, kQueriesPerTask)));
  });
}

/// Answers the queries of a batch by find(queries, values, sizes), which appends to the values of a task and writes how
/// many each query has; then gathers them by query.
template <class T, class Input, class Find>
ResultLists<T> WorldQueries::findEach(const Input& input, const Find& find) const {
  const std::vector<CurveKey> order = orderOf(input);
  std::vector<std::vector<T>> parts((order.size() + kQueriesPerTask - 1) / kQueriesPerTask);
  ResultLists<T> lists;
  lists.offsets.assign(order.size() + 1, 0);
  answerInOrder(order, [&](std::size_t task, Queries some) { find(some, parts[task], lists.offsets.data() + 1); });
  sumUp(lists.offsets);
  lists.values.resize(lists.offsets.back());
  answerInOrder(order, [&](std::size_t task, Queries some) {
    const T* from = parts[task].data();
    for (const CurveKey key : some) {
      const std::size_t query = indexOf(key);
      const std::size_t size = lists.offsets[query + 1] - lists.offsets[query];
      std::copy_n(from, size, lists.values.data() + lists.offsets[query]);
      from += size;
    }
  });
  return lists;
}

/// Boxes that ask together, without empty ones, and whose size each writes; the arrays are not initialised.
struct WorldQueries::Askers {
  explicit Askers(std::span<Box> room) : boxes(room) {}

  std::span<Box> boxes;
  std::array<LaneBox, kTogether> lanes;
  std::array<bool, kTogether> areExact;
  std::array<std::size_t*, kTogether> sizes;
  std::size_t count = 0;

  void add(const Box& box, std::size_t& size) {
    if (isEmpty(box)) return;
    lanes[count] = lanesOf(box);
    boxes[count] = box;
    areExact[count] = boxOf(lanes[count]) == box;
    sizes[count++] = &size;
  }
};

/// In several hierarchies the hits of boxes that ask together would come mixed.
bool WorldQueries::canAskTogether() const {
  std::size_t trees = 0;
  eachBvh([&](const QueryTree&) { ++trees; });
  return trees == 1;
}

/// Appends the ids that each box overlaps, and adds how many there are to its size.
void WorldQueries::overlapping(const Askers& askers, std::vector<BoxId>& ids) const {
  std::size_t begin = ids.size();
  eachBvh([&](const QueryTree& tree) {
    descendTogether(tree, {askers.lanes.data(), askers.count}, [&](std::size_t i, BoxId id) {
      if (!passes(id)) return;
      const bool isCertain = tree.isExact && askers.areExact[i];
      if (!isCertain && !overlap(m_store.box(id), askers.boxes[i], m_store.margin(id))) return;
      ids.push_back(id);
      ++*askers.sizes[i];
    });
  });
  for (std::size_t i = 0; i < askers.count; ++i) {
    sortIds(std::span(ids).subspan(begin, *askers.sizes[i]));
    begin += *askers.sizes[i];
  }
}

/// One box descends node by node: it has not enough to test at once.
void WorldQueries::overlapping(const Box& query, std::vector<BoxId>& ids) const {
  if (isEmpty(query)) return;
  const std::size_t begin = ids.size();
  const LaneBox lanes = lanesOf(query);
  const bool queryIsExact = boxOf(lanes) == query;
  const auto lanesIn = [&](const LaneBlock& block) { return m_search.kernels().touchingLanes(block, lanes); };
  eachBvh([&](const QueryTree& tree) {
    const auto take = [&](BoxId id, const LaneBox&) {
      if (!passes(id)) return;
      if ((tree.isExact && queryIsExact) || overlap(m_store.box(id), query, m_store.margin(id))) ids.push_back(id);
    };
    descend(tree, lanesIn, take);
  });
  sortIds(std::span(ids).subspan(begin));
}

SweepHit WorldQueries::first(const BoxSweep& sweep) const {
  SweepHit best;
  if (isEmpty(sweep.box)) return best;
  const SweepLanes lanes = lanesOf(sweep);
  float limit = roundUpFar(sweep.length);
  const auto lanesIn = [&](const LaneBlock& block, float* times) {
    return m_search.kernels().meetingLanes(block, lanes, limit, times);
  };
  eachBvh([&](const QueryTree& tree) {
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
  eachBvh([&](const QueryTree& tree) {
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
float WorldQueries::limitFrom(const Box& query, std::span<const Neighbor> others) const {
  double farthest = 0.0;
  for (const Neighbor& other : others) {
    farthest = std::max(farthest, distanceBetween(query, widened(m_store.box(other.id), m_store.margin(other.id))));
  }
  return roundUpFar(farthest * farthest);
}

/// The boxes nearest to the previous query, which is close in space, cannot be far: they give an initial limit.
void WorldQueries::nearest(const Box& query, std::size_t count, std::vector<Neighbor>& neighbors) const {
  if (count == 0 || isEmpty(query)) return;
  const LaneBox lanes = lanesOf(query);
  float limit = kNever;
  if (neighbors.size() >= count) limit = limitFrom(query, std::span<const Neighbor>(neighbors).last(count));
  const auto lanesIn = [&](const LaneBlock& block, float* squares) {
    return m_search.kernels().nearLanes(block, lanes, limit, squares);
  };
  const std::size_t begin = neighbors.size();
  eachBvh([&](const QueryTree& tree) {
    const auto take = [&](BoxId id, const LaneBox& at) {
      if (!passes(id)) return;
      const Neighbor found{id, distanceBetween(query, widenedBox(id, at, tree.isExact))};
      if (!keepNearest(neighbors, begin, count, found)) return;
      const double farthest = neighbors[begin].distance;
      limit = std::min(limit, roundUpFar(farthest * farthest));
    };
    descendByCost(tree, lanesIn, limit, take);
  });
  std::sort(neighbors.begin() + static_cast<std::ptrdiff_t>(begin), neighbors.end(), isCloser);
}

/// The visitor measures for itself: a distance in double would be taken twice.
void WorldQueries::near(const Box& query, double distance, FunctionRef<double(BoxId)> visit) const {
  if (isEmpty(query)) return;
  const LaneBox lanes = lanesOf(query);
  const auto limitOf = [](double most) { return most >= 0.0 ? roundUpFar(most * most) : -1.0F; };
  float limit = limitOf(distance);
  const auto lanesIn = [&](const LaneBlock& block, float* squares) {
    return m_search.kernels().nearLanes(block, lanes, limit, squares);
  };
  eachBvh([&](const QueryTree& tree) {
    descendByCost(tree, lanesIn, limit, [&](BoxId id, const LaneBox&) {
      if (passes(id)) limit = std::min(limit, limitOf(visit(id)));
    });
  });
}

/// Of no more queries than one task answers, neither an order nor tasks pay.
ResultLists<BoxId> WorldQueries::overlapping(const BoxView& boxes) const {
  const bool areTogether = canAskTogether();
  const auto alone = oneByOne(boxes, [&](std::size_t i, std::vector<BoxId>& ids) { overlapping(boxes[i], ids); });
  const auto find = [&](Queries queries, std::vector<BoxId>& ids, std::size_t* sizes) {
    if (!areTogether) return alone(queries, ids, sizes);
    for (std::size_t begin = 0; begin < queries.size(); begin += kTogether) {
      std::array<Box, kTogether> room;
      Askers askers(room);
      for (const CurveKey key : queries.subspan(begin, std::min(queries.size() - begin, kTogether))) {
        askers.add(boxes[indexOf(key)], sizes[indexOf(key)]);
      }
      if (askers.count != 0) overlapping(askers, ids);
    }
  };
  if (boxes.size() > kQueriesPerTask) return findEach<BoxId>(boxes, find);
  checkStop(m_search.stop());
  std::array<CurveKey, kQueriesPerTask> order;
  std::iota(order.begin(), order.end(), CurveKey{0});
  ResultLists<BoxId> lists;
  lists.offsets.assign(boxes.size() + 1, 0);
  find(Queries(order).first(boxes.size()), lists.values, lists.offsets.data() + 1);
  sumUp(lists.offsets);
  return lists;
}

template <class Query>
void WorldQueries::first(std::span<const Query> queries, std::span<SweepHit> hits) const {
  answerInOrder(orderOf(queries), [&](std::size_t, Queries some) {
    const auto prefetch = [&](std::uint32_t i) {
      prefetchQuery(queries, i);
      prefetchObject(hits[i]);
    };
    eachQuery(some, prefetch, [&](std::uint32_t i) { hits[i] = first(sweepOf(queries[i])); });
  });
}
template void WorldQueries::first(std::span<const Ray>, std::span<SweepHit>) const;
template void WorldQueries::first(std::span<const BoxSweep>, std::span<SweepHit>) const;

template <class Query>
ResultLists<SweepHit> WorldQueries::all(std::span<const Query> queries) const {
  return findEach<SweepHit>(
      queries, oneByOne(queries, [&](std::size_t i, std::vector<SweepHit>& hits) { all(sweepOf(queries[i]), hits); }));
}
template ResultLists<SweepHit> WorldQueries::all(std::span<const Ray>) const;
template ResultLists<SweepHit> WorldQueries::all(std::span<const BoxSweep>) const;

ResultLists<Neighbor> WorldQueries::nearest(std::span<const std::array<double, 3>> points, std::size_t count) const {
  return findEach<Neighbor>(points, oneByOne(points, [&](std::size_t i, std::vector<Neighbor>& neighbors) {
                              nearest(Box{points[i], points[i]}, count, neighbors);
                            }));
}

ResultLists<Neighbor> WorldQueries::nearest(const BoxView& boxes, std::size_t count) const {
  return findEach<Neighbor>(boxes, oneByOne(boxes, [&](std::size_t i, std::vector<Neighbor>& neighbors) {
                              nearest(boxes[i], count, neighbors);
                            }));
}

}  // namespace allpairs::engine
