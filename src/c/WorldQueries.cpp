// SPDX-License-Identifier: MIT
#include <type_traits>

#include "Handles.h"

namespace allpairs::c {
namespace {

static_assert(sizeof(allpairs_hit) == sizeof(SweepHit) && alignof(allpairs_hit) == alignof(SweepHit));
static_assert(offsetof(allpairs_hit, t) == offsetof(SweepHit, t));
static_assert(sizeof(allpairs_neighbor) == sizeof(Neighbor) && alignof(allpairs_neighbor) == alignof(Neighbor));
static_assert(offsetof(allpairs_neighbor, distance) == offsetof(Neighbor, distance));
static_assert(sizeof(allpairs_ray) == sizeof(Ray) && alignof(allpairs_ray) == alignof(Ray));
static_assert(offsetof(allpairs_ray, direction) == offsetof(Ray, direction));
static_assert(offsetof(allpairs_ray, length) == offsetof(Ray, length));
static_assert(sizeof(allpairs_sweep) == sizeof(BoxSweep) && alignof(allpairs_sweep) == alignof(BoxSweep));
static_assert(offsetof(allpairs_sweep, motion) == offsetof(BoxSweep, motion));
static_assert(offsetof(allpairs_sweep, length) == offsetof(BoxSweep, length));
static_assert(sizeof(std::array<double, 3>) == 3 * sizeof(double));

/// The filter of a query of this world.
QueryFilter filterOf(const allpairs_world* world, const allpairs_query_filter* given) {
  QueryFilter filter;
  if (given != nullptr) filter = {given->category, given->mask, !given->skip_static, !given->skip_moving};
  filter.world = required(world, "world").queried;
  return filter;
}

std::array<double, 3> vectorOf(const double* values) { return {values[0], values[1], values[2]}; }

Ray rayOf(const allpairs_ray& ray) { return {vectorOf(ray.origin), vectorOf(ray.direction), ray.length}; }

BoxSweep sweepOf(const allpairs_sweep& sweep) { return {boxOf(sweep.box), vectorOf(sweep.motion), sweep.length}; }

allpairs_hit toC(const SweepHit& hit) { return {hit.id, hit.t}; }

allpairs_hits toC(const std::vector<SweepHit>& hits) {
  return {reinterpret_cast<const allpairs_hit*>(hits.data()), hits.size()};
}

allpairs_neighbors toC(const std::vector<Neighbor>& neighbors) {
  return {reinterpret_cast<const allpairs_neighbor*>(neighbors.data()), neighbors.size()};
}

/// C's array as the engine's: the two have the same layout.
template <class T, class Given>
std::span<const T> sameAs(const Given* data, std::size_t count, const char* name) {
  return {reinterpret_cast<const T*>(requiredSpan(data, count, name).data()), count};
}

std::span<const Ray> raysOf(const allpairs_rays& rays) { return sameAs<Ray>(rays.data, rays.count, "rays"); }

std::span<const BoxSweep> sweepsOf(const allpairs_sweeps& sweeps) {
  return sameAs<BoxSweep>(sweeps.data, sweeps.count, "sweeps");
}

std::span<SweepHit> hitsOf(allpairs_hit* hits, std::size_t count) {
  return {reinterpret_cast<SweepHit*>(requiredSpan(hits, count, "hits").data()), count};
}

/// The engine's lists as C's: List is allpairs_id_lists or another of its form.
template <class List, class T>
List toC(const ResultLists<T>& lists) {
  List result{};
  using Value = std::remove_reference_t<decltype(*result.data)>;
  result.offsets = lists.offsets.data();
  result.data = reinterpret_cast<Value*>(lists.values.data());
  result.count = lists.size();
  return result;
}

}  // namespace
}  // namespace allpairs::c

// NOLINTBEGIN(readability-identifier-naming): names are C's.
using namespace allpairs::c;

allpairs_status allpairs_world_find_overlapping(allpairs_world* world, const double* box,
                                                const allpairs_query_filter* filter, allpairs_ids* ids) {
  return guarded([&] {
    allpairs_ids& result = required(ids, "ids");
    auto& found = required(world, "world").found.ids;
    found = CallingBack(world).world().findOverlapping(boxOf(&required(box, "box")), filterOf(world, filter));
    result = {found.data(), found.size()};
  });
}

allpairs_status allpairs_world_find_first(allpairs_world* world, const allpairs_ray* ray,
                                          const allpairs_query_filter* filter, allpairs_hit* hit) {
  return guarded([&] {
    allpairs_hit& result = required(hit, "hit");
    result = toC(CallingBack(world).world().findFirst(rayOf(required(ray, "ray")), filterOf(world, filter)));
  });
}

allpairs_status allpairs_world_find_all(allpairs_world* world, const allpairs_ray* ray,
                                        const allpairs_query_filter* filter, allpairs_hits* hits) {
  return guarded([&] {
    allpairs_hits& result = required(hits, "hits");
    auto& found = required(world, "world").found.hits;
    found = CallingBack(world).world().findAll(rayOf(required(ray, "ray")), filterOf(world, filter));
    result = toC(found);
  });
}

allpairs_status allpairs_world_sweep_first(allpairs_world* world, const allpairs_sweep* sweep,
                                           const allpairs_query_filter* filter, allpairs_hit* hit) {
  return guarded([&] {
    allpairs_hit& result = required(hit, "hit");
    result = toC(CallingBack(world).world().findFirst(sweepOf(required(sweep, "sweep")), filterOf(world, filter)));
  });
}

