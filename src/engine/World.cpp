// SPDX-License-Identifier: MIT
#include "allpairs/World.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "CheckOptions.h"
#include "allpairs/Error.h"
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
  const std::string name = (isRay ? "ray " : "sweep ") + std::to_string(index);
  if (hasNan(sweep.box) || (isRay && !isFinite(sweep.box.min))) {
    throw InvalidArgument(name + (isRay ? ": its origin is not finite" : ": its box has a NaN"));
  }
  if (!isFinite(sweep.motion)) throw InvalidArgument(name + ": its direction is not finite");
  if (std::isnan(sweep.length) || sweep.length < 0.0) throw InvalidArgument(name + ": its length is NaN or negative");
}

void checkQueryBox(const Box& box) {
  if (hasNan(box)) throw InvalidBox(0, "the box of the query has a NaN");
}

void checkPoint(const std::array<double, 3>& point, std::size_t index) {
  if (!isFinite(point)) throw InvalidArgument("point " + std::to_string(index) + " is not finite");
}

}  // namespace

struct World::State {
  State(WorldOptions given, const engine::Kernels& chosen)
      : options(std::move(given)), kernels(chosen), search(options, chosen) {}

  WorldOptions options;
  const engine::Kernels& kernels;
  engine::BoxStore store;
  engine::WorldSearch search;
  engine::WorldQueries queries;
  std::vector<BoxSweep> sweeps;
  std::vector<Box> swept;

  engine::WorldQueries& lookAt() {
    search.update(store);
    queries.lookAt({&store,
                    {search.dynamicBoxes().levels().hierarchy(), search.staticBoxes().levels().hierarchy()},
                    {search.dynamicBoxes().exact(), search.staticBoxes().exact()},
                    &kernels,
                    &search.executor()});
    return queries;
  }

  std::span<const BoxSweep> sweepsOf(std::span<const Ray> rays) {
    sweeps.clear();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      sweeps.push_back(engine::sweepOf(rays[i]));
      checkSweep(sweeps.back(), true, i);
    }
    return sweeps;
  }
};

World::World(WorldOptions options) {
  OverlapOptions checked;
  checked.distance = options.distance;
  checked.instructionSet = options.instructionSet;
  const BoxSet none;
  engine::checkOptions({none, none, true}, checked);
  m_state = std::make_unique<State>(std::move(options), engine::chooseKernels(checked));
}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

const WorldOptions& World::options() const noexcept { return m_state->options; }
void World::reserve(std::size_t boxes) { m_state->store.reserve(boxes); }

BoxId World::add(const Box& box, const BoxProperties& properties) {
  BoxId id = kNoBox;
  add(BoxSet(std::span<const Box>(&box, 1)), {&properties, 1}, {&id, 1});
  return id;
}

void World::add(const BoxSet& boxes, std::span<const BoxProperties> properties, std::span<BoxId> ids) {
  m_state->store.add(boxes, properties, ids);
}

std::vector<BoxId> World::add(const BoxSet& boxes, const BoxProperties& properties) {
  std::vector<BoxId> ids(boxes.size());
  add(boxes, {&properties, 1}, ids);
  return ids;
}

void World::move(BoxId id, const Box& box) { m_state->store.move(id, box); }
void World::move(std::span<const BoxId> ids, const BoxSet& boxes) { m_state->store.move(ids, boxes); }

void World::moveSwept(std::span<const BoxId> ids, const BoxSet& starts, const BoxSet& ends) {
  if (starts.size() != ids.size() || ends.size() != ids.size()) {
    throw InvalidArgument(std::to_string(starts.size()) + " starts and " + std::to_string(ends.size()) + " ends for " +
                          std::to_string(ids.size()) + " boxes");
  }
  std::vector<Box>& swept = m_state->swept;
  swept.clear();
  for (std::size_t i = 0; i < ids.size(); ++i) swept.push_back(merge(starts[i], ends[i]));
  m_state->store.move(ids, swept);
}

void World::moveSwept(std::span<const BoxId> ids, const BoxSet& starts, std::span<const double> velocities,
                      double duration) {
  if (starts.size() != ids.size() || velocities.size() != 3 * ids.size()) {
    throw InvalidArgument(std::to_string(starts.size()) + " starts and " + std::to_string(velocities.size()) +
                          " velocity components for " + std::to_string(ids.size()) + " boxes");
  }
  if (!std::isfinite(duration)) throw InvalidArgument("the duration is not finite");
  std::vector<Box>& swept = m_state->swept;
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
    swept.push_back(merge(starts[i], end));
  }
  m_state->store.move(ids, swept);
}

