// SPDX-License-Identifier: MIT
#include "allpairs/World.h"

#include <atomic>
#include <cmath>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>

#include "allpairs/Error.h"
#include "input/Options.h"
#include "search/SearchState.h"
#include "search/WorkingThreads.h"
#include "world/BoxStore.h"
#include "world/QueryTests.h"
#include "world/WorldQueries.h"
#include "world/WorldSearch.h"

namespace allpairs {
namespace {

bool isFinite(const std::array<double, 3>& values) {
  return std::isfinite(values[0]) && std::isfinite(values[1]) && std::isfinite(values[2]);
}

void checkSweep(const BoxSweep& sweep, bool isRay, std::size_t index) {
  const auto refuse = [&](const std::string& why) {
    throw InvalidArgument((isRay ? "ray " : "sweep ") + std::to_string(index) + why);
  };
  if (isRay && !isFinite(sweep.box.min)) refuse(": its origin is not finite");
  if (hasNan(sweep.box)) throw InvalidBox(index, "sweep " + std::to_string(index) + ": its box has a NaN");
  if (!isFinite(sweep.motion)) refuse(std::string(": its ") + (isRay ? "direction" : "motion") + " is not finite");
  if (std::isnan(sweep.length) || sweep.length < 0.0) refuse(": its length is NaN or negative");
}

/// Of rays or sweeps.
template <class Query>
void checkEach(std::span<const Query> queries) {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    checkSweep(engine::sweepOf(queries[i]), std::is_same_v<Query, Ray>, i);
  }
}

/// In a world the margin of a box is one of its properties.
void refuseMargins(const BoxView& boxes) {
  if (boxes.hasMargins()) throw InvalidArgument("boxes for a world carry no margins: there they are properties");
}

void checkQueryBox(const Box& box) {
  if (hasNan(box)) throw InvalidBox(0, "the box of the query has a NaN");
}

template <class T>
Box toDouble(const BasicBox<T>& box) {
  Box result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.min[axis] = static_cast<double>(box.min[axis]);
    result.max[axis] = static_cast<double>(box.max[axis]);
  }
  return result;
}

void checkPoint(const std::array<double, 3>& point, std::size_t index) {
  if (!isFinite(point)) throw InvalidArgument("point " + std::to_string(index) + " is not finite");
}

}  // namespace

struct World::State {
  State(WorldOptions given, const engine::Kernels& chosen)
      : options(std::move(given)),
        store(engine::memoryOr(options.memory)),
        search(engine::memoryOr(options.memory), options, chosen),
        swept(engine::memoryOr(options.memory)) {}

  WorldOptions options;
  engine::BoxStore store;
  engine::WorldSearch search;
  std::pmr::vector<Box> swept;
  engine::InUse inUse{true};

  /// What const members read: a world without boxes if it has been moved from.
  static State& of(const World& world) {
    static State none({}, engine::chooseKernels(""));
    return world.m_state != nullptr ? *world.m_state : none;
  }

  void shrink() noexcept {
    search.shrink();
    store.settle();  // The hierarchies will be rebuilt, whatever has changed.
    store.shrink();
    swept = std::pmr::vector<Box>(search.memory());
  }

  /// Updates the hierarchies for queries, once after each change.
  void settle() {
    doOnce(isSettled, [this] {
      inUse.check("World");  // Only a step that has not updated them yet leaves them so.
      search.update(store, &working);
    });
  }

  /// Groups the lists of the last step by world, once after each step.
  void group() {
    if (isListing.load(std::memory_order_relaxed)) engine::InUse::refuse("World");
    doOnce(isGrouped, [this] { search.groupLists(); });
  }

  /// Does what is not done yet; concurrent const members wait for it, but not those that its own callbacks call.
  template <class Work>
  void doOnce(std::atomic<bool>& isDone, const Work& work) {
    if (isDone.load(std::memory_order_acquire)) return;
    if (working.haveThis()) engine::InUse::refuse("World");
    const std::lock_guard lock(settling);
    if (isDone.load(std::memory_order_relaxed)) return;
    const engine::WorkingThreads::Mark mark(working);
    work();
    isDone.store(true, std::memory_order_release);
  }

  static engine::WorldQueries queries(const World& world, const QueryFilter& filter) {
    State& state = of(world);
    state.settle();
    return {state.store, state.search, filter};
  }

  std::mutex settling;
  engine::WorkingThreads working;       ///< On what the mutex guards.
  std::atomic<bool> isSettled = true;   ///< Whether the hierarchies hold all changes.
  std::atomic<bool> isGrouped = false;  ///< Whether the lists of the last step are grouped by world.
  std::atomic<bool> isListing = false;  ///< Whether a step makes its lists.
};

