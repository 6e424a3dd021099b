// SPDX-License-Identifier: MIT
#include <allpairs/Overlaps.h>

#include <cstdlib>
#include <vector>

int main() {
  const std::vector<allpairs::Box> boxes{{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}, {{3, 3, 3}, {4, 4, 4}}};
  const std::vector<allpairs::Pair> expected{{0, 1}};
  return allpairs::overlaps(boxes) == expected ? EXIT_SUCCESS : EXIT_FAILURE;
}
