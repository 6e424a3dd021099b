// SPDX-License-Identifier: MIT
//
// The library from C: the pairs of a set, what errors look like, and boxes that move.
#include <allpairs.h>

#include <math.h>
#include <stdio.h>

static int fail(void) {
  fprintf(stderr, "allpairs: %s\n", allpairs_error_message());
  return 1;
}

static void print(const char* title, allpairs_pairs pairs) {
  printf("%s:", title);
  for (size_t i = 0; i < pairs.count; ++i) printf(" (%u, %u)", pairs.data[i].first, pairs.data[i].second);
  printf("\n");
}

/// A box rolls from one neighbour to the other.
static int roll(const double* rows) {
  allpairs_world* world = NULL;
  allpairs_set* start = NULL;
  allpairs_set* end = NULL;
  uint32_t ids[3] = {0};
  const double moved[6] = {7, 7, 7, 9, 9, 9};
  allpairs_step step;
  if (allpairs_set_create_f64(rows, 3, &start) || allpairs_set_create_f64(moved, 1, &end)) return fail();
  if (allpairs_world_create(NULL, &world) || allpairs_world_add(world, start, NULL, ids)) return fail();
  if (allpairs_world_step(world, &step)) return fail();
  print("began", step.began);
  const allpairs_ids rolling = {&ids[1], 1};
  if (allpairs_world_move(world, rolling, end) || allpairs_world_step(world, &step)) return fail();
  print("began", step.began);
  print("ended", step.ended);
  allpairs_world_destroy(world);
  allpairs_set_destroy(start);
  allpairs_set_destroy(end);
  return 0;
}

int main(void) {
  double rows[18] = {0, 0, 0, 2, 2, 2,   // box 0
                     2, 2, 2, 4, 4, 4,   // box 1 shares a corner with it: that counts
                     8, 8, 8, 9, 9, 9};  // box 2 is far away
  allpairs_set* set = NULL;
  allpairs_search* search = NULL;
  allpairs_pairs pairs;
  if (allpairs_set_create_f64(rows, 3, &set) || allpairs_search_create(NULL, &search)) return fail();
  if (allpairs_find(search, set, &pairs)) return fail();
  print("pairs", pairs);
  allpairs_search_destroy(search);
  allpairs_set_destroy(set);

  if (roll(rows)) return 1;

  rows[9] = NAN;
  if (allpairs_set_create_f64(rows, 3, &set) == ALLPAIRS_INVALID_BOX) {
    printf("refused: %s\n", allpairs_error_message());
  }
  return 0;
}
