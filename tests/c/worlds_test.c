// SPDX-License-Identifier: MIT
#include <string.h>

#include "Check.h"

enum { kWorlds = 40, kBoxes = 30, kAll = kWorlds * kBoxes, kPairs = kWorlds * kBoxes * kBoxes };

static double rows[6 * kAll];
static allpairs_pair expected[kPairs];
static allpairs_pair listed[kPairs];
static uint64_t expectedBegin[kWorlds + 1];
static uint64_t begin[kWorlds + 1];
static uint32_t groups[kBoxes];

/// The pairs of each world by a search of its own.
static void findEach(allpairs_search* search, const allpairs_set* shared) {
  size_t count = 0;
  for (size_t k = 0; k < kWorlds; ++k) {
    allpairs_set* world = NULL;
    allpairs_pairs pairs;
    expectedBegin[k] = count;
    ALLPAIRS_CHECK(allpairs_set_create_f64(&rows[6 * kBoxes * k], kBoxes, &world) == ALLPAIRS_OK);
    if (shared == NULL) {
      ALLPAIRS_CHECK(allpairs_find(search, world, &pairs) == ALLPAIRS_OK);
    } else {
      ALLPAIRS_CHECK(allpairs_find_between(search, world, shared, &pairs) == ALLPAIRS_OK);
    }
    memcpy(&expected[count], pairs.data, pairs.count * sizeof(allpairs_pair));
    count += pairs.count;
    allpairs_set_destroy(world);
  }
  expectedBegin[kWorlds] = count;
  ALLPAIRS_CHECK(count > 0);
}

