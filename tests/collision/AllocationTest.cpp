// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>

#include "Fixture.h"
#include "support/AllocationCount.h"
#include "support/Strategies.h"

namespace allpairs::test {
namespace {

using collision::BruteForceBroadPhase;

class AllocationTest : public BroadPhaseTest {
 protected:
  void addRandom(std::size_t count) {
    std::size_t number = 0;
    for (const Box& box : toDouble(randomBoxes(count, 3))) {
      collision::BoxModel& model = add(box);
      if (number % 3 == 0) model.setGroups({static_cast<int>(number % 7)});
      if (number % 4 == 0) model.setContactDistance(0.01);
      model.setSelfCollision(number++ % 5 == 0);
    }
  }

  template <class Step>
  static std::size_t allocationsOf(const Step& step) {
    for (int i = 0; i < 8; ++i) step();  // a kept search comes after a few steps, and its buffers grow in a few more
    const std::size_t before = allocationCount();
    step();
    return allocationCount() - before;
  }
};

class ComponentAllocation : public AllocationTest, public ::testing::WithParamInterface<Strategy> {};

INSTANTIATE_TEST_SUITE_P(EachStrategy, ComponentAllocation, ::testing::ValuesIn(kStrategies));

TEST_P(ComponentAllocation, ASecondStepLikeTheFirstAllocatesNothing) {
  addRandom(1200);
  BruteForceBroadPhase phase;
  phase.setIntersectionMethod(&m_method);
  phase.setBox({-1.0, -1.0, -1.0}, {1e3, 1e3, 1e3});
  phase.init();
  phase.setStrategy(GetParam());
  EXPECT_EQ(allocationsOf([&] {
              phase.beginBroadPhase();
              phase.addCollisionModels(m_models);
              phase.endBroadPhase();
            }),
            0U);
  EXPECT_FALSE(phase.getCollisionModelPairs().empty());
}

TEST_P(ComponentAllocation, ReadingAfterEachAdditionAllocatesNothingTheSecondTime) {
  addRandom(150);
  BruteForceBroadPhase phase;
  phase.setIntersectionMethod(&m_method);
  phase.setStrategy(GetParam());
  EXPECT_EQ(allocationsOf([&] {
              phase.beginBroadPhase();
              for (collision::CollisionModel* model : m_models) {
                phase.addCollisionModel(model);
                static_cast<void>(phase.getCollisionModelPairs());
              }
            }),
            0U);
}

TEST_F(AllocationTest, ASecondBoundingTreeAllocatesNothing) {
  std::vector<Box> boxes = toDouble(randomBoxes(500, 5));
  collision::BoxModel model("many", boxes);
  EXPECT_EQ(allocationsOf([&] { model.computeBoundingTree(); }), 0U);
  EXPECT_EQ(allocationsOf([&] { model.computeContinuousBoundingTree(0.1, 5); }), 0U);
}

}  // namespace
}  // namespace allpairs::test
