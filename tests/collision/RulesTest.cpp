// SPDX-License-Identifier: MIT
// What the contract says of the rules, case by case.
#include <cmath>
#include <numbers>

#include "Fixture.h"
#include "SceneWorld.h"
#include "allpairs/collision/DiscreteIntersection.h"
#include "allpairs/collision/LocalMinDistance.h"
#include "allpairs/collision/NewProximityIntersection.h"
#include "allpairs/collision/SphereModel.h"
#include "allpairs/collision/TriangleModel.h"
#include "support/Numbers.h"

namespace allpairs::test {
namespace {

using namespace collision;

class Rules : public BroadPhaseTest {};

TEST_F(Rules, ModelsThatAllOverlapArePairedNewestFirstOldestPartnerFirst) {
  addTouching(4);
  EXPECT_EQ(detect(), (Numbers{{1, 0}, {2, 0}, {2, 1}, {3, 0}, {3, 1}, {3, 2}}));
}

TEST_F(Rules, ASelfPairComesBeforeTheOtherPairsOfItsModel) {
  addTouching(2);
  for (auto& model : m_owned) model->setSelfCollision(true);
  EXPECT_EQ(detect(), (Numbers{{0, 0}, {1, 1}, {1, 0}}));
}

TEST_F(Rules, BoxesThatTouchAreAPair) {
  add(unitBoxAt(0.0));
  add(unitBoxAt(1.0));
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
}

TEST_F(Rules, AGapOfOneRoundingErrorIsNoPair) {
  add(unitBoxAt(0.0));
  add({{1.0 + 0x1p-52, 0.0, 0.0}, {2.0, 1.0, 1.0}});
  EXPECT_EQ(detect(), Numbers{});
}

TEST_F(Rules, DistanceIsPerAxisAndNotEuclidean) {
  m_method.setAlarmDistance(0.5);
  add({{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
  add({{1.4, 1.4, 1.4}, {2.0, 2.0, 2.0}});
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
}

TEST_F(Rules, ANegativeAlarmDistanceShrinks) {
  m_method.setAlarmDistance(-0.5);
  add(unitBoxAt(0.0));
  add(unitBoxAt(0.5));
  add(unitBoxAt(1.25));
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
}

TEST_F(Rules, ContactDistancesAreAddedLeftToRightInTheOrderOfThePair) {
  m_method.setAlarmDistance(1.0);
  const double large = 0x1.8p-53;  // 1 + large + small is 1 + 2^-51, and 1 + small + large is 1 + 2^-52
  const double small = 0x1p-53;
  const double gap = 1.0 + 0x1p-51;
  add({{-1.0, 0.0, 0.0}, {0.0, 1.0, 1.0}}).setContactDistance(small);
  add({{gap, 0.0, 0.0}, {3.0, 1.0, 1.0}}).setContactDistance(large);
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
  m_owned[0]->setContactDistance(large);
  m_owned[1]->setContactDistance(small);
  EXPECT_EQ(detect(), Numbers{});
}

TEST_F(Rules, TheSearchLosesNoPairToAnotherOrderOfAdding) {
  const double alarm = 0.007;
  const double older = 0.6;
  const double newer = 2.1;
  const double gap = alarm + newer + older;
  ASSERT_LT(alarm * (1.0 + 0x1p-48) + older + newer, gap) << "the distance alone, widened, is not enough";
  m_method.setAlarmDistance(alarm);
  add({{-1.0, 0.0, 0.0}, {0.0, 1.0, 1.0}}).setContactDistance(older);
  add({{gap, 0.0, 0.0}, {gap + 1.0, 1.0, 1.0}}).setContactDistance(newer);
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
}

TEST_F(Rules, ContactDistancesPlayNoPartWithDiscreteIntersectionOrWithTheSwitchOff) {
  add(unitBoxAt(0.0)).setContactDistance(1.0);
  add(unitBoxAt(1.5)).setContactDistance(1.0);
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
  m_method.setContactDistanceInBroadPhase(false);
  EXPECT_EQ(detect(), Numbers{});
  DiscreteIntersection discrete;
  EXPECT_EQ(detect(discrete), Numbers{});
}

TEST_F(Rules, EveryProximityMethodFindsTheSamePairs) {
  NewProximityIntersection newProximity;
  LocalMinDistance localMinDistance;
  add(unitBoxAt(0.0));
  add(unitBoxAt(2.0)).setContactDistance(0.25);
  add(unitBoxAt(4.2)).setContactDistance(0.25);
  for (ProximityIntersection* method :
       {static_cast<ProximityIntersection*>(&newProximity), static_cast<ProximityIntersection*>(&localMinDistance)}) {
    EXPECT_EQ(method->getAlarmDistance(), 1.0);
    EXPECT_EQ(method->getContactDistance(), 0.5);
    EXPECT_EQ(detect(*method), (Numbers{{1, 0}, {2, 1}}));
  }
}

TEST_F(Rules, TwoModelsThatAreBothNotSimulatedAreNoPair) {
  addTouching(3);
  m_owned[0]->setSimulated(false);
  m_owned[1]->setSimulated(false);
  EXPECT_EQ(detect(), (Numbers{{2, 0}, {2, 1}}));
}

TEST_F(Rules, AModelThatIsNotSimulatedHasNoSelfPair) {
  add(unitBoxAt(0.0)).setSelfCollision(true);
  m_owned[0]->setSimulated(false);
  EXPECT_EQ(detect(), Numbers{});
}

TEST_F(Rules, GroupsPlayNoPartInSelfCollision) {
  add(unitBoxAt(0.0)).setSelfCollision(true);
  m_owned[0]->setGroups({1, 2});
  EXPECT_EQ(detect(), (Numbers{{0, 0}}));
}

TEST_F(Rules, ModelsOfOneOwnerCollideIfBothHaveSelfCollisionWhateverTheirGroups) {
  addTouching(3);
  for (auto& model : m_owned) model->setOwner(this);
  m_owned[0]->setGroups({7});
  m_owned[2]->setGroups({7});
  m_owned[0]->setSelfCollision(true);
  m_owned[2]->setSelfCollision(true);
  EXPECT_EQ(detect(), (Numbers{{0, 0}, {2, 2}, {2, 0}}));
}

TEST_F(Rules, ModelsWithoutOwnerShareOne) {
  addTouching(2);
  for (auto& model : m_owned) model->setOwner(nullptr);
  EXPECT_EQ(detect(), Numbers{});
}

TEST_F(Rules, ModelsWithACommonGroupDoNotCollide) {
  addTouching(4);
  m_owned[0]->setGroups({1, 2});
  m_owned[1]->setGroups({3, 2});
  m_owned[2]->setGroups({1});
  EXPECT_EQ(detect(), (Numbers{{2, 1}, {3, 0}, {3, 1}, {3, 2}}));
}

TEST_F(Rules, ZeroMinusOneAndNumbersFarApartAreOrdinaryGroups) {
  addTouching(4);
  m_owned[0]->setGroups({0});
  m_owned[1]->setGroups({64});  // the same bit as 0 of a 64-bit mask
  m_owned[2]->setGroups({-1});
  m_owned[3]->setGroups({-1, 0});
  EXPECT_EQ(detect(), (Numbers{{1, 0}, {2, 0}, {2, 1}, {3, 1}}));
}

TEST_F(Rules, TheSameModelTwiceIsTwoEntries) {
  add(unitBoxAt(0.0));
  addAgain(*m_owned[0]);
  EXPECT_EQ(detect(), Numbers{});
  m_owned[0]->setSelfCollision(true);
  EXPECT_EQ(detect(), (Numbers{{0, 0}, {0, 0}, {0, 0}}));
}

TEST_F(Rules, NullAndEmptyModelsAreIgnored) {
  add(unitBoxAt(0.0));
  m_models.push_back(nullptr);
  m_others.push_back(std::make_unique<BoxModel>("empty", std::vector<Box>{}));
  m_models.push_back(m_others.back().get());
  add(unitBoxAt(0.5));
  EXPECT_EQ(detect(), (Numbers{{3, 0}}));
}

TEST_F(Rules, AnInvertedBoxOverlapsNothingItselfIncluded) {
  add({{1.0, 0.0, 0.0}, {0.0, 1.0, 1.0}}).setSelfCollision(true);
  add(unitBoxAt(0.0));
  EXPECT_EQ(detect(), Numbers{});
}

TEST_F(Rules, TheWholeSpaceOverlapsEveryBoxThatIsNotEmpty) {
  add({{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}});
  add(unitBoxAt(1e300));
  add({{1.0, 0.0, 0.0}, {0.0, 1.0, 1.0}});
  add({{kInfinity, 0.0, 0.0}, {kInfinity, 0.0, 0.0}});
  EXPECT_EQ(detect(), (Numbers{{1, 0}, {3, 0}}));
}

TEST_F(Rules, UsersMayOverrideCanCollideWithAndBothAreAsked) {
  m_others.push_back(std::make_unique<PickyModel>(unitBoxAt(0.0)));
  m_models.push_back(m_others.back().get());
  addTouching(2);
  m_owned[1]->setSelfCollision(true);
  EXPECT_EQ(detect(), (Numbers{{2, 2}, {2, 0}, {2, 1}}));
  EXPECT_FALSE(BruteForceBroadPhase::keepCollisionBetween(m_models[0], m_models[1]));
  EXPECT_FALSE(BruteForceBroadPhase::keepCollisionBetween(m_models[1], m_models[0]));
  EXPECT_TRUE(BruteForceBroadPhase::keepCollisionBetween(m_models[2], m_models[0]));
}

TEST_F(Rules, NullCollidesWithNothing) {
  addTouching(1);
  EXPECT_FALSE(BruteForceBroadPhase::keepCollisionBetween(nullptr, m_models[0]));
  EXPECT_FALSE(BruteForceBroadPhase::keepCollisionBetween(m_models[0], nullptr));
}

TEST_F(Rules, AnIntersectorThatSwapsTurnsThePairAround) {
  m_method.add<OddModel, BoundingBoxModel>(std::make_shared<BoxIntersector>());
  m_others.push_back(std::make_unique<OddModel>(unitBoxAt(0.0)));
  m_others.back()->setOwner(this);
  m_models.push_back(m_others.back().get());
  addTouching(1);
  EXPECT_EQ(detect(), (Numbers{{0, 1}}));
  std::swap(m_models[0], m_models[1]);
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
}

TEST_F(Rules, AnIntersectorForOneWayServesOnlyThatOne) {
  m_method.add<OddModel, BoundingBoxModel>(std::make_shared<BoxIntersector>(), false);
  m_others.push_back(std::make_unique<OddModel>(unitBoxAt(0.0)));
  m_others.back()->setOwner(this);
  m_models.push_back(m_others.back().get());
  addTouching(1);
  EXPECT_EQ(detect(), Numbers{});
  std::swap(m_models[0], m_models[1]);
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
}

TEST_F(Rules, AnIntersectorOfTwoEqualTypesLeavesThePairAsItIs) {
  m_method.add<OddModel, OddModel>(std::make_shared<BoxIntersector>());
  for (int i = 0; i < 2; ++i) {
    m_others.push_back(std::make_unique<OddModel>(unitBoxAt(0.0)));
    m_others.back()->setOwner(m_others.back().get());
    m_models.push_back(m_others.back().get());
  }
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
}

TEST_F(Rules, AnAlarmDistanceMayBeInfiniteButNotNanOrMinusInfinity) {
  add(unitBoxAt(0.0));
  add(unitBoxAt(1e6));
  EXPECT_THROW(m_method.setAlarmDistance(kNan), InvalidArgument);
  EXPECT_THROW(m_method.setAlarmDistance(-kInfinity), InvalidArgument);
  EXPECT_EQ(detect(), Numbers{});
  add({{1.0, 0.0, 0.0}, {0.0, 1.0, 1.0}});  // empty: no distance makes it touch
  m_method.setAlarmDistance(kInfinity);
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
}

/// Finds none for models of the name "ghost".
class MethodThatReadsNames : public collision::DiscreteIntersection {
 public:
  collision::ElementIntersector* findIntersector(collision::CollisionModel* first, collision::CollisionModel* second,
                                                 bool& swapModels) override {
    const auto isGhost = [](collision::CollisionModel* model) { return model->getLast()->getName() == "ghost"; };
    if (isGhost(first) || isGhost(second)) return nullptr;
    return DiscreteIntersection::findIntersector(first, second, swapModels);
  }
};

TEST_F(Rules, AUsersMethodMayFindAnIntersectorByMoreThanTypes) {
  MethodThatReadsNames method;
  addTouching(3);
  m_owned[1]->setName("ghost");
  EXPECT_EQ(detect(method), (Numbers{{2, 0}}));
}

TEST_F(Rules, TypesWithoutIntersectorAreNoPair) {
  m_others.push_back(std::make_unique<OddModel>(unitBoxAt(0.0)));
  m_others.back()->setOwner(this);
  m_others.back()->setSelfCollision(true);
  m_models.push_back(m_others.back().get());
  addTouching(1);
  EXPECT_EQ(detect(), Numbers{});
}

/// A method without any intersector.
class EmptyMethod : public Intersection {};

TEST_F(Rules, AVerdictOfAModelAndItselfNamesAMissingIntersectorAfterTheFlags) {
  EmptyMethod method;
  BruteForceBroadPhase phase;
  phase.setIntersectionMethod(&method);
  BoxModel& model = add(unitBoxAt(0.0));
  EXPECT_EQ(phase.judge(&model, &model).rule, PairRule::OneOwner);
  model.setSelfCollision(true);
  EXPECT_EQ(phase.judge(&model, &model).rule, PairRule::NoIntersector);
  phase.setIntersectionMethod(&m_method);
  EXPECT_TRUE(phase.judge(&model, &model).isPair());
  BoxModel& empty = add({{1.0, 0.0, 0.0}, {0.0, 1.0, 1.0}});
  empty.setSelfCollision(true);
  EXPECT_EQ(phase.judge(&empty, &empty).rule, PairRule::Apart);
}

TEST_F(Rules, AVerdictMayBeAskedOfLevelsThatAreGoneOnceItsTreesAreComputed) {
  BoxModel many("many", std::vector<Box>(16, unitBoxAt(0.0)));
  many.setSelfCollision(true);
  BoxModel& other = add(unitBoxAt(0.5));
  BruteForceBroadPhase phase;
  phase.setIntersectionMethod(&m_method);
  const auto staleLevel = [&many] {
    many.computeBoundingTree(3);
    many.boundsChanged();
    return many.getPrevious();
  };
  EXPECT_TRUE(phase.judge(staleLevel(), &other).isPair());
  EXPECT_TRUE(phase.judge(&other, staleLevel()).isPair());
  CollisionModel* const level = staleLevel();
  EXPECT_TRUE(phase.judge(level, level).isPair());
  phase.setBox({10.0, 10.0, 10.0}, {11.0, 11.0, 11.0});
  phase.init();
  const PairVerdict verdict = phase.judge(&other, staleLevel());
  EXPECT_EQ(verdict.rule, PairRule::OutsideRegion);
  EXPECT_EQ(verdict.model, &many);
}

TEST_F(Rules, AMethodThatCannotBoundItsDistanceIsAskedAboutEveryPairEmptyBoxesIncluded) {
  UserUnboundedMethod method;
  add(unitBoxAt(0.0));
  add(unitBoxAt(1e6));
  add({{1.0, 0.0, 0.0}, {0.0, 1.0, 1.0}});
  EXPECT_EQ(detect(method), (Numbers{{1, 0}, {2, 0}, {2, 1}}));
}

/// Two triangles that meet at an edge; z is how far the second one rises.
std::unique_ptr<TriangleModel> patch(double z) {
  std::vector<Vec3> points{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 1.0, z}};
  auto model =
      std::make_unique<TriangleModel>("patch", points, std::vector<TriangleModel::Triangle>{{0, 1, 2}, {1, 3, 2}});
  model->setSelfCollision(true);
  model->setUseCurvature(true);
  return model;
}

TEST_F(Rules, ANearlyFlatPatchCannotTouchItselfWithDiscreteIntersection) {
  m_others.push_back(patch(0.0));
  m_models.push_back(m_others.back().get());
  DiscreteIntersection discrete;
  EXPECT_EQ(detect(discrete), Numbers{});
  EXPECT_EQ(detect(), (Numbers{{0, 0}}));  // proximity methods don't look at cones
  dynamic_cast<TriangleModel&>(*m_others.back()).setUseCurvature(false);
  EXPECT_EQ(detect(discrete), (Numbers{{0, 0}}));
}

TEST_F(Rules, AFlatPatchThatIsAddedTwiceCannotTouchItself) {
  m_others.push_back(patch(0.0));
  m_models = {m_others.back().get(), m_others.back().get()};
  DiscreteIntersection discrete;
  EXPECT_EQ(detect(discrete), Numbers{});
  EXPECT_EQ(detect(), (Numbers{{0, 0}, {0, 0}, {0, 0}}));
}

/// One element with a cone of the given half-angle.
class ConeModel : public UserModel {
 public:
  explicit ConeModel(double halfAngle) : UserModel(unitBoxAt(0.0)), m_halfAngle(halfAngle) { setSelfCollision(true); }
  [[nodiscard]] NormalCone elementCone(std::size_t /*index*/) const override { return {{0.0, 0.0, 1.0}, m_halfAngle}; }

 private:
  double m_halfAngle;
};

TEST_F(Rules, AHalfAngleOfAQuarterTurnIsEnoughToTouchItselfAndALittleLessIsNot) {
  const double quarter = std::numbers::pi / 2.0;
  for (const double halfAngle : {quarter, std::nextafter(quarter, 0.0)}) {
    m_others.push_back(std::make_unique<ConeModel>(halfAngle));
    m_others.back()->setOwner(m_others.back().get());
    m_models.push_back(m_others.back().get());
  }
  DiscreteIntersection discrete;
  EXPECT_EQ(detect(discrete), (Numbers{{0, 0}, {1, 0}}));
}

TEST_F(Rules, ASharpFoldMayTouchItselfWithDiscreteIntersection) {
  std::vector<Vec3> points{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.1, 0.1, 1.0}};
  using Triangles = std::vector<TriangleModel::Triangle>;
  auto fold = std::make_unique<TriangleModel>("fold", points, Triangles{{0, 1, 2}, {1, 3, 2}, {0, 2, 1}});
  fold->setSelfCollision(true);
  fold->setUseCurvature(true);
  m_models.push_back(fold.get());
  m_others.push_back(std::move(fold));
  DiscreteIntersection discrete;
  EXPECT_EQ(detect(discrete), (Numbers{{0, 0}}));
}

TEST_F(Rules, WorkedNumbersOfTwoSpheres) {
  for (const double x : {0.0, 3.0}) {
    m_others.push_back(std::make_unique<SphereModel>("sphere", std::vector<Vec3>{{x, 0.0, 0.0}}));
    m_others.back()->setOwner(m_others.back().get());
    m_others.back()->setContactDistance(0.1);
    m_models.push_back(m_others.back().get());
  }
  m_method.setAlarmDistance(0.75);
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));  // d = 0.95
  m_method.setContactDistanceInBroadPhase(false);
  EXPECT_EQ(detect(), Numbers{});
  m_method.setAlarmDistance(0.85);
  EXPECT_EQ(detect(), (Numbers{{1, 0}}));
}

TEST_F(Rules, WorkedNumbersOfFiveToriInAChain) {
  const double ranges[][2] = {
      {-2.31705, 2.35285}, {0.18295, 4.85285}, {2.68295, 7.35285}, {5.18295, 9.85285}, {7.68295, 12.35285}};
  for (const auto& [low, high] : ranges) add({{low, 0.0, 0.0}, {high, 1.0, 1.0}});
  m_method.setAlarmDistance(0.3);
  EXPECT_EQ(detect(), (Numbers{{1, 0}, {2, 1}, {3, 2}, {4, 3}}));
}

}  // namespace
}  // namespace allpairs::test