static void check(allpairs_search* search, const allpairs_worlds* worlds) {
  allpairs_world_pairs found;
  const size_t count = (size_t)expectedBegin[kWorlds];
  ALLPAIRS_CHECK(allpairs_find_in_worlds(search, worlds, &found) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(found.pairs.count == count);
  ALLPAIRS_CHECK(memcmp(found.pairs.data, expected, count * sizeof(allpairs_pair)) == 0);
  ALLPAIRS_CHECK(memcmp(found.begin, expectedBegin, sizeof expectedBegin) == 0);
  ALLPAIRS_CHECK(allpairs_count_in_worlds(search, worlds, begin) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(memcmp(begin, expectedBegin, sizeof expectedBegin) == 0);
  memset(listed, 0, sizeof listed);
  ALLPAIRS_CHECK(allpairs_list_in_worlds(search, worlds, begin, listed) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(memcmp(listed, expected, count * sizeof(allpairs_pair)) == 0);
}

static void pairsAreThoseOfEachWorld(const allpairs_set* boxes) {
  allpairs_search* search = NULL;
  uint64_t offsets[kWorlds + 1];
  allpairs_worlds worlds = {0};
  worlds.struct_size = sizeof worlds;
  worlds.boxes = boxes;
  worlds.count = kWorlds;
  for (size_t k = 0; k <= kWorlds; ++k) offsets[k] = k * kBoxes;
  ALLPAIRS_CHECK(allpairs_search_create(NULL, &search) == ALLPAIRS_OK);
  findEach(search, NULL);
  check(search, &worlds);
  worlds.begin = offsets;
  check(search, &worlds);
  ALLPAIRS_CHECK(allpairs_search_shrink(search) == ALLPAIRS_OK);
  check(search, &worlds);
  allpairs_search_destroy(search);
}

static void aFilterOfOneWorldHoldsForAll(const allpairs_set* boxes) {
  allpairs_search* search = NULL;
  allpairs_options options = allpairs_default_options();
  allpairs_worlds worlds = {0};
  allpairs_world_pairs found;
  const allpairs_pair ignored = {1, 0};
  worlds.struct_size = sizeof worlds;
  worlds.boxes = boxes;
  worlds.count = kWorlds;
  worlds.filter_is_of_one = true;
  options.first.groups = groups;
  options.threads = 2;
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  findEach(search, NULL);
  check(search, &worlds);
  worlds.ignored = &ignored;
  worlds.ignored_count = 1;
  ALLPAIRS_CHECK(allpairs_find_in_worlds(search, &worlds, &found) == ALLPAIRS_OK);
  for (size_t i = 0; i < found.pairs.count; ++i) {
    ALLPAIRS_CHECK(found.pairs.data[i].first != 0 || found.pairs.data[i].second != 1);
  }
  allpairs_search_destroy(search);
}

static void sharedBoxesAreInEveryWorld(const allpairs_set* boxes) {
  const double ground[12] = {0, 0, 0, 15, 15, 1, 3, 3, 3, 4, 4, 4};
  allpairs_search* search = NULL;
  allpairs_set* shared = NULL;
  allpairs_worlds worlds = {0};
  ALLPAIRS_CHECK(allpairs_search_create(NULL, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_set_create_f64(ground, 2, &shared) == ALLPAIRS_OK);
  worlds.struct_size = sizeof worlds;
  worlds.boxes = boxes;
  worlds.count = kWorlds;
  worlds.shared = shared;
  findEach(search, shared);
  check(search, &worlds);
  allpairs_set_destroy(shared);
  allpairs_search_destroy(search);
}

struct Caller {
  allpairs_search* search;
  const allpairs_set* boxes;
};

/// Uses the search that calls it, which is refused.
static bool callBack(void* context, uint32_t first, uint32_t second) {
  const struct Caller* caller = context;
  allpairs_pairs pairs;
  ALLPAIRS_CHECK(allpairs_find(caller->search, caller->boxes, &pairs) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_search_set_options(caller->search, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_search_shrink(caller->search) == ALLPAIRS_INVALID_ARGUMENT);
  return first < second;
}

static void mistakesAreNamed(const allpairs_set* boxes) {
  allpairs_search* search = NULL;
  const uint64_t wrong[3] = {0, 50, 40};
  allpairs_worlds worlds = {0};
  allpairs_world_pairs found;
  struct Caller caller;
  allpairs_options options = allpairs_default_options();
  ALLPAIRS_CHECK(allpairs_search_create(NULL, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find_in_worlds(search, &worlds, &found) == ALLPAIRS_INVALID_ARGUMENT);
  worlds.struct_size = sizeof worlds;
  worlds.boxes = boxes;
  worlds.count = 7;
  ALLPAIRS_CHECK(allpairs_find_in_worlds(search, &worlds, &found) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(strcmp(allpairs_error_message(), "1200 boxes cannot be divided equally among 7 worlds") == 0);
  worlds.count = 2;
  worlds.begin = wrong;
  ALLPAIRS_CHECK(allpairs_find_in_worlds(search, &worlds, &found) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(strstr(allpairs_error_message(), "world 1") != NULL);
  ALLPAIRS_CHECK(allpairs_find_in_worlds(search, NULL, &found) == ALLPAIRS_INVALID_ARGUMENT);
  worlds.begin = NULL;
  caller.search = search;
  caller.boxes = boxes;
  options.accept = callBack;
  options.accept_context = &caller;
  ALLPAIRS_CHECK(allpairs_search_set_options(search, &options) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find_in_worlds(search, &worlds, &found) == ALLPAIRS_OK && found.pairs.count > 0);
  allpairs_search_destroy(search);
}

#ifdef ALLPAIRS_IS_SANITIZED
enum { kRefusals = 1 };  // each is an exception, and takes ten times as long
#else
enum { kRefusals = 20 };
#endif

/// Searches of worlds are made when they are first asked for: callbacks of either kind of search ask for the other.
static bool searchWorlds(void* context, uint32_t first, uint32_t second) {
  const struct Caller* caller = context;
  allpairs_worlds worlds = {0};
  allpairs_world_pairs found;
  allpairs_pairs pairs;
  worlds.struct_size = sizeof worlds;
  worlds.boxes = caller->boxes;
  worlds.count = 2;
  for (int i = 0; i < kRefusals; ++i) {
    ALLPAIRS_CHECK(allpairs_find_in_worlds(caller->search, &worlds, &found) == ALLPAIRS_INVALID_ARGUMENT);
    ALLPAIRS_CHECK(allpairs_find(caller->search, caller->boxes, &pairs) == ALLPAIRS_INVALID_ARGUMENT);
  }
  return first < second;
}

static void callbacksInSeveralThreadsAreRefused(const allpairs_set* boxes) {
  struct Caller caller = {NULL, boxes};
  allpairs_options options = allpairs_default_options();
  allpairs_worlds worlds = {0};
  allpairs_world_pairs found;
  allpairs_pairs pairs;
  options.accept = searchWorlds;
  options.accept_context = &caller;
  options.threads = 4;
  worlds.struct_size = sizeof worlds;
  worlds.boxes = boxes;
  worlds.count = 2;
  ALLPAIRS_CHECK(allpairs_search_create(&options, &caller.search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(caller.search, boxes, &pairs) == ALLPAIRS_OK && pairs.count > 0);
  ALLPAIRS_CHECK(allpairs_find_in_worlds(caller.search, &worlds, &found) == ALLPAIRS_OK && found.pairs.count > 0);
  ALLPAIRS_CHECK(allpairs_find(caller.search, boxes, &pairs) == ALLPAIRS_OK && pairs.count > 0);
  allpairs_search_destroy(caller.search);
}

int main(void) {
  allpairs_set* boxes = NULL;
  checkFill(rows, kAll, 5);
  for (uint32_t i = 0; i < kBoxes; ++i) groups[i] = i % 4;
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows, kAll, &boxes) == ALLPAIRS_OK);
  pairsAreThoseOfEachWorld(boxes);
  sharedBoxesAreInEveryWorld(boxes);
  mistakesAreNamed(boxes);
  callbacksInSeveralThreadsAreRefused(boxes);
  aFilterOfOneWorldHoldsForAll(boxes);
  allpairs_set_destroy(boxes);
  return EXIT_SUCCESS;
}
