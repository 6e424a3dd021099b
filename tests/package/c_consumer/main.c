// SPDX-License-Identifier: MIT
#include <allpairs.h>
#include <stdlib.h>

int main(void) {
  const float rows[12] = {0, 0, 0, 1, 1, 1, 1, 1, 1, 2, 2, 2};
  allpairs_set* set = NULL;
  allpairs_search* search = NULL;
  uint64_t count = 0;
  if (allpairs_set_create_f32(rows, 2, &set) || allpairs_search_create(NULL, &search)) return EXIT_FAILURE;
  if (allpairs_count(search, set, &count)) return EXIT_FAILURE;
  allpairs_search_destroy(search);
  allpairs_set_destroy(set);
  return count == 1 ? EXIT_SUCCESS : EXIT_FAILURE;
}
