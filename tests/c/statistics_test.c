// SPDX-License-Identifier: MIT
// What searches and worlds say of their work, with each instruction set, and what else can be asked of them.
#include <string.h>

#include "Check.h"

enum { kBoxes = 400, kWorlds = 20 };

static double rows[6 * kBoxes];

static uint64_t everyPair(void) {
  uint64_t count = 0;
  for (size_t i = 0; i < kBoxes; ++i) {
    for (size_t j = i + 1; j < kBoxes; ++j) count += checkMeet(&rows[6 * i], &rows[6 * j], 0) ? 1 : 0;
  }
  return count;
}

static allpairs_overlap_statistics lastOf(const allpairs_search* search) {
  allpairs_overlap_statistics statistics;
  statistics.struct_size = sizeof statistics;
  ALLPAIRS_CHECK(allpairs_search_statistics(search, &statistics) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(statistics.struct_size == sizeof statistics);
  return statistics;
}

static void checkLast(const allpairs_search* search, uint64_t pairs, uint64_t boxTests) {
  const allpairs_overlap_statistics statistics = lastOf(search);
  ALLPAIRS_CHECK(statistics.pairs == pairs && statistics.box_tests == boxTests && statistics.group_tests == 0);
}

static allpairs_step_statistics lastOfWorld(const allpairs_world* world) {
  allpairs_step_statistics statistics;
  statistics.struct_size = sizeof statistics;
  ALLPAIRS_CHECK(allpairs_world_statistics(world, &statistics) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(statistics.struct_size == sizeof statistics);
  return statistics;
}

/// An exhaustive search tests each pair once, whichever its result is and with which instructions it tests.
static void tests(const allpairs_set* set, const allpairs_set* other, const char* instructionSet) {
  const uint64_t every = everyPair();
  const uint64_t most = (uint64_t)kBoxes * (kBoxes - 1) / 2;
  allpairs_search* search = NULL;
  allpairs_pairs pairs;
  uint64_t count = 0;
  allpairs_options options = allpairs_default_options();
  options.strategy = ALLPAIRS_EXHAUSTIVE;
  options.instruction_set = instructionSet;
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  checkLast(search, 0, 0);
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_OK && pairs.count == every);
  checkLast(search, every, most);
  ALLPAIRS_CHECK(allpairs_find_between(search, set, other, &pairs) == ALLPAIRS_OK);
  checkLast(search, pairs.count, (uint64_t)kBoxes * allpairs_set_size(other));
  ALLPAIRS_CHECK(allpairs_count(search, set, &count) == ALLPAIRS_OK && count == every);
  checkLast(search, every, most);
  ALLPAIRS_CHECK(allpairs_search_shrink(search) == ALLPAIRS_OK);
  checkLast(search, every, most);
  allpairs_search_destroy(search);
}

static bool accept(void* context, uint32_t first, uint32_t second) {
  const allpairs_search* search = *(allpairs_search**)context;
  checkLast(search, 0, 0);  // not of the one before, and not yet of this
  return first < second;
}

/// One pair counts once, in rows and in worlds too; a search that fails leaves nothing.
static void everySearchHasStatistics(const allpairs_set* set) {
  const uint64_t every = everyPair();
  allpairs_search* search = NULL;
  allpairs_rows found;
  allpairs_pairs pairs;
  uint64_t begin[kWorlds + 1];
  allpairs_worlds worlds = {0};
  worlds.struct_size = sizeof worlds;
  worlds.boxes = set;
  worlds.count = kWorlds;
  allpairs_options options = allpairs_default_options();
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find_neighbors(search, set, ALLPAIRS_FULL_ROWS, &found) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(found.offsets[kBoxes] == 2 * every && lastOf(search).pairs == every);
  ALLPAIRS_CHECK(allpairs_count_in_worlds(search, &worlds, begin) == ALLPAIRS_OK && begin[kWorlds] > 0);
  ALLPAIRS_CHECK(lastOf(search).pairs == begin[kWorlds] && lastOf(search).box_tests >= begin[kWorlds]);
  ALLPAIRS_CHECK(allpairs_search_shrink(search) == ALLPAIRS_OK && lastOf(search).pairs == begin[kWorlds]);
  ALLPAIRS_CHECK(allpairs_find(search, NULL, &pairs) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(lastOf(search).pairs == begin[kWorlds]);  // no search
  options.max_pairs = 5;
  ALLPAIRS_CHECK(allpairs_search_set_options(search, &options) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_LIMIT_EXCEEDED);
  checkLast(search, 0, 0);
  ALLPAIRS_CHECK(allpairs_find_in_worlds(search, &worlds, &(allpairs_world_pairs){{NULL, 0}, NULL}) ==
                 ALLPAIRS_LIMIT_EXCEEDED);
  checkLast(search, 0, 0);
  options.max_pairs = 0;
  options.accept = accept;
  options.accept_context = &search;
  ALLPAIRS_CHECK(allpairs_search_set_options(search, &options) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &pairs) == ALLPAIRS_OK && lastOf(search).pairs == every);
  allpairs_search_destroy(search);
}

/// A caller that was compiled against an earlier, shorter structure gets what it knows, and nothing beside it.
static void shorterStructuresAreWritten(const allpairs_set* set) {
  allpairs_search* search = NULL;
  uint64_t count = 0;
  allpairs_overlap_statistics statistics = {0, 7, 7, 7, 7};
  ALLPAIRS_CHECK(allpairs_search_create(NULL, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_count(search, set, &count) == ALLPAIRS_OK);
  statistics.struct_size = offsetof(allpairs_overlap_statistics, box_tests);
  ALLPAIRS_CHECK(allpairs_search_statistics(search, &statistics) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(statistics.struct_size == offsetof(allpairs_overlap_statistics, box_tests));
  ALLPAIRS_CHECK(statistics.pairs == count && statistics.box_tests == 7 && statistics.exact_tests == 7);
  statistics.pairs = 7;
  statistics.struct_size = sizeof statistics + 8;
  ALLPAIRS_CHECK(allpairs_search_statistics(search, &statistics) == ALLPAIRS_INVALID_ARGUMENT &&
                 checkSays("knows up to"));
  statistics.struct_size = 0;
  ALLPAIRS_CHECK(allpairs_search_statistics(search, &statistics) == ALLPAIRS_INVALID_ARGUMENT &&
                 checkSays("size is 0"));
  statistics.struct_size = sizeof statistics - 4;
  ALLPAIRS_CHECK(allpairs_search_statistics(search, &statistics) == ALLPAIRS_INVALID_ARGUMENT && checkSays("no such"));
  ALLPAIRS_CHECK(statistics.pairs == 7);
  ALLPAIRS_CHECK(allpairs_search_statistics(search, NULL) == ALLPAIRS_INVALID_ARGUMENT &&
                 checkSays("statistics is null"));
  ALLPAIRS_CHECK(allpairs_search_statistics(NULL, &statistics) == ALLPAIRS_INVALID_ARGUMENT &&
                 checkSays("search is null"));
  allpairs_search_destroy(search);
}

static void aWorldSaysWhatItsStepHasDone(const allpairs_set* set, const char* instructionSet) {
  static uint32_t ids[kBoxes];
  allpairs_world* world = NULL;
  allpairs_step step;
  allpairs_world_options options = {.struct_size = sizeof options, .instruction_set = instructionSet};
  ALLPAIRS_CHECK(allpairs_world_create(&options, &world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(lastOfWorld(world).changed == 0 && !lastOfWorld(world).joined_all);
  ALLPAIRS_CHECK(allpairs_world_id_bound(world) == 0 && allpairs_world_id_bound(NULL) == 0);
  ALLPAIRS_CHECK(allpairs_world_reserve(world, 2 * (size_t)kBoxes) == ALLPAIRS_OK && allpairs_world_size(world) == 0);
  ALLPAIRS_CHECK(allpairs_world_add(world, set, NULL, ids) == ALLPAIRS_OK && allpairs_world_id_bound(world) == kBoxes);
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK && step.pairs.count == everyPair());
  allpairs_step_statistics last = lastOfWorld(world);
  ALLPAIRS_CHECK(last.changed == kBoxes && last.joined_all && last.box_tests >= step.pairs.count);

  const allpairs_ids most = {ids + 100, kBoxes - 100};
  ALLPAIRS_CHECK(allpairs_world_remove(world, most) == ALLPAIRS_OK && allpairs_world_id_bound(world) == kBoxes);
  ALLPAIRS_CHECK(lastOfWorld(world).changed == kBoxes);  // of the last step
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK);
  last = lastOfWorld(world);
  ALLPAIRS_CHECK(last.changed == kBoxes - 100);
  ALLPAIRS_CHECK(allpairs_world_shrink(world) == ALLPAIRS_OK && allpairs_world_id_bound(world) == 100);
  ALLPAIRS_CHECK(allpairs_world_reserve(world, SIZE_MAX) == ALLPAIRS_INVALID_ARGUMENT && checkSays("can be numbered"));
  ALLPAIRS_CHECK(allpairs_world_reserve(NULL, 1) == ALLPAIRS_INVALID_ARGUMENT && checkSays("world is null"));
  ALLPAIRS_CHECK(allpairs_world_step(world, &step) == ALLPAIRS_OK && lastOfWorld(world).changed == 0);

  last.struct_size = 4;
  ALLPAIRS_CHECK(allpairs_world_statistics(world, &last) == ALLPAIRS_INVALID_ARGUMENT && checkSays("struct_size is 4"));
  ALLPAIRS_CHECK(allpairs_world_statistics(world, NULL) == ALLPAIRS_INVALID_ARGUMENT &&
                 checkSays("statistics is null"));
  ALLPAIRS_CHECK(allpairs_world_statistics(NULL, &last) == ALLPAIRS_INVALID_ARGUMENT && checkSays("world is null"));
  allpairs_world_destroy(world);
}

static void anUnknownInstructionSetIsRefused(void) {
  allpairs_search* search = NULL;
  allpairs_world* world = NULL;
  allpairs_options options = allpairs_default_options();
  allpairs_world_options ofWorld = {.struct_size = sizeof ofWorld, .instruction_set = "none"};
  ALLPAIRS_CHECK(allpairs_world_create(&ofWorld, &world) == ALLPAIRS_INVALID_ARGUMENT && world == NULL);
  ALLPAIRS_CHECK(checkSays("no instruction set 'none'") && checkSays("SCALAR"));
  options.instruction_set = "";
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_INVALID_ARGUMENT && search == NULL);
  ALLPAIRS_CHECK(allpairs_search_create(NULL, &search) == ALLPAIRS_OK);
  options.instruction_set = "scalar";
  ALLPAIRS_CHECK(allpairs_search_set_options(search, &options) == ALLPAIRS_INVALID_ARGUMENT && checkSays("'scalar'"));
  // The name is read when options are set, and may go then.
  char name[] = "SCALAR";
  options.instruction_set = name;
  ALLPAIRS_CHECK(allpairs_search_set_options(search, &options) == ALLPAIRS_OK);
  memset(name, 'X', sizeof name - 1);
  allpairs_set* set = NULL;
  uint64_t count = 0;
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows, kBoxes, &set) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_count(search, set, &count) == ALLPAIRS_OK && count == everyPair());
  allpairs_set_destroy(set);
  allpairs_search_destroy(search);
}

int main(void) {
  allpairs_set *set = NULL, *other = NULL;
  checkFill(rows, kBoxes, 3);
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows, kBoxes, &set) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows + 60, 300, &other) == ALLPAIRS_OK);
  const char* last = NULL;
  for (size_t i = 0; allpairs_instruction_set(i) != NULL; ++i) {
    last = allpairs_instruction_set(i);
    tests(set, other, last);
    aWorldSaysWhatItsStepHasDone(set, last);
  }
  ALLPAIRS_CHECK(last != NULL && strcmp(last, "SCALAR") == 0 && allpairs_instruction_set(SIZE_MAX) == NULL);
  aWorldSaysWhatItsStepHasDone(set, NULL);
  everySearchHasStatistics(set);
  shorterStructuresAreWritten(set);
  anUnknownInstructionSetIsRefused();
  allpairs_set_destroy(set);
  allpairs_set_destroy(other);
  return EXIT_SUCCESS;
}
