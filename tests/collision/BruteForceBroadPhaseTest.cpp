// SPDX-License-Identifier: MIT
// The component from outside: steps, region, strategies, statistics, errors.
#include <stdexcept>
#include <utility>

#include "Fixture.h"
#include "SceneWorld.h"
#include "allpairs/Overlaps.h"
#include "support/Numbers.h"
#include "support/Strategies.h"

namespace allpairs::test {
namespace {

using namespace collision;
using ::testing::Test;

class Component : public BroadPhaseTest {
 protected:
  Component() { m_phase.setIntersectionMethod(&m_method); }

  Numbers step() {
    m_phase.beginBroadPhase();
    m_phase.addCollisionModels(m_models);
    m_phase.endBroadPhase();
    return numbers(m_phase.getCollisionModelPairs());
  }

  /// What is thrown, or nothing.
  template <class Exception, class Action>
  static std::string messageOf(const Action& action) {
    try {
      action();
    } catch (const Exception& error) {
      return error.what();
    }
    return {};
  }

  BruteForceBroadPhase m_phase;
};

TEST_F(Component, TheListGrowsWithEachModelThatIsAdded) {
  addTouching(3);
  m_phase.beginBroadPhase();
  EXPECT_TRUE(m_phase.getCollisionModelPairs().empty());
  m_phase.addCollisionModel(m_models[0]);
  EXPECT_TRUE(m_phase.getCollisionModelPairs().empty());
  m_phase.addCollisionModel(m_models[1]);
  EXPECT_EQ(numbers(m_phase.getCollisionModelPairs()), (Numbers{{1, 0}}));
  m_phase.addCollisionModel(m_models[2]);
  EXPECT_EQ(numbers(m_phase.getCollisionModelPairs()), (Numbers{{1, 0}, {2, 0}, {2, 1}}));
  m_phase.beginBroadPhase();
  EXPECT_TRUE(m_phase.getCollisionModelPairs().empty());
}

TEST_F(Component, AStopEndsAStepAndVerifyAndTheNextStepIsWhole) {
  addTouching(60);
  const Numbers expected = step();
  ASSERT_EQ(expected.size(), 60U * 59U / 2U);
  std::size_t asked = 0;
  std::size_t answersNo = 0;
  const auto ask = [&] { return asked++ == answersNo; };
  const StopFlag stop(ask);
  m_phase.setStop(&stop);
  for (const Strategy strategy : {Strategy::Automatic, Strategy::Exhaustive}) {
    m_phase.setStrategy(strategy);
    asked = 0;
    answersNo = 0;
    EXPECT_THROW(static_cast<void>(step()), Stopped);
    EXPECT_EQ(step(), expected);
    asked = 0;
    EXPECT_THROW(m_phase.verify(), Stopped);
    m_phase.verify();
  }
}

TEST_F(Component, FlagsGroupsDistancesAndBoxesAreReadWhenAModelIsAdded) {
  addTouching(2);
  m_phase.beginBroadPhase();
  for (auto& model : m_owned) {
    m_phase.addCollisionModel(model.get());
    model->setSimulated(false);
    model->setGroups({1});
    model->setOwner(nullptr);
    model->setContactDistance(-5.0);
    model->setBox(0, {{1e3 * static_cast<double>(m_owned.size()), 0.0, 0.0}, {1e9, 1.0, 1.0}});
  }
  m_method.setAlarmDistance(-0.75);
  EXPECT_EQ(numbers(m_phase.getCollisionModelPairs()), (Numbers{{1, 0}}));
}

TEST_F(Component, TheDoubleLoopReadsFlagsOfBothModelsForEachPair) {
  addTouching(2);
  m_owned[1]->setSimulated(false);
  m_phase.setStrategy(Strategy::Exhaustive);
  m_phase.beginBroadPhase();
  m_phase.addCollisionModel(m_models[0]);
  m_owned[0]->setSimulated(false);
  m_phase.addCollisionModel(m_models[1]);
  EXPECT_EQ(numbers(m_phase.getCollisionModelPairs()), Numbers{});
  m_owned[0]->setSimulated(true);
  EXPECT_THROW(m_phase.verify(), VerificationError);
}

TEST_F(Component, AModelWhosePositionsWereSetGetsANewRootWhenItIsAdded) {
  add(unitBoxAt(0.0));
  add(unitBoxAt(5.0));
  EXPECT_EQ(step(), Numbers{});
  m_owned[1]->setBox(0, unitBoxAt(0.5));
  EXPECT_EQ(step(), (Numbers{{1, 0}}));
}

TEST_F(Component, AModelGivenByALevelThatIsGoneIsNamedByItsNewRoot) {
  for (const Strategy strategy : {Strategy::Automatic, Strategy::Exhaustive}) {
    BoxModel model("many", std::vector<Box>(16, unitBoxAt(5.0)));
    BoxModel other("other", unitBoxAt(0.0));
    other.setOwner(&other);
    model.computeBoundingTree(3);
    CollisionModel* const level = model.getFirst()->getNext();
    m_phase.setStrategy(strategy);
    m_phase.beginBroadPhase();
    m_phase.addCollisionModel(level);
    EXPECT_EQ(m_phase.getCollisionModelPairs().size(), 0U);
    model.setBox(7, unitBoxAt(0.5));  // its tree is made again, and has one level then
    m_phase.beginBroadPhase();
    m_phase.addCollisionModel(level);
    m_phase.addCollisionModel(&other);
    const std::vector<CollisionModelPair> wanted{{&other, model.getFirst()}};
    EXPECT_EQ(m_phase.getCollisionModelPairs(), wanted);
    m_phase.verify();
  }
}

TEST_F(Component, ATreeThatWasComputedIsUsedAsItIs) {
  add(unitBoxAt(0.0));
  add(unitBoxAt(5.0)).setVelocities({{-10.0, 0.0, 0.0}});
  m_owned[1]->computeContinuousBoundingTree(1.0);
  EXPECT_EQ(step(), (Numbers{{1, 0}}));
}

TEST_F(Component, AddingManyAsksTheOverriddenAdditionForEach) {
  class Selective : public BruteForceBroadPhase {
   public:
    void addCollisionModel(core::CollisionModel* cm) override {
      if (cm->getName() != "model 1") BruteForceBroadPhase::addCollisionModel(cm);
    }
  };
  addTouching(3);
  Selective phase;
  phase.setIntersectionMethod(&m_method);
  phase.beginBroadPhase();
  phase.addCollisionModels(m_models);
  EXPECT_EQ(numbers(phase.getCollisionModelPairs()), (Numbers{{2, 0}}));
}

TEST_F(Component, TheExhaustiveStrategyMakesEveryTestAndCountsThem) {
  for (int i = 0; i < 50; ++i) add(unitBoxAt(10.0 * i));
  m_phase.setStrategy(Strategy::Exhaustive);
  step();
  EXPECT_EQ(m_phase.statistics().models, 50U);
  EXPECT_EQ(m_phase.statistics().testsMade, 50U * 49U / 2U);
  EXPECT_EQ(m_phase.statistics().testsOfAllPairs, 50U * 49U / 2U);
  EXPECT_EQ(m_phase.statistics().candidates, 50U * 49U / 2U);
  EXPECT_EQ(m_phase.statistics().pairs, 0U);
}

TEST_F(Component, AMethodWithoutBoundIsAskedAboutEveryPairAndEachIsCounted) {
  for (int i = 0; i < 50; ++i) add(unitBoxAt(10.0 * i));
  UserUnboundedMethod method;
  m_phase.setIntersectionMethod(&method);
  step();
  EXPECT_EQ(m_phase.statistics().testsMade, 50U * 49U / 2U);
  EXPECT_EQ(m_phase.statistics().candidates, 50U * 49U / 2U);
}

TEST_F(Component, TestsAreThoseOfTheSearchOfTheirBoxes) {
  std::vector<Box> boxes;
  for (int i = 0; i < 3000; ++i) boxes.push_back(unitBoxAt(10.0 * i));
  for (const Box& box : boxes) add(box);
  step();
  OverlapSearch search(OverlapOptions{.order = Order::BySecond});
  static_cast<void>(search.find(BoxView(boxes)));
  EXPECT_GT(search.statistics().groupTests, 0U);
  EXPECT_EQ(m_phase.statistics().testsMade, search.statistics().boxTests + search.statistics().groupTests);
}

TEST_F(Component, OnlyPairsWhoseBoxesAreNearAreAsked) {
  for (int i = 0; i < 50; ++i) add(unitBoxAt(0.9 * i));
  step();
  EXPECT_EQ(m_phase.statistics().pairs, 49U);
  EXPECT_EQ(m_phase.statistics().candidates, 49U);
  EXPECT_EQ(m_phase.statistics().testsOfAllPairs, 50U * 49U / 2U);
}

TEST_F(Component, ReadingAfterEachAdditionPaysForOneRow) {
  m_phase.beginBroadPhase();
  for (int i = 0; i < 200; ++i) {
    m_phase.addCollisionModel(&add(unitBoxAt(0.9 * i)));
    static_cast<void>(m_phase.getCollisionModelPairs());
  }
  EXPECT_EQ(m_phase.statistics().pairs, 199U);
  EXPECT_EQ(m_phase.statistics().candidates, 199U);
  EXPECT_LE(m_phase.statistics().testsMade, 2U * m_phase.statistics().testsOfAllPairs);
}

TEST_F(Component, ReadingHalfWayChangesNothing) {
  for (int i = 0; i < 200; ++i) add(unitBoxAt(0.9 * (i % 100)));
  const Numbers expected = step();
  ASSERT_EQ(expected.size(), 99U + 99U + 100U + 99U + 99U);
  m_phase.beginBroadPhase();
  for (std::size_t i = 0; i < m_models.size(); ++i) {
    m_phase.addCollisionModel(m_models[i]);
    if (i == 99) {
      EXPECT_EQ(m_phase.getCollisionModelPairs().size(), 99U);
    }
  }
  EXPECT_EQ(numbers(m_phase.getCollisionModelPairs()), expected);
}

TEST_F(Component, ModelsOutsideOfTheRegionTakeNoPart) {
  for (const double x : {0.0, 0.5, 5.0, 5.5}) add(unitBoxAt(x)).setSelfCollision(true);
  m_phase.setBox({4.0, -1.0, -1.0}, {9.0, 2.0, 2.0});
  m_phase.init();
  EXPECT_EQ(step(), (Numbers{{2, 2}, {3, 3}, {3, 2}}));
  EXPECT_EQ(m_phase.statistics().models, 2U);
}

TEST_F(Component, TheRegionIsClosedAndWidenedByTheDistance) {
  addTouching(2);
  m_phase.setBox({1.0, 0.0, 0.0}, {2.0, 1.0, 1.0});
  m_phase.init();
  EXPECT_EQ(step(), (Numbers{{1, 0}}));
  m_phase.setBox({1.5, 0.0, 0.0}, {2.0, 1.0, 1.0});
  m_phase.reinit();
  EXPECT_EQ(step(), Numbers{});
  m_method.setAlarmDistance(0.25);
  for (auto& model : m_owned) model->setContactDistance(0.25);
  EXPECT_EQ(step(), (Numbers{{1, 0}}));
}

TEST_F(Component, TheRegionIsReadByInitAndReinitOnly) {
  addTouching(2);
  m_phase.setBox({10.0, 0.0, 0.0}, {11.0, 1.0, 1.0});
  EXPECT_EQ(step(), (Numbers{{1, 0}}));
  m_phase.reinit();
  EXPECT_EQ(step(), Numbers{});
  m_phase.clearBox();
  EXPECT_EQ(step(), Numbers{});
  m_phase.init();
  EXPECT_EQ(step(), (Numbers{{1, 0}}));
}

TEST_F(Component, ARegionThatIsNoBoxIsAnError) {
  const auto problem = [this](const Vec3& min, const Vec3& max) {
    m_phase.setBox(min, max);
    return messageOf<InvalidArgument>([this] { m_phase.init(); });
  };
  EXPECT_NE(problem({0.0, 1.0, 0.0}, {1.0, 0.0, 1.0}).find("y axis"), std::string::npos);
  EXPECT_NE(problem({0.0, 0.0, 1.0}, {1.0, 1.0, 1.0}).find("z axis"), std::string::npos);
  EXPECT_NE(problem({kNan, 0.0, 0.0}, {1.0, 1.0, 1.0}).find("x axis"), std::string::npos);
  EXPECT_EQ(problem({2e-9, 0.0, 0.0}, {1e-9, 1.0, 1.0}),
            "the region box does not have min < max on the x axis: 2e-09 to 1e-09");
  EXPECT_EQ(problem({0.1, 0.0, 0.0}, {0.1, 1.0, 1.0}),
            "the region box does not have min < max on the x axis: 0.1 to 0.1");
  EXPECT_EQ(problem({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), "");
}

TEST_F(Component, AMethodWithoutIntersectorForTheRegionLetsEveryModelIn) {
  class MethodOfOddRoots : public UserUnboundedMethod {
   public:
    MethodOfOddRoots() {
      add<BoundingBoxModel, BoundingBoxModel>(nullptr);
      add<OddModel, OddModel>(std::make_shared<BoxIntersector>());
    }
  };
  for (int i = 0; i < 2; ++i) {
    m_others.push_back(std::make_unique<OddModel>(unitBoxAt(0.0)));
    m_others.back()->setOwner(m_others.back().get());
    m_models.push_back(m_others.back().get());
  }
  MethodOfOddRoots method;
  m_phase.setIntersectionMethod(&method);
  m_phase.setBox({10.0, 0.0, 0.0}, {11.0, 1.0, 1.0});
  m_phase.init();
  EXPECT_EQ(step(), (Numbers{{1, 0}}));
}

TEST_F(Component, ABoxWithANanIsRefusedByTheModelsName) {
  UserModel model({{0.0, 0.0, 0.0}, {1.0, kNan, 1.0}});
  model.setName("broken");
  addTouching(1);
  m_phase.beginBroadPhase();
  m_phase.addCollisionModel(m_models[0]);
  EXPECT_NE(messageOf<InvalidBox>([&] { m_phase.addCollisionModel(&model); }).find("model 'broken'"),
            std::string::npos);
  EXPECT_EQ(m_phase.statistics().pairs, 0U);
  m_phase.addCollisionModel(&add(unitBoxAt(0.5)));  // the step goes on without it
  EXPECT_EQ(numbers(m_phase.getCollisionModelPairs()), (Numbers{{1, 0}}));
  addAgain(model);
  addTouching(1);
  EXPECT_THROW(step(), InvalidBox);
  EXPECT_EQ(numbers(m_phase.getCollisionModelPairs()), (Numbers{{1, 0}})) << "those before it have been added";
}

TEST_F(Component, AMissingMethodIsAnError) {
  addTouching(1);
  m_phase.setIntersectionMethod(nullptr);
  m_phase.beginBroadPhase();
  EXPECT_THROW(m_phase.addCollisionModel(m_models[0]), InvalidArgument);
  EXPECT_TRUE(m_phase.getCollisionModelPairs().empty());
}

/// Says that it looks no further than 0, and looks 1 far.
class LyingMethod : public MinProximityIntersection {
 public:
  [[nodiscard]] double maximumDistance() const override { return 0.0; }
};

TEST_F(Component, VerifyShowsAMethodThatSaysLessThanItDoes) {
  add(unitBoxAt(0.0));
  add(unitBoxAt(1.5));
  LyingMethod method;
  m_phase.setIntersectionMethod(&method);
  EXPECT_EQ(step(), Numbers{});
  const std::string message = messageOf<VerificationError>([this] { m_phase.verify(); });
  EXPECT_NE(message.find("'model 1'"), std::string::npos) << message;
  EXPECT_NE(message.find("'model 0'"), std::string::npos) << message;
  m_phase.setStrategy(Strategy::Exhaustive);
  EXPECT_EQ(step(), (Numbers{{1, 0}}));
  EXPECT_NO_THROW(m_phase.verify());
}

TEST_F(Component, VerifyTakesTheMethodOfTheWholeStepOnly) {
  addTouching(2);
  m_owned[0]->setSelfCollision(true);
  m_phase.setIntersectionMethod(nullptr);
  EXPECT_THROW(m_phase.verify(), InvalidArgument);
  m_phase.setIntersectionMethod(&m_method);
  m_phase.verify();  // of no step
  EXPECT_EQ(step(), (Numbers{{0, 0}, {1, 0}}));
  m_phase.verify();
  m_phase.setIntersectionMethod(nullptr);
  EXPECT_THROW(m_phase.verify(), InvalidArgument);
  MinProximityIntersection other;
  m_phase.setIntersectionMethod(&other);
  EXPECT_THROW(m_phase.verify(), InvalidArgument);
  m_phase.setIntersectionMethod(&m_method);
  m_phase.verify();
  m_method.setAlarmDistance(0.5);
  EXPECT_THROW(m_phase.verify(), InvalidArgument);
  m_phase.addCollisionModel(m_models[0]);  // now there is a row of either setting
  EXPECT_THROW(m_phase.verify(), InvalidArgument);
  step();
  m_phase.verify();
}

/// Says that no two models can touch at all.
class MethodOfNothing : public MinProximityIntersection {
 public:
  [[nodiscard]] double maximumDistance() const override { return -kInfinity; }
};

TEST_F(Component, ADistanceOfMinusInfinityIsRefusedByEveryStrategy) {
  addTouching(2);
  MethodOfNothing method;
  m_phase.setIntersectionMethod(&method);
  for (const Strategy strategy : kStrategies) {
    m_phase.setStrategy(strategy);
    EXPECT_THROW(step(), InvalidArgument);
  }
}

TEST_F(Component, AStepCanChangeItsMethodOnTheWay) {
  for (const double x : {0.0, 1.5, 3.0}) add(unitBoxAt(x));
  MinProximityIntersection wide;
  m_phase.beginBroadPhase();
  m_phase.addCollisionModel(m_models[0]);
  m_phase.addCollisionModel(m_models[1]);
  m_phase.setIntersectionMethod(&wide);
  m_phase.addCollisionModel(m_models[2]);
  EXPECT_EQ(numbers(m_phase.getCollisionModelPairs()), (Numbers{{2, 1}}));
}

/// Says the same of all roots.
class ConstantIntersector : public ElementIntersector {
 public:
  explicit ConstantIntersector(bool answer) : m_answer(answer) {}
  [[nodiscard]] bool canIntersect(const CollisionElement& /*first*/, const CollisionElement& /*second*/,
                                  const Intersection& /*method*/) const override {
    return m_answer;
  }

 private:
  bool m_answer;
};

TEST_F(Component, AnIntersectorThatIsReplacedBeforeTheListIsReadIsNotAskedAnyMore) {
  const auto replaceBy = [this](std::shared_ptr<ElementIntersector> intersector) {
    m_method.add<BoundingBoxModel, BoundingBoxModel>(std::move(intersector));
  };
  addTouching(3);
  replaceBy(std::make_shared<ConstantIntersector>(true));
  m_phase.beginBroadPhase();
  m_phase.addCollisionModel(m_models[0]);
  m_phase.addCollisionModel(m_models[1]);
  EXPECT_EQ(numbers(m_phase.getCollisionModelPairs()), (Numbers{{1, 0}}));
  m_phase.addCollisionModel(m_models[2]);
  replaceBy(std::make_shared<ConstantIntersector>(false));
  EXPECT_EQ(numbers(m_phase.getCollisionModelPairs()), (Numbers{{1, 0}}));
  m_phase.addCollisionModel(m_models[2]);
  replaceBy(nullptr);
  EXPECT_EQ(numbers(m_phase.getCollisionModelPairs()), (Numbers{{1, 0}}));
}

TEST_F(Component, ManyModelsOfManyGroupsAreFoundAsTheDoubleLoopFindsThem) {
  std::size_t number = 0;
  for (const Box& box : toDouble(randomBoxes(1500, 7))) {
    BoxModel& model = add(box);
    const int group = static_cast<int>(number % 97);
    if (number % 2 == 0) model.setGroups({group, -group});
    model.setSimulated(number % 5 != 0);
    model.setContactDistance(number % 3 == 0 ? 0.01 : 0.0);
    ++number;
  }
  const Numbers pairs = detect();
  EXPECT_GT(pairs.size(), 1000U);
}

/// Refuses to answer the first time that it is asked about another.
class ReluctantModel : public BoxModel {
 public:
  using BoxModel::BoxModel;
  bool canCollideWith(CollisionModel* other) override {
    if (other != this && !std::exchange(m_asked, true)) throw std::runtime_error("not now");
    return BoxModel::canCollideWith(other);
  }

 private:
  bool m_asked = false;
};

TEST_F(Component, WhatARuleThrowsOnLeavesNoPairTwice) {
  for (const Strategy strategy : {Strategy::Automatic, Strategy::Exhaustive}) {
    m_models.clear();
    addTouching(2);
    ReluctantModel reluctant("reluctant", unitBoxAt(0.0));
    reluctant.setOwner(&reluctant);
    addAgain(reluctant);
    m_phase.setStrategy(strategy);
    m_phase.beginBroadPhase();
    EXPECT_THROW(m_phase.addCollisionModels(m_models), std::runtime_error);
    EXPECT_EQ(numbers(m_phase.getCollisionModelPairs()), (Numbers{{1, 0}, {2, 0}, {2, 1}}));
  }
}

TEST_F(Component, WhatIsSetAfterAStepThatThrewDoesNotTouchItsModels) {
  {
    BoxModel model("one", unitBoxAt(0.0));
    ReluctantModel reluctant("reluctant", unitBoxAt(0.0));
    reluctant.setOwner(&reluctant);
    m_phase.beginBroadPhase();
    m_phase.addCollisionModel(&model);
    m_phase.addCollisionModel(&reluctant);
    EXPECT_THROW(m_phase.endBroadPhase(), std::runtime_error);
  }
  m_phase.setStrategy(Strategy::Exhaustive);
  m_phase.setKeepsSearch(false);
  m_phase.setIntersectionMethod(&m_method);
  addTouching(2);
  EXPECT_EQ(step(), (Numbers{{1, 0}}));
}

}  // namespace
}  // namespace allpairs::test