allpairs_status allpairs_world_sweep_all(allpairs_world* world, const allpairs_sweep* sweep,
                                         const allpairs_query_filter* filter, allpairs_hits* hits) {
  return guarded([&] {
    allpairs_hits& result = required(hits, "hits");
    auto& found = required(world, "world").found.hits;
    found = CallingBack(world).world().findAll(sweepOf(required(sweep, "sweep")), filterOf(world, filter));
    result = toC(found);
  });
}

allpairs_status allpairs_world_find_nearest(allpairs_world* world, const allpairs_nearest* nearest,
                                            const allpairs_query_filter* filter, allpairs_neighbors* neighbors) {
  return guarded([&] {
    allpairs_neighbors& result = required(neighbors, "neighbors");
    const allpairs_nearest& wanted = required(nearest, "nearest");
    auto& found = required(world, "world").found.neighbors;
    found = CallingBack(world).world().findNearest(vectorOf(wanted.point), wanted.count, filterOf(world, filter));
    result = toC(found);
  });
}

allpairs_status allpairs_world_find_overlapping_many(allpairs_world* world, const allpairs_set* boxes,
                                                     const allpairs_query_filter* filter, allpairs_id_lists* lists) {
  return guarded([&] {
    allpairs_id_lists& result = required(lists, "lists");
    auto& found = required(world, "world").found.idLists;
    found = CallingBack(world).world().findOverlapping(required(boxes, "boxes").boxes, filterOf(world, filter));
    result = toC<allpairs_id_lists>(found);
  });
}

allpairs_status allpairs_world_find_first_many(allpairs_world* world, allpairs_rays rays,
                                               const allpairs_query_filter* filter, allpairs_hit* hits) {
  return guarded(
      [&] { CallingBack(world).world().findFirst(raysOf(rays), hitsOf(hits, rays.count), filterOf(world, filter)); });
}

allpairs_status allpairs_world_find_all_many(allpairs_world* world, allpairs_rays rays,
                                             const allpairs_query_filter* filter, allpairs_hit_lists* lists) {
  return guarded([&] {
    allpairs_hit_lists& result = required(lists, "lists");
    auto& found = required(world, "world").found.hitLists;
    found = CallingBack(world).world().findAll(raysOf(rays), filterOf(world, filter));
    result = toC<allpairs_hit_lists>(found);
  });
}

allpairs_status allpairs_world_sweep_first_many(allpairs_world* world, allpairs_sweeps sweeps,
                                                const allpairs_query_filter* filter, allpairs_hit* hits) {
  return guarded([&] {
    CallingBack(world).world().findFirst(sweepsOf(sweeps), hitsOf(hits, sweeps.count), filterOf(world, filter));
  });
}

allpairs_status allpairs_world_sweep_all_many(allpairs_world* world, allpairs_sweeps sweeps,
                                              const allpairs_query_filter* filter, allpairs_hit_lists* lists) {
  return guarded([&] {
    allpairs_hit_lists& result = required(lists, "lists");
    auto& found = required(world, "world").found.hitLists;
    found = CallingBack(world).world().findAll(sweepsOf(sweeps), filterOf(world, filter));
    result = toC<allpairs_hit_lists>(found);
  });
}

allpairs_status allpairs_world_find_nearest_many(allpairs_world* world, const allpairs_nearest_many* nearest,
                                                 const allpairs_query_filter* filter, allpairs_neighbor_lists* lists) {
  return guarded([&] {
    allpairs_neighbor_lists& result = required(lists, "lists");
    const allpairs_nearest_many& wanted = required(nearest, "nearest");
    const auto points = sameAs<std::array<double, 3>>(wanted.points, wanted.point_count, "nearest.points");
    auto& found = required(world, "world").found.neighborLists;
    found = CallingBack(world).world().findNearest(points, wanted.count, filterOf(world, filter));
    result = toC<allpairs_neighbor_lists>(found);
  });
}

allpairs_status allpairs_world_find_nearest_to_boxes(allpairs_world* world, const allpairs_nearest_to_boxes* nearest,
                                                     const allpairs_query_filter* filter,
                                                     allpairs_neighbor_lists* lists) {
  return guarded([&] {
    allpairs_neighbor_lists& result = required(lists, "lists");
    const allpairs_nearest_to_boxes& wanted = required(nearest, "nearest");
    const allpairs::BoxView& boxes = required(wanted.boxes, "nearest.boxes").boxes;
    auto& found = required(world, "world").found.neighborLists;
    found = CallingBack(world).world().findNearest(boxes, wanted.count, filterOf(world, filter));
    result = toC<allpairs_neighbor_lists>(found);
  });
}

allpairs_status allpairs_world_find_between(allpairs_world* world, allpairs_world* other, allpairs_pairs* pairs) {
  return guarded([&] {
    allpairs_pairs& result = required(pairs, "pairs");
    const CallingBack call(world);
    std::optional<CallingBack> otherCall;
    if (other != world) otherCall.emplace(other, "other");
    world->found.between = call.world().findBetween(otherCall ? otherCall->world() : call.world());
    result = toC(std::span<const allpairs::Pair>(world->found.between));
  });
}

// NOLINTEND(readability-identifier-naming)
