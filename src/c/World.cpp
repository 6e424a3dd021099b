// SPDX-License-Identifier: MIT
#include "allpairs/World.h"

#include "Handles.h"

namespace allpairs::c {
namespace {

BoxProperties propertiesOf(const allpairs_properties& given) {
  return {given.category, given.mask, given.group, given.margin, given.is_static};
}

std::vector<BoxProperties> propertiesOf(std::span<const allpairs_properties> given) {
  std::vector<BoxProperties> each;
  each.reserve(given.size());
  for (const allpairs_properties& one : given) each.push_back(propertiesOf(one));
  return each;
}

allpairs_properties toC(const BoxProperties& properties) {
  return {properties.category, properties.mask, properties.group, properties.margin, properties.isStatic};
}

allpairs_step stepOf(const StepResult& found) {
  return {c::toC(found.pairs), c::toC(found.began), c::toC(found.persisted), c::toC(found.ended)};
}

/// All but what the handle owns.
WorldOptions optionsOf(const allpairs_world_options& given) {
  WorldOptions options;
  options.distance = given.distance;
  options.order = orderOf(numberIn(given.order));
  options.instructionSet = instructionSetOf(given.instruction_set);
  if (given.accept != nullptr) {
    options.accept = [accept = given.accept, context = given.accept_context](BoxId a, BoxId b) {
      return accept(context, a, b);
    };
  }
  return options;
}

/// The default for an id that is not there, which setProperties() refuses.
BoxProperties propertiesIn(const World& world, BoxId id) {
  return world.contains(id) ? world.properties(id) : BoxProperties();
}

std::span<const BoxId> idsOf(const allpairs_ids& ids) { return requiredSpan(ids.data, ids.count, "ids.data"); }

}  // namespace
}  // namespace allpairs::c

// NOLINTBEGIN(readability-identifier-naming): names are C's.
using namespace allpairs::c;

allpairs_status allpairs_world_create(const allpairs_world_options* options, allpairs_world** world) {
  return guarded([&] {
    allpairs_world*& result = required(world, "world");
    const allpairs_world_options given = known(options);
    std::unique_ptr<allpairs::Executor> executor = executorFor(given.threads);
    std::unique_ptr<CallerMemory> memory = memoryOf(given.memory);
    std::unique_ptr<CallerStop> stop = stopOf(given);
    allpairs::WorldOptions settings = optionsOf(given);
    settings.executor = executor.get();
    settings.memory = memory.get();
    settings.stop = flagOf(stop);
    allpairs::World made(std::move(settings));
    // An atomic does not move: made where it stays.
    std::unique_ptr<allpairs_world> handle(
        new allpairs_world{std::move(memory), std::move(executor), std::move(stop), std::move(made)});
    result = handle.release();
  });
}

void allpairs_world_destroy(allpairs_world* world) {
  delete world;  // NOLINT(cppcoreguidelines-owning-memory): C's handle
}

allpairs_status allpairs_world_shrink(allpairs_world* world) {
  return guarded([&] {
    worldOf(world).shrink();
    world->found = {};
  });
}

allpairs_status allpairs_world_reserve(allpairs_world* world, size_t boxes) {
  return guarded([&] { worldOf(world).reserve(boxes); });
}

allpairs_status allpairs_world_add(allpairs_world* world, const allpairs_set* boxes,
                                   const allpairs_properties* properties, uint32_t* ids) {
  return guarded([&] {
    const allpairs::BoxView& set = required(boxes, "boxes").boxes;
    const allpairs::BoxProperties all = propertiesOf(properties ? *properties : allpairs_default_properties());
    worldOf(world).add(set, {&all, 1}, requiredSpan(ids, set.size(), "ids"));
  });
}

allpairs_status allpairs_world_add_each(allpairs_world* world, const allpairs_set* boxes,
                                        const allpairs_properties* properties, uint32_t* ids) {
  return guarded([&] {
    const allpairs::BoxView& set = required(boxes, "boxes").boxes;
    const std::vector<allpairs::BoxProperties> each = propertiesOf(requiredSpan(properties, set.size(), "properties"));
    worldOf(world).add(set, each, requiredSpan(ids, set.size(), "ids"));
  });
}

allpairs_status allpairs_world_add_to_worlds(allpairs_world* world, const allpairs_set* boxes,
                                             const allpairs_membership* membership, uint32_t* ids) {
  return guarded([&] {
    const allpairs::BoxView& set = required(boxes, "boxes").boxes;
    const allpairs_membership& given = required(membership, "membership");
    const allpairs_properties all = given.properties ? *given.properties : allpairs_default_properties();
    std::vector<allpairs::BoxProperties> each(set.size(), propertiesOf(all));
    for (std::size_t i = 0; i < each.size() && given.worlds != nullptr; ++i) each[i].world = given.worlds[i];
    worldOf(world).add(set, each, requiredSpan(ids, set.size(), "ids"));
  });
}

allpairs_status allpairs_world_move(allpairs_world* world, allpairs_ids ids, const allpairs_set* boxes) {
  return guarded([&] { worldOf(world).move(idsOf(ids), required(boxes, "boxes").boxes); });
}

