// SPDX-License-Identifier: MIT
#include "world/SmallWorlds.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "allpairs/Worlds.h"
#include "input/BoxRuns.h"
#include "input/Parts.h"

namespace allpairs::engine {
namespace {

/// Boxes of every world are tested in each world like its own, up to so many: about as many as robots have grounds,
/// walls and ramps. Of more, a hierarchy finds those that matter.
constexpr std::size_t kMostShared = 32;

}  // namespace

void SmallWorlds::start(const BoxStore& store, const PairTest& filter, std::size_t threads) {
  m_store = &store;
  m_filter = &filter;
  m_boxes = store.tested().boxes;
  m_isPlain = !m_boxes->hasMargins() && m_options.distance == 0.0;
  // Half as many again as are tested exhaustively: a quarter of the boxes at most has changed.
  const std::size_t most = std::min(kMostFew, m_kernels.flatBoxes + m_kernels.flatBoxes / 2);
  m_takesChanged = m_isPlain && !store.isNumbered() && m_boxes->size() <= most;
  const std::size_t listed = store.isNumbered() ? kMostInWorld : kMostAlone;
  m_mostBoxes = std::min({listed, m_kernels.flatBoxes, m_isPlain ? kMostInWorld : m_kernels.wideBoxes});
  m_workers.require(threads);
  for (std::size_t i = 0; i < m_workers.size(); ++i) m_workers[i].boxTests = 0;
}

bool SmallWorlds::takes(std::size_t world) const noexcept {
  const std::size_t shared = world == m_members.everyWorld() ? 0 : m_members.shared().size();
  const std::size_t size = m_members.size(world);
  return size != 0 && shared <= kMostShared && size + shared <= m_mostBoxes;
}

std::uint64_t SmallWorlds::boxTests() const noexcept {
  std::uint64_t tests = 0;
  for (std::size_t i = 0; i < m_workers.size(); ++i) tests += m_workers[i].boxTests;
  return tests;
}

/// The boxes of a world and those of every world, by ascending id.
std::span<const BoxId> SmallWorlds::idsOf(std::size_t world, Worker& worker) const {
  const std::span<const BoxId> own = m_members.boxes(world);
  const std::span<const BoxId> shared = m_members.shared();
  if (world == m_members.everyWorld() || shared.empty()) return own;
  worker.ids.require(own.size() + shared.size());
  BoxId* const end = std::merge(own.begin(), own.end(), shared.begin(), shared.end(), worker.ids.data());
  return {worker.ids.data(), end};
}

/// Lists the worlds, from the first on, whose boxes follow each other in the store, so that the kernel takes them in
/// one call; returns their number.
std::size_t SmallWorlds::listRow(std::span<const std::uint32_t> worlds, Worker& worker) const {
  if (!m_isPlain || !m_members.shared().empty()) return 0;
  worker.begin.require(worlds.size() + 2);
  worker.pairEnd.require(worlds.size() + 2);
  std::size_t row = 0;
  for (; row < worlds.size(); ++row) {
    const std::span<const BoxId> ids = m_members.boxes(worlds[row]);
    if (ids.empty() || ids.back() - ids.front() + 1 != ids.size()) break;
    if (row != 0 && ids.front() != worker.begin[row + 1]) break;
    worker.begin[row + 1] = ids.front();
    worker.begin[row + 2] = std::uint64_t{ids.back()} + 1;
  }
  worker.begin[0] = 0;
  return row;
}

/// The pairs of worlds of a row, after those that are done, as many worlds as there is room for.
template <class T>
std::span<const Pair> SmallWorlds::findInRowOf(std::size_t row, std::size_t& done, Worker& worker) const {
  const std::span<const std::uint64_t> begin(worker.begin.data(), row + 2);
  const Worlds worlds(m_boxes->slice(0, begin.back()), begin);
  // Two parts of pairs stay in a second-level cache until they are taken.
  const std::size_t least = WorldSink::roomFor(begin[done + 2] - begin[done + 1]);
  worker.pairs.require(done + 1 == row ? least : std::max(2 * kPartSize, least));
  WorldsRun<T> run;
  run.boxes = runOf<T>(*m_boxes);
  run.worlds = &worlds;
  run.world = done + 1;
  run.end = row + 1;
  run.pairEnd = worker.pairEnd.data();
  searchRun(run, worker);
  worker.boxTests += run.boxTests;
  Pair* pair = worker.pairs.data();
  for (; done + 1 < run.world; ++done) {
    const auto first = static_cast<BoxId>(begin[done + 1]);
    for (; pair != worker.pairs.data() + run.pairEnd[done + 1]; ++pair)
      *pair = {pair->first + first, pair->second + first};
  }
  const std::span<Pair> pairs(worker.pairs.data(), run.sink.size);
  return pairs.first(select(m_members.everyWorld(), pairs));
}

std::span<const Pair> SmallWorlds::findInRow(std::size_t row, std::size_t& done, Worker& worker) const {
  return m_boxes->isFloat64() ? findInRowOf<double>(row, done, worker) : findInRowOf<float>(row, done, worker);
}

std::span<const Pair> SmallWorlds::find(std::size_t world, Worker& worker) const {
  if (m_members.boxes(world).empty()) return {};
  const std::span<const BoxId> ids = idsOf(world, worker);
  worker.pairs.require(WorldSink::roomFor(ids.size()));
  const std::uint64_t size = !m_isPlain             ? runWide(ids, worker)
                             : m_boxes->isFloat64() ? runPlain<double>(ids, worker)
                                                    : runPlain<float>(ids, worker);
  worker.boxTests += WorldSink::pairsOf(ids.size());
  const std::span<Pair> pairs(worker.pairs.data(), size);
  for (Pair& pair : pairs) pair = {ids[pair.first], ids[pair.second]};
  return pairs.first(select(world, pairs));
}

WorldSink SmallWorlds::sinkOf(const Worker& worker) const noexcept {
  WorldSink sink{worker.pairs.data(), worker.pairs.capacity()};
  sink.bySecond = m_options.order == Order::BySecond;
  return sink;
}

template <class T>
void SmallWorlds::searchRun(WorldsRun<T>& run, Worker& worker) const {
  run.sink = sinkOf(worker);
  run.hadMany = worker.hadMany;
  m_kernels.plain<T>().searchWorlds(run);
  worker.hadMany = run.hadMany;
}

/// Boxes that are not in a row are copied. Returns the number of pairs.
template <class T>
std::uint64_t SmallWorlds::runPlain(std::span<const BoxId> ids, Worker& worker) const {
  auto& rows = std::get<Buffer<T>>(worker.rows);
  rows.require(6 * ids.size());
  T* to = rows.data();
  for (const BoxId id : ids) to = std::copy_n(cornersOf<T>(*m_boxes).min.data + std::size_t{6} * id, 6, to);
  // The kernel asks only where worlds begin.
  const std::array<std::uint64_t, 2> begin{0, ids.size()};
  const Worlds worlds(m_boxes->slice(0, ids.size()), begin);
  std::uint64_t pairEnd = 0;
  WorldsRun<T> run;
  run.boxes = {rows.data(), rows.data() + 3, 6, ids.size()};
  run.worlds = &worlds;
  run.end = 1;
  run.pairEnd = &pairEnd;
  searchRun(run, worker);
  return run.sink.size;
}

/// The same in double, with margins and a distance.
std::uint64_t SmallWorlds::runWide(std::span<const BoxId> ids, Worker& worker) const {
  worker.wide.require(1);
  WideWorld& wide = worker.wide[0];
  const auto isIn = [](const Box&, double) { return true; };
  wide.read(
      ids.size(), *m_boxes, [&](std::size_t i) { return ids[i]; }, isIn);
  wide.distance = m_options.distance;
  WorldSink sink = sinkOf(worker);
  m_kernels.searchWideWorld(wide, sink);
  return sink.size;
}

/// Rows of the store against all of them as they lie in memory: no row of an unused id is hit.
template <class T>
void SmallWorlds::findChanged(std::span<const BoxId> changed, Worker& worker,
                              FunctionRef<void(std::span<Pair>)> take) const {
  const BoxRun<T> all = runOf<T>(*m_boxes);
  std::array<T, 6 * kWordBoxes> rows;
  worker.pairs.require(kPartSize + kVectorSlack);
  worker.boxTests += changed.size() * m_boxes->size();
  const auto taken = [&](std::span<const Pair> found) {
    const std::span<Pair> pairs(worker.pairs.data(), found.size());
    for (Pair& pair : pairs) pair.first = changed[pair.first];
    take(pairs);
  };
  const FunctionRef<void(std::span<const Pair>)> emit(taken);
  for (; !changed.empty(); changed = changed.subspan(std::min(changed.size(), kWordBoxes))) {
    const std::size_t size = std::min(changed.size(), kWordBoxes);
    for (std::size_t i = 0; i < size; ++i) std::copy_n(all.min + std::size_t{6} * changed[i], 6, &rows[6 * i]);
    BetweenRun<T> run{{rows.data(), rows.data() + 3, 6, size}, all, {worker.pairs.data(), kPartSize + kVectorSlack}};
    run.sink.emit = &emit;
    m_kernels.plain<T>().searchBetween(run);
    taken({worker.pairs.data(), run.sink.size});
  }
}

void SmallWorlds::searchChanged(std::span<const BoxId> changed, FunctionRef<void(std::span<Pair>, std::size_t)> take) {
  m_workers.withOne([&](std::size_t index, Worker& worker) {
    const auto taken = [&](std::span<Pair> pairs) { take(pairs, index); };
    m_boxes->isFloat64() ? findChanged<double>(changed, worker, taken) : findChanged<float>(changed, worker, taken);
  });
}

std::size_t SmallWorlds::select(std::size_t world, std::span<Pair> pairs) const {
  const bool hasShared = world != m_members.everyWorld() && !m_members.shared().empty();
  if (!hasShared && m_store->staticCount() == 0) return m_filter->select(pairs);
  const auto isShared = [&](BoxId id) { return m_members.worldOf(id) == m_members.everyWorld(); };
  const auto isDropped = [&](Pair pair) {
    if (hasShared && isShared(pair.first) && isShared(pair.second)) return true;
    return m_store->isStatic(pair.first) && m_store->isStatic(pair.second);
  };
  const auto end = std::remove_if(pairs.begin(), pairs.end(), isDropped);
  return m_filter->select(pairs.first(static_cast<std::size_t>(end - pairs.begin())));
}

}  // namespace allpairs::engine
