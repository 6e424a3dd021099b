// SPDX-License-Identifier: MIT
// A handle takes its memory from the caller's functions, and gives it back to them.
#include <string.h>

#include "Check.h"

enum { kBoxes = 3000 };

/// What the caller's functions have counted.
typedef struct Count {
  size_t allocations;
  size_t held;
  bool used_up;
} Count;

static void* allocate(void* context, size_t bytes, size_t alignment) {
  Count* count = context;
  void* memory = NULL;
  if (count->used_up) return NULL;
  memory = aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (memory == NULL) return NULL;
  ++count->allocations;
  count->held += bytes;
  return memory;
}

static void deallocate(void* context, void* memory, size_t bytes, size_t alignment) {
  Count* count = context;
  (void)alignment;
  count->held -= bytes;
  free(memory);
}

static void aSearchGivesBackWhatItTook(const allpairs_set* set) {
  Count count = {0, 0, false};
  allpairs_options options = allpairs_default_options();
  allpairs_search* search = NULL;
  allpairs_pairs pairs;
  allpairs_pair last;
  const allpairs_memory memory = {allocate, deallocate, &count};
  options.memory = memory;
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_OK && pairs.count > 1000);
  ALLPAIRS_CHECK(count.held > pairs.count * sizeof *pairs.data);
  last = pairs.data[pairs.count - 1];
  const size_t before = count.held;
  ALLPAIRS_CHECK(allpairs_search_shrink(search) == ALLPAIRS_OK && count.held < before);
  ALLPAIRS_CHECK(memcmp(&last, &pairs.data[pairs.count - 1], sizeof last) == 0);
  count.used_up = true;
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_OUT_OF_MEMORY);
  count.used_up = false;
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_OK);
  allpairs_search_destroy(search);
  ALLPAIRS_CHECK(count.allocations > 0 && count.held == 0);
}

static void aWorldGivesBackWhatItTook(const allpairs_set* set) {
  static uint32_t ids[kBoxes];
  Count count = {0, 0, false};
  allpairs_world_options options = {0};
  allpairs_world* world = NULL;
  allpairs_step step;
  const allpairs_memory memory = {allocate, deallocate, &count};
  options.struct_size = sizeof options;
  options.memory = memory;
  ALLPAIRS_CHECK(allpairs_world_create(&options, &world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(world, set, NULL, ids) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK && step.pairs.count > 1000);
  const size_t pairs = step.pairs.count;
  const size_t before = count.held;
  ALLPAIRS_CHECK(allpairs_world_shrink(world) == ALLPAIRS_OK && count.held < before);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK && step.pairs.count == pairs);
  allpairs_world_destroy(world);
  ALLPAIRS_CHECK(count.allocations > 0 && count.held == 0);
}

static void candidatesGiveBackWhatTheyTook(void) {
  // Too many triangles for a search that needs no memory.
  enum { TRIANGLES = 800 };
  static uint32_t triangles[3 * TRIANGLES];
  static float places[9 * TRIANGLES];
  for (uint32_t i = 0; i < 3 * TRIANGLES; ++i) {
    triangles[i] = i;
    places[3 * i + i % 3] = 1;
  }
  const allpairs_mesh mesh = {3 * TRIANGLES, triangles, TRIANGLES};
  Count count = {0, 0, false};
  allpairs_elements_options options = {0};
  allpairs_elements* elements = NULL;
  allpairs_pairs pairs;
  const allpairs_memory memory = {allocate, deallocate, &count};
  options.struct_size = sizeof options;
  options.memory = memory;
  ALLPAIRS_CHECK(allpairs_elements_create(&mesh, 1, &options, &elements) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_elements_move_f32(elements, 0, places, places) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_elements_find(elements, ALLPAIRS_FACE_FACE, &pairs) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(pairs.count == TRIANGLES * (TRIANGLES - 1) / 2);
  const size_t before = count.held;
  ALLPAIRS_CHECK(allpairs_elements_shrink(elements) == ALLPAIRS_OK && count.held < before && pairs.data[0].second == 1);
  allpairs_elements_destroy(elements);
  ALLPAIRS_CHECK(count.allocations > 0 && count.held == 0);
}

static void oneFunctionWithoutTheOtherIsRefused(void) {
  allpairs_options options = allpairs_default_options();
  allpairs_search* search = NULL;
  options.memory.allocate = allocate;
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_INVALID_ARGUMENT && search == NULL);
  ALLPAIRS_CHECK(strstr(allpairs_error_message(), "only one of allocate and deallocate") != NULL);
}

static void callersThatKnowNoMemoryGetTheDefault(const allpairs_set* set) {
  allpairs_options options = allpairs_default_options();
  allpairs_search* search = NULL;
  uint64_t count = 0;
  options.memory.allocate = allocate;  // not read
  options.struct_size = offsetof(allpairs_options, memory);
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_count(search, set, &count) == ALLPAIRS_OK && count > 1000);
  allpairs_search_destroy(search);
}

int main(void) {
  static double rows[6 * kBoxes];
  allpairs_set* set = NULL;
  checkFill(rows, kBoxes, 7);
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows, kBoxes, &set) == ALLPAIRS_OK);
  aSearchGivesBackWhatItTook(set);
  aWorldGivesBackWhatItTook(set);
  candidatesGiveBackWhatTheyTook();
  oneFunctionWithoutTheOtherIsRefused();
  callersThatKnowNoMemoryGetTheDefault(set);
  ALLPAIRS_CHECK(allpairs_search_shrink(NULL) == ALLPAIRS_INVALID_ARGUMENT);
  allpairs_set_destroy(set);
  return EXIT_SUCCESS;
}
