// SPDX-License-Identifier: MIT
//
// 1,000 copies of a small robot, each in a world of its own, walk over the same floor with a step. Each step of the
// simulation finds all pairs of all worlds in two calls: the parts of each robot with each other, and with the floor.
#include <allpairs/Worlds.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <vector>

namespace {

constexpr std::size_t kRobots = 1000;
constexpr std::size_t kSteps = 20;

/// A body, and four legs of two parts: 2 * leg + 1 is an upper part, 2 * leg + 2 a lower one.
constexpr std::size_t kParts = 9;

allpairs::BoxF boxAround(float x, float y, float z, float half) {
  return {{x - half, y - half, z - half}, {x + half, y + half, z + half}};
}

/// The parts of a robot some time after it has begun to walk; each walks a little faster than the one before.
void place(std::size_t robot, std::size_t step, allpairs::BoxF* parts) {
  const float speed = 0.5F + 0.001F * static_cast<float>(robot);
  const float x = 0.1F * speed * static_cast<float>(step);
  parts[0] = boxAround(x, 0.0F, 1.0F, 0.3F);
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const float side = leg % 2 == 0 ? 0.35F : -0.35F;
    const float beat = std::fmod(2.0F * speed * static_cast<float>(step) + (leg == 0 || leg == 3 ? 0.0F : 2.0F), 4.0F);
    const float swing = 0.3F * (1.0F - std::abs(beat - 2.0F));
    const float front = leg < 2 ? 0.4F : -0.4F;
    parts[2 * leg + 1] = boxAround(x + front + swing / 2, side, 0.6F, 0.15F);
    parts[2 * leg + 2] = boxAround(x + front + swing, side, 0.2F + std::abs(swing) / 2, 0.2F);
  }
}

}  // namespace

int main() {
  std::vector<allpairs::BoxF> boxes(kRobots * kParts);

  // Parts that a joint connects always touch: written once for all robots.
  std::vector<allpairs::Pair> joints;
  for (std::uint32_t leg = 0; leg < 4; ++leg) {
    joints.push_back({0, 2 * leg + 1});
    joints.push_back({2 * leg + 1, 2 * leg + 2});
  }

  // In every world; the step begins at x = 1.5.
  const std::array<allpairs::BoxF, 2> floor{{{{-9, -9, -1}, {9, 9, 0}}, {{1.5F, -9, 0}, {9, 9, 0.1F}}}};

  allpairs::WorldsSearch among;  // keep their memory from step to step
  allpairs::WorldsSearch withFloor;
  std::size_t collisions = 0;
  std::size_t contacts = 0;
  std::size_t arrived = 0;
  for (std::size_t step = 0; step < kSteps; ++step) {
    for (std::size_t robot = 0; robot < kRobots; ++robot) place(robot, step, &boxes[robot * kParts]);
    auto robots = allpairs::Worlds::ofEqualSize(boxes, kRobots);  // boxes that have changed are checked again
    robots.setIgnoredPairs(joints);
    collisions += among.find(robots).pairs.size();
    const allpairs::WorldPairsView feet = withFloor.find(robots, floor);
    contacts += feet.pairs.size();
    arrived = 0;
    for (std::size_t robot = 0; robot < kRobots; ++robot) {
      bool isOnStep = false;
      for (const auto& [part, ground] : feet[robot]) isOnStep = isOnStep || ground == 1;
      arrived += isOnStep ? 1U : 0U;
    }
  }
  std::cout << kRobots << " robots, " << kSteps << " steps: " << collisions << " collisions of a robot with itself, "
            << contacts << " contacts with the floor; " << arrived << " have reached the step\n";
}
