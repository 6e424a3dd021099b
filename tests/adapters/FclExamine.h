// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/fcl/FclNarrowPhase.h"

namespace allpairs::test {

inline constexpr double kClose = 1e-12;  // to two numbers that differ in rounding alone

inline double dot(const collision::Vec3& a, const collision::Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline collision::Vec3 plus(const collision::Vec3& a, const collision::Vec3& b, double scale = 1.0) {
  return {a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]};
}

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
