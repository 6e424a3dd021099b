// SPDX-License-Identifier: MIT
#include <math.h>
#include <string.h>

#include "Check.h"

static const double kBoxes[12] = {0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1};

static void aNanNamesItsBox(void) {
  double rows[18] = {0};
  allpairs_set* set = NULL;
  rows[2 * 6 + 4] = NAN;
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows, 3, &set) == ALLPAIRS_INVALID_BOX);
  ALLPAIRS_CHECK(set == NULL && allpairs_error_index() == 2 && checkSays("box 2: max y"));
}

static void nullIsAnError(void) {
  allpairs_set* set = NULL;
  allpairs_search* search = NULL;
  allpairs_pairs pairs;
  uint64_t count = 0;
  const allpairs_visitor nobody = {NULL, NULL, 0};
  const allpairs_ids none = {NULL, 3};
  ALLPAIRS_CHECK(allpairs_set_create_f64(NULL, 3, &set) == ALLPAIRS_INVALID_ARGUMENT && checkSays("rows is null"));
  ALLPAIRS_CHECK(allpairs_set_create_f64(kBoxes, 2, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_search_create(NULL, NULL) == ALLPAIRS_INVALID_ARGUMENT && checkSays("search is null"));
  ALLPAIRS_CHECK(allpairs_set_create_f64(kBoxes, 2, &set) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(NULL, set, &pairs) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_search_create(NULL, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, NULL, &pairs) == ALLPAIRS_INVALID_ARGUMENT && checkSays("set is null"));
  ALLPAIRS_CHECK(allpairs_find(search, set, NULL) == ALLPAIRS_INVALID_ARGUMENT && checkSays("pairs is null"));
  ALLPAIRS_CHECK(allpairs_count_between(search, set, NULL, &count) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_stream(search, set, nobody) == ALLPAIRS_INVALID_ARGUMENT && checkSays("visit is null"));
  ALLPAIRS_CHECK(allpairs_world_remove(NULL, none) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_step(NULL, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  allpairs_search_destroy(search);
  allpairs_search_destroy(NULL);
  allpairs_set_destroy(set);
  allpairs_set_destroy(NULL);
  allpairs_world_destroy(NULL);
}

static void settingsThatMakeNoSenseAreRefused(void) {
  allpairs_search* search = NULL;
  allpairs_set* set = NULL;
  allpairs_pairs pairs;
  allpairs_options options = {0};
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_INVALID_ARGUMENT &&
                 checkSays("struct_size is 0"));
  options.struct_size = offsetof(allpairs_options, region) + 4;  // half of a pointer
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_INVALID_ARGUMENT &&
                 checkSays("no such structure"));
  options.struct_size = sizeof options + 8;
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_INVALID_ARGUMENT);
  options = allpairs_default_options();
  options.strategy = (allpairs_strategy)17;
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_INVALID_ARGUMENT && checkSays("no strategy 17"));
  options.strategy = ALLPAIRS_AUTOMATIC;
  options.max_pairs = 1;
  options.distance = NAN;
  double rows[18] = {0};
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows, 3, &set) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_INVALID_ARGUMENT && checkSays("distance"));
  options.distance = 0;
  ALLPAIRS_CHECK(allpairs_search_set_options(search, &options) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_LIMIT_EXCEEDED && allpairs_error_index() == 3);
  // Where a result would be written is looked at before anything is searched.
  ALLPAIRS_CHECK(allpairs_find(search, set, NULL) == ALLPAIRS_INVALID_ARGUMENT && checkSays("pairs is null"));
  ALLPAIRS_CHECK(allpairs_find_between(search, set, set, NULL) == ALLPAIRS_INVALID_ARGUMENT &&
                 checkSays("pairs is null"));
  ALLPAIRS_CHECK(allpairs_find_between(search, NULL, set, &pairs) == ALLPAIRS_INVALID_ARGUMENT &&
                 checkSays("first is null"));
  ALLPAIRS_CHECK(allpairs_find_neighbors(search, set, ALLPAIRS_HALF_ROWS, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_find_neighbors_between(search, set, set, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_count(search, set, NULL) == ALLPAIRS_INVALID_ARGUMENT && checkSays("count is null"));
  ALLPAIRS_CHECK(allpairs_count_between(search, set, set, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_set_margin(set, NAN) == ALLPAIRS_INVALID_ARGUMENT);
  allpairs_search_destroy(search);
  allpairs_set_destroy(set);
}

static void aFailedCallLeavesResultsAsTheyWere(void) {
  static const allpairs_pair kNone[1];
  double rows[18] = {0};
  allpairs_set* set = NULL;
  allpairs_set* other = NULL;
  allpairs_search* search = NULL;
  allpairs_pairs pairs = {kNone, 77};
  uint64_t count = 77;
  allpairs_options options = allpairs_default_options();
  options.max_pairs = 1;
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows, 3, &set) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_LIMIT_EXCEEDED);
  ALLPAIRS_CHECK(pairs.data == kNone && pairs.count == 77);
  ALLPAIRS_CHECK(allpairs_count(search, set, &count) == ALLPAIRS_LIMIT_EXCEEDED && count == 77);
  rows[4] = NAN;
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows, 3, &other) == ALLPAIRS_INVALID_BOX && other == NULL);
  allpairs_search_destroy(search);
  allpairs_set_destroy(set);
}

