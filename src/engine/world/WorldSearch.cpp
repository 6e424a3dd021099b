// SPDX-License-Identifier: MIT
#include "world/WorldSearch.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "LaneReader.h"

namespace allpairs::engine {
namespace {

/// If one box in so many has changed, all boxes are joined: the changed ones meet all others from both sides.
constexpr std::size_t kShareOfChanged = 4;

/// Whether a hit of a changed box, the first of the pair, is to be dropped: it met itself, or a partner that changed too
/// and finds the same pair from its side.
bool isFoundTwice(const BoxStore& store, Pair pair) noexcept {
  return (pair.first == pair.second) | (store.isTouched(pair.second) & (pair.second < pair.first));
}

/// Drops what is found twice and puts the smaller id of the others first; returns how many are left.
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
  if (store.stale().empty()) return;
  OverlapOptions lanes;
  // Queries ask for the boxes themselves: lanes are never smaller than those.
  lanes.distance = std::max(0.0, m_options.distance);
  const LaneReader reader(store.set(), lanes);
  const UpdateTools tools{reader, m_kernels, executor()};
  m_statistics.rebuilds += m_dynamic.update(store, tools) ? 1U : 0U;
  m_statistics.rebuilds += m_static.update(store, tools) ? 1U : 0U;
  store.settle();
}

StepResult WorldSearch::step(BoxStore& store) {
  update(store);
  m_statistics.boxTests = 0;
  m_statistics.groupTests = 0;
  m_statistics.exactTests = 0;
  m_statistics.changed = store.touched().size();
  m_statistics.joinedAll = store.touched().size() > store.size() / kShareOfChanged;
  m_history.begin(store.idBound(), m_finder.prepare(executor()),
                  m_statistics.joinedAll ? Joined::All : Joined::Changed);
  if (m_statistics.joinedAll) {
    joinAll(store);
    m_history.finishAll(m_kernels, executor());
  } else {
    joinChanged(store);
    m_history.finishChanged([&](Pair pair) { return store.isTouched(pair.first) | store.isTouched(pair.second); },
                            m_kernels, executor());
  }
  store.endStep();
  return m_history.result();
}

std::uint64_t WorldSearch::join(const PairFinder::Job& job, PairFinder::Taker taker) {
  const PairFinder::Counts counts = m_finder.run(job, m_kernels, executor(), taker);
  m_statistics.boxTests += counts.boxTests;
  m_statistics.groupTests += counts.groupTests;
  return counts.boxTests;
}

void WorldSearch::joinAll(const BoxStore& store) {
  const PairSelect rules{store, store, m_options.accept, m_options.distance, !isExact() || m_options.distance != 0.0};
  std::atomic<std::uint64_t> tested = 0;
  const auto take = [&](std::span<Pair> pairs, std::size_t finder) {
    tested += pairs.size();
    m_history.take(pairs.first(rules.select(pairs)), finder);
  };
  LevelStack& dynamics = m_dynamic.levels();
  LevelStack& statics = m_static.levels();
  const Hierarchy all = dynamics.hierarchy();
  std::uint64_t tests = join({all, all, true, PairSide::SmallerFirst}, take);
  m_dynamic.rule().note(Joined::All, m_dynamic.size(), tests);
  const std::size_t depth = std::max(dynamics.depth(), statics.depth());
  tests = join({dynamics.hierarchy(depth), statics.hierarchy(depth), false, PairSide::SmallerFirst}, take);
  m_static.rule().note(Joined::All, m_dynamic.size(), tests);
  m_statistics.exactTests = rules.exactTest ? tested.load() : 0;
}

std::uint64_t WorldSearch::joinChangedWith(ChangedBoxes& changed, KeptHierarchy& with, PairFinder::Taker taker) {
  const std::size_t depth = std::max(changed.levels().depth(), with.levels().depth());
  const PairFinder::Job job{changed.levels().hierarchy(depth), with.levels().hierarchy(depth), false,
                            PairSide::RowFirst};
  const std::uint64_t tests = join(job, taker);
  with.rule().note(Joined::Changed, changed.size(), tests);
  return tests;
}

void WorldSearch::joinChanged(const BoxStore& store) {
  const PairSelect rules{store, store, m_options.accept, m_options.distance, !isExact() || m_options.distance != 0.0};
  std::atomic<std::uint64_t> tested = 0;
  const auto take = [&](std::span<Pair> pairs, std::size_t finder) {
    const std::span<Pair> once = pairs.first(dropDoubles(store, pairs));
    tested += once.size();
    m_history.take(once.first(rules.select(once)), finder);
  };
  m_changedDynamic.gather(store.touched(), m_dynamic, m_kernels, executor());
  m_changedStatic.gather(store.touched(), m_static, m_kernels, executor());
  joinChangedWith(m_changedDynamic, m_dynamic, take);
  joinChangedWith(m_changedDynamic, m_static, take);
  joinChangedWith(m_changedStatic, m_dynamic, take);
  m_statistics.exactTests = rules.exactTest ? tested.load() : 0;
}

std::span<const Pair> WorldSearch::findBetween(const BoxStore& store, WorldSearch& other, const BoxStore& otherStore) {
  const bool exact = isExact() && other.isExact() && m_options.distance == 0.0 && other.m_options.distance == 0.0;
  // Half of each: what the lanes of the two worlds have been widened by.
  const double distance = 0.5 * m_options.distance + 0.5 * other.m_options.distance;
  const PairSelect rules{store, otherStore, m_options.accept, distance, !exact};
  std::mutex mutex;
  std::size_t size = 0;
  const auto take = [&](std::span<Pair> pairs, std::size_t) {
    const std::size_t kept = rules.select(pairs);
    const std::lock_guard lock(mutex);
    m_between.grow(size + kept);
    std::copy_n(pairs.data(), kept, m_between.data() + size);
    size += kept;
  };
  m_finder.prepare(executor());
  for (KeptHierarchy* mine : {&m_dynamic, &m_static}) {
    for (KeptHierarchy* theirs : {&other.m_dynamic, &other.m_static}) {
      const std::size_t depth = std::max(mine->levels().depth(), theirs->levels().depth());
      const PairFinder::Job job{mine->levels().hierarchy(depth), theirs->levels().hierarchy(depth), false,
                                PairSide::RowFirst};
      m_finder.run(job, m_kernels, executor(), take);
    }
  }
  PairSort::Task task;
  task.firsts = std::max<std::size_t>(1, store.idBound());
  task.seconds = std::max<std::size_t>(1, otherStore.idBound());
  task.kernels = &m_kernels;
  m_betweenSort.sort({m_between.data(), size}, task, executor());
  return {m_between.data(), size};
}

}  // namespace allpairs::engine
