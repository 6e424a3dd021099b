// SPDX-License-Identifier: MIT
#include <math.h>
#include <string.h>

#include "Check.h"

enum { kBoxes = 120 };

static double rows[6 * kBoxes];
static uint32_t ids[kBoxes];
static bool isIn[kBoxes];
static bool met[kBoxes][kBoxes];

static allpairs_set* setOf(const double* data, size_t count) {
  allpairs_set* set = NULL;
  ALLPAIRS_CHECK(allpairs_set_create_f64(data, count, &set) == ALLPAIRS_OK);
  return set;
}

static bool meetNow(size_t i, size_t j) { return isIn[i] && isIn[j] && checkMeet(&rows[6 * i], &rows[6 * j], 0.5); }

/// One step against the double loop: pairs, and which began, persisted and ended. Ids are those of the rows here.
static void checkStep(allpairs_world* world) {
  allpairs_step step;
  size_t all = 0, began = 0, persisted = 0, ended = 0;
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK);
  for (uint32_t i = 0; i < kBoxes; ++i) {
    for (uint32_t j = i + 1; j < kBoxes; ++j) {
      const bool now = meetNow(i, j);
      const allpairs_pair pair = {i, j};
      if (now) ALLPAIRS_CHECK(all < step.pairs.count && !memcmp(&step.pairs.data[all++], &pair, sizeof pair));
      if (now && !met[i][j]) ALLPAIRS_CHECK(!memcmp(&step.began.data[began++], &pair, sizeof pair));
      if (now && met[i][j]) ALLPAIRS_CHECK(!memcmp(&step.persisted.data[persisted++], &pair, sizeof pair));
      if (!now && met[i][j]) ALLPAIRS_CHECK(!memcmp(&step.ended.data[ended++], &pair, sizeof pair));
      met[i][j] = now;
    }
  }
  ALLPAIRS_CHECK(step.pairs.count == all && step.began.count == began);
  ALLPAIRS_CHECK(step.persisted.count == persisted && step.ended.count == ended);
}

static void moveSome(allpairs_world* world, uint32_t seed) {
  uint32_t moved[kBoxes];
  double bounds[6 * kBoxes];
  size_t count = 0;
  for (uint32_t i = 0; i < kBoxes; i += 1 + checkRandom(&seed, 6)) {
    if (!isIn[i]) continue;
    checkFill(&rows[6 * i], 1, seed);
    memcpy(&bounds[6 * count], &rows[6 * i], 6 * sizeof(double));
    moved[count++] = i;
  }
  allpairs_set* set = setOf(bounds, count);
  const allpairs_ids chosen = {moved, count};
  ALLPAIRS_CHECK(allpairs_world_move(world, chosen, set) == ALLPAIRS_OK);
  allpairs_set_destroy(set);
}

static void checkQueries(allpairs_world* world) {
  const double box[6] = {3, 3, 3, 6, 6, 6};
  allpairs_ids found;
  size_t next = 0;
  ALLPAIRS_CHECK(allpairs_world_find_overlapping(world, box, NULL, &found) == ALLPAIRS_OK && found.count > 0);
  for (uint32_t i = 0; i < kBoxes; ++i) {
    if (isIn[i] && checkMeet(box, &rows[6 * i], 0)) ALLPAIRS_CHECK(next < found.count && found.data[next++] == i);
  }
  ALLPAIRS_CHECK(next == found.count);
  const allpairs_query_filter nothing = {.category = UINT32_MAX, .mask = UINT32_MAX, .skip_moving = true};
  ALLPAIRS_CHECK(allpairs_world_find_overlapping(world, box, &nothing, &found) == ALLPAIRS_OK && found.count == 0);

  const allpairs_ray up = {{100.5, 0.5, -5}, {0, 0, 2}, 50};
  allpairs_hit hit;
  ALLPAIRS_CHECK(allpairs_world_find_first(world, &up, NULL, &hit) == ALLPAIRS_OK && hit.id == ALLPAIRS_NO_BOX);
  const double target[6] = {100, 0, 1, 101, 1, 2};
  allpairs_set* set = setOf(target, 1);
  uint32_t id = 0;
  ALLPAIRS_CHECK(allpairs_world_add(world, set, NULL, &id) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_find_first(world, &up, NULL, &hit) == ALLPAIRS_OK && hit.id == id && hit.t == 3);
  const allpairs_ids added = {&id, 1};
  ALLPAIRS_CHECK(allpairs_world_remove(world, added) == ALLPAIRS_OK && !allpairs_world_contains(world, id));
  allpairs_set_destroy(set);
}