/// Also of the last call with the same structure.
static void aFailedCallLeavesNoNumberInTheCallersMemory(void) {
  allpairs_set* set = NULL;
  allpairs_search* search = NULL;
  allpairs_pair_memory pairs = {NULL, 0, 0};
  uint64_t offsets[3];
  allpairs_rows_memory rows = {offsets, NULL, 0, 0};
  ALLPAIRS_CHECK(allpairs_set_create_f64(kBoxes, 2, &set) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_search_create(NULL, &search) == ALLPAIRS_OK);
  pairs.count = 55;
  ALLPAIRS_CHECK(allpairs_find_into(search, NULL, &pairs) == ALLPAIRS_INVALID_ARGUMENT && pairs.count == 0);
  pairs.count = 55;
  ALLPAIRS_CHECK(allpairs_find_between_into(search, set, NULL, &pairs) == ALLPAIRS_INVALID_ARGUMENT &&
                 checkSays("second is null") && pairs.count == 0);
  rows.count = 55;
  ALLPAIRS_CHECK(allpairs_find_neighbors_into(search, set, (allpairs_rows_kind)5, &rows) == ALLPAIRS_INVALID_ARGUMENT &&
                 checkSays("no kind of rows 5") && rows.count == 0);
  rows.count = 55;
  ALLPAIRS_CHECK(allpairs_find_neighbors_between_into(search, set, NULL, &rows) == ALLPAIRS_INVALID_ARGUMENT &&
                 checkSays("second is null") && rows.count == 0);
  allpairs_search_destroy(search);
  allpairs_set_destroy(set);
}

/// A caller that was compiled against an earlier, shorter structure.
static void shorterStructuresAreTaken(void) {
  allpairs_search* search = NULL;
  allpairs_set* set = NULL;
  allpairs_pairs pairs;
  allpairs_options options = allpairs_default_options();
  options.struct_size = offsetof(allpairs_options, max_pairs);
  options.max_pairs = 1;  // not known to that caller, and so not read
  double rows[18] = {0};
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows, 3, &set) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_OK && pairs.count == 3);
  allpairs_search_destroy(search);
  allpairs_set_destroy(set);
}

static void anUnknownIdIsNamed(void) {
  allpairs_world* world = NULL;
  const uint32_t id = 41;
  const allpairs_ids ids = {&id, 1};
  double bounds[6];
  ALLPAIRS_CHECK(allpairs_world_create(NULL, &world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_remove(world, ids) == ALLPAIRS_INVALID_BOX && checkSays("41"));
  ALLPAIRS_CHECK(allpairs_world_box(world, id, bounds) == ALLPAIRS_INVALID_BOX);
  ALLPAIRS_CHECK(allpairs_world_size(world) == 0 && !allpairs_world_contains(world, id));
  const allpairs_ids tooMany = {&id, SIZE_MAX};
  ALLPAIRS_CHECK(allpairs_world_set_properties(world, tooMany, NULL) == ALLPAIRS_INVALID_ARGUMENT && checkSays("null"));
  allpairs_world_destroy(world);
}

int main(void) {
  ALLPAIRS_CHECK(strlen(allpairs_error_message()) == 0);
  ALLPAIRS_CHECK(strlen(allpairs_version()) >= 5);
  aNanNamesItsBox();
  nullIsAnError();
  settingsThatMakeNoSenseAreRefused();
  aFailedCallLeavesResultsAsTheyWere();
  aFailedCallLeavesNoNumberInTheCallersMemory();
  shorterStructuresAreTaken();
  anUnknownIdIsNamed();
  return EXIT_SUCCESS;
}