allpairs_status allpairs_world_move_swept(allpairs_world* world, allpairs_ids ids, const allpairs_set* starts,
                                          const allpairs_set* ends) {
  return guarded(
      [&] { worldOf(world).moveSwept(idsOf(ids), required(starts, "starts").boxes, required(ends, "ends").boxes); });
}

allpairs_status allpairs_world_move_swept_by(allpairs_world* world, allpairs_ids ids, const allpairs_set* starts,
                                             const allpairs_velocities* velocities) {
  return guarded([&] {
    const allpairs::BoxView& set = required(starts, "starts").boxes;
    const allpairs_velocities& given = required(velocities, "velocities");
    const std::span<const double> rows = requiredSpan(given.data, 3 * set.size(), "velocities.data");
    worldOf(world).moveSwept(idsOf(ids), set, rows, given.duration);
  });
}

allpairs_status allpairs_world_remove(allpairs_world* world, allpairs_ids ids) {
  return guarded([&] { worldOf(world).remove(idsOf(ids)); });
}

allpairs_status allpairs_world_clear(allpairs_world* world) {
  return guarded([&] { worldOf(world).clear(); });
}

allpairs_status allpairs_world_set_properties(allpairs_world* world, allpairs_ids ids,
                                              const allpairs_properties* properties) {
  return guarded([&] {
    std::vector<allpairs::BoxProperties> each = propertiesOf(requiredSpan(properties, ids.count, "properties"));
    const std::span<const allpairs::BoxId> chosen = idsOf(ids);
    for (std::size_t i = 0; i < each.size(); ++i) each[i].world = propertiesIn(worldOf(world), chosen[i]).world;
    worldOf(world).setProperties(chosen, each);
  });
}

allpairs_status allpairs_world_set_worlds(allpairs_world* world, allpairs_ids ids, const uint32_t* worlds) {
  return guarded([&] {
    const std::span<const std::uint32_t> numbers = requiredSpan(worlds, ids.count, "worlds");
    const std::span<const allpairs::BoxId> chosen = idsOf(ids);
    std::vector<allpairs::BoxProperties> each;
    each.reserve(chosen.size());
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      each.push_back(propertiesIn(worldOf(world), chosen[i]));
      each.back().world = numbers[i];
    }
    worldOf(world).setProperties(chosen, each);
  });
}

allpairs_status allpairs_world_invalidate(allpairs_world* world, allpairs_ids ids) {
  return guarded([&] { worldOf(world).invalidate(idsOf(ids)); });
}

size_t allpairs_world_size(const allpairs_world* world) { return world == nullptr ? 0 : world->world.size(); }

bool allpairs_world_contains(const allpairs_world* world, uint32_t id) {
  return world != nullptr && world->world.contains(id);
}

uint32_t allpairs_world_id_bound(const allpairs_world* world) { return world == nullptr ? 0 : world->world.idBound(); }

allpairs_status allpairs_world_box(const allpairs_world* world, uint32_t id, double* bounds) {
  return guarded([&] {
    const allpairs::Box box = required(world, "world").world.box(id);
    const std::span<double> values = requiredSpan(bounds, 6, "bounds");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      values[axis] = box.min[axis];
      values[axis + 3] = box.max[axis];
    }
  });
}

allpairs_status allpairs_world_list_ids(const allpairs_world* world, uint32_t* ids) {
  return guarded([&] {
    const allpairs::World& boxes = required(world, "world").world;
    const std::span<std::uint32_t> values = requiredSpan(ids, boxes.size(), "ids");
    std::size_t next = 0;
    for (allpairs::BoxId id = 0; next < values.size(); ++id) {
      if (boxes.contains(id)) values[next++] = id;
    }
  });
}

allpairs_status allpairs_world_properties(const allpairs_world* world, uint32_t id, allpairs_properties* properties) {
  return guarded([&] {
    allpairs_properties& result = required(properties, "properties");
    result = toC(required(world, "world").world.properties(id));
  });
}

allpairs_status allpairs_world_number(const allpairs_world* world, uint32_t id, uint32_t* number) {
  return guarded([&] {
    std::uint32_t& result = required(number, "number");
    result = required(world, "world").world.properties(id).world;
  });
}

allpairs_status allpairs_world_step(allpairs_world* world, allpairs_step* step) {
  return guarded([&] {
    allpairs_step& result = required(step, "step");
    result = stepOf(CallingBack(world).world().step());
  });
}

allpairs_status allpairs_world_statistics(const allpairs_world* world, allpairs_step_statistics* statistics) {
  return guarded([&] {
    const allpairs::WorldStatistics& last = required(world, "world").world.statistics();
    write({0, last.boxTests, last.groupTests, last.exactTests, last.changed, last.rebuilds, last.joinedAll}, statistics,
          "statistics");
  });
}

allpairs_status allpairs_world_result_of(allpairs_world* world, uint32_t number, allpairs_step* step) {
  return guarded([&] {
    allpairs_step& result = required(step, "step");
    result = stepOf(worldOf(world).result(number));
  });
}

allpairs_status allpairs_world_restrict_queries(allpairs_world* world, uint32_t number) {
  return guarded([&] {
    static_cast<void>(worldOf(world));
    world->queried = number;
  });
}

// NOLINTEND(readability-identifier-naming)
