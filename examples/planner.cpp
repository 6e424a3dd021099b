// SPDX-License-Identifier: MIT
//
// A robot among obstacles, as a motion planner asks: which parts collide in a pose, and is the way to the next pose
// free? The obstacles are static, so that they are in no pair with each other; links that a joint connects are left out
// by `accept`.
#include <allpairs/World.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <vector>

namespace {

constexpr std::size_t kLinks = 5;

/// The boxes of an arm in the plane z = 0, whose links are one long and each turned by `bend` against the one before.
std::array<allpairs::Box, kLinks> armAt(double bend) {
  std::array<allpairs::Box, kLinks> links;
  std::array<double, 2> at{0.0, 0.0};
  for (std::size_t i = 0; i < kLinks; ++i) {
    const double angle = bend * static_cast<double>(i + 1);
    const std::array<double, 2> end{at[0] + std::cos(angle), at[1] + std::sin(angle)};
    links[i] = {{std::min(at[0], end[0]) - 0.05, std::min(at[1], end[1]) - 0.05, -0.05},
                {std::max(at[0], end[0]) + 0.05, std::max(at[1], end[1]) + 0.05, 0.05}};
    at = end;
  }
  return links;
}

}  // namespace

int main() {
  allpairs::WorldOptions options;
  options.accept = [](allpairs::BoxId a, allpairs::BoxId b) { return b >= kLinks || b - a > 1; };  // a < b
  allpairs::World world(options);
  const auto arm = armAt(0.1);
  const std::vector<allpairs::BoxId> links = world.add(arm);  // ids 0 to 4
  allpairs::BoxProperties obstacle;
  obstacle.isStatic = true;
  static_cast<void>(world.add(allpairs::Box{{3.0, 3.0, -1.0}, {4.0, 4.0, 1.0}}, obstacle));    // id 5
  static_cast<void>(world.add(allpairs::Box{{-1.5, 1.0, -1.0}, {-1.0, 1.5, 1.0}}, obstacle));  // id 6

  // Poses: all pairs of two links, and of a link and an obstacle.
  for (const double bend : {0.1, 1.2, 1.5}) {
    const auto pose = armAt(bend);
    world.move(links, pose);
    std::cout << "bent by " << bend << ':';
    for (const allpairs::Pair pair : world.step().pairs) std::cout << " (" << pair.first << ", " << pair.second << ')';
    std::cout << '\n';
  }

  // The way of each link along y, against the obstacles only. Queries are const: any number of threads may ask at once.
  allpairs::QueryFilter obstacles;
  obstacles.dynamicBoxes = false;
  for (std::size_t i = 0; i < kLinks; ++i) {
    const allpairs::SweepHit hit = world.findFirst(allpairs::BoxSweep{arm[i], {0.0, 5.0, 0.0}}, obstacles);
    if (hit.id == allpairs::kNoBox) continue;
    std::cout << "link " << i << " hits box " << hit.id << " after " << hit.t << " of its way\n";
  }
}
