// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "WorldOracle.h"
#include "allpairs/World.h"
#include "support/Boxes.h"

namespace allpairs::test {

/// Two steps gave the same lists.
template <class Found, class Expected>
void compareLists(const Found& found, const Expected& expected) {
  ASSERT_EQ(toVector(found.pairs), toVector(expected.pairs));
  ASSERT_EQ(toVector(found.began), toVector(expected.began));
  ASSERT_EQ(toVector(found.persisted), toVector(expected.persisted));
  ASSERT_EQ(toVector(found.ended), toVector(expected.ended));
}

/// A step of both gives the same lists.
inline void compareStep(World& world, WorldOracle& oracle) {
  const StepResult found = world.step();
  oracle.step();
  compareLists(found, oracle);
}

}  // namespace allpairs::test
