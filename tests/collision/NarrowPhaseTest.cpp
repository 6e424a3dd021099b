// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "SceneWorld.h"
#include "allpairs/Error.h"
#include "allpairs/collision/NarrowPhaseDetection.h"
#include "support/Oracle.h"

namespace allpairs::test {
namespace {

using namespace collision;

std::vector<IndexPair> elementsOf(const ElementNarrowPhase& phase) {
  std::vector<IndexPair> result;
  for (const CollisionElementPair& pair : phase.getElementPairs())
    result.emplace_back(pair.first.index, pair.second.index);
  return result;
}

class NarrowPhase : public ::testing::Test {
 protected:
  NarrowPhase() {
    m_method.setAlarmDistance(0.0);
    m_phase.setIntersectionMethod(&m_method);
    m_phase.beginNarrowPhase();
  }

  MinProximityIntersection m_method;
  ElementNarrowPhase m_phase;
  BoxModel m_first{"first", std::vector<Box>{cube(0, 0, 0), cube(2, 0, 0), cube(4, 0, 0)}};
  BoxModel m_second{"second", std::vector<Box>{cube(5, 0, 0), cube(0.5, 0.5, 0)}};
};

TEST_F(NarrowPhase, ElementsThatTouchArePairsByFirstThenSecond) {
  m_phase.addCollisionPair({&m_first, &m_second});
  EXPECT_EQ(elementsOf(m_phase), (std::vector<IndexPair>{{0, 1}, {2, 0}}));
  EXPECT_EQ(m_phase.getElementPairs()[0].first.model, &m_first);
  EXPECT_EQ(m_phase.getElementPairs()[0].second.model, &m_second);
}

TEST_F(NarrowPhase, TheDistanceIsTheMethods) {
  m_method.setAlarmDistance(0.25);
  m_first.setContactDistance(0.25);
  m_phase.addCollisionPair({&m_second, &m_first});
  EXPECT_EQ(elementsOf(m_phase), (std::vector<IndexPair>{{0, 2}, {1, 0}, {1, 1}}));
}

TEST_F(NarrowPhase, ElementsHaveContactDistancesWhetherTheRootsHaveThemOrNot) {
  m_first.setContactDistance(0.5);
  m_first.computeBoundingTree(2);
  m_second.computeBoundingTree();
  m_phase.addCollisionPair({m_second.getFirst(), m_first.getFirst()});
  const std::vector<IndexPair> pairs = elementsOf(m_phase);
  EXPECT_EQ(pairs, (std::vector<IndexPair>{{0, 2}, {1, 0}, {1, 1}}));
  m_method.setContactDistanceInBroadPhase(false);
  m_phase.beginNarrowPhase();
  m_phase.addCollisionPair({m_second.getFirst(), m_first.getFirst()});
  EXPECT_EQ(elementsOf(m_phase), pairs);
  EXPECT_EQ(m_method.distanceBetween(*m_first.getFirst(), *m_second.getFirst()), 0.0);
  EXPECT_EQ(m_method.distanceBetween(*m_first.getPrevious(), *m_second.getPrevious()), 0.0) << "boxes above elements";
  EXPECT_EQ(m_method.distanceBetween(m_first, m_second), 0.5);
}

TEST_F(NarrowPhase, AModelWithItselfGivesEachPairOfElementsOnce) {
  const std::vector<Box> boxes = toDouble(randomBoxes(60, 21));
  BoxModel model("self", boxes);
  model.computeBoundingTree();
  m_phase.addCollisionPair({model.getFirst(), model.getFirst()});
  std::vector<IndexPair> expected;
  for (const Pair& pair : oracle(boxes)) expected.emplace_back(pair.first, pair.second);
  EXPECT_EQ(elementsOf(m_phase), expected);
  EXPECT_FALSE(expected.empty());
}

TEST_F(NarrowPhase, AnIntersectorForTheTwoTypesIsAskedAndMaySwap) {
  m_method.add<UserModel, BoxModel>(std::make_shared<OddIntersector>());
  UserModel user(cube(0.75, 0, 0));
  m_phase.addCollisionPair({&m_first, &user});
  EXPECT_EQ(elementsOf(m_phase), std::vector<IndexPair>{}) << "the user's box doesn't begin before the other";
  UserModel before(cube(-0.5, 0, 0));
  m_phase.addCollisionPair({&m_first, &before});
  ASSERT_EQ(elementsOf(m_phase), (std::vector<IndexPair>{{0, 0}}));
  EXPECT_EQ(m_phase.getElementPairs()[0].first.model, &before);
}

TEST_F(NarrowPhase, AContinuousMethodLooksAtTheWholeStep) {
  UserModel still(cube(10, 0, 0));
  m_first.setVelocities({{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {5.0, 0.0, 0.0}});
  m_phase.setTimeStep(1.0);
  m_phase.addCollisionPair({&m_first, &still});
  EXPECT_EQ(elementsOf(m_phase), std::vector<IndexPair>{});
  m_method.setContinuous(true);
  m_phase.addCollisionPair({&m_first, &still});
  EXPECT_EQ(elementsOf(m_phase), (std::vector<IndexPair>{{2, 0}}));
}

TEST_F(NarrowPhase, WhatItCannotUseIsRefused) {
  ElementNarrowPhase withoutMethod;
  EXPECT_THROW(withoutMethod.addCollisionPair({&m_first, &m_second}), InvalidArgument);
  EXPECT_THROW(m_phase.addCollisionPair({&m_first, nullptr}), InvalidArgument);
  EXPECT_THROW(m_phase.addCollisionPair({nullptr, &m_second}), InvalidArgument);
  EXPECT_THROW(m_phase.setTimeStep(std::numeric_limits<double>::infinity()), InvalidArgument);
  UserModel broken({{0.0, 0.0, 0.0}, {1.0, std::numeric_limits<double>::quiet_NaN(), 1.0}});
  EXPECT_THROW(m_phase.addCollisionPair({&m_first, &broken}), InvalidBox);
}

/// Throws when it is asked about its second pair.
class ThrowingIntersector : public BoxIntersector {
 public:
  bool canIntersect(const CollisionElement& /*a*/, const CollisionElement& /*b*/,
                    const Intersection& /*method*/) const override {
    if (m_asked++ == 1) throw Error("an intersector's own");
    return true;
  }

 private:
  mutable int m_asked = 0;
};

TEST_F(NarrowPhase, APairOfModelsThatThrowsLeavesNoneOfItsElements) {
  m_method.add<BoxModel, BoxModel>(std::make_shared<ThrowingIntersector>());
  EXPECT_THROW(m_phase.addCollisionPair({&m_first, &m_second}), Error);
  EXPECT_TRUE(m_phase.getElementPairs().empty());
  m_phase.addCollisionPair({&m_first, &m_second});
  EXPECT_EQ(elementsOf(m_phase), (std::vector<IndexPair>{{0, 1}, {2, 0}}));
}

}  // namespace
}  // namespace allpairs::test
