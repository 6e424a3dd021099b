// SPDX-License-Identifier: MIT
#include "world/WorldSearch.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <utility>

#include "input/BoxReader.h"
#include "input/Parts.h"
#include "kernels/WorldsRun.h"
#include "order/PairSort.h"

namespace allpairs::engine {
namespace {

/// Joining a changed box with its world takes as long as so many tests where all of a small world are made
/// (docs/decisions/0031).
constexpr std::size_t kTestsForChange = 2048;

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

void WorldSearch::update(BoxStore& store, WorkingThreads* working) {
  const BoxView& boxes = store.set();
  if (store.stale().empty() && m_forest.isWhole()) return;
  OverlapOptions lanes;
  // Queries test the boxes themselves: lanes contain them.
  lanes.distance = std::max(0.0, m_options.distance);
  const BoxReader reader(boxes, lanes, m_kernels);
  CallExecutor call;  // queries make updates, too
  Executor& executor = call.over(m_options.executor, m_options.stop, working);
  m_members.update(store, executor);
  m_rebuilds += m_forest.update(store, m_members, reader, executor);
  store.settle();
}

void WorldSearch::shrink() noexcept {
  m_members.release();
  m_forest.release();
  m_small.release();
  m_changedDynamic = ChangedBoxes(m_memory, m_kernels);
  m_changedStatic = ChangedBoxes(m_memory, m_kernels);
  m_runner = JoinRunner(m_memory);
  m_history.shrink();
  m_lists.shrink();
  const auto release = [](auto&... lists) { ((lists.clear(), lists.shrink_to_fit()), ...); };
  release(m_isChosen, m_chosen, m_large, m_partly, m_touchedIn, m_touched, m_runs);
}

void WorldSearch::findPairs(BoxStore& store, std::atomic<bool>& isUpdated) {
  static_cast<void>(begin(m_stepExecutor));
  m_history.dropChanges();
  m_lists.prepareStep(store);
  static_cast<void>(store.set());  // The tests read it.
  m_members.update(store, m_stepExecutor);
  const PairTest filter = testOf(store, 0.0, true);
  m_small.start(store, filter, m_stepExecutor.concurrency());
  m_statistics.changed = store.touched().size();
  m_statistics.joinedAll = chooseWorlds(store);
  moveLarge();
  // Small worlds are searched without hierarchies; but `accept` may ask queries.
  const bool joinsTrees = !m_large.empty() || (!m_partly.empty() && !m_small.takesChanged());
  if (joinsTrees || m_options.accept) {
    update(store);
    isUpdated.store(true, std::memory_order_release);
  }
  m_statistics.boxTests = 0;
  m_statistics.groupTests = 0;
  m_statistics.exactTests = 0;
  join(store);
  m_statistics.boxTests += m_small.boxTests();
}

StepResult WorldSearch::listPairs(BoxStore& store) {
  if (m_statistics.joinedAll) {
    m_history.finishAll(m_stepExecutor, m_runner);
  } else if (store.touched().empty()) {
    // All pairs persist, as begin() left them.
  } else if (m_chosen.empty() && m_large.empty()) {
    m_history.finishChanged([&](Pair pair) { return store.isTouched(pair.first) | store.isTouched(pair.second); },
                            m_stepExecutor);
  } else {
    m_history.finishChanged([&](Pair pair) { return isLookedFor(store, pair); }, m_stepExecutor);
  }
  m_statistics.rebuilds = m_rebuilds;
  m_lists.noteStep(store);
  store.endStep();
  return m_history.result();
}

/// The test of pairs of this world. Lanes are widened by the distance, unless it is negative, when all hits are tested.
PairTest WorldSearch::testOf(const BoxStore& store, double distance, bool exact) const {
  PairTest test(store.tested(), store.tested(), distance, m_options.accept);
  test.requireExactTestInDoubt(!exact || distance != 0.0);
  return test;
}

/// Counts the changed boxes of each world, and lists the worlds that have some.
void WorldSearch::countTouched(const BoxStore& store) {
  m_touchedIn.assign(m_members.everyWorld() + 1, 0);
  m_chosen.clear();
  if (!store.isNumbered()) {  // They are of one world, those that have gone included.
    m_touchedIn[0] = static_cast<std::uint32_t>(store.touched().size());
    if (m_touchedIn[0] != 0) m_chosen.push_back(0);
    return;
  }
  for (const BoxId id : store.touched()) {
    if (!store.contains(id)) continue;
    const std::size_t world = m_members.worldOf(id);
    if (m_touchedIn[world]++ == 0) m_chosen.push_back(static_cast<std::uint32_t>(world));
  }
  std::sort(m_chosen.begin(), m_chosen.end());
}

/// Chooses the worlds to search: those in which a box has changed, or all if these have many boxes, since looking up
/// each pair among those of the last step would then take longer than comparing the lists. Returns whether all worlds
/// are searched, as a whole.
bool WorldSearch::chooseWorlds(const BoxStore& store) {
  const std::size_t most = store.size() / kShareToJoinAll;
  if (store.touched().size() <= most && chooseChanged(store) <= most) return false;
  const std::size_t worlds = m_members.everyWorld() + 1;
  m_partly.clear();
  m_chosen.resize(worlds);
  std::iota(m_chosen.begin(), m_chosen.end(), 0U);
  m_isChosen.assign(worlds, 1);
  return true;
}

/// Chooses the worlds in which a box has changed; of large worlds with few changed boxes only these are joined. Returns
/// how many boxes are searched: all, if one of every world has changed.
std::size_t WorldSearch::chooseChanged(const BoxStore& store) {
  countTouched(store);
  if (m_touchedIn[m_members.everyWorld()] != 0) return store.size();
  m_isChosen.assign(m_touchedIn.size(), 0);
  m_partly.clear();
  std::size_t boxes = 0;
  std::size_t whole = 0;
  for (const std::uint32_t world : m_chosen) {
    const std::size_t size = m_members.size(world);
    const bool isJoinedWhole =
        store.isNumbered() && m_small.takes(world) && m_small.testsOf(world) < m_touchedIn[world] * kTestsForChange;
    if (m_touchedIn[world] <= size / kShareToJoinAll && !isJoinedWhole) {
      m_partly.push_back(world);
      boxes += m_touchedIn[world];
    } else {
      m_chosen[whole++] = world;
      m_isChosen[world] = 1;
      boxes += size;
    }
  }
  m_chosen.resize(whole);
  return boxes;
}

/// Moves the chosen worlds that are too large for an exhaustive search to a list of their own.
void WorldSearch::moveLarge() {
  m_large.clear();
  std::size_t kept = 0;
  for (const std::uint32_t world : m_chosen) {
    if (m_small.takes(world)) {
      m_chosen[kept++] = world;
    } else if (m_members.size(world) != 0) {
      m_large.push_back(world);
    }
  }
  m_chosen.resize(kept);
}

/// Whether the pairs of two boxes of the last step were looked for.
bool WorldSearch::isLookedFor(const BoxStore& store, Pair pair) const noexcept {
  if (store.isTouched(pair.first) || store.isTouched(pair.second)) return true;
  return (m_isChosen[m_members.worldOf(pair.first)] | m_isChosen[m_members.worldOf(pair.second)]) != 0;
}

/// Finds the pairs of the chosen worlds.
void WorldSearch::join(const BoxStore& store) {
  const auto takeSmall = [&](std::span<const Pair> pairs, std::size_t worker) { m_history.take(pairs, worker, true); };
  m_history.begin(store.idBound(), m_stepExecutor.concurrency(), m_statistics.joinedAll);
  cutIntoRuns(
      m_chosen, [&](std::uint32_t world) { return m_members.size(world); }, m_runs);
  m_stepExecutor.run(m_runs.size() - 1, [&](std::size_t run) {
    m_small.search(std::span(m_chosen).subspan(m_runs[run], m_runs[run + 1] - m_runs[run]), takeSmall);
  });
  if (!m_large.empty() || m_statistics.joinedAll) joinTrees(store);  // All pairs are ordered in its memory.
  if (m_partly.empty()) return;
  m_small.takesChanged() ? searchChanged(store) : joinPartly(store);
}

/// Finds the pairs of the large worlds in their hierarchies: a task has some worlds, or a part of a huge or the only
/// one.
void WorldSearch::joinTrees(const BoxStore& store) {
  const PairTest test = testOf(store, m_options.distance, m_forest.exact());
  const auto take = [&](std::span<Pair> pairs, std::size_t worker) {
    m_history.take(pairs, worker);
    return pairs.size();
  };
  SinkOptions sink{test, &m_kernels, PairSide::SmallerFirst};
  sink.stop = m_options.stop;
  sink.emit.emplace(take);
  m_runner.start(sink, m_stepExecutor);
  const std::span<const std::uint32_t> worlds = m_large;
  const auto sizeOf = [&](std::uint32_t world) { return m_members.size(world); };
  const auto isHuge = [&](std::uint32_t world) { return worlds.size() == 1 || sizeOf(world) > kPartSize; };
  cutIntoRuns(worlds, sizeOf, m_runs);
  m_runner.runTasks(m_runs.size() - 1, m_stepExecutor, [&](std::size_t task, const auto& joinPart) {
    for (std::size_t i = m_runs[task]; i < m_runs[task + 1]; ++i) {
      if (!isHuge(worlds[i])) joinWorld(worlds[i], joinPart);
    }
  });
  for (const std::uint32_t world : worlds) {
    if (isHuge(world)) joinWorld(world, [&](const JoinRunner::Job& job) { return run(job); });
  }
  noteTotals();
}

/// The pairs of a world's boxes with each other and with those of every world; joinOne(job) returns the number of box
/// tests.
template <class JoinOne>
void WorldSearch::joinWorld(std::size_t world, const JoinOne& joinOne) {
  DynamicBvh& dynamicBoxes = m_forest.tree(world, false);
  DynamicBvh& staticBoxes = m_forest.tree(world, true);
  const auto joinTwo = [&](const DynamicBvh& first, const DynamicBvh& second) -> std::uint64_t {
    if (first.size() == 0 || second.size() == 0) return 0;
    return joinOne(JoinRunner::Job::ofJoin(first.view(), second.view()));
  };
  const JoinRunner::Job selfJoin = JoinRunner::Job::ofSelfJoin(dynamicBoxes.view());
  dynamicBoxes.rule().noteAll(dynamicBoxes.size(), joinOne(selfJoin));
  const std::uint64_t tests = joinTwo(dynamicBoxes, staticBoxes);
  if (staticBoxes.size() != 0) staticBoxes.rule().noteAll(dynamicBoxes.size(), tests);
  if (world == m_members.everyWorld()) return;
  joinTwo(dynamicBoxes, m_forest.tree(m_members.everyWorld(), false));
  joinTwo(dynamicBoxes, m_forest.tree(m_members.everyWorld(), true));
  joinTwo(staticBoxes, m_forest.tree(m_members.everyWorld(), false));
}

/// Lists the changed boxes of the worlds in m_partly, in m_runs where those of each begin and in m_touchedIn where they
/// end.
void WorldSearch::listTouched(const BoxStore& store) {
  m_runs.clear();
  std::uint32_t size = 0;
  for (const std::uint32_t world : m_partly) {
    m_runs.push_back(size);
    size += std::exchange(m_touchedIn[world], size);
  }
  m_touched.resize(size);
  for (const BoxId id : store.touched()) {
    if (!store.contains(id)) continue;
    const std::size_t world = m_members.worldOf(id);
    if (m_isChosen[world] == 0) m_touched[m_touchedIn[world]++] = id;
  }
}

/// Tests the changed boxes of the only world against all.
void WorldSearch::searchChanged(const BoxStore& store) {
  checkStop(m_options.stop);
  m_small.searchChanged(store.touched(), [&](std::span<Pair> pairs, std::size_t worker) {
    checkStop(m_options.stop);
    const std::span<Pair> once = pairs.first(dropDoubles(store, pairs));
    m_history.take(once.first(m_small.select(m_members.everyWorld(), once)), worker);
  });
}

/// Joins the changed boxes of some worlds with all boxes there, one world after the other.
void WorldSearch::joinPartly(const BoxStore& store) {
  const PairTest test = testOf(store, m_options.distance, m_forest.exact());
  const PairTest filter = test.withoutBounds();  // Asked once for each pair.
  const auto take = [&](std::span<Pair> pairs, std::size_t worker) {
    const std::span<Pair> once = pairs.first(dropDoubles(store, pairs));
    m_history.take(once.first(filter.select(once)), worker);
    return pairs.size();
  };
  SinkOptions sink{test.boundsOfHits(), &m_kernels};
  sink.stop = m_options.stop;
  sink.emit.emplace(take);
  m_runner.start(sink, m_stepExecutor);
  if (m_partly.size() == 1) {  // What is of other worlds is not in its hierarchies.
    joinTouched(m_partly[0], store.touched());
  } else {
    listTouched(store);
    for (std::size_t i = 0; i < m_partly.size(); ++i) {
      joinTouched(m_partly[i], std::span(m_touched).subspan(m_runs[i], m_touchedIn[m_partly[i]] - m_runs[i]));
    }
  }
  noteTotals();
}

void WorldSearch::joinTouched(std::size_t world, std::span<const BoxId> touched) {
  const std::size_t shared = m_members.everyWorld();
  DynamicBvh& dynamicBoxes = m_forest.tree(world, false);
  DynamicBvh& staticBoxes = m_forest.tree(world, true);
  m_changedDynamic.gather(touched, m_forest, dynamicBoxes, m_stepExecutor);
  m_changedStatic.gather(touched, m_forest, staticBoxes, m_stepExecutor);
  const auto joinWith = [&](const ChangedBoxes& changed, const DynamicBvh& with) -> std::uint64_t {
    if (changed.size() == 0 || with.size() == 0) return 0;
    return run(JoinRunner::Job::ofJoin(changed.view(), with.view()));
  };
  const auto joinHere = [&](const ChangedBoxes& changed, DynamicBvh& with) {
    with.rule().noteChanged(changed.size(), joinWith(changed, with));
  };
  joinHere(m_changedDynamic, dynamicBoxes);
  joinHere(m_changedDynamic, staticBoxes);
  joinHere(m_changedStatic, dynamicBoxes);
  joinWith(m_changedDynamic, m_forest.tree(shared, false));
  joinWith(m_changedDynamic, m_forest.tree(shared, true));
  joinWith(m_changedStatic, m_forest.tree(shared, false));
}

/// Runs a join on all threads; returns the number of box tests.
std::uint64_t WorldSearch::run(const JoinRunner::Job& job) {
  const std::uint64_t before = m_runner.totals().boxTests;
  m_runner.run(job, m_stepExecutor);
  return m_runner.totals().boxTests - before;
}

void WorldSearch::noteTotals() {
  const OverlapStatistics totals = m_runner.totals();
  m_statistics.boxTests += totals.boxTests;
  m_statistics.groupTests += totals.groupTests;
  m_statistics.exactTests += totals.exactTests;
}

std::vector<Pair> WorldSearch::findBetween(const BoxStore& store, const WorldSearch& other,
                                           const BoxStore& otherStore) const {
  // Half of each: the lanes of the two worlds have been enlarged by that, unless it is negative.
  const double distance = std::midpoint(m_options.distance, other.m_options.distance);
  const bool exact = m_forest.exact() && other.m_forest.exact() && distance == 0.0;
  PairTest test(store.tested(), otherStore.tested(), distance, m_options.accept);
  test.requireExactTest(!exact);
  std::mutex mutex;
  std::vector<Pair> found;
  const auto take = [&](std::span<Pair> pairs, std::size_t) {
    const std::lock_guard lock(mutex);
    found.insert(found.end(), pairs.begin(), pairs.end());
    return pairs.size();
  };
  SinkOptions sink{test, &m_kernels};
  sink.stop = m_options.stop;
  sink.emit.emplace(take);
  CallExecutor call;
  Executor& executor = begin(call);
  JoinRunner runner(defaultMemory());
  runner.start(sink, executor);
  const WorldMembers& others = other.m_members;
  const auto joinWith = [&](std::size_t world, std::size_t otherWorld) {
    eachTree(world, [&](const DynamicBvh& mine, bool) {
      other.eachTree(otherWorld, [&](const DynamicBvh& theirs, bool) {
        runner.run(JoinRunner::Job::ofJoin(mine.view(), theirs.view()), executor);
      });
    });
  };
  for (std::size_t world = 0; world < m_members.everyWorld(); ++world) {
    joinWith(world, others.find(m_members.numberOf(world)));
    joinWith(world, others.everyWorld());
  }
  for (std::size_t world = 0; world <= others.everyWorld(); ++world) joinWith(m_members.everyWorld(), world);
  PairSort(defaultMemory()).sortList(found, {store.idBound(), otherStore.idBound(), m_options.order}, {}, executor);
  return found;
}

}  // namespace allpairs::engine
