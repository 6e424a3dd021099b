// SPDX-License-Identifier: MIT
// Many queries in one call give what they give one by one, which queries_test.c and world_test.c hold against loops.
#include <math.h>
#include <string.h>

#include "Check.h"

enum { kBoxes = 300, kQueries = 400, kNearest = 7 };

static double rows[6 * kBoxes];
static double asked[6 * kQueries];

static allpairs_set* setOf(const double* data, size_t count) {
  allpairs_set* set = NULL;
  ALLPAIRS_CHECK(allpairs_set_create_f64(data, count, &set) == ALLPAIRS_OK);
  return set;
}

static allpairs_world* worldWith(size_t threads) {
  uint32_t ids[kBoxes];
  allpairs_world* world = NULL;
  allpairs_world_options options = {0};
  options.struct_size = sizeof options;
  options.threads = threads;
  allpairs_set* set = setOf(rows, kBoxes);
  ALLPAIRS_CHECK(allpairs_world_create(&options, &world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(world, set, NULL, ids) == ALLPAIRS_OK);
  allpairs_set_destroy(set);
  return world;
}

static void sameHits(const allpairs_hit* many, size_t count, allpairs_hits one) {
  ALLPAIRS_CHECK(count == one.count);
  for (size_t k = 0; k < count; ++k) ALLPAIRS_CHECK(many[k].id == one.data[k].id && many[k].t == one.data[k].t);
}

/// `single` answers one by one: what `many` gives would be gone after another query of the same world.
static void boxesAreAnswered(allpairs_world* many, allpairs_world* single, const allpairs_query_filter* filter) {
  allpairs_id_lists lists;
  allpairs_ids one;
  allpairs_set* boxes = setOf(asked, kQueries);
  ALLPAIRS_CHECK(allpairs_world_find_overlapping_many(many, boxes, filter, &lists) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(lists.count == kQueries && lists.offsets[0] == 0 && lists.offsets[kQueries] > kQueries);
  for (size_t i = 0; i < kQueries; ++i) {
    const size_t size = lists.offsets[i + 1] - lists.offsets[i];
    ALLPAIRS_CHECK(allpairs_world_find_overlapping(single, &asked[6 * i], filter, &one) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(size == one.count);
    ALLPAIRS_CHECK(size == 0 || memcmp(&lists.data[lists.offsets[i]], one.data, size * sizeof *one.data) == 0);
  }
  allpairs_set_destroy(boxes);
}

static void raysAreAnswered(allpairs_world* many, allpairs_world* single, const allpairs_query_filter* filter) {
  static allpairs_ray each[kQueries];
  static allpairs_hit firsts[kQueries];
  const allpairs_rays rays = {each, kQueries};
  allpairs_hit_lists lists;
  allpairs_hits one;
  for (size_t i = 0; i < kQueries; ++i) {
    const double* box = &asked[6 * i];
    const allpairs_ray ray = {{box[0], box[1], box[2]}, {1, 0.5, 0}, (double)(i % 5)};
    each[i] = ray;
  }
  ALLPAIRS_CHECK(allpairs_world_find_all_many(many, rays, filter, &lists) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(lists.count == kQueries && lists.offsets[kQueries] > kQueries);
  ALLPAIRS_CHECK(allpairs_world_find_first_many(many, rays, filter, firsts) == ALLPAIRS_OK);
  for (size_t i = 0; i < kQueries; ++i) {
    allpairs_hit first;
    ALLPAIRS_CHECK(allpairs_world_find_first(single, &each[i], filter, &first) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(firsts[i].id == first.id && firsts[i].t == first.t);
    ALLPAIRS_CHECK(allpairs_world_find_all(single, &each[i], filter, &one) == ALLPAIRS_OK);
    sameHits(&lists.data[lists.offsets[i]], lists.offsets[i + 1] - lists.offsets[i], one);
  }
}

static void sweepsAreAnswered(allpairs_world* many, allpairs_world* single, const allpairs_query_filter* filter) {
  static allpairs_sweep each[kQueries];
  static allpairs_hit firsts[kQueries];
  const allpairs_sweeps sweeps = {each, kQueries};
  allpairs_hit_lists lists;
  allpairs_hits one;
  for (size_t i = 0; i < kQueries; ++i) {
    memcpy(each[i].box, &asked[6 * i], sizeof each[i].box);
    each[i].motion[2] = 1;
    each[i].length = (double)(i % 5);
  }
  ALLPAIRS_CHECK(allpairs_world_sweep_all_many(many, sweeps, filter, &lists) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(lists.count == kQueries && lists.offsets[kQueries] > kQueries);
  ALLPAIRS_CHECK(allpairs_world_sweep_first_many(many, sweeps, filter, firsts) == ALLPAIRS_OK);
  for (size_t i = 0; i < kQueries; ++i) {
    allpairs_hit first;
    ALLPAIRS_CHECK(allpairs_world_sweep_first(single, &each[i], filter, &first) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(firsts[i].id == first.id && firsts[i].t == first.t);
    ALLPAIRS_CHECK(allpairs_world_sweep_all(single, &each[i], filter, &one) == ALLPAIRS_OK);
    sameHits(&lists.data[lists.offsets[i]], lists.offsets[i + 1] - lists.offsets[i], one);
  }
}

static void pointsAreAnswered(allpairs_world* many, allpairs_world* single, const allpairs_query_filter* filter) {
  const allpairs_nearest_many wanted = {asked, 2 * (size_t)kQueries, kNearest};  // a box is two points
  allpairs_neighbor_lists lists;
  allpairs_neighbors one;
  ALLPAIRS_CHECK(allpairs_world_find_nearest_many(many, &wanted, filter, &lists) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(lists.count == wanted.point_count && lists.offsets[lists.count] == kNearest * lists.count);
  for (size_t i = 0; i < wanted.point_count; ++i) {
    const double* point = &asked[3 * i];
    const allpairs_nearest alone = {{point[0], point[1], point[2]}, kNearest};
    ALLPAIRS_CHECK(allpairs_world_find_nearest(single, &alone, filter, &one) == ALLPAIRS_OK && one.count == kNearest);
    for (size_t k = 0; k < kNearest; ++k) {
      const allpairs_neighbor neighbor = lists.data[lists.offsets[i] + k];
      ALLPAIRS_CHECK(neighbor.id == one.data[k].id && neighbor.distance == one.data[k].distance);
    }
  }
}

static double squareBetween(const double* a, const double* b) {
  double sum = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double gap = fmax(fmax(a[axis] - b[axis + 3], b[axis] - a[axis + 3]), 0);
    sum += gap * gap;
  }
  return sum;
}

/// The k-th neighbor is at its distance, and k boxes come before it.
static void boxesAreToldTheirNearest(allpairs_world* many) {
  allpairs_neighbor_lists lists;
  allpairs_set* boxes = setOf(asked, kQueries);
  const allpairs_nearest_to_boxes wanted = {boxes, kNearest};
  ALLPAIRS_CHECK(allpairs_world_find_nearest_to_boxes(many, &wanted, NULL, &lists) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(lists.count == kQueries && lists.offsets[kQueries] == kNearest * (size_t)kQueries);
  for (size_t i = 0; i < lists.offsets[kQueries]; ++i) {
    const allpairs_neighbor found = lists.data[i];
    const double* query = &asked[6 * (i / kNearest)];
    const double square = squareBetween(query, &rows[6 * (size_t)found.id]);
    size_t nearer = 0;
    for (uint32_t id = 0; id < kBoxes; ++id) {
      const double other = squareBetween(query, &rows[6 * (size_t)id]);
      nearer += other < square || (other == square && id < found.id) ? 1 : 0;
    }
    ALLPAIRS_CHECK(fabs(found.distance - sqrt(square)) <= 1e-12 * sqrt(square) && nearer == i % kNearest);
  }
  allpairs_set_destroy(boxes);
}

static void noQueriesAreNoLists(allpairs_world* world) {
  const allpairs_rays rays = {NULL, 0};
  const allpairs_nearest_many nearest = {NULL, 0, 3};
  allpairs_hit_lists hits;
  allpairs_neighbor_lists neighbors;
  ALLPAIRS_CHECK(allpairs_world_find_all_many(world, rays, NULL, &hits) == ALLPAIRS_OK && hits.count == 0);
  ALLPAIRS_CHECK(allpairs_world_find_first_many(world, rays, NULL, NULL) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_find_nearest_many(world, &nearest, NULL, &neighbors) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(neighbors.count == 0 && neighbors.offsets[0] == 0);
}

static bool refused(allpairs_status status, const char* why) {
  return status == ALLPAIRS_INVALID_ARGUMENT && strstr(allpairs_error_message(), why) != NULL;
}

static void nonsenseIsNamedAndAnswersNothing(allpairs_world* world) {
  const allpairs_ray each[2] = {{{0, 0, 0}, {1, 0, 0}, 9}, {{0, NAN, 0}, {1, 0, 0}, 9}};
  const allpairs_rays rays = {each, 2};
  const allpairs_rays nowhere = {NULL, 2};
  const allpairs_sweep moving[2] = {{{0, 0, 0, 1, 1, 1}, {1, 0, 0}, 1}, {{0, 0, 0, 1, 1, 1}, {1, 0, 0}, -1}};
  const allpairs_sweeps sweeps = {moving, 2};
  const double points[6] = {0, 0, 0, 0, INFINITY, 0};
  const allpairs_nearest_many nearest = {points, 2, 1};
  allpairs_hit hits[2] = {{7, 7}, {7, 7}};
  allpairs_hit_lists lists;
  allpairs_neighbor_lists neighbors;
  ALLPAIRS_CHECK(refused(allpairs_world_find_first_many(world, rays, NULL, hits), "ray 1") && hits[0].id == 7);
  ALLPAIRS_CHECK(refused(allpairs_world_find_all_many(world, rays, NULL, &lists), "ray 1"));
  ALLPAIRS_CHECK(refused(allpairs_world_sweep_first_many(world, sweeps, NULL, hits), "sweep 1") && hits[0].id == 7);
  ALLPAIRS_CHECK(refused(allpairs_world_sweep_all_many(world, sweeps, NULL, &lists), "sweep 1"));
  const allpairs_sweep withNan[2] = {moving[0], {{0, NAN, 0, 1, 1, 1}, {1, 0, 0}, 1}};
  const allpairs_sweeps ofNoBox = {withNan, 2};
  ALLPAIRS_CHECK(allpairs_world_sweep_first_many(world, ofNoBox, NULL, hits) == ALLPAIRS_INVALID_BOX &&
                 strstr(allpairs_error_message(), "1") != NULL && allpairs_error_index() == 1 && hits[0].id == 7);
  ALLPAIRS_CHECK(allpairs_world_sweep_all_many(world, ofNoBox, NULL, &lists) == ALLPAIRS_INVALID_BOX &&
                 allpairs_error_index() == 1);
  ALLPAIRS_CHECK(refused(allpairs_world_find_nearest_many(world, &nearest, NULL, &neighbors), "point 1"));
  ALLPAIRS_CHECK(refused(allpairs_world_find_all_many(world, nowhere, NULL, &lists), "rays is null"));
  ALLPAIRS_CHECK(refused(allpairs_world_find_first_many(world, rays, NULL, NULL), "hits is null"));
  ALLPAIRS_CHECK(refused(allpairs_world_find_overlapping_many(world, NULL, NULL, NULL), "lists is null"));
  const allpairs_nearest_to_boxes none = {NULL, 1};
  ALLPAIRS_CHECK(refused(allpairs_world_find_nearest_to_boxes(world, &none, NULL, &neighbors), "boxes is null"));
}

int main(void) {
  const allpairs_query_filter none = {1, 0, false, false};
  allpairs_id_lists lists;
  checkFill(rows, kBoxes, 5);
  checkFill(asked, kQueries, 6);
  allpairs_world* single = worldWith(0);
  for (size_t threads = 0; threads < 4; threads += 3) {
    allpairs_world* many = worldWith(threads);
    boxesAreAnswered(many, single, NULL);
    raysAreAnswered(many, single, NULL);
    sweepsAreAnswered(many, single, NULL);
    pointsAreAnswered(many, single, NULL);
    boxesAreToldTheirNearest(many);
    noQueriesAreNoLists(many);
    nonsenseIsNamedAndAnswersNothing(many);
    allpairs_set* boxes = setOf(asked, kQueries);
    ALLPAIRS_CHECK(allpairs_world_find_overlapping_many(many, boxes, &none, &lists) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(lists.count == kQueries && lists.offsets[kQueries] == 0);
    allpairs_set_destroy(boxes);
    allpairs_world_destroy(many);
  }
  allpairs_world_destroy(single);
  return EXIT_SUCCESS;
}
