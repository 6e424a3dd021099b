// SPDX-License-Identifier: MIT
// The pairs that the plugin's component finds, case by case.
#include <limits>

#include "World.h"

namespace allpairs::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A model that lets nobody of an even name collide with it.
class Picky : public sofa::core::CollisionModel {
 public:
  bool canCollideWith(sofa::core::CollisionModel* other) override {
    return (other->getPathName().back() - '0') % 2 != 0;
  }
};

/// A method of SOFA's, changed by a subclass: it finds near whatever is not further than 10 on x.
class WiderProximity : public intersection::MinProximityIntersection {
 public:
  bool testIntersection(const intersection::Cube& first, const intersection::Cube& second,
                        const sofa::core::collision::Intersection* /*current*/) override {
    return intersection::areWithin(10.0, first, second);
  }
};

class SofaBroadPhase : public ::testing::Test {
 protected:
  SofaBroadPhase() { m_method.setAlarmDistance(0.0); }

  World m_world;
  intersection::MinProximityIntersection m_method;
};

TEST_F(SofaBroadPhase, ModelsThatAllOverlapArePairedNewestFirstOldestPartnerFirst) {
  for (int i = 0; i < 4; ++i) m_world.addAt(0.0);
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{1, 0}, {2, 0}, {2, 1}, {3, 0}, {3, 1}, {3, 2}}));
}

TEST_F(SofaBroadPhase, ContactDistancesOfBothComeOnTopOfTheAlarmDistance) {
  m_world.addAt(0.0).root->setContactDistance(0.25);
  m_world.addAt(2.0).root->setContactDistance(0.25);
  EXPECT_EQ(m_world.runBoth(m_method), Numbers{});
  m_method.setAlarmDistance(0.5);
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{1, 0}}));
}

TEST_F(SofaBroadPhase, TheDiscreteMethodDoesNotLookAtContactDistances) {
  intersection::DiscreteIntersection discrete;
  m_world.addAt(0.0).root->setContactDistance(5.0);
  m_world.addAt(2.0);
  EXPECT_EQ(m_world.runBoth(discrete), Numbers{});
}

TEST_F(SofaBroadPhase, OnlyConesOfHalfASphereLetADiscreteModelMeetItself) {
  intersection::DiscreteIntersection discrete;
  for (const double angle : {1.5, 1.6}) {
    Body& body = m_world.addAt(0.0);
    body.box().setConeAngle(angle);
    body.elements->setSelfCollision(true);
  }
  EXPECT_EQ(m_world.runBoth(discrete), (Numbers{{1, 1}, {1, 0}}));
}

TEST_F(SofaBroadPhase, SimulatedIsReadFromTheRootAndTheRestFromTheElements) {
  m_world.addAt(0.0).root->setSimulated(false);
  m_world.addAt(0.0).root->setSimulated(false);
  m_world.addAt(0.0).elements->setSimulated(false);
  m_world.addAt(0.0).elements->setGroups({1, 2});
  m_world.addAt(0.0).elements->setGroups({2, 3});
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{2, 0}, {2, 1}, {3, 0}, {3, 1}, {3, 2}, {4, 0}, {4, 1}, {4, 2}}));
}

TEST_F(SofaBroadPhase, ChangedGroupsAreSeenInTheNextStep) {
  Body& first = m_world.addAt(0.0);
  Body& second = m_world.addAt(0.0);
  first.elements->setGroups({7});
  second.elements->setGroups({7});
  EXPECT_EQ(m_world.runBoth(m_method), Numbers{});
  second.elements->setGroups({});
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{1, 0}}));
}

TEST_F(SofaBroadPhase, ModelsOfOneNodeMeetIfBothMayCollideWithThemselves) {
  Body& first = m_world.addAt(0.0);
  Body& second = m_world.addAt(0.0);
  second.elements->setContext(first.elements->getContext());
  first.elements->setSelfCollision(true);
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{0, 0}}));
  second.elements->setSelfCollision(true);
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{0, 0}, {1, 1}, {1, 0}}));
}

