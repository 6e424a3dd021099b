// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/fcl/FclNarrowPhase.h"

namespace allpairs::test {

inline constexpr double kClose = 1e-12;  // to two numbers that differ in rounding alone

/// What the narrow phase says of these two models.
inline ExactPair examine(collision::CollisionModel& first, collision::CollisionModel& second,
                         const ExactOptions& options = {}) {
  FclNarrowPhase phase(options);
  phase.beginNarrowPhase();
  phase.addCollisionPair({&first, &second});
  phase.endNarrowPhase();
  return phase.pairs().front();
}

}  // namespace allpairs::test
