// SPDX-License-Identifier: MIT
#include <string.h>

#include "Check.h"

enum { kBoxes = 300, kPairs = kBoxes * kBoxes };

static double rows[6 * kBoxes];
static float single[6 * kBoxes];
static uint32_t groups[kBoxes];
static allpairs_pair expected[kPairs];

/// The double loop; with groups, boxes of the same non-zero one are left out.
static size_t everyPair(double distance, const uint32_t* group) {
  size_t count = 0;
  for (uint32_t i = 0; i < kBoxes; ++i) {
    for (uint32_t j = i + 1; j < kBoxes; ++j) {
      if (group != NULL && group[i] == group[j] && group[i] != 0) continue;
      if (!checkMeet(&rows[6 * i], &rows[6 * j], distance)) continue;
      expected[count].first = i;
      expected[count++].second = j;
    }
  }
  return count;
}

static void checkPairs(allpairs_pairs found, size_t count) {
  ALLPAIRS_CHECK(count > 0 && found.count == count);
  ALLPAIRS_CHECK(memcmp(found.data, expected, count * sizeof(allpairs_pair)) == 0);
}

static void pairsAreThoseOfTheDoubleLoop(allpairs_set* set) {
  allpairs_search* search = NULL;
  allpairs_pairs found;
  uint64_t count = 0;
  ALLPAIRS_CHECK(allpairs_search_create(NULL, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &found) == ALLPAIRS_OK);
  checkPairs(found, everyPair(0, NULL));
  ALLPAIRS_CHECK(allpairs_count(search, set, &count) == ALLPAIRS_OK && count == found.count);
  allpairs_search_destroy(search);
}

static void optionsAreRead(allpairs_set* set) {
  allpairs_search* search = NULL;
  allpairs_pairs found;
  allpairs_options options = allpairs_default_options();
  options.distance = 1;
  options.threads = 2;
  options.strategy = ALLPAIRS_BVH;
  options.first.groups = groups;
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &found) == ALLPAIRS_OK);
  checkPairs(found, everyPair(1, groups));
  options = allpairs_default_options();
  options.order = ALLPAIRS_BY_SECOND;
  ALLPAIRS_CHECK(allpairs_search_set_options(search, &options) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &found) == ALLPAIRS_OK && found.count == everyPair(0, NULL));
  for (size_t i = 1; i < found.count; ++i) ALLPAIRS_CHECK(found.data[i - 1].second <= found.data[i].second);
  const double region[6] = {0, 0, 0, 0, 0, 0};
  options.region = region;
  uint64_t inside = 0;
  ALLPAIRS_CHECK(allpairs_search_set_options(search, &options) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_count(search, set, &inside) == ALLPAIRS_OK && inside < found.count);
  allpairs_search_destroy(search);
}

static bool acceptOdd(void* context, uint32_t first, uint32_t second) {
  ++*(size_t*)context;
  return (first + second) % 2 == 1;
}

static void aCallbackDecides(allpairs_set* set) {
  allpairs_search* search = NULL;
  allpairs_pairs found;
  size_t asked = 0;
  allpairs_options options = allpairs_default_options();
  options.accept = acceptOdd;
  options.accept_context = &asked;
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, set, &found) == ALLPAIRS_OK);
  size_t odd = 0;
  const size_t all = everyPair(0, NULL);
  for (size_t i = 0; i < all; ++i) {
    if ((expected[i].first + expected[i].second) % 2 == 1) expected[odd++] = expected[i];
  }
  checkPairs(found, odd);
  ALLPAIRS_CHECK(asked >= all);
  allpairs_search_destroy(search);
}

typedef struct Collected {
  allpairs_pair pairs[kPairs];
  size_t count;
  size_t stopAt;
} Collected;

static bool collect(void* context, allpairs_pairs batch) {
  Collected* collected = context;
  ALLPAIRS_CHECK(batch.count > 0 && batch.count <= 7);
  memcpy(collected->pairs + collected->count, batch.data, batch.count * sizeof(allpairs_pair));
  collected->count += batch.count;
  return collected->count < collected->stopAt;
}

