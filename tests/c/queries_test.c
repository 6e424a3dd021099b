// SPDX-License-Identifier: MIT
#include <math.h>

#include "Check.h"

enum { kBoxes = 150 };

static double rows[6 * kBoxes];
static double others[6 * kBoxes];

static allpairs_world* worldOf(const double* data) {
  uint32_t ids[kBoxes];
  allpairs_world* world = NULL;
  allpairs_set* set = NULL;
  ALLPAIRS_CHECK(allpairs_world_create(NULL, &world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_set_create_f64(data, kBoxes, &set) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(world, set, NULL, ids) == ALLPAIRS_OK && ids[kBoxes - 1] == kBoxes - 1);
  allpairs_set_destroy(set);
  return world;
}

/// When a box on its way up, by two a unit of t, meets a box of the world; -1 if it doesn't.
static double meets(const double* box, const double* other, double length) {
  double below[6] = {box[0], box[1], other[2], box[3], box[4], other[5]};
  const double t = fmax((other[2] - box[5]) / 2, 0);
  return checkMeet(below, other, 0) && other[5] >= box[2] && t <= length ? t : -1;
}

/// Whether hits come in the order in which they should.
static bool isAfter(const allpairs_hit* a, const allpairs_hit* b) {
  return a->t < b->t || (a->t == b->t && a->id < b->id);
}

static void checkHits(const double* box, double length, allpairs_hits hits, allpairs_hit first) {
  size_t expected = 0;
  for (size_t i = 0; i < kBoxes; ++i) expected += meets(box, &rows[6 * i], length) >= 0;
  ALLPAIRS_CHECK(hits.count == expected);
  for (size_t i = 0; i < hits.count; ++i) {
    ALLPAIRS_CHECK(hits.data[i].t == meets(box, &rows[(size_t)6 * hits.data[i].id], length));
    ALLPAIRS_CHECK(i == 0 || isAfter(&hits.data[i - 1], &hits.data[i]));
  }
  ALLPAIRS_CHECK(expected == 0 ? first.id == ALLPAIRS_NO_BOX
                               : first.id == hits.data[0].id && first.t == hits.data[0].t);
}

static size_t raysAndSweepsMeetWhatIsInTheirWay(allpairs_world* world) {
  allpairs_hit first;
  allpairs_hits hits;
  size_t met = 0;
  for (uint32_t seed = 0; seed < 200; ++seed) {
    const double length = seed % 9;
    double box[6];
    checkFill(box, 1, seed);
    const allpairs_sweep sweep = {{box[0], box[1], box[2], box[3], box[4], box[5]}, {0, 0, 2}, length};
    ALLPAIRS_CHECK(allpairs_world_sweep_first(world, &sweep, NULL, &first) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(allpairs_world_sweep_all(world, &sweep, NULL, &hits) == ALLPAIRS_OK);
    checkHits(box, length, hits, first);
    const double point[6] = {box[0], box[1], box[2], box[0], box[1], box[2]};
    const allpairs_ray ray = {{box[0], box[1], box[2]}, {0, 0, 2}, length};
    ALLPAIRS_CHECK(allpairs_world_find_first(world, &ray, NULL, &first) == ALLPAIRS_OK);
    ALLPAIRS_CHECK(allpairs_world_find_all(world, &ray, NULL, &hits) == ALLPAIRS_OK);
    checkHits(point, length, hits, first);
    met += hits.count;
  }
  return met;
}

static double distanceFrom(const double* point, const double* box) {
  double sum = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    const double away = fmax(fmax(box[axis] - point[axis], point[axis] - box[axis + 3]), 0);
    sum += away * away;
  }
  return sqrt(sum);
}

/// Each neighbor is where it says, and as many boxes are before it as neighbors are.
static void theNearestComeFirst(allpairs_world* world) {
  allpairs_neighbors found;
  for (uint32_t seed = 0; seed < 20; ++seed) {
    double box[6];
    checkFill(box, 1, seed);
    const allpairs_nearest wanted = {{box[0] + 0.5, box[1], -3}, seed * 10};
    const size_t expected = wanted.count < kBoxes ? wanted.count : kBoxes;
    ALLPAIRS_CHECK(allpairs_world_find_nearest(world, &wanted, NULL, &found) == ALLPAIRS_OK && found.count == expected);
    for (size_t k = 0; k < found.count; ++k) {
      const allpairs_neighbor neighbor = found.data[k];
      size_t before = 0;
      ALLPAIRS_CHECK(neighbor.distance == distanceFrom(wanted.point, &rows[(size_t)6 * neighbor.id]));
      for (uint32_t i = 0; i < kBoxes; ++i) {
        const double distance = distanceFrom(wanted.point, &rows[(size_t)6 * i]);
        before += distance < neighbor.distance || (distance == neighbor.distance && i < neighbor.id);
      }
      ALLPAIRS_CHECK(before == k);
    }
  }
}

static void twoWorldsMeet(allpairs_world* world, allpairs_world* other) {
  allpairs_pairs found;
  size_t next = 0;
  ALLPAIRS_CHECK(allpairs_world_find_between(world, other, &found) == ALLPAIRS_OK && found.count > 0);
  for (uint32_t i = 0; i < kBoxes; ++i) {
    for (uint32_t j = 0; j < kBoxes; ++j) {
      if (!checkMeet(&rows[(size_t)6 * i], &others[(size_t)6 * j], 0)) continue;
      ALLPAIRS_CHECK(next < found.count && found.data[next].first == i && found.data[next].second == j);
      ++next;
    }
  }
  ALLPAIRS_CHECK(next == found.count);
}

static void nonsenseIsRefused(allpairs_world* world) {
  const allpairs_ray ray = {{NAN, 0, 0}, {0, 0, 1}, 1};
  const allpairs_sweep sweep = {{0, 0, 0, 1, 1, 1}, {0, 0, 1}, -1};
  const allpairs_nearest nearest = {{INFINITY, 0, 0}, 1};
  allpairs_hits hits = {NULL, 7};
  allpairs_neighbors neighbors;
  allpairs_pairs pairs;
  ALLPAIRS_CHECK(allpairs_world_find_all(world, &ray, NULL, &hits) == ALLPAIRS_INVALID_ARGUMENT && hits.count == 7);
  ALLPAIRS_CHECK(allpairs_world_find_all(world, NULL, NULL, &hits) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_sweep_all(world, &sweep, NULL, &hits) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_sweep_first(world, &sweep, NULL, NULL) == ALLPAIRS_INVALID_ARGUMENT);
  const allpairs_sweep no_box = {{0, 0, 0, 1, NAN, 1}, {0, 0, 1}, 1};
  ALLPAIRS_CHECK(allpairs_world_sweep_all(world, &no_box, NULL, &hits) == ALLPAIRS_INVALID_BOX && hits.count == 7);
  ALLPAIRS_CHECK(allpairs_world_find_nearest(world, &nearest, NULL, &neighbors) == ALLPAIRS_INVALID_ARGUMENT);
  ALLPAIRS_CHECK(allpairs_world_find_between(world, NULL, &pairs) == ALLPAIRS_INVALID_ARGUMENT);
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(__clang__)
#include <malloc.h>

/// In bytes, what the process has from its allocator.
static size_t allocated(void) {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// A query of many boxes whose result is larger than all else that there is.
static void shrinkingReleasesResults(void) {
  enum { kMany = 200000 };
  const double everything[6] = {-INFINITY, -INFINITY, -INFINITY, INFINITY, INFINITY, INFINITY};
  static const double corner[3] = {0, 0, 0};
  const allpairs_corner_f64 same = {corner, 0, 1};
  const allpairs_nearest all = {{0, 0, 0}, kMany};
  uint32_t* ids = malloc(kMany * sizeof *ids);
  allpairs_world* world = NULL;
  allpairs_set* set = NULL;
  allpairs_ids found;
  allpairs_neighbors neighbors;
  ALLPAIRS_CHECK(ids != NULL && allpairs_world_create(NULL, &world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_set_create_strided_f64(kMany, same, same, &set) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_add(world, set, NULL, ids) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_world_shrink(world) == ALLPAIRS_OK);
  const size_t before = allocated();
  ALLPAIRS_CHECK(allpairs_world_find_overlapping(world, everything, NULL, &found) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(found.count == kMany);
  ALLPAIRS_CHECK(allpairs_world_find_nearest(world, &all, NULL, &neighbors) == ALLPAIRS_OK && neighbors.count == kMany);
  ALLPAIRS_CHECK(allpairs_world_shrink(world) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allocated() < before + kMany);
  allpairs_world_destroy(world);
  allpairs_set_destroy(set);
  free(ids);
}
#else
static void shrinkingReleasesResults(void) {}
#endif

static void aFilterOfDefaultsLeavesNothingOut(allpairs_world* world) {
  const double all[6] = {-99, -99, -99, 99, 99, 99};
  allpairs_query_filter filter = allpairs_default_query_filter();
  allpairs_ids ids;
  ALLPAIRS_CHECK(allpairs_world_find_overlapping(world, all, &filter, &ids) == ALLPAIRS_OK && ids.count == kBoxes);
  filter.skip_static = true;
  ALLPAIRS_CHECK(allpairs_world_find_overlapping(world, all, &filter, &ids) == ALLPAIRS_OK && ids.count == kBoxes);
  filter.skip_moving = true;
  ALLPAIRS_CHECK(allpairs_world_find_overlapping(world, all, &filter, &ids) == ALLPAIRS_OK && ids.count == 0);
}

static void aRayMayHaveNoEnd(allpairs_world* world) {
  const allpairs_ray endless = {{6, 6, -1e9}, {0, 0, 1}, INFINITY};
  const allpairs_ray nowhere = {{6, 6, -1e9}, {0, 0, 1}, 0};
  allpairs_hits hits;
  size_t above = 0;
  for (size_t i = 0; i < kBoxes; ++i) {
    const double* box = &rows[6 * i];
    above += box[0] <= 6 && 6 <= box[3] && box[1] <= 6 && 6 <= box[4];
  }
  ALLPAIRS_CHECK(allpairs_world_find_all(world, &endless, NULL, &hits) == ALLPAIRS_OK && hits.count == above);
  ALLPAIRS_CHECK(above > 0 && allpairs_world_find_all(world, &nowhere, NULL, &hits) == ALLPAIRS_OK && hits.count == 0);
}

int main(void) {
  checkFill(rows, kBoxes, 3);
  checkFill(others, kBoxes, 4);
  allpairs_world* world = worldOf(rows);
  allpairs_world* other = worldOf(others);
  ALLPAIRS_CHECK(raysAndSweepsMeetWhatIsInTheirWay(world) > 100);
  theNearestComeFirst(world);
  twoWorldsMeet(world, other);
  nonsenseIsRefused(world);
  aFilterOfDefaultsLeavesNothingOut(world);
  aRayMayHaveNoEnd(world);
  allpairs_world_destroy(world);
  allpairs_world_destroy(other);
  shrinkingReleasesResults();
  return EXIT_SUCCESS;
}
