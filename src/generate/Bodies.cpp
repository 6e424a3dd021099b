// SPDX-License-Identifier: MIT
#include "Bodies.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "Arithmetic.h"

namespace allpairs::generate {
namespace {

constexpr double kFilled = 0.1;     // of the unit cube, by all bodies together
constexpr double kGravity = 2e-5;   // lengths a frame, a frame: through the unit cube in about 300 frames
constexpr double kRebound = 0.3;    // of the speed at which a body meets a wall
constexpr double kDamping = 0.995;  // a frame, so that tumbling bodies don't gain speed for ever

/// Keeps one coordinate of a body in its room; what hits the wall comes back slower, and at last rests there.
void keepInRoom(Bodies& bodies, std::size_t i) {
  double& position = bodies.position[i];
  double& velocity = bodies.velocity[i];
  const double wall = position < bodies.low[i] ? bodies.low[i] : bodies.high[i];
  if (position >= bodies.low[i] && position <= bodies.high[i]) return;
  position = wall;
  const bool isSlow = velocity < 4.0 * kGravity && velocity > -4.0 * kGravity;
  velocity = isSlow ? 0.0 : -kRebound * velocity;
}

/// The column of the floor, one side wide, that a body stands on.
std::size_t columnOf(const Bodies& bodies, std::size_t body, std::size_t columns) {
  const auto along = [&](std::size_t axis) {
    const double place = bodies.position[3 * body + axis] / (1.0 - bodies.side);
    return std::min(columns - 1, static_cast<std::size_t>(place * static_cast<double>(columns)));
  };
  return along(1) * columns + along(0);
}

}  // namespace

Bodies spreadBodies(std::size_t count, std::uint64_t seed) {
  Bodies bodies;
  bodies.side = cubeRoot(kFilled / static_cast<double>(std::max<std::size_t>(count, 1)));
  bodies.velocity.assign(3 * count, 0.0);
  bodies.low.assign(3 * count, 0.0);
  bodies.high.assign(3 * count, 1.0 - bodies.side);
  bodies.random.reserve(count);
  bodies.position.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    Random& random = bodies.random.emplace_back(seed, i);
    for (int axis = 0; axis < 3; ++axis) bodies.position.push_back(random.between(0.0, 1.0 - bodies.side));
  }
  return bodies;
}

void beginNothing(Bodies& /*bodies*/) {}

/// Bodies of one column come to rest on each other, the lowest first.
void beginFall(Bodies& bodies) {
  const std::size_t columns = std::max<std::size_t>(1, static_cast<std::size_t>(1.0 / bodies.side));
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double heightA = bodies.position[3 * a + 2];
    const double heightB = bodies.position[3 * b + 2];
    return heightA != heightB ? heightA < heightB : a < b;
  });
  std::vector<double> tops(columns * columns, 0.0);
  for (const std::size_t body : order) {
    double& top = tops[columnOf(bodies, body, columns)];
    bodies.low[3 * body + 2] = std::min(top, bodies.high[3 * body + 2]);
    top += bodies.side;
  }
}

/// Each body stops at a distance of its own from a wall, so that all of them make a pile and no layer: thick enough
/// that they fit into an edge of the cube, where gravity drives them between two walls.
void beginTumbling(Bodies& bodies) {
  constexpr double kPile = 0.35;
  for (std::size_t i = 0; i < bodies.position.size(); ++i) {
    const double place = bodies.random[i / 3].unit();
    bodies.low[i] = kPile * place * (1.0 - bodies.side);
    bodies.high[i] = (1.0 - kPile * (1.0 - place)) * (1.0 - bodies.side);
  }
}

void stepBrownian(Bodies& bodies) {
  const double longest = 0.2 * bodies.side;  // a tenth of the side on average
  for (std::size_t i = 0; i < bodies.position.size(); ++i) {
    const double moved = bodies.position[i] + bodies.random[i / 3].between(-longest, longest);
    const double reflected = moved < 0.0 ? -moved : moved;
    bodies.position[i] = reflected > bodies.high[i] ? 2.0 * bodies.high[i] - reflected : reflected;
  }
}

void stepFall(Bodies& bodies) {
  for (std::size_t i = 2; i < bodies.position.size(); i += 3) {
    bodies.velocity[i] -= kGravity;
    bodies.position[i] += bodies.velocity[i];
    keepInRoom(bodies, i);
  }
}

void stepTumbling(Bodies& bodies) {
  constexpr double kFramesPerTurn = 500.0;
  const auto [cosine, sine] = cosineAndSine(static_cast<double>(bodies.frame) / kFramesPerTurn);
  const std::array<double, 3> gravity{-sine * kGravity, 0.0, -cosine * kGravity};
  for (std::size_t i = 0; i < bodies.position.size(); ++i) {
    bodies.velocity[i] = kDamping * (bodies.velocity[i] + gravity[i % 3]);
    bodies.position[i] += bodies.velocity[i];
    keepInRoom(bodies, i);
  }
}

}  // namespace allpairs::generate