static void streamsComeInBatchesAndCanBeStopped(allpairs_set* set) {
  static Collected collected;
  collected.count = 0;
  collected.stopAt = kPairs;
  const allpairs_visitor visitor = {collect, &collected, 7};
  allpairs_search* search = NULL;
  allpairs_options options = allpairs_default_options();
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_stream(search, set, visitor) == ALLPAIRS_OK);
  const allpairs_pairs all = {collected.pairs, collected.count};
  checkPairs(all, everyPair(0, NULL));
  collected.count = 0;
  collected.stopAt = 10;
  ALLPAIRS_CHECK(allpairs_stream(search, set, visitor) == ALLPAIRS_STOPPED);
  ALLPAIRS_CHECK(collected.count == 14);
  allpairs_search_destroy(search);
}

static void twoSetsAreMet(allpairs_set* set) {
  allpairs_search* search = NULL;
  allpairs_set* one = NULL;
  allpairs_pairs found;
  uint64_t count = 0;
  const uint32_t group[1] = {1};
  allpairs_options options = allpairs_default_options();
  options.first.groups = groups;
  options.second.groups = group;
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows, 1, &one) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find_between(search, set, one, &found) == ALLPAIRS_OK && found.count > 0);
  size_t next = 0;
  for (uint32_t i = 0; i < kBoxes; ++i) {
    if (groups[i] == 1 || !checkMeet(&rows[6 * i], rows, 0)) continue;
    ALLPAIRS_CHECK(next < found.count && found.data[next].first == i && found.data[next].second == 0);
    ++next;
  }
  ALLPAIRS_CHECK(next == found.count);
  ALLPAIRS_CHECK(allpairs_count_between(search, set, one, &count) == ALLPAIRS_OK && count == next);
  allpairs_set_destroy(one);
  allpairs_search_destroy(search);
}

/// Row by row what the double loop finds in its order.
static void checkRow(const allpairs_rows* found, uint32_t row, bool half) {
  uint64_t next = found->offsets[row];
  for (uint32_t j = half ? row + 1 : 0; j < kBoxes; ++j) {
    if (j == row || !checkMeet(&rows[6 * row], &rows[6 * j], 0)) continue;
    ALLPAIRS_CHECK(next < found->offsets[row + 1] && found->indices[next] == j);
    ++next;
  }
  ALLPAIRS_CHECK(next == found->offsets[row + 1]);
}

