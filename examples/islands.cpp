// SPDX-License-Identifier: MIT
//
// Which boxes hang together? Rows of neighbors are a graph: a walk along them finds its connected parts, the islands
// that a solver can treat one by one.
#include <allpairs/Neighbors.h>

#include <cstddef>
#include <cstdint>
#include <iostream>
#include <vector>

namespace {

/// The boxes that can be reached from one, which is not yet seen, in the order of the walk.
std::vector<std::uint32_t> islandOf(std::uint32_t box, const allpairs::Neighbors& rows, std::vector<bool>& seen) {
  std::vector<std::uint32_t> island{box};
  seen[box] = true;
  for (std::size_t i = 0; i < island.size(); ++i) {
    for (const std::uint32_t partner : rows[island[i]]) {
      if (!seen[partner]) island.push_back(partner);
      seen[partner] = true;
    }
  }
  return island;
}

}  // namespace

int main() {
  const std::vector<allpairs::Box> boxes{{{0, 0, 0}, {2, 2, 2}}, {{8, 0, 0}, {9, 1, 1}}, {{3, 0, 0}, {5, 2, 2}},
                                         {{9, 1, 1}, {9, 2, 2}}, {{1, 1, 1}, {4, 3, 3}}, {{6, 6, 6}, {7, 7, 7}}};
  const allpairs::Neighbors rows = allpairs::neighbors(boxes);
  std::vector<bool> seen(boxes.size());
  for (std::uint32_t box = 0; box < boxes.size(); ++box) {
    if (seen[box]) continue;
    std::cout << "island:";
    for (const std::uint32_t member : islandOf(box, rows, seen)) std::cout << ' ' << member;
    std::cout << '\n';
  }
}
