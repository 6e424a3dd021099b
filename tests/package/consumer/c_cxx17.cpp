// SPDX-License-Identifier: MIT
#include <allpairs.h>

#include <cstdlib>
#include <vector>

#include "DoubleLoop.h"

static_assert(__cplusplus == 201703L, "what is linked asks for another standard");

int main() {
  const std::vector<Row> rows = someRows(1000, 1);
  allpairs_set* set = nullptr;
  allpairs_search* search = nullptr;
  allpairs_pairs found = {};
  if (allpairs_set_create_f32(rows.front().data(), rows.size(), &set) != 0 ||
      allpairs_search_create(nullptr, &search) != 0 || allpairs_find(search, set, &found) != 0) {
    return EXIT_FAILURE;
  }
  Pairs pairs;
  for (std::size_t i = 0; i < found.count; ++i) pairs.emplace_back(found.data[i].first, found.data[i].second);
  allpairs_search_destroy(search);
  allpairs_set_destroy(set);
  return pairs == byDoubleLoop(rows) ? EXIT_SUCCESS : EXIT_FAILURE;
}
