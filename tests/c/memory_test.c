// SPDX-License-Identifier: MIT
// What the library can't allocate is a status, on the calling thread and on others: no exception leaves it.
#define _POSIX_C_SOURCE 200809L
#include <string.h>
#include <sys/resource.h>

#include "Check.h"

// Sanitizers need the address space. GCC says so by macros, Clang by what it has.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define IS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define IS_SANITIZED 1
#endif
#endif
#ifndef IS_SANITIZED
#define IS_SANITIZED 0
#endif

enum { kBoxes = 20000 };  // in one place they have 200 million pairs, which is 1.6 GB

static const rlim_t kMost = (rlim_t)640 << 20U;  // bytes of address space, stacks of threads included

static void tooManyPairsAreAStatus(const allpairs_set* boxes, const allpairs_set* few, size_t threads) {
  allpairs_search* search = NULL;
  allpairs_pairs pairs = {NULL, 7};
  allpairs_options options = allpairs_default_options();
  options.threads = threads;
  ALLPAIRS_CHECK(allpairs_search_create(&options, &search) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_find(search, boxes, &pairs) == ALLPAIRS_OUT_OF_MEMORY);
  ALLPAIRS_CHECK(pairs.data == NULL && pairs.count == 7 && strlen(allpairs_error_message()) > 0);
  ALLPAIRS_CHECK(allpairs_find(search, few, &pairs) == ALLPAIRS_OK && pairs.count == 3);
  allpairs_search_destroy(search);
}

int main(void) {
  if (IS_SANITIZED) {
    puts("skipped: a sanitizer needs the address space");
    return EXIT_SUCCESS;
  }
  const double corner[3] = {0, 0, 0};
  const allpairs_corner_f64 all = {corner, 0, 1};
  const struct rlimit limit = {kMost, kMost};
  allpairs_set* boxes = NULL;
  allpairs_set* few = NULL;
  ALLPAIRS_CHECK(allpairs_set_create_strided_f64(kBoxes, all, all, &boxes) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(allpairs_set_create_strided_f64(3, all, all, &few) == ALLPAIRS_OK);
  ALLPAIRS_CHECK(setrlimit(RLIMIT_AS, &limit) == 0);
  tooManyPairsAreAStatus(boxes, few, 1);
  tooManyPairsAreAStatus(boxes, few, 2);
  allpairs_set_destroy(boxes);
  allpairs_set_destroy(few);
  return EXIT_SUCCESS;
}
