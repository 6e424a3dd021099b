// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "Random.h"

namespace allpairs::generate {

/// Equal cubes within the unit cube, by their min corners. Each has a room of its own, in which it stays.
struct Bodies {
  double side = 0.0;
  std::size_t frame = 0;
  std::vector<double> position;  ///< Rows of 3, as are the rest.
  std::vector<double> velocity;  ///< In lengths a frame.
  std::vector<double> low;
  std::vector<double> high;
  std::vector<Random> random;  ///< For each body.

  [[nodiscard]] std::size_t size() const noexcept { return random.size(); }
};

/// Bodies spread evenly over the unit cube, at rest, each with all of it for a room.
[[nodiscard]] Bodies spreadBodies(std::size_t count, std::uint64_t seed);

// For each motion what it needs to begin with, and a step of it.
void beginNothing(Bodies& bodies);
void beginFall(Bodies& bodies);
void beginTumbling(Bodies& bodies);
void stepBrownian(Bodies& bodies);
void stepFall(Bodies& bodies);
void stepTumbling(Bodies& bodies);

}  // namespace allpairs::generate