static void propertiesAreRead(void) {
  const double same[12] = {0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1};
  allpairs_world* world = NULL;
  allpairs_set* set = setOf(same, 2);
  allpairs_properties properties = allpairs_default_properties();
  allpairs_properties apart[2];
  uint32_t two[2];
  allpairs_step step;
  properties.is_static = true;
  ALLPAIRS_CHECK(allpairs_world_create(NULL, &world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(world, set, &properties, two) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK && step.pairs.count == 0);
  apart[0] = apart[1] = allpairs_default_properties();
  const allpairs_ids both = {two, 2};
  ALLPAIRS_CHECK(allpairs_world_set_properties(world, both, apart) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK && step.began.count == 1);
  apart[0].group = apart[1].group = 4;
  ALLPAIRS_CHECK(allpairs_world_set_properties(world, both, apart) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK && step.ended.count == 1);
  allpairs_world_destroy(world);
  allpairs_set_destroy(set);
}

static bool areEqual(const allpairs_properties* a, const allpairs_properties* b) {
  return a->category == b->category && a->mask == b->mask && a->group == b->group && a->margin == b->margin &&
         a->is_static == b->is_static;
}

/// Boxes that are added with their properties have these; those that are refused are not there.
static void anotherWorldHoldsTheSame(const allpairs_set* set, const allpairs_properties* properties, uint32_t count) {
  uint32_t given[40];
  allpairs_properties got, wrong[40];
  allpairs_world* world = NULL;
  ALLPAIRS_CHECK(allpairs_world_create(NULL, &world) == ALLPAIRS_OK);
  memcpy(wrong, properties, count * sizeof *wrong);
  wrong[5].margin = NAN;
  ALLPAIRS_CHECK(allpairs_world_add_each(world, set, wrong, given) == ALLPAIRS_INVALID_BOX);
  ALLPAIRS_CHECK(allpairs_error_index() == 5 && allpairs_world_size(world) == 0);
  ALLPAIRS_CHECK(allpairs_world_add_each(world, set, NULL, given) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(checkSays("properties is null"));
  ALLPAIRS_CHECK(allpairs_world_add_each(world, set, properties, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_add_each(world, NULL, properties, given) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_add_each(NULL, set, properties, given) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_add_each(world, set, properties, given) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_size(world) == count);
  for (uint32_t i = 0; i < count; ++i) {
    ALLPAIRS_CHECK(given[i] == i && allpairs_world_properties(world, i, &got) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(areEqual(&got, &properties[i]));
  }
  allpairs_world_destroy(world);
}

/// A world says what it has been given: of boxes that all have something else.
static void whatAWorldHoldsCanBeAsked(void) {
  enum { kMany = 40 };
  uint32_t numbers[kMany], given[kMany], listed[kMany] = {0}, number = 0;
  allpairs_properties properties[kMany], got = allpairs_default_properties();
  allpairs_world* world = NULL;
  allpairs_set* set = setOf(rows, kMany);
  allpairs_step step;
  ALLPAIRS_CHECK(allpairs_world_create(NULL, &world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_list_ids(world, NULL) == ALLPAIRS_OK);  // of no boxes
  for (uint32_t i = 0; i < kMany; ++i) {
    numbers[i] = i % 7 == 0 ? ALLPAIRS_EVERY_WORLD : i % 3;
    const allpairs_properties each = {i + 1, ~i, i % 5, i / 8.0 - 1, i % 2 == 1};
    properties[i] = each;
  }
  const allpairs_membership membership = {NULL, numbers};
  const allpairs_ids all = {given, kMany};
  ALLPAIRS_CHECK(allpairs_world_add_to_worlds(world, set, &membership, given) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_properties(world, 3, &got) == ALLPAIRS_OK);
  const allpairs_properties defaults = allpairs_default_properties();
  ALLPAIRS_CHECK(areEqual(&got, &defaults));
  ALLPAIRS_CHECK(allpairs_world_set_properties(world, all, properties) == ALLPAIRS_OK);
  for (uint32_t i = 0; i < kMany; ++i) {
    ALLPAIRS_CHECK(allpairs_world_properties(world, given[i], &got) == ALLPAIRS_OK && areEqual(&got, &properties[i]));
    ALLPAIRS_CHECK(allpairs_world_number(world, given[i], &number) == ALLPAIRS_OK && number == numbers[i]);
  }
  anotherWorldHoldsTheSame(set, properties, kMany);
  const uint32_t gone[3] = {0, 8, kMany - 1};
  const allpairs_ids removed = {gone, 3};
  ALLPAIRS_CHECK(allpairs_world_remove(world, removed) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_list_ids(world, listed) == ALLPAIRS_OK && listed[kMany - 3] == 0);
  for (uint32_t id = 0, next = 0; id < kMany; ++id) {
    if (id != gone[0] && id != gone[1] && id != gone[2]) ALLPAIRS_CHECK(listed[next++] == id);
  }

  got.group = 77;
  number = 77;
  ALLPAIRS_CHECK(allpairs_world_properties(world, 8, &got) == ALLPAIRS_INVALID_BOX && got.group == 77);
  ALLPAIRS_CHECK(checkSays("no box with the id 8"));
  ALLPAIRS_CHECK(allpairs_world_number(world, ALLPAIRS_NO_BOX, &number) == ALLPAIRS_INVALID_BOX && number == 77);
  ALLPAIRS_CHECK(allpairs_world_properties(world, 1, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_properties(NULL, 1, &got) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_number(world, 1, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_list_ids(world, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_list_ids(NULL, listed) == ALLPAIRS_INVALID_ARGUMENT);

  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK);
  const size_t before = step.pairs.count;
  ALLPAIRS_CHECK(before > 0 && allpairs_world_clear(world) == ALLPAIRS_OK && allpairs_world_size(world) == 0);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK && step.pairs.count == 0 &&
                 step.ended.count == before);
  ALLPAIRS_CHECK(allpairs_world_clear(world) == ALLPAIRS_OK && allpairs_world_list_ids(world, NULL) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_clear(NULL) == ALLPAIRS_INVALID_ARGUMENT);
  allpairs_world_destroy(world);
  allpairs_set_destroy(set);
}

static void sweptBoxesHoldTheirWay(allpairs_world* world) {
  const double start[6] = {0, 0, 0, 1, 1, 1}, end[6] = {4, 0, 0, 5, 1, 1};
  allpairs_set *from = setOf(start, 1), *to = setOf(end, 1);
  const allpairs_ids first = {ids, 1};
  double bounds[6];
  ALLPAIRS_CHECK(allpairs_world_move_swept(world, first, from, to) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_box(world, ids[0], bounds) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(bounds[0] == 0 && bounds[3] == 5 && bounds[4] == 1);
  allpairs_set_destroy(from);
  allpairs_set_destroy(to);
}

/// Boxes that move by velocities are where start + velocity * duration is, in double.
static void velocitiesSweepBoxes(void) {
  enum { kMany = 30 };
  double velocities[3 * kMany], ends[6 * kMany], bounds[6], expected[6];
  uint32_t seed = 3, given[kMany], sweptIds[kMany];
  allpairs_world *world = NULL, *swept = NULL;
  for (size_t i = 0; i < 3 * (size_t)kMany; ++i) velocities[i] = checkRandom(&seed, 1000) / 7.0 - 70;
  for (size_t i = 0; i < 6 * (size_t)kMany; ++i) ends[i] = rows[i] + velocities[i / 6 * 3 + i % 3] * 0.3;
  allpairs_set *from = setOf(rows, kMany), *to = setOf(ends, kMany);
  const allpairs_ids all = {given, kMany};
  const allpairs_velocities motion = {velocities, 0.3};
  ALLPAIRS_CHECK(allpairs_world_create(NULL, &world) == ALLPAIRS_OK &&
                 allpairs_world_create(NULL, &swept) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(world, from, NULL, given) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(swept, from, NULL, sweptIds) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_move_swept_by(world, all, from, &motion) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_move_swept(swept, all, from, to) == ALLPAIRS_OK);
  for (uint32_t i = 0; i < kMany; ++i) {
    ALLPAIRS_CHECK(allpairs_world_box(world, i, bounds) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(allpairs_world_box(swept, i, expected) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(memcmp(bounds, expected, sizeof bounds) == 0);
  }

  // What is refused changes nothing.
  allpairs_velocities wrong = {velocities, INFINITY};
  const allpairs_ids fewer = {given, kMany - 1}, none = {given, SIZE_MAX / 3 + kMany};
  ALLPAIRS_CHECK(allpairs_world_move_swept_by(world, all, from, &wrong) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(checkSays("the duration is not finite"));
  wrong.duration = 1;
  velocities[3 * 4 + 2] = NAN;
  ALLPAIRS_CHECK(allpairs_world_move_swept_by(world, all, from, &wrong) == ALLPAIRS_INVALID_BOX);
  ALLPAIRS_CHECK(allpairs_error_index() == 4 && checkSays("not finite"));
  wrong.data = NULL;
  ALLPAIRS_CHECK(allpairs_world_move_swept_by(world, all, from, &wrong) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(checkSays("velocities.data is null"));
  ALLPAIRS_CHECK(allpairs_world_move_swept_by(world, fewer, from, &motion) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_move_swept_by(world, none, from, &motion) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_move_swept_by(world, all, from, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_move_swept_by(world, all, NULL, &motion) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_move_swept_by(NULL, all, from, &motion) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_box(world, kMany - 1, bounds) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(memcmp(bounds, expected, sizeof bounds) == 0);
  allpairs_world_destroy(world);
  allpairs_world_destroy(swept);
  allpairs_set_destroy(from);
  allpairs_set_destroy(to);
}

static void checkPairs(allpairs_pairs pairs, const allpairs_pair* expected, size_t count) {
  ALLPAIRS_CHECK(pairs.count == count);
  ALLPAIRS_CHECK(count == 0 || !memcmp(pairs.data, expected, count * sizeof *expected));
}

/// Four boxes at one place: of worlds 5, 9 and 5, and of every world.
static void worldsAreApart(void) {
  const double data[24] = {0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1};
  const uint32_t numbers[4] = {5, 9, 5, ALLPAIRS_EVERY_WORLD};
  const allpairs_membership membership = {NULL, numbers};
  allpairs_world* world = NULL;
  allpairs_step step;
  uint32_t made[4];
  ALLPAIRS_CHECK(allpairs_world_create(NULL, &world) == ALLPAIRS_OK);
  allpairs_set* set = setOf(data, 4);
  ALLPAIRS_CHECK(allpairs_world_add_to_worlds(world, set, NULL, made) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_add_to_worlds(world, set, &membership, made) == ALLPAIRS_OK);
  allpairs_set_destroy(set);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK);
  checkPairs(step.pairs, (allpairs_pair[]){{0, 2}, {0, 3}, {1, 3}, {2, 3}}, 4);
  ALLPAIRS_CHECK(allpairs_world_result_of(world, 5, &step) == ALLPAIRS_OK);
  checkPairs(step.began, (allpairs_pair[]){{0, 2}, {0, 3}, {2, 3}}, 3);

  allpairs_ids found;
  ALLPAIRS_CHECK(allpairs_world_restrict_queries(world, 9) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_find_overlapping(world, data, NULL, &found) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(found.count == 2 && found.data[0] == 1 && found.data[1] == 3);
  ALLPAIRS_CHECK(allpairs_world_restrict_queries(world, ALLPAIRS_EVERY_WORLD) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_find_overlapping(world, data, NULL, &found) == ALLPAIRS_OK && found.count == 4);

  // Other properties leave boxes in their worlds, and worlds leave the properties.
  const allpairs_ids two = {made, 2};
  const allpairs_properties still[2] = {{UINT32_MAX, UINT32_MAX, 0, 0.0, true}, {UINT32_MAX, UINT32_MAX, 0, 0.0, true}};
  ALLPAIRS_CHECK(allpairs_world_set_properties(world, two, still) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK);
  checkPairs(step.pairs, (allpairs_pair[]){{0, 2}, {0, 3}, {1, 3}, {2, 3}}, 4);
  ALLPAIRS_CHECK(allpairs_world_set_worlds(world, two, (uint32_t[]){9, 5}) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK);
  checkPairs(step.pairs, (allpairs_pair[]){{0, 3}, {1, 2}, {1, 3}, {2, 3}}, 4);
  checkPairs(step.ended, (allpairs_pair[]){{0, 2}}, 1);
  const uint32_t missing = 44;
  const allpairs_ids none = {&missing, 1};
  ALLPAIRS_CHECK(allpairs_world_set_worlds(world, none, numbers) == ALLPAIRS_INVALID_BOX);
  allpairs_world_destroy(world);
}

struct Caller {
  allpairs_world* world;
  allpairs_world* other;
};

/// Uses the worlds that call it: as const handles only.
static bool callBack(void* context, uint32_t first, uint32_t second) {
  const struct Caller* caller = context;
  allpairs_world* const worlds[2] = {caller->world, caller->other};
  double box[6];
  for (size_t i = 0; i < 2 && worlds[i] != NULL; ++i) {
    const allpairs_ray ray = {{0, 0, 0}, {1, 0, 0}, 1};
    const allpairs_nearest nearest = {{0, 0, 0}, 1};
    allpairs_properties properties;
    uint32_t listed[2];
    allpairs_step step;
    allpairs_ids found;
    allpairs_hit hit;
    allpairs_hits hits;
    allpairs_neighbors neighbors;
    allpairs_pairs pairs;
    ALLPAIRS_CHECK(allpairs_world_contains(worlds[i], 0) && allpairs_world_size(worlds[i]) == 2);
    ALLPAIRS_CHECK(allpairs_world_box(worlds[i], 0, box) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(allpairs_world_list_ids(worlds[i], listed) == ALLPAIRS_OK && listed[1] == 1);
    ALLPAIRS_CHECK(allpairs_world_properties(worlds[i], 1, &properties) == ALLPAIRS_OK && properties.group == 0);
    ALLPAIRS_CHECK(allpairs_world_clear(worlds[i]) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_world_step(worlds[i], &step) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_world_result_of(worlds[i], 0, &step) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_world_find_overlapping(worlds[i], box, NULL, &found) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_world_find_first(worlds[i], &ray, NULL, &hit) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_world_find_all(worlds[i], &ray, NULL, &hits) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_world_find_nearest(worlds[i], &nearest, NULL, &neighbors) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_world_find_between(worlds[i], worlds[i], &pairs) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_world_restrict_queries(worlds[i], 5) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_world_shrink(worlds[i]) == ALLPAIRS_INVALID_ARGUMENT);
  }
  return first <= second;
}

static void aWorldIsNotUsedByItsOwnCallback(size_t threads) {
  const double data[12] = {0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1};
  struct Caller caller = {NULL, NULL};
  allpairs_world_options options = {.struct_size = sizeof options, .threads = threads};
  allpairs_step step;
  allpairs_pairs pairs;
  allpairs_ids found;
  options.accept = callBack;
  options.accept_context = &caller;
  allpairs_set* set = setOf(data, 2);
  ALLPAIRS_CHECK(allpairs_world_create(&options, &caller.world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(caller.world, set, NULL, ids) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_step(caller.world, &step) == ALLPAIRS_OK && step.pairs.count == 1);
  ALLPAIRS_CHECK(allpairs_world_find_between(caller.world, caller.world, &pairs) == ALLPAIRS_OK && pairs.count == 3);
  ALLPAIRS_CHECK(allpairs_world_create(NULL, &caller.other) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(caller.other, set, NULL, ids) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_find_between(caller.world, caller.other, &pairs) == ALLPAIRS_OK && pairs.count == 3);
  ALLPAIRS_CHECK(allpairs_world_find_overlapping(caller.other, data, NULL, &found) == ALLPAIRS_OK && found.count == 2);
  ALLPAIRS_CHECK(allpairs_set_margin(set, 0.5) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(caller.other, set, NULL, ids) == ALLPAIRS_INVALID_ARGUMENT);
  allpairs_world_destroy(caller.other);
  allpairs_world_destroy(caller.world);
  allpairs_set_destroy(set);
}

static void idsAreReusedAfterTheNextStep(void) {
  const uint32_t middle = 1;
  const allpairs_ids gone = {&middle, 1};
  allpairs_world* world = NULL;
  allpairs_set* three = setOf(rows, 3);
  allpairs_set* one = setOf(rows, 1);
  allpairs_step step;
  uint32_t given[3];
  ALLPAIRS_CHECK(allpairs_world_create(NULL, &world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(world, three, NULL, given) == ALLPAIRS_OK && given[0] == 0 && given[2] == 2);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_remove(world, gone) == ALLPAIRS_OK && !allpairs_world_contains(world, 1));
  ALLPAIRS_CHECK(allpairs_world_add(world, one, NULL, given) == ALLPAIRS_OK && given[0] == 3);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(world, one, NULL, given) == ALLPAIRS_OK && given[0] == 1);
  allpairs_world_destroy(world);
  allpairs_set_destroy(three);
  allpairs_set_destroy(one);
}

int main(void) {
  idsAreReusedAfterTheNextStep();
  aWorldIsNotUsedByItsOwnCallback(0);
  aWorldIsNotUsedByItsOwnCallback(2);
  worldsAreApart();
  allpairs_world* world = NULL;
  allpairs_world_options options = {.struct_size = sizeof options, .distance = 0.5, .threads = 2};
  ALLPAIRS_CHECK(allpairs_world_create(&options, &world) == ALLPAIRS_OK);
  checkFill(rows, kBoxes, 11);
  allpairs_set* set = setOf(rows, kBoxes);
  ALLPAIRS_CHECK(allpairs_world_add(world, set, NULL, ids) == ALLPAIRS_OK && allpairs_world_size(world) == kBoxes);
  allpairs_set_destroy(set);
  for (uint32_t i = 0; i < kBoxes; ++i) {
    ALLPAIRS_CHECK(ids[i] == i && allpairs_world_contains(world, i));
    isIn[i] = true;
  }
  for (uint32_t step = 0; step < 20; ++step) {
    checkStep(world);
    moveSome(world, 7 * step + 1);
    const uint32_t gone = 5 * step;
    const allpairs_ids removed = {&gone, 1};
    ALLPAIRS_CHECK(allpairs_world_remove(world, removed) == ALLPAIRS_OK);
    isIn[gone] = false;
  }
  checkStep(world);
  checkQueries(world);
  propertiesAreRead();
  whatAWorldHoldsCanBeAsked();
  velocitiesSweepBoxes();
  ids[0] = 1;
  sweptBoxesHoldTheirWay(world);
  allpairs_world_destroy(world);
  return EXIT_SUCCESS;
}
