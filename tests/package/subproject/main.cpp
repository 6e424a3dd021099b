// SPDX-License-Identifier: MIT
#include <allpairs/Overlaps.h>

#include <vector>

int main() {
  const std::vector<allpairs::Box> boxes{{{0, 0, 0}, {2, 2, 2}}, {{2, 2, 2}, {3, 3, 3}}, {{5, 5, 5}, {6, 6, 6}}};
  const std::vector<allpairs::Pair> pairs = allpairs::overlaps(boxes);
  return pairs.size() == 1 && pairs[0] == allpairs::Pair{0, 1} ? 0 : 1;
}
