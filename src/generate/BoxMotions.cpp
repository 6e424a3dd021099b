// SPDX-License-Identifier: MIT
#include "allpairs/generate/BoxMotions.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "Bodies.h"
#include "allpairs/Error.h"

namespace allpairs::generate {
namespace {

constexpr std::array<BoxMotion, 3> kMotions{{
    {"brownian", "each box moves at random, about a tenth of its side on each axis and frame"},
    {"free-fall", "boxes fall, rebound and settle on each other"},
    {"rotating-gravity", "boxes fall to and fro, since gravity turns once in 500 frames"},
}};

/// How a motion begins, and its step.
struct Moves {
  void (*begin)(Bodies&);
  void (*step)(Bodies&);
};

constexpr std::array<Moves, kMotions.size()> kMoves{{
    {beginNothing, stepBrownian},
    {beginFall, stepFall},
    {beginTumbling, stepTumbling},
}};

const Moves& movesOf(std::string_view name) {
  const auto* const motion =
      std::find_if(kMotions.begin(), kMotions.end(), [&](const BoxMotion& m) { return m.name == name; });
  if (motion != kMotions.end()) return kMoves[static_cast<std::size_t>(motion - kMotions.begin())];
  std::string message = std::string("unknown motion '").append(name).append("'; there are");
  for (const BoxMotion& known : kMotions) message.append(" ").append(known.name);
  throw InvalidArgument(message);
}

}  // namespace

struct MotionFrames::State {
  const Moves* moves = nullptr;
  Bodies bodies;
  std::vector<float> rows;
};

Span<const BoxMotion> boxMotions() noexcept { return kMotions; }

MotionFrames::MotionFrames(const MotionRequest& request) : m_state(std::make_unique<State>()) {
  m_state->moves = &movesOf(request.motion);
  if (request.count > std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidArgument("a motion of " + std::to_string(request.count) + " boxes is more than 2^32 - 1");
  }
  m_state->bodies = spreadBodies(request.count, request.seed);
  m_state->moves->begin(m_state->bodies);
  m_state->rows.resize(6 * request.count);
}

MotionFrames::~MotionFrames() = default;
MotionFrames::MotionFrames(MotionFrames&&) noexcept = default;
MotionFrames& MotionFrames::operator=(MotionFrames&&) noexcept = default;

Span<const float> MotionFrames::next() {
  Bodies& bodies = m_state->bodies;
  if (bodies.frame != 0) m_state->moves->step(bodies);
  ++bodies.frame;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double min = bodies.position[3 * i + axis];
      m_state->rows[6 * i + axis] = static_cast<float>(min);
      m_state->rows[6 * i + axis + 3] = static_cast<float>(min + bodies.side);
    }
  }
  return m_state->rows;
}

}  // namespace allpairs::generate