void World::remove(BoxId id) { remove(std::span<const BoxId>(&id, 1)); }
void World::remove(std::span<const BoxId> ids) { m_state->store.remove(ids); }
void World::clear() { m_state->store.clear(); }

void World::setProperties(BoxId id, const BoxProperties& properties) { setProperties({&id, 1}, {&properties, 1}); }
void World::setProperties(std::span<const BoxId> ids, std::span<const BoxProperties> properties) {
  m_state->store.setProperties(ids, properties);
}
void World::touch(std::span<const BoxId> ids) { m_state->store.touch(ids); }

std::size_t World::size() const noexcept { return m_state->store.size(); }
BoxId World::idBound() const noexcept { return static_cast<BoxId>(m_state->store.idBound()); }
bool World::contains(BoxId id) const noexcept { return m_state->store.contains(id); }

Box World::box(BoxId id) const {
  m_state->store.check({&id, 1});
  return m_state->store.box(id);
}

BoxProperties World::properties(BoxId id) const {
  m_state->store.check({&id, 1});
  return m_state->store.properties(id);
}

StepResult World::step() { return m_state->search.step(m_state->store); }
StepResult World::result() const noexcept { return m_state->search.result(); }
const WorldStatistics& World::statistics() const noexcept { return m_state->search.statistics(); }

std::span<const Pair> World::findBetween(World& other) {
  m_state->search.update(m_state->store);
  other.m_state->search.update(other.m_state->store);
  return m_state->search.findBetween(m_state->store, other.m_state->search, other.m_state->store);
}

std::span<const BoxId> World::findOverlapping(const Box& box, const QueryFilter& filter) {
  checkQueryBox(box);
  return m_state->lookAt().findOverlapping(BoxSet(std::span<const Box>(&box, 1)), filter)[0];
}
ResultLists<BoxId> World::findOverlapping(const BoxSet& boxes, const QueryFilter& filter) {
  return m_state->lookAt().findOverlapping(boxes, filter);
}

SweepHit World::findFirst(const Ray& ray, const QueryFilter& filter) {
  SweepHit hit;
  findFirst(std::span<const Ray>(&ray, 1), {&hit, 1}, filter);
  return hit;
}
SweepHit World::findFirst(const BoxSweep& sweep, const QueryFilter& filter) {
  SweepHit hit;
  findFirst(std::span<const BoxSweep>(&sweep, 1), {&hit, 1}, filter);
  return hit;
}
void World::findFirst(std::span<const Ray> rays, std::span<SweepHit> hits, const QueryFilter& filter) {
  if (hits.size() != rays.size()) throw InvalidArgument("as many hits as rays are needed");
  m_state->lookAt().findFirst(m_state->sweepsOf(rays), hits, filter);
}
void World::findFirst(std::span<const BoxSweep> sweeps, std::span<SweepHit> hits, const QueryFilter& filter) {
  if (hits.size() != sweeps.size()) throw InvalidArgument("as many hits as sweeps are needed");
  for (std::size_t i = 0; i < sweeps.size(); ++i) checkSweep(sweeps[i], false, i);
  m_state->lookAt().findFirst(sweeps, hits, filter);
}

std::span<const SweepHit> World::findAll(const Ray& ray, const QueryFilter& filter) {
  return findAll(std::span<const Ray>(&ray, 1), filter)[0];
}
std::span<const SweepHit> World::findAll(const BoxSweep& sweep, const QueryFilter& filter) {
  return findAll(std::span<const BoxSweep>(&sweep, 1), filter)[0];
}
ResultLists<SweepHit> World::findAll(std::span<const Ray> rays, const QueryFilter& filter) {
  return m_state->lookAt().findAll(m_state->sweepsOf(rays), filter);
}
ResultLists<SweepHit> World::findAll(std::span<const BoxSweep> sweeps, const QueryFilter& filter) {
  for (std::size_t i = 0; i < sweeps.size(); ++i) checkSweep(sweeps[i], false, i);
  return m_state->lookAt().findAll(sweeps, filter);
}

std::span<const Neighbor> World::findNearest(const std::array<double, 3>& point, std::size_t count,
                                             const QueryFilter& filter) {
  return findNearest(std::span<const std::array<double, 3>>(&point, 1), count, filter)[0];
}
ResultLists<Neighbor> World::findNearest(std::span<const std::array<double, 3>> points, std::size_t count,
                                         const QueryFilter& filter) {
  for (std::size_t i = 0; i < points.size(); ++i) checkPoint(points[i], i);
  return m_state->lookAt().findNearest(points, count, filter);
}

}  // namespace allpairs
