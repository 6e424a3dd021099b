// SPDX-License-Identifier: MIT
//
// Which of these boxes overlap?
#include <allpairs/Overlaps.h>

#include <iostream>
#include <vector>

int main() {
  const std::vector<allpairs::Box> boxes{
      {{0, 0, 0}, {2, 2, 2}},  // box 0
      {{1, 1, 1}, {3, 3, 3}},  // box 1 reaches into box 0
      {{3, 3, 3}, {4, 4, 4}},  // box 2 shares a corner with box 1: that counts
      {{9, 9, 9}, {9, 9, 9}},  // box 3 is a point, far away
  };
  for (const auto& [first, second] : allpairs::overlaps(boxes)) std::cout << first << " and " << second << '\n';
}