World::World(WorldOptions options) {
  if (options.order == Order::Unordered)
    throw InvalidArgument("the lists of a world are ordered: by first or by second");
  engine::checkDistance(options.distance);
  engine::checkOrder(options.order);
  const engine::Kernels& kernels = engine::chooseKernels(options.instructionSet);
  m_state = std::make_unique<State>(std::move(options), kernels);
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

World::State& World::state() {
  if (m_state == nullptr) m_state = std::move(World().m_state);
  m_state->inUse.check("World");
  if (m_state->working.haveThis()) engine::InUse::refuse("World");
  m_state->isSettled.store(false, std::memory_order_relaxed);
  return *m_state;
}

const WorldOptions& World::options() const noexcept { return State::of(*this).options; }

void World::reserve(std::size_t boxes) { state().store.reserve(boxes); }

BoxId World::add(const Box& box, const BoxProperties& properties) {
  BoxId id = kNoBox;
  add(BoxView(std::span<const Box>(&box, 1)), {&properties, 1}, {&id, 1});
  return id;
}

void World::add(const BoxView& boxes, Span<const BoxProperties> properties, Span<BoxId> ids) {
  refuseMargins(boxes);
  state().store.add(boxes, properties, ids);
}

std::vector<BoxId> World::add(const BoxView& boxes, const BoxProperties& properties) {
  std::vector<BoxId> ids(boxes.size());
  add(boxes, {&properties, 1}, ids);
  return ids;
}

void World::move(BoxId id, const Box& box) { state().store.move(id, box); }
void World::move(Span<const BoxId> ids, const BoxView& boxes) {
  refuseMargins(boxes);
  state().store.move(ids, boxes);
}

void World::moveSwept(Span<const BoxId> ids, const BoxView& starts, const BoxView& ends) {
  refuseMargins(starts);
  refuseMargins(ends);
  if (starts.size() != ids.size() || ends.size() != ids.size()) {
    throw InvalidArgument(std::to_string(starts.size()) + " starts and " + std::to_string(ends.size()) + " ends for " +
                          std::to_string(ids.size()) + " boxes");
  }
  std::pmr::vector<Box>& swept = state().swept;
  swept.clear();
  for (std::size_t i = 0; i < ids.size(); ++i) swept.push_back(merge(starts[i], ends[i]));
  state().store.move(ids, swept);
}

void World::moveSwept(Span<const BoxId> ids, const BoxView& starts, Span<const double> velocities, double duration) {
  refuseMargins(starts);
  if (starts.size() != ids.size() || velocities.size() != 3 * ids.size()) {
    throw InvalidArgument(std::to_string(starts.size()) + " starts and " + std::to_string(velocities.size()) +
                          " velocity components for " + std::to_string(ids.size()) + " boxes");
  }
  if (!std::isfinite(duration)) throw InvalidArgument("the duration is not finite");
  std::pmr::vector<Box>& swept = state().swept;
  swept.clear();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::span<const double> velocity = velocities.subspan(3 * i, 3);
    Box end = starts[i];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(velocity[axis])) {
        throw InvalidBox(i, "the velocity of box " + std::to_string(ids[i]) + " is not finite");
      }
      end.min[axis] += velocity[axis] * duration;
      end.max[axis] += velocity[axis] * duration;
    }
    // The end of an empty box may not be empty, by rounding, or a NaN.
    const bool isMoved = !isEmpty(starts[i]) && !hasNan(starts[i]);
    if (isMoved && hasNan(end))
      throw InvalidBox(i, "box " + std::to_string(ids[i]) + " and its motion are infinite: it ends at a NaN");
    swept.push_back(isMoved ? merge(starts[i], end) : starts[i]);
  }
  state().store.move(ids, swept);
}

void World::remove(BoxId id) { remove(std::span<const BoxId>(&id, 1)); }
void World::remove(Span<const BoxId> ids) { state().store.remove(ids); }
void World::clear() { state().store.clear(); }

void World::setProperties(BoxId id, const BoxProperties& properties) { setProperties({&id, 1}, {&properties, 1}); }
void World::setProperties(Span<const BoxId> ids, Span<const BoxProperties> properties) {
  state().store.setProperties(ids, properties);
}
void World::invalidate(Span<const BoxId> ids) { state().store.invalidate(ids); }

void World::shrink() {
  if (m_state != nullptr) state().shrink();
}

std::size_t World::size() const noexcept { return State::of(*this).store.size(); }
BoxId World::idBound() const noexcept { return static_cast<BoxId>(State::of(*this).store.idBound()); }
bool World::contains(BoxId id) const noexcept { return State::of(*this).store.contains(id); }

Box World::box(BoxId id) const {
  State::of(*this).store.check({&id, 1});
  return State::of(*this).store.box(id);
}

BoxProperties World::properties(BoxId id) const {
  State::of(*this).store.check({&id, 1});
  return State::of(*this).store.properties(id);
}

StepResult World::step() {
  State& state = this->state();
  const auto mark = state.inUse.mark();
  // `accept` may group the lists of the step before.
  const auto end = [](State* of) {
    of->isGrouped.store(false, std::memory_order_relaxed);
    of->isListing.store(false, std::memory_order_relaxed);
  };
  const std::unique_ptr<State, decltype(end)> after(&state, end);
  state.isGrouped.store(false, std::memory_order_relaxed);
  state.search.findPairs(state.store, state.isSettled);
  state.isListing.store(true, std::memory_order_relaxed);
  return state.search.listPairs(state.store);
}

StepResult World::result() const noexcept { return State::of(*this).search.result(); }

