// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "WorldOracle.h"
#include "allpairs/World.h"
#include "support/Boxes.h"

namespace allpairs::test {

/// A step of both gives the same lists.
inline void compareStep(World& world, WorldOracle& oracle) {
  const StepResult found = world.step();
  oracle.step();
  ASSERT_EQ(toVector(found.pairs), oracle.pairs);
  ASSERT_EQ(toVector(found.began), oracle.began);
  ASSERT_EQ(toVector(found.persisted), oracle.persisted);
  ASSERT_EQ(toVector(found.ended), oracle.ended);
}

}  // namespace allpairs::test
