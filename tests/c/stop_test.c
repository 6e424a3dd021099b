// SPDX-License-Identifier: MIT
// A function of the caller's ends calls, and the handles can be used on.
#include <stddef.h>
#include <string.h>

#include "Check.h"

enum { kBoxes = 4000 };

#ifdef ALLPAIRS_IS_SANITIZED
enum { kAsksPerLook = 8 };  // each refusal is an exception, and takes ten times as long
#else
enum { kAsksPerLook = 1 };
#endif

static double rows[6 * kBoxes];
static uint32_t ids[kBoxes];

/// Ends the call after it has been asked so many times; looks at the handles that ask.
typedef struct Stop {
  size_t left;
  size_t asked;
  allpairs_search* search;
  allpairs_world* world;
  allpairs_elements* elements;
} Stop;

/// As far as they are const, they may be used.
static void lookAtHandles(const Stop* stop) {
  allpairs_pairs pairs;
  allpairs_step step;
  allpairs_ids found;
  if (stop->search != NULL) {
    uint64_t count = 0;
    ALLPAIRS_CHECK(allpairs_count(stop->search, NULL, &count) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_search_shrink(stop->search) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(checkSays("the search is called by its own filter, visitor or stop"));
  }
  if (stop->world != NULL) {
    ALLPAIRS_CHECK(allpairs_world_size(stop->world) == kBoxes && allpairs_world_contains(stop->world, 7));
    ALLPAIRS_CHECK(allpairs_world_step(stop->world, &step) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(checkSays("called by its own accept or stop"));
    ALLPAIRS_CHECK(allpairs_world_clear(stop->world) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_world_find_overlapping(stop->world, rows, NULL, &found) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_world_find_between(stop->world, stop->world, &pairs) == ALLPAIRS_INVALID_ARGUMENT);
  }
  if (stop->elements != NULL) {
    allpairs_element_counts counts;
    ALLPAIRS_CHECK(allpairs_elements_before(stop->elements, 1, &counts) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(allpairs_elements_find(stop->elements, ALLPAIRS_EDGE_EDGE, &pairs) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(checkSays("called by its own filter, visitor, stop or task"));
    ALLPAIRS_CHECK(allpairs_elements_move_f64(stop->elements, 0, rows, rows) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_elements_shrink(stop->elements) == ALLPAIRS_INVALID_ARGUMENT);
  }
}

static bool ask(void* context) {
  Stop* stop = context;
  if (stop->asked++ % kAsksPerLook == 0) lookAtHandles(stop);
  if (stop->left == 0) return true;
  --stop->left;
  return false;
}

static bool takeAll(void* context, allpairs_pairs batch) {
  *(size_t*)context += batch.count;
  return true;
}

static allpairs_status findEach(allpairs_search* search, const allpairs_set* set, size_t call) {
  static allpairs_pair memory[64 * kBoxes];
  allpairs_pair_memory into = {memory, 64 * (size_t)kBoxes, 0};
  allpairs_pairs pairs;
  allpairs_rows lists;
  allpairs_world_pairs ofWorlds;
  allpairs_worlds worlds = {0};
  uint64_t count = 0;
  size_t streamed = 0;
  const allpairs_visitor visitor = {takeAll, &streamed, 0};
  worlds.struct_size = sizeof worlds;
  worlds.boxes = set;
  worlds.count = 2;
  switch (call) {
    case 0:
      return allpairs_find(search, set, &pairs);
    case 1:
      return allpairs_find_between(search, set, set, &pairs);
    case 2:
      return allpairs_find_into(search, set, &into);
    case 3:
      return allpairs_find_neighbors(search, set, ALLPAIRS_HALF_ROWS, &lists);
    case 4:
      return allpairs_count(search, set, &count);
    case 5:
      return allpairs_stream(search, set, visitor);
    default:
      return allpairs_find_in_worlds(search, &worlds, &ofWorlds);
  }
}

static void searchesEnd(const allpairs_set* set) {
  allpairs_search* search = NULL;
  allpairs_overlap_statistics statistics;
  allpairs_pairs pairs;
  uint64_t expected = 0;
  Stop stop = {0, 0, NULL, NULL, NULL};
  allpairs_options options = allpairs_default_options();
  options.stop = ask;
  options.stop_context = &stop;
  statistics.struct_size = sizeof statistics;
  ALLPAIRS_CHECK(allpairs_search_create(NULL, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_count(search, set, &expected) == ALLPAIRS_OK && expected > kBoxes);
  ALLPAIRS_CHECK(allpairs_search_set_options(search, &options) == ALLPAIRS_OK);
  stop.search = search;
  for (size_t call = 0; call < 7; ++call) {
    stop.left = 0;
    stop.asked = 0;
    ALLPAIRS_CHECK(findEach(search, set, call) == ALLPAIRS_STOPPED && stop.asked == 1);
    ALLPAIRS_CHECK(findEach(search, set, call) == ALLPAIRS_STOPPED);
    ALLPAIRS_CHECK(strcmp(allpairs_error_message(), "the search was stopped before its end") == 0);
    ALLPAIRS_CHECK(allpairs_search_statistics(search, &statistics) == ALLPAIRS_OK && statistics.pairs == 0);
    stop.left = SIZE_MAX;
    ALLPAIRS_CHECK(findEach(search, set, call) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_OK && pairs.count == expected);
  }
  // Without it, nobody asks.
  stop.asked = 0;
  options.stop = NULL;
  ALLPAIRS_CHECK(allpairs_search_set_options(search, &options) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_OK && pairs.count == expected && stop.asked == 0);
  allpairs_search_destroy(search);
}

static allpairs_status queryEach(allpairs_world* world, const allpairs_set* set, size_t call) {
  static allpairs_ray rays[kBoxes];
  static allpairs_hit hits[kBoxes];
  const allpairs_rays all = {rays, kBoxes};
  const allpairs_nearest_many nearest = {rows, 2 * (size_t)kBoxes, 3};
  const allpairs_nearest_to_boxes toBoxes = {set, 3};
  allpairs_id_lists idLists;
  allpairs_hit_lists hitLists;
  allpairs_neighbor_lists neighbors;
  allpairs_pairs pairs;
  for (size_t i = 0; i < kBoxes; ++i) {
    const allpairs_ray ray = {{rows[6 * i], -9, 0}, {0, 1, 1}, 99};
    rays[i] = ray;
  }
  switch (call) {
    case 0:
      return allpairs_world_find_overlapping_many(world, set, NULL, &idLists);
    case 1:
      return allpairs_world_find_first_many(world, all, NULL, hits);
    case 2:
      return allpairs_world_find_all_many(world, all, NULL, &hitLists);
    case 3:
      return allpairs_world_find_nearest_many(world, &nearest, NULL, &neighbors);
    case 4:
      return allpairs_world_find_nearest_to_boxes(world, &toBoxes, NULL, &neighbors);
    default:
      return allpairs_world_find_between(world, world, &pairs);
  }
}

static void stepsAndQueriesEnd(const allpairs_set* set) {
  allpairs_world* world = NULL;
  allpairs_step step;
  Stop stop = {SIZE_MAX, 0, NULL, NULL, NULL};
  allpairs_world_options options = {.struct_size = sizeof options, .stop = ask, .stop_context = &stop};
  ALLPAIRS_CHECK(allpairs_world_create(&options, &world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(world, set, NULL, ids) == ALLPAIRS_OK);
  stop.world = world;
  stop.left = 0;
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_STOPPED && stop.asked > 0);
  ALLPAIRS_CHECK(allpairs_world_size(world) == kBoxes);
  stop.left = SIZE_MAX;
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(step.pairs.count > kBoxes && step.began.count == step.pairs.count);
  const size_t pairs = step.pairs.count;
  for (size_t call = 0; call < 6; ++call) {
    stop.left = 0;
    ALLPAIRS_CHECK(queryEach(world, set, call) == ALLPAIRS_STOPPED);
    stop.left = SIZE_MAX;
    ALLPAIRS_CHECK(queryEach(world, set, call) == ALLPAIRS_OK);
  }
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK && step.persisted.count == pairs);
  ALLPAIRS_CHECK(step.began.count == 0 && step.ended.count == 0);
  allpairs_world_destroy(world);
}

static bool isSet(void* context) { return *(const bool*)context; }

static void callsOnThreadsEnd(const allpairs_set* set) {
  bool stop = true;
  allpairs_search* search = NULL;
  allpairs_world* world = NULL;
  allpairs_pairs pairs;
  allpairs_step step;
  allpairs_options options = allpairs_default_options();
  allpairs_world_options ofWorld = {.struct_size = sizeof ofWorld, .threads = 2, .stop = isSet, .stop_context = &stop};
  options.threads = 2;
  options.stop = isSet;
  options.stop_context = &stop;
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_create(&ofWorld, &world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(world, set, NULL, ids) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_STOPPED);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_STOPPED);
  stop = false;
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK && step.began.count == pairs.count);
  ALLPAIRS_CHECK(memcmp(step.began.data, pairs.data, pairs.count * sizeof *pairs.data) == 0);
  allpairs_search_destroy(search);
  allpairs_world_destroy(world);
}

static void candidatesEnd(void) {
  static uint32_t triangles[3 * kBoxes];
  for (uint32_t i = 0; i < 3 * kBoxes; ++i) triangles[i] = i % (2 * kBoxes);
  const allpairs_mesh mesh = {2 * (size_t)kBoxes, triangles, kBoxes};
  allpairs_elements* elements = NULL;
  allpairs_pairs pairs;
  uint64_t count = 0;
  Stop stop = {0, 0, NULL, NULL, NULL};
  allpairs_elements_options options = {.struct_size = sizeof options, .stop = ask, .stop_context = &stop};
  ALLPAIRS_CHECK(allpairs_elements_create(&mesh, 1, &options, &elements) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_elements_move_f64(elements, 0, rows, rows) == ALLPAIRS_OK);
  stop.elements = elements;
  ALLPAIRS_CHECK(allpairs_elements_find(elements, ALLPAIRS_EDGE_EDGE, &pairs) == ALLPAIRS_STOPPED);
  ALLPAIRS_CHECK(allpairs_elements_count(elements, ALLPAIRS_FACE_FACE, &count) == ALLPAIRS_STOPPED);
  stop.left = SIZE_MAX;
  ALLPAIRS_CHECK(allpairs_elements_find(elements, ALLPAIRS_EDGE_EDGE, &pairs) == ALLPAIRS_OK && pairs.count > 0);
  ALLPAIRS_CHECK(allpairs_elements_count(elements, ALLPAIRS_EDGE_EDGE, &count) == ALLPAIRS_OK && count == pairs.count);
  allpairs_elements_destroy(elements);
}

/// Of structures as they were before they had a stop, and up to its context, those fields are not read.
static void smallerOptionsHaveNone(const allpairs_set* set) {
  static const uint32_t triangle[] = {0, 1, 2};
  const allpairs_mesh mesh = {2 * (size_t)kBoxes, triangle, 1};
  Stop stop = {0, 0, NULL, NULL, NULL};
  allpairs_options options = allpairs_default_options();
  allpairs_world_options ofWorld = {.instruction_set = "none", .stop = ask, .stop_context = &stop};
  allpairs_elements_options ofElements = {
      .struct_size = offsetof(allpairs_elements_options, stop), .stop = ask, .stop_context = &stop};
  allpairs_search* search = NULL;
  allpairs_world* world = NULL;
  allpairs_elements* elements = NULL;
  allpairs_pairs pairs;
  allpairs_step step;
  options.struct_size = offsetof(allpairs_options, instruction_set);
  options.instruction_set = "none";
  options.stop = ask;
  options.stop_context = &stop;
  ofWorld.struct_size = offsetof(allpairs_world_options, instruction_set);
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_create(&ofWorld, &world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(world, set, NULL, ids) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK && step.pairs.count == pairs.count);
  ALLPAIRS_CHECK(allpairs_elements_create(&mesh, 1, &ofElements, &elements) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_elements_move_f64(elements, 0, rows, rows) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_elements_find(elements, ALLPAIRS_EDGE_EDGE, &pairs) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(stop.asked == 0);
  allpairs_search_destroy(search);
  allpairs_world_destroy(world);
  allpairs_elements_destroy(elements);
}

int main(void) {
  uint32_t seed = 5;
  for (size_t i = 0; i < kBoxes; ++i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      rows[6 * i + axis] = checkRandom(&seed, 40);
      rows[6 * i + axis + 3] = rows[6 * i + axis] + checkRandom(&seed, 5);
    }
  }
  allpairs_set* set = NULL;
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows, kBoxes, &set) == ALLPAIRS_OK);
  searchesEnd(set);
  stepsAndQueriesEnd(set);
  callsOnThreadsEnd(set);
  candidatesEnd();
  smallerOptionsHaveNone(set);
  allpairs_set_destroy(set);
  return EXIT_SUCCESS;
}