StepResult World::result(std::uint32_t world) const {
  State& state = State::of(*this);
  state.group();
  return state.search.resultOf(world);
}

const WorldStatistics& World::statistics() const noexcept { return State::of(*this).search.statistics(); }

std::vector<Pair> World::findBetween(const World& other) const {
  if (m_state == nullptr || other.m_state == nullptr) return {};
  m_state->settle();
  other.m_state->settle();
  const auto myMark = m_state->inUse.mark();
  const auto theirMark = other.m_state->inUse.mark();
  return m_state->search.findBetween(m_state->store, other.m_state->search, other.m_state->store);
}

std::vector<BoxId> World::findOverlapping(const Box& box, const QueryFilter& filter) const {
  checkQueryBox(box);
  std::vector<BoxId> ids;
  State::queries(*this, filter).overlapping(box, ids);
  return ids;
}
ResultLists<BoxId> World::findOverlapping(const BoxView& boxes, const QueryFilter& filter) const {
  refuseMargins(boxes);
  return State::queries(*this, filter).overlapping(boxes);
}

SweepHit World::findFirst(const Ray& ray, const QueryFilter& filter) const {
  const BoxSweep sweep = engine::sweepOf(ray);
  checkSweep(sweep, true, 0);
  return State::queries(*this, filter).first(sweep);
}
SweepHit World::findFirst(const BoxSweep& sweep, const QueryFilter& filter) const {
  checkSweep(sweep, false, 0);
  return State::queries(*this, filter).first(sweep);
}
void World::findFirst(Span<const Ray> rays, Span<SweepHit> hits, const QueryFilter& filter) const {
  if (hits.size() != rays.size())
    throw InvalidArgument(std::to_string(rays.size()) + " rays, and room for " + std::to_string(hits.size()) + " hits");
  checkEach<Ray>(rays);
  State::queries(*this, filter).first<Ray>(rays, hits);
}
void World::findFirst(Span<const BoxSweep> sweeps, Span<SweepHit> hits, const QueryFilter& filter) const {
  if (hits.size() != sweeps.size())
    throw InvalidArgument(std::to_string(sweeps.size()) + " sweeps, and room for " + std::to_string(hits.size()) +
                          " hits");
  checkEach<BoxSweep>(sweeps);
  State::queries(*this, filter).first<BoxSweep>(sweeps, hits);
}

std::vector<SweepHit> World::findAll(const Ray& ray, const QueryFilter& filter) const {
  const BoxSweep sweep = engine::sweepOf(ray);
  checkSweep(sweep, true, 0);
  std::vector<SweepHit> hits;
  State::queries(*this, filter).all(sweep, hits);
  return hits;
}
std::vector<SweepHit> World::findAll(const BoxSweep& sweep, const QueryFilter& filter) const {
  checkSweep(sweep, false, 0);
  std::vector<SweepHit> hits;
  State::queries(*this, filter).all(sweep, hits);
  return hits;
}
ResultLists<SweepHit> World::findAll(Span<const Ray> rays, const QueryFilter& filter) const {
  checkEach<Ray>(rays);
  return State::queries(*this, filter).all<Ray>(rays);
}
ResultLists<SweepHit> World::findAll(Span<const BoxSweep> sweeps, const QueryFilter& filter) const {
  checkEach<BoxSweep>(sweeps);
  return State::queries(*this, filter).all<BoxSweep>(sweeps);
}

std::vector<Neighbor> World::findNearest(const std::array<double, 3>& point, std::size_t count,
                                         const QueryFilter& filter) const {
  checkPoint(point, 0);
  std::vector<Neighbor> neighbors;
  State::queries(*this, filter).nearest(Box{point, point}, count, neighbors);
  return neighbors;
}
ResultLists<Neighbor> World::findNearest(Span<const std::array<double, 3>> points, std::size_t count,
                                         const QueryFilter& filter) const {
  for (std::size_t i = 0; i < points.size(); ++i) checkPoint(points[i], i);
  return State::queries(*this, filter).nearest(points, count);
}
template <class T>
std::vector<Neighbor> World::findNearest(const BasicBox<T>& box, std::size_t count, const QueryFilter& filter) const {
  const Box wide = toDouble(box);
  checkQueryBox(wide);
  std::vector<Neighbor> neighbors;
  State::queries(*this, filter).nearest(wide, count, neighbors);
  return neighbors;
}
template std::vector<Neighbor> World::findNearest(const BoxF&, std::size_t, const QueryFilter&) const;
template std::vector<Neighbor> World::findNearest(const Box&, std::size_t, const QueryFilter&) const;
ResultLists<Neighbor> World::findNearest(const BoxView& boxes, std::size_t count, const QueryFilter& filter) const {
  refuseMargins(boxes);
  return State::queries(*this, filter).nearest(boxes, count);
}

void World::visitNear(const Box& box, double distance, FunctionRef<double(BoxId)> visit,
                      const QueryFilter& filter) const {
  checkQueryBox(box);
  if (std::isnan(distance)) throw InvalidArgument("the distance of a query is NaN");
  State::queries(*this, filter).near(box, distance, visit);
}

}  // namespace allpairs
