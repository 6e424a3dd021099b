// SPDX-License-Identifier: MIT
#pragma once

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "allpairs.h"

/// Ends the test unless the condition holds.
#define ALLPAIRS_CHECK(condition)                                                                    \
  do {                                                                                               \
    if (!(condition)) {                                                                              \
      fprintf(stderr, "%s:%d: %s (%s)\n", __FILE__, __LINE__, #condition, allpairs_error_message()); \
      exit(EXIT_FAILURE);                                                                            \
    }                                                                                                \
  } while (0)

/// Whether the message of the last failure has the text.
static inline bool checkSays(const char* text) { return strstr(allpairs_error_message(), text) != NULL; }

/// The next of a fixed sequence of numbers from 0 to limit - 1 (constants of Numerical Recipes, section 7.1).
static inline uint32_t checkRandom(uint32_t* state, uint32_t limit) {
  *state = 1664525U * *state + 1013904223U;
  return (*state >> 8U) % limit;
}

/// Boxes on a coarse grid, many of which touch.
static inline void checkFill(double* rows, size_t count, uint32_t seed) {
  for (size_t i = 0; i < count; ++i) {
    for (size_t axis = 0; axis < 3; ++axis) {
      rows[6 * i + axis] = checkRandom(&seed, 12);
      rows[6 * i + axis + 3] = rows[6 * i + axis] + checkRandom(&seed, 4);
    }
  }
}

/// The oracle's test of two boxes.
static inline bool checkMeet(const double* a, const double* b, double distance) {
  for (size_t axis = 0; axis < 3; ++axis) {
    if (a[axis] > b[axis + 3] + distance || b[axis] > a[axis + 3] + distance) return false;
  }
  return true;
}
