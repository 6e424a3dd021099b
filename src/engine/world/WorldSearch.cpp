// SPDX-License-Identifier: MIT
#include "world/WorldSearch.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "input/BoxReader.h"
#include "order/PairSort.h"

namespace allpairs::engine {
namespace {

/// Whether to drop a hit of a changed box, the first of the pair: the partner is the box itself, or has changed too and
/// finds the same pair from its side.
bool isFoundTwice(const BoxStore& store, Pair pair) noexcept {
  return (pair.first == pair.second) | (store.isTouched(pair.second) & (pair.second < pair.first));
}

/// Drops duplicates and puts the smaller id first in the other pairs; returns the remaining number.
std::size_t dropDoubles(const BoxStore& store, std::span<Pair> pairs) noexcept {
  std::size_t kept = 0;
  for (const Pair pair : pairs) {
    pairs[kept] = {std::min(pair.first, pair.second), std::max(pair.first, pair.second)};
    kept += isFoundTwice(store, pair) ? 0U : 1U;
  }
  return kept;
}

}  // namespace

void WorldSearch::update(BoxStore& store) {
  followNumbering(store);
  const BoxView& boxes = store.set();
  const bool isWhole = store.isNumbered() ? m_dynamicTrees.isWhole() && m_staticTrees.isWhole()
                                          : m_dynamic.isWhole() && m_static.isWhole();
  if (store.stale().empty() && isWhole) return;
  OverlapOptions lanes;
  // Queries test the boxes themselves: lanes contain them.
  lanes.distance = std::max(0.0, m_options.distance);
  const BoxReader reader(boxes, lanes, m_kernels);
  if (store.isNumbered()) {
    updateTrees(store, reader);
  } else {
    m_statistics.rebuilds += m_dynamic.update(store, reader, executor()) ? 1U : 0U;
    m_statistics.rebuilds += m_static.update(store, reader, executor()) ? 1U : 0U;
  }
  store.settle();
}

void WorldSearch::shrink() noexcept {
  std::pmr::memory_resource* const from = memory();
  m_dynamic.release();
  m_static.release();
  releaseTrees();
  m_changedDynamic = ChangedBoxes(from);
  m_changedStatic = ChangedBoxes(from);
  m_runner = JoinRunner(from);
  m_history.shrink();
  m_lists.shrink();
  const auto release = [](auto&... lists) { ((lists.clear(), lists.shrink_to_fit()), ...); };
  release(m_isChosen, m_chosen, m_large, m_partly, m_touchedIn, m_runs);
}

/// Releases the hierarchies of the other kind when the store becomes numbered, or is no longer.
void WorldSearch::followNumbering(const BoxStore& store) noexcept {
  if (std::exchange(m_isNumbered, store.isNumbered()) == store.isNumbered()) return;
  m_dynamic.release();
  m_static.release();
  releaseTrees();
}

void WorldSearch::releaseTrees() noexcept {
  m_members.release();
  m_dynamicTrees.release();
  m_staticTrees.release();
  m_small.release();
}

StepResult WorldSearch::step(BoxStore& store) {
  m_history.dropChanges();
  m_lists.prepareStep(store);
  followNumbering(store);
  if (!m_isNumbered) update(store);
  m_statistics.boxTests = 0;
  m_statistics.groupTests = 0;
  m_statistics.exactTests = 0;
  m_statistics.changed = store.touched().size();
  m_statistics.joinedAll = store.touched().size() > store.size() / kShareOfChanged;
  if (m_isNumbered) {
    joinWorlds(store);
  } else {
    m_statistics.joinedAll ? joinAll(store) : joinChanged(store);
  }
  m_lists.noteStep(store);
  store.endStep();
  return m_history.result();
}

/// The test of pairs of this world. Lanes are widened by the distance, unless it is negative, when all hits are tested.
PairTest WorldSearch::testOf(const BoxStore& store, double distance, bool exact) const {
  PairTest test(store.tested(), store.tested(), distance, m_options.accept);
  test.requireExactTestInDoubt(!exact || distance != 0.0, {});
  return test;
}

/// Joins two hierarchies; returns the number of box tests.
std::uint64_t WorldSearch::join(const BvhLevels& first, const BvhLevels& second, JoinRunner& runner) const {
  const BvhPair both(first, second);
  return join(JoinRunner::Job::ofJoin(both.first, both.second), runner);
}

std::uint64_t WorldSearch::join(const JoinRunner::Job& job, JoinRunner& runner) const {
  const std::uint64_t before = runner.totals().boxTests;
  runner.run(job, executor());
  return runner.totals().boxTests - before;
}

void WorldSearch::noteTotals() {
  const OverlapStatistics totals = m_runner.totals();
  m_statistics.boxTests += totals.boxTests;
  m_statistics.groupTests += totals.groupTests;
  m_statistics.exactTests += totals.exactTests;
}

void WorldSearch::joinAll(const BoxStore& store) {
  const PairTest test = testOf(store, m_options.distance, isExact());
  const auto take = [&](std::span<Pair> pairs, std::size_t worker) {
    m_history.take(pairs, worker);
    return pairs.size();
  };
  SinkOptions sink{&m_kernels, &test, PairSide::SmallerFirst};
  sink.stop = m_options.stop;
  sink.emit.emplace(take);
  m_history.begin(store.idBound(), m_runner.start(sink, executor()), Joined::All);
  const BvhView all = m_dynamic.levels().view();
  m_dynamic.rule().note(Joined::All, m_dynamic.size(), join(JoinRunner::Job::ofJoin(all, all), m_runner));
  m_static.rule().note(Joined::All, m_dynamic.size(), join(m_dynamic.levels(), m_static.levels(), m_runner));
  noteTotals();
  m_history.finishAll(executor());
}

/// Starts a join of changed boxes with all and calls use().
template <class Use>
void WorldSearch::withTouchedSink(const BoxStore& store, const Use& use) {
  const PairTest test = testOf(store, m_options.distance, isExact());
  const PairTest bounds = test.boundsOfHits();
  const PairTest filter = test.withoutBounds();  // Asked once for each pair.
  const auto take = [&](std::span<Pair> pairs, std::size_t worker) {
    const std::span<Pair> once = pairs.first(dropDoubles(store, pairs));
    m_history.take(once.first(filter.select(once)), worker);
    return pairs.size();
  };
  SinkOptions sink{&m_kernels, &bounds};
  sink.stop = m_options.stop;
  sink.emit.emplace(take);
  use(m_runner.start(sink, executor()));
}

void WorldSearch::joinChanged(const BoxStore& store) {
  withTouchedSink(store, [&](std::size_t workers) {
    m_history.begin(store.idBound(), workers, Joined::Changed);
    joinChangedTrees(store);
  });
  noteTotals();
  m_history.finishChanged([&](Pair pair) { return store.isTouched(pair.first) | store.isTouched(pair.second); },
                          executor());
}

void WorldSearch::joinChangedTrees(const BoxStore& store) {
  m_changedDynamic.gather(store.touched(), m_dynamic, m_kernels, executor());
  m_changedStatic.gather(store.touched(), m_static, m_kernels, executor());
  const auto joinWith = [&](ChangedBoxes& changed, DynamicBvh& with) {
    with.rule().note(Joined::Changed, changed.size(), join(changed.levels(), with.levels(), m_runner));
  };
  joinWith(m_changedDynamic, m_dynamic);
  joinWith(m_changedDynamic, m_static);
  joinWith(m_changedStatic, m_dynamic);
}

/// Joins the changed boxes of some large worlds with all boxes there, one world after the other.
void WorldSearch::joinPartly(const BoxStore& store) {
  withTouchedSink(store, [&](std::size_t) {
    for (const std::uint32_t world : m_partly) joinTouched(store, world);
  });
}

void WorldSearch::joinTouched(const BoxStore& store, std::size_t world) {
  const std::size_t shared = m_members.everyWorld();
  m_changedDynamic.gather(store, m_dynamicTrees.view(world), m_kernels, executor());
  m_changedStatic.gather(store, m_staticTrees.view(world), m_kernels, executor());
  const auto joinWith = [&](ChangedBoxes& changed, const WorldForest& trees, std::size_t with) -> std::uint64_t {
    const BvhView view = trees.view(with);
    if (changed.size() == 0 || view.depth == 0) return 0;
    const BvhPair both(changed.levels().view(), view);
    return join(JoinRunner::Job::ofJoin(both.first, both.second), m_runner);
  };
  const auto joinHere = [&](ChangedBoxes& changed, WorldForest& trees) {
    trees.rule(world).note(Joined::Changed, changed.size(), joinWith(changed, trees, world));
  };
  joinHere(m_changedDynamic, m_dynamicTrees);
  joinHere(m_changedDynamic, m_staticTrees);
  joinHere(m_changedStatic, m_dynamicTrees);
  joinWith(m_changedDynamic, m_dynamicTrees, shared);
  joinWith(m_changedDynamic, m_staticTrees, shared);
  joinWith(m_changedStatic, m_dynamicTrees, shared);
}

/// Calls visit(number, hierarchy) for all hierarchies that are not empty.
template <class Visit>
void WorldSearch::eachTree(const BoxStore& store, const Visit& visit) const {
  if (!store.isNumbered()) {
    treesOf(store, 0, [&](const BvhView& view) { visit(0, view); });
    return;
  }
  for (std::size_t world = 0; world <= m_members.everyWorld(); ++world) {
    const std::uint32_t number = m_members.numberOf(world);
    treesOf(store, number, [&](const BvhView& view) { visit(number, view); });
  }
}

/// Calls visit(hierarchy) for those of one world, or of the boxes of every world.
template <class Visit>
void WorldSearch::treesOf(const BoxStore& store, std::uint32_t number, const Visit& visit) const {
  const auto show = [&](const BvhView& view) {
    if (view.depth != 0) visit(view);
  };
  if (store.isNumbered()) {
    const std::size_t world = m_members.find(number);
    show(m_dynamicTrees.view(world));
    show(m_staticTrees.view(world));
  } else if (number == 0) {
    show(m_dynamic.levels().view());
    show(m_static.levels().view());
  }
}

std::vector<Pair> WorldSearch::findBetween(const BoxStore& store, const WorldSearch& other,
                                           const BoxStore& otherStore) const {
  const bool exact = isExact() && other.isExact() && m_options.distance == 0.0 && other.m_options.distance == 0.0;
  // Half of each: the lanes of the two worlds have been enlarged by that.
  const double distance = 0.5 * m_options.distance + 0.5 * other.m_options.distance;
  PairTest test(store.tested(), otherStore.tested(), distance, m_options.accept);
  test.requireExactTest(!exact);
  std::mutex mutex;
  std::vector<Pair> found;
  const auto take = [&](std::span<Pair> pairs, std::size_t) {
    const std::lock_guard lock(mutex);
    found.insert(found.end(), pairs.begin(), pairs.end());
    return pairs.size();
  };
  SinkOptions sink{&m_kernels, &test};
  sink.stop = m_options.stop;
  sink.emit.emplace(take);
  JoinRunner runner(defaultMemory());
  runner.start(sink, executor());
  eachTree(store, [&](std::uint32_t number, const BvhView& mine) {
    const auto joinWith = [&](const BvhView& theirs) {
      const BvhPair both(mine, theirs);
      join(JoinRunner::Job::ofJoin(both.first, both.second), runner);
    };
    if (number == kEveryWorld) {
      other.eachTree(otherStore, [&](std::uint32_t, const BvhView& theirs) { joinWith(theirs); });
    } else {
      other.treesOf(otherStore, number, joinWith);
      other.treesOf(otherStore, kEveryWorld, joinWith);
    }
  });
  PairSort::Task task;
  task.firsts = std::max<std::size_t>(1, store.idBound());
  task.seconds = std::max<std::size_t>(1, otherStore.idBound());
  task.order = m_options.order;
  PairSort(defaultMemory()).sort(found, task, executor());
  return found;
}

}  // namespace allpairs::engine
