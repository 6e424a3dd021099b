// SPDX-License-Identifier: MIT
// The step of a world whose boxes have world numbers (docs/decisions/0031).
#include <algorithm>
#include <numeric>

#include "kernels/WorldsRun.h"
#include "world/WorldSearch.h"

namespace allpairs::engine {

/// Counts the changed boxes of each world, and lists the worlds that have some.
void WorldSearch::countTouched(const BoxStore& store) {
  m_touchedIn.assign(m_members.everyWorld() + 1, 0);
  m_chosen.clear();
  for (const BoxId id : store.touched()) {
    if (!store.contains(id)) continue;
    const std::size_t world = m_members.worldOf(id);
    if (m_touchedIn[world]++ == 0) m_chosen.push_back(static_cast<std::uint32_t>(world));
  }
  std::sort(m_chosen.begin(), m_chosen.end());
}

/// Chooses the worlds to search: those in which a box has changed, or all if these have many boxes, since looking up each pair
/// among those of the last step would then take longer than comparing the lists. Of large worlds with few changed boxes only
/// these are joined. Returns whether all worlds are searched, as a whole.
bool WorldSearch::chooseWorlds(const BoxStore& store) {
  countTouched(store);
  m_isChosen.assign(m_touchedIn.size(), 0);
  m_partly.clear();
  std::size_t boxes = 0;
  std::size_t whole = 0;
  for (const std::uint32_t world : m_chosen) {
    const std::size_t size = m_members.boxes(world).size();
    if (m_touchedIn[world] <= size / kShareOfChanged && !m_small.takes(world)) {
      m_partly.push_back(world);
      boxes += m_touchedIn[world];
    } else {
      m_chosen[whole++] = world;
      m_isChosen[world] = 1;
      boxes += size;
    }
  }
  const std::size_t most = store.size() / kShareOfChanged;
  const bool all = std::max(boxes, store.touched().size()) > most || m_touchedIn[m_members.everyWorld()] != 0;
  m_chosen.resize(all ? m_isChosen.size() : whole);
  if (!all) return false;
  m_partly.clear();
  std::iota(m_chosen.begin(), m_chosen.end(), 0U);
  std::fill(m_isChosen.begin(), m_isChosen.end(), std::uint8_t{1});
  return true;
}

/// Moves the chosen worlds that are too large for an exhaustive search to a list of their own.
void WorldSearch::moveLarge() {
  m_large.clear();
  std::size_t kept = 0;
  for (const std::uint32_t world : m_chosen) {
    if (m_small.takes(world)) {
      m_chosen[kept++] = world;
    } else {
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

void WorldSearch::joinWorlds(BoxStore& store) {
  m_members.update(store, executor());
  static_cast<void>(store.set());  // The tests read it.
  const PairTest filter = testOf(store, 0.0, true);
  m_small.start(store, filter, executor().concurrency());
  m_statistics.joinedAll = chooseWorlds(store);
  moveLarge();
  if (!m_large.empty() || !m_partly.empty() || m_options.accept) update(store);  // `accept` may ask queries.
  const PairTest test = testOf(store, m_options.distance, isExact());
  const auto take = [&](std::span<const Pair> pairs, std::size_t worker) {
    m_history.take(pairs, worker);
    return pairs.size();
  };
  const auto takeHits = [&](std::span<Pair> pairs, std::size_t worker) { return take(pairs, worker); };
  SinkOptions sink{&m_kernels, &test, PairSide::SmallerFirst};
  sink.stop = m_options.stop;
  sink.emit.emplace(takeHits);
  const std::size_t workers = std::max(m_runner.start(sink, executor()), executor().concurrency());
  m_history.begin(store.idBound(), workers, m_statistics.joinedAll ? Joined::All : Joined::Changed);
  cutIntoRuns(
      m_chosen, [&](std::uint32_t world) { return m_members.boxes(world).size(); }, m_runs);
  executor().run(m_runs.size(), [&](std::size_t run) {
    const std::size_t begin = run == 0 ? 0 : m_runs[run - 1];
    m_small.search(std::span(m_chosen).subspan(begin, m_runs[run] - begin), take);
  });
  joinTrees();
  noteTotals();
  if (!m_partly.empty()) {
    joinPartly(store);
    noteTotals();
  }
  m_statistics.boxTests += m_small.boxTests();
  if (m_statistics.joinedAll) {
    m_history.finishAll(executor());
  } else {
    m_history.finishChanged([&](Pair pair) { return isLookedFor(store, pair); }, executor());
  }
}

/// Finds the pairs of the large worlds in their hierarchies.
void WorldSearch::joinTrees() {
  const std::span<const std::uint32_t> worlds = m_large;
  const auto sizeOf = [&](std::uint32_t world) { return m_members.boxes(world).size(); };
  const auto isHuge = [&](std::uint32_t world) { return sizeOf(world) > kHugeWorld; };
  cutIntoRuns(worlds, sizeOf, m_runs);
  m_runner.runTasks(m_runs.size(), executor(), [&](std::size_t run, const auto& joinPart) {
    for (std::size_t i = run == 0 ? 0 : m_runs[run - 1]; i < m_runs[run]; ++i) {
      if (!isHuge(worlds[i])) joinWorld(worlds[i], joinPart);
    }
  });
  for (const std::uint32_t world : worlds) {
    if (isHuge(world)) joinWorld(world, [&](const JoinRunner::Job& job) { return join(job, m_runner); });
  }
}

/// The pairs of a world's boxes with each other and with those of every world; joinOne(job) returns the number of box
/// tests.
template <class JoinOne>
void WorldSearch::joinWorld(std::size_t world, const JoinOne& joinOne) {
  const BvhView dynamicBoxes = m_dynamicTrees.view(world);
  const BvhView staticBoxes = m_staticTrees.view(world);
  const auto joinTwo = [&](const BvhView& first, const BvhView& second) -> std::uint64_t {
    if (first.depth == 0 || second.depth == 0) return 0;
    const BvhPair both(first, second);
    return joinOne(JoinRunner::Job::ofJoin(both.first, both.second));
  };
  const std::size_t size = dynamicBoxes.depth == 0 ? 0 : dynamicBoxes.level[0].size;
  m_dynamicTrees.rule(world).note(Joined::All, size, joinOne(JoinRunner::Job::ofJoin(dynamicBoxes, dynamicBoxes)));
  m_staticTrees.rule(world).note(Joined::All, size, joinTwo(dynamicBoxes, staticBoxes));
  if (world == m_members.everyWorld()) return;
  joinTwo(dynamicBoxes, m_dynamicTrees.view(m_members.everyWorld()));
  joinTwo(dynamicBoxes, m_staticTrees.view(m_members.everyWorld()));
  joinTwo(staticBoxes, m_dynamicTrees.view(m_members.everyWorld()));
}

/// Updates the hierarchies of a numbered store.
void WorldSearch::updateTrees(const BoxStore& store, const BoxReader& reader) {
  m_members.update(store, executor());
  m_statistics.rebuilds += m_dynamicTrees.update(store, m_members, reader, executor());
  m_statistics.rebuilds += m_staticTrees.update(store, m_members, reader, executor());
}

}  // namespace allpairs::engine