TEST_F(SofaBroadPhase, AModelThatIsAddedTwiceAndMayMeetItselfDoesSoThreeTimes) {
  Body& body = m_world.addAt(0.0);
  m_world.addAgain(body);
  EXPECT_EQ(m_world.runBoth(m_method), Numbers{});
  body.elements->setSelfCollision(true);
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{0, 0}, {0, 0}, {0, 0}}));
}

TEST_F(SofaBroadPhase, EmptyModelsAndNullAreLeftOut) {
  m_world.addAt(0.0);
  m_world.addAt(0.0).root->resize(0);
  m_world.addAt(0.0);
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{2, 0}}));
  m_world.ours().addCollisionModel(nullptr);
  EXPECT_EQ(m_world.ours().getCollisionModelPairs().size(), 1U);
}

TEST_F(SofaBroadPhase, ModelsWithRulesOfTheirOwnAreAsked) {
  for (int i = 0; i < 3; ++i) m_world.addAt(0.0);
  m_world.add<Picky>({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{1, 0}, {2, 0}, {2, 1}, {3, 3}, {3, 1}}));
}

TEST_F(SofaBroadPhase, BoxesWithANanAreTestedAsTheMethodTestsThem) {
  m_world.add({kNan, kNan, kNan}, {kNan, kNan, kNan});
  m_world.addAt(100.0);
  m_world.add({0.0, kNan, 0.0}, {1.0, 1.0, 1.0});
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{1, 0}, {2, 0}}));
}

TEST_F(SofaBroadPhase, ReversedBoxesAreTestedAsTheMethodTestsThem) {
  m_world.add({1.0, 1.0, 1.0}, {-1.0, -1.0, -1.0});
  m_world.add({-5.0, -5.0, -5.0}, {5.0, 5.0, 5.0});
  m_world.addAt(0.0);
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{1, 0}, {2, 1}}));
}

TEST_F(SofaBroadPhase, AModelWithoutABoxIsOfNoInterestToAMethodThatKnowsBoxes) {
  m_world.addAt(0.0);
  m_world.addBody(new Triangles, new Triangles).root->resize(1);
  m_world.addAt(0.0);
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{2, 0}}));
}

TEST_F(SofaBroadPhase, AMethodOfTheUsersOwnIsAskedAboutEveryPairAndMaySwap) {
  SlabMethod method;
  m_world.addAt(0.0);
  m_world.add({1.5, 100.0, 0.0}, {2.0, 101.0, 1.0});
  m_world.addAt(7.0);
  EXPECT_EQ(m_world.runBoth(method), (Numbers{{0, 1}}));
  method.asked = 0;
  m_world.run(m_world.ours(), method);
  EXPECT_EQ(method.asked, 3);
}

TEST_F(SofaBroadPhase, ASubclassOfAKnownMethodIsNotTakenForIt) {
  WiderProximity method;
  m_world.addAt(0.0);
  m_world.addAt(8.0);
  EXPECT_EQ(m_world.runBoth(method), (Numbers{{1, 0}}));
}

TEST_F(SofaBroadPhase, AKnownMethodWithAnotherTestForBoxesIsNotTakenForItself) {
  SlabMethod slab;
  m_method.setBoxIntersector(
      std::make_unique<
          sofa::core::collision::MemberElementIntersector<intersection::Cube, intersection::Cube, SlabMethod>>(&slab));
  m_world.addAt(0.0);
  m_world.add({1.5, 100.0, 0.0}, {2.0, 101.0, 1.0});
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{1, 0}}));
}

TEST_F(SofaBroadPhase, AnInfiniteAlarmDistancePairsEverything) {
  m_method.setAlarmDistance(std::numeric_limits<double>::infinity());
  m_world.addAt(0.0);
  m_world.addAt(100.0);
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{1, 0}}));
}

TEST_F(SofaBroadPhase, AnotherMethodIsUsedFromTheNextStepOn) {
  intersection::LocalMinDistance wide;
  m_world.addAt(0.0);
  m_world.addAt(1.75);
  EXPECT_EQ(m_world.runBoth(m_method), Numbers{});
  EXPECT_EQ(m_world.runBoth(wide), (Numbers{{1, 0}}));
}

}  // namespace
}  // namespace allpairs::test