static void neighborsAreThoseOfTheDoubleLoop(allpairs_set* set) {
  allpairs_search* search = NULL;
  allpairs_rows found;
  allpairs_options options = allpairs_default_options();
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  for (int strategy = ALLPAIRS_EXHAUSTIVE; strategy <= ALLPAIRS_BVH; ++strategy) {
    options.strategy = (allpairs_strategy)strategy;
    options.max_pairs = everyPair(0, NULL);
    ALLPAIRS_CHECK(allpairs_search_set_options(search, &options) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(allpairs_find_neighbors(search, set, ALLPAIRS_FULL_ROWS, &found) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(found.count == kBoxes && found.offsets[0] == 0);
    for (uint32_t i = 0; i < kBoxes; ++i) checkRow(&found, i, false);
    ALLPAIRS_CHECK(allpairs_find_neighbors(search, set, ALLPAIRS_HALF_ROWS, &found) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(found.count == kBoxes && found.offsets[kBoxes] == options.max_pairs);
    for (uint32_t i = 0; i < kBoxes; ++i) checkRow(&found, i, true);
  }
  ALLPAIRS_CHECK(allpairs_find_neighbors(search, set, (allpairs_rows_kind)2, &found) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(strcmp(allpairs_error_message(), "no kind of rows 2") == 0);
  ALLPAIRS_CHECK(allpairs_find_neighbors(search, set, ALLPAIRS_HALF_ROWS, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  allpairs_search_destroy(search);
}

static void resultsGoToMemoryOfTheCaller(allpairs_set* set) {
  static allpairs_pair pairs[kPairs];
  static uint64_t offsets[kBoxes + 1];
  static uint32_t indices[kPairs];
  const size_t count = everyPair(0, NULL);
  allpairs_pair_memory memory = {pairs, kPairs, 0};
  allpairs_rows_memory place = {offsets, indices, kPairs, 0};
  allpairs_search* search = NULL;
  allpairs_rows found;
  allpairs_options few = allpairs_default_options();
  ALLPAIRS_CHECK(allpairs_search_create(NULL, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find_into(search, set, &memory) == ALLPAIRS_OK && memory.count == count);
  ALLPAIRS_CHECK(memcmp(pairs, expected, count * sizeof(allpairs_pair)) == 0);
  memory.capacity = count - 1;
  ALLPAIRS_CHECK(allpairs_find_into(search, set, &memory) == ALLPAIRS_LIMIT_EXCEEDED && memory.count == count);
  ALLPAIRS_CHECK(allpairs_error_index() == count);
  memory.capacity = kPairs;
  ALLPAIRS_CHECK(allpairs_find_between_into(search, set, set, &memory) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(memory.count > 2 * count && memory.count <= 2 * count + kBoxes);
  ALLPAIRS_CHECK(allpairs_find_neighbors_into(search, set, ALLPAIRS_FULL_ROWS, &place) == ALLPAIRS_OK);
  found.offsets = offsets;
  found.indices = indices;
  ALLPAIRS_CHECK(place.count == 2 * count && offsets[kBoxes] == place.count);
  for (uint32_t i = 0; i < kBoxes; ++i) checkRow(&found, i, false);
  ALLPAIRS_CHECK(allpairs_find_neighbors_between_into(search, set, set, &place) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(place.count == memory.count && offsets[kBoxes] == place.count);
  place.capacity = place.count - 1;
  ALLPAIRS_CHECK(allpairs_find_neighbors_between_into(search, set, set, &place) == ALLPAIRS_LIMIT_EXCEEDED);
  ALLPAIRS_CHECK(place.count == memory.count);
  place.capacity = kPairs;
  few.max_pairs = 3;
  ALLPAIRS_CHECK(allpairs_search_set_options(search, &few) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find_into(search, set, &memory) == ALLPAIRS_LIMIT_EXCEEDED && memory.count == 0);
  ALLPAIRS_CHECK(allpairs_find_neighbors_into(search, set, ALLPAIRS_FULL_ROWS, &place) == ALLPAIRS_LIMIT_EXCEEDED);
  ALLPAIRS_CHECK(place.count == 0);
  place.offsets = NULL;
  ALLPAIRS_CHECK(allpairs_find_neighbors_into(search, set, ALLPAIRS_FULL_ROWS, &place) == ALLPAIRS_INVALID_ARGUMENT);
  memory.data = NULL;
  ALLPAIRS_CHECK(allpairs_find_into(search, set, &memory) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(strcmp(allpairs_error_message(), "memory is null") == 0);
  ALLPAIRS_CHECK(allpairs_find_into(search, set, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  allpairs_search_destroy(search);
}

static void neighborsBetweenTwoSetsAreOfTheFirst(allpairs_set* set) {
  enum { kOthers = 40 };
  allpairs_search* search = NULL;
  allpairs_set* others = NULL;
  allpairs_rows found;
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows, kOthers, &others) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_search_create(NULL, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find_neighbors_between(search, set, others, &found) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(found.count == kBoxes && found.offsets[0] == 0 && found.offsets[kBoxes] > kOthers);
  for (uint32_t i = 0; i < kBoxes; ++i) {
    uint64_t next = found.offsets[i];
    for (uint32_t j = 0; j < kOthers; ++j) {
      if (!checkMeet(&rows[6 * i], &rows[6 * j], 0)) continue;
      ALLPAIRS_CHECK(next < found.offsets[i + 1] && found.indices[next] == j);
      ++next;
    }
    ALLPAIRS_CHECK(next == found.offsets[i + 1]);
  }
  allpairs_set_destroy(others);
  allpairs_search_destroy(search);
}

static void marginsAreAdded(void) {
  const double near[12] = {0, 0, 0, 1, 1, 1, 2, 0, 0, 3, 1, 1};
  const double each[2] = {0.25, 0.75};
  allpairs_set* set = NULL;
  allpairs_search* search = NULL;
  uint64_t count = 0;
  ALLPAIRS_CHECK(allpairs_set_create_f64(near, 2, &set) == ALLPAIRS_OK && allpairs_set_size(set) == 2);
  ALLPAIRS_CHECK(allpairs_search_create(NULL, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_set_margin(set, 0.25) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_count(search, set, &count) == ALLPAIRS_OK && count == 0);
  ALLPAIRS_CHECK(allpairs_set_margins(set, each) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_count(search, set, &count) == ALLPAIRS_OK && count == 1);
  ALLPAIRS_CHECK(allpairs_set_margin(set, 0.5) == ALLPAIRS_OK);  // replaces them
  ALLPAIRS_CHECK(allpairs_set_margins(set, each) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_set_margin(set, 0.25) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_count(search, set, &count) == ALLPAIRS_OK && count == 0);
  ALLPAIRS_CHECK(allpairs_set_margin(set, 0.5) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_set_margins(set, each) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_set_margins(set, NULL) == ALLPAIRS_OK);  // brings that of all back
  ALLPAIRS_CHECK(allpairs_count(search, set, &count) == ALLPAIRS_OK && count == 1);
  ALLPAIRS_CHECK(allpairs_set_margin(set, 0) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_count(search, set, &count) == ALLPAIRS_OK && count == 0);
  allpairs_search_destroy(search);
  allpairs_set_destroy(set);
}

static void onSets(void (*test)(allpairs_set*)) {
  const allpairs_corner_f64 min = {rows, 6, 1};
  const allpairs_corner_f64 max = {rows + 3, 6, 1};
  const allpairs_corner_f32 low = {single, 1, kBoxes};
  const allpairs_corner_f32 high = {single + 3 * kBoxes, 1, kBoxes};
  allpairs_set* sets[3] = {NULL};
  ALLPAIRS_CHECK(allpairs_set_create_f64(rows, kBoxes, &sets[0]) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_set_create_strided_f64(kBoxes, min, max, &sets[1]) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_set_create_strided_f32(kBoxes, low, high, &sets[2]) == ALLPAIRS_OK);
  for (size_t i = 0; i < 3; ++i) {
    test(sets[i]);
    allpairs_set_destroy(sets[i]);
  }
}

#ifndef ALLPAIRS_IS_SANITIZED
/// 93,000 boxes in one place: more pairs than 32 bits hold are counted, and allowed.
static void numbersOfPairsHave64Bits(void) {
  const float corner[3] = {0, 0, 0};
  const allpairs_corner_f32 all = {corner, 0, 1};
  const size_t size = 93000;
  allpairs_set* many = NULL;
  allpairs_set* few = NULL;
  allpairs_search* search = NULL;
  allpairs_pairs found;
  uint64_t count = 0;
  allpairs_options options = allpairs_default_options();
  options.strategy = ALLPAIRS_EXHAUSTIVE;
  options.max_pairs = (uint64_t)1 << 33U;
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_set_create_strided_f32(size, all, all, &many) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_set_create_strided_f32(100, all, all, &few) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_count(search, many, &count) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(count == (uint64_t)size * (size - 1) / 2);
  ALLPAIRS_CHECK(allpairs_find(search, few, &found) == ALLPAIRS_OK && found.count == 4950);
  allpairs_set_destroy(many);
  allpairs_set_destroy(few);
  allpairs_search_destroy(search);
}
#endif

int main(void) {
  checkFill(rows, kBoxes, 3);
  for (size_t i = 0; i < kBoxes; ++i) {
    groups[i] = (uint32_t)i % 3;
    for (size_t k = 0; k < 6; ++k) single[k * kBoxes + i] = (float)rows[6 * i + k];
  }
  onSets(pairsAreThoseOfTheDoubleLoop);
  onSets(neighborsAreThoseOfTheDoubleLoop);
  onSets(neighborsBetweenTwoSetsAreOfTheFirst);
  onSets(resultsGoToMemoryOfTheCaller);
  onSets(optionsAreRead);
  onSets(aCallbackDecides);
  onSets(streamsComeInBatchesAndCanBeStopped);
  onSets(twoSetsAreMet);
  marginsAreAdded();
#ifndef ALLPAIRS_IS_SANITIZED  // four billion tests take a minute then
  numbersOfPairsHave64Bits();
#endif
  return EXIT_SUCCESS;
}
