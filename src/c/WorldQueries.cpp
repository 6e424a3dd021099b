// SPDX-License-Identifier: MIT
#include <type_traits>

#include "Handles.h"

namespace allpairs::c {
namespace {

static_assert(sizeof(allpairs_hit) == sizeof(SweepHit) && alignof(allpairs_hit) == alignof(SweepHit));
static_assert(offsetof(allpairs_hit, t) == offsetof(SweepHit, t));
static_assert(sizeof(allpairs_neighbor) == sizeof(Neighbor) && alignof(allpairs_neighbor) == alignof(Neighbor));
static_assert(offsetof(allpairs_neighbor, distance) == offsetof(Neighbor, distance));

QueryFilter filterOf(const allpairs_query_filter* given) {
  if (given == nullptr) return {};
  return {given->category, given->mask, !given->skip_static, !given->skip_moving};
}

std::array<double, 3> vectorOf(const double* values) { return {values[0], values[1], values[2]}; }

Ray rayOf(const allpairs_ray& ray) { return {vectorOf(ray.origin), vectorOf(ray.direction), ray.length}; }

BoxSweep sweepOf(const allpairs_sweep& sweep) { return {boxOf(sweep.box), vectorOf(sweep.motion), sweep.length}; }

allpairs_hit toC(const SweepHit& hit) { return {hit.id, hit.t}; }

allpairs_hits toC(std::span<const SweepHit> hits) {
  return {reinterpret_cast<const allpairs_hit*>(hits.data()), hits.size()};
}

allpairs_neighbors toC(std::span<const Neighbor> neighbors) {
  return {reinterpret_cast<const allpairs_neighbor*>(neighbors.data()), neighbors.size()};
}

}  // namespace
}  // namespace allpairs::c

// NOLINTBEGIN(readability-identifier-naming): names are C's.
using namespace allpairs::c;

allpairs_status allpairs_world_find_overlapping(allpairs_world* world, const double* box,
                                                const allpairs_query_filter* filter, allpairs_ids* ids) {
  return guarded([&] {
    allpairs_ids& result = required(ids, "ids");
    const auto found = worldOf(world).findOverlapping(boxOf(&required(box, "box")), filterOf(filter));
    result = {found.data(), found.size()};
  });
}

allpairs_status allpairs_world_find_first(allpairs_world* world, const allpairs_ray* ray,
                                          const allpairs_query_filter* filter, allpairs_hit* hit) {
  return guarded([&] {
    allpairs_hit& result = required(hit, "hit");
    result = toC(worldOf(world).findFirst(rayOf(required(ray, "ray")), filterOf(filter)));
  });
}

allpairs_status allpairs_world_find_all(allpairs_world* world, const allpairs_ray* ray,
                                        const allpairs_query_filter* filter, allpairs_hits* hits) {
  return guarded([&] {
    allpairs_hits& result = required(hits, "hits");
    result = toC(worldOf(world).findAll(rayOf(required(ray, "ray")), filterOf(filter)));
  });
}

allpairs_status allpairs_world_sweep_first(allpairs_world* world, const allpairs_sweep* sweep,
                                           const allpairs_query_filter* filter, allpairs_hit* hit) {
  return guarded([&] {
    allpairs_hit& result = required(hit, "hit");
    result = toC(worldOf(world).findFirst(sweepOf(required(sweep, "sweep")), filterOf(filter)));
  });
}

allpairs_status allpairs_world_sweep_all(allpairs_world* world, const allpairs_sweep* sweep,
                                         const allpairs_query_filter* filter, allpairs_hits* hits) {
  return guarded([&] {
    allpairs_hits& result = required(hits, "hits");
    result = toC(worldOf(world).findAll(sweepOf(required(sweep, "sweep")), filterOf(filter)));
  });
}

allpairs_status allpairs_world_find_nearest(allpairs_world* world, const allpairs_nearest* nearest,
                                            const allpairs_query_filter* filter, allpairs_neighbors* neighbors) {
  return guarded([&] {
    allpairs_neighbors& result = required(neighbors, "neighbors");
    const allpairs_nearest& wanted = required(nearest, "nearest");
    result = toC(worldOf(world).findNearest(vectorOf(wanted.point), wanted.count, filterOf(filter)));
  });
}

allpairs_status allpairs_world_find_between(allpairs_world* world, allpairs_world* other, allpairs_pairs* pairs) {
  return guarded([&] {
    allpairs_pairs& result = required(pairs, "pairs");
    result = toC(worldOf(world).findBetween(required(other, "other").world));
  });
}

// NOLINTEND(readability-identifier-naming)
