// SPDX-License-Identifier: MIT
#include "world/SmallWorlds.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "allpairs/Worlds.h"

namespace allpairs::engine {
namespace {

/// Boxes of every world are tested in each world like its own, up to so many: about as many as robots have grounds, walls
/// and ramps. Of more, a hierarchy finds those that matter.
constexpr std::size_t kMostShared = 32;

/// Pairs that worlds in a row are searched for at once: they stay in a second-level cache until they are taken.
constexpr std::size_t kPairsAtOnce = 8192;

/// Whether the kernel for boxes of float32 takes the rows as they are.
bool isPlain(const SmallWorlds::Input& input) noexcept {
  const BoxView& boxes = *input.store.tested().boxes;
  return !boxes.isFloat64() && !boxes.hasMargins() && input.options.distance == 0.0;
}

}  // namespace

bool SmallWorlds::takes(const Input& input, std::size_t world) noexcept {
  const WorldMembers& members = input.members;
  const std::size_t shared = world == members.everyWorld() ? 0 : members.shared().size();
  const std::size_t most =
      std::min({kMostInWorld, input.kernels.flatOrdered, isPlain(input) ? kMostInWorld : kMostInDouble});
  return shared <= kMostShared && members.boxes(world).size() + shared <= most;
}

void SmallWorlds::start(std::size_t threads) {
  m_workers.require(threads);
  for (std::size_t i = 0; i < m_workers.size(); ++i) m_workers[i].boxTests = 0;
}

std::uint64_t SmallWorlds::boxTests() const noexcept {
  std::uint64_t tests = 0;
  for (std::size_t i = 0; i < m_workers.size(); ++i) tests += m_workers[i].boxTests;
  return tests;
}

/// The boxes of a world and those of every world, by ascending id.
std::span<const BoxId> SmallWorlds::idsOf(const WorldMembers& members, std::size_t world, Worker& worker) {
  const std::span<const BoxId> own = members.boxes(world);
  const std::span<const BoxId> shared = members.shared();
  if (world == members.everyWorld() || shared.empty()) return own;
  worker.ids.require(own.size() + shared.size());
  BoxId* const end = std::merge(own.begin(), own.end(), shared.begin(), shared.end(), worker.ids.data());
  return {worker.ids.data(), end};
}

/// Lists the worlds, from the first on, whose boxes follow each other in the store, so that the kernel takes them in one call;
/// returns their number.
std::size_t SmallWorlds::listRow(const Input& input, std::span<const std::uint32_t> worlds, Worker& worker) {
  if (!isPlain(input) || !input.members.shared().empty()) return 0;
  worker.begin.require(worlds.size() + 2);
  worker.pairEnd.require(worlds.size() + 2);
  std::size_t row = 0;
  for (; row < worlds.size(); ++row) {
    const std::span<const BoxId> boxes = input.members.boxes(worlds[row]);
    if (boxes.empty() || boxes.back() - boxes.front() + 1 != boxes.size()) break;
    if (row != 0 && boxes.front() != worker.begin[row + 1]) break;
    worker.begin[row + 1] = boxes.front();
    worker.begin[row + 2] = std::uint64_t{boxes.back()} + 1;
  }
  worker.begin[0] = 0;
  return row;
}

/// The pairs of worlds of a row, after those that are done, as many worlds as there is room for.
std::span<const Pair> SmallWorlds::findInRow(const Input& input, std::size_t row, std::size_t& done, Worker& worker) {
  const BoxView& boxes = *input.store.tested().boxes;
  const std::span<const std::uint64_t> begin(worker.begin.data(), row + 2);
  const Worlds worlds(boxes.slice(0, begin.back()), begin);
  worker.pairs.require(std::max(kPairsAtOnce, WorldPairsPlace::roomFor(begin[done + 2] - begin[done + 1])));
  WorldsRun run = runOf(input, worker);
  run.min = boxes.float32().min.data;
  run.max = run.min + 3;
  run.worlds = &worlds;
  run.world = done + 1;
  run.end = row + 1;
  run.pairEnd = worker.pairEnd.data();
  input.kernels.searchWorlds(run);
  worker.boxTests += run.boxTests;
  Pair* pair = worker.pairs.data();
  for (; done + 1 < run.world; ++done) {
    const auto first = static_cast<BoxId>(begin[done + 1]);
    for (; pair != worker.pairs.data() + run.pairEnd[done + 1]; ++pair)
      *pair = {pair->first + first, pair->second + first};
  }
  const std::span<Pair> pairs(worker.pairs.data(), run.place.size);
  return pairs.first(select(input, input.members.everyWorld(), pairs));
}

std::span<const Pair> SmallWorlds::find(const Input& input, std::size_t world, Worker& worker) {
  if (input.members.boxes(world).empty()) return {};
  const std::span<const BoxId> ids = idsOf(input.members, world, worker);
  worker.pairs.require(WorldPairsPlace::roomFor(ids.size()));
  const std::uint64_t size = isPlain(input) ? runPlain(input, ids, worker) : runWide(input, ids, worker);
  worker.boxTests += ids.size() * (ids.size() - 1) / 2;
  const std::span<Pair> pairs(worker.pairs.data(), size);
  for (Pair& pair : pairs) pair = {ids[pair.first], ids[pair.second]};
  return pairs.first(select(input, world, pairs));
}

/// What is the same in each call of the kernel.
WorldsRun SmallWorlds::runOf(const Input& input, const Worker& worker) {
  WorldsRun run;
  run.rule.bySecond = input.options.order == Order::BySecond;
  run.place = {worker.pairs.data(), worker.pairs.capacity()};
  return run;
}

/// Boxes of float32 that are not in a row are copied. Returns the number of pairs.
std::uint64_t SmallWorlds::runPlain(const Input& input, std::span<const BoxId> ids, Worker& worker) {
  const BoxView& boxes = *input.store.tested().boxes;
  worker.rows.require(6 * ids.size());
  float* to = worker.rows.data();
  for (const BoxId id : ids) to = std::copy_n(boxes.float32().min.data + std::size_t{6} * id, 6, to);
  // The kernel asks only where worlds begin.
  const std::array<std::uint64_t, 2> begin{0, ids.size()};
  const Worlds worlds(boxes.slice(0, ids.size()), begin);
  std::uint64_t pairEnd = 0;
  WorldsRun run = runOf(input, worker);
  run.min = worker.rows.data();
  run.max = run.min + 3;
  run.worlds = &worlds;
  run.end = 1;
  run.pairEnd = &pairEnd;
  input.kernels.searchWorlds(run);
  return run.place.size;
}

/// The same in double, with margins and a distance.
std::uint64_t SmallWorlds::runWide(const Input& input, std::span<const BoxId> ids, Worker& worker) {
  worker.wide.require(1);
  WideWorld& wide = worker.wide[0];
  const BoxView& boxes = *input.store.tested().boxes;
  const WorldPlaces places = WorldPlaces::of(ids.size());
  wide.alive.fill(0);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Box box = boxes[ids[i]];
    const std::size_t at = places.first + i;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      wide.tile.bound[axis][at] = box.min[axis];
      wide.tile.bound[axis + 3][at] = box.max[axis];
    }
    wide.margins[at] = boxes.margin(ids[i]);
    if (!isEmpty(box)) wide.alive[at / kWordBoxes] |= std::uint64_t{1} << (at % kWordBoxes);
  }
  wide.boxes = ids.size();
  wide.distance = input.options.distance;
  wide.hasMargins = boxes.hasMargins();
  WorldPairsPlace place{worker.pairs.data(), worker.pairs.capacity()};
  input.kernels.searchWideWorld(wide, {input.options.order == Order::BySecond}, place);
  return place.size;
}

/// Moves the pairs that are pairs of this world to the front; returns their number.
std::size_t SmallWorlds::select(const Input& input, std::size_t world, std::span<Pair> pairs) {
  const WorldMembers& members = input.members;
  const bool hasShared = world != members.everyWorld() && !members.shared().empty();
  if (!hasShared && input.store.staticCount() == 0) return input.test.select(pairs);
  const auto isShared = [&](BoxId id) { return members.worldOf(id) == members.everyWorld(); };
  const auto isDropped = [&](Pair pair) {
    if (hasShared && isShared(pair.first) && isShared(pair.second)) return true;
    return input.store.isStatic(pair.first) && input.store.isStatic(pair.second);
  };
  const auto end = std::remove_if(pairs.begin(), pairs.end(), isDropped);
  return input.test.select(pairs.first(static_cast<std::size_t>(end - pairs.begin())));
}

}  // namespace allpairs::engine
