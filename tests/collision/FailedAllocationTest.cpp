// SPDX-License-Identifier: MIT
// Each allocation of the component fails once: the next step gives what a new component gives.
#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/collision/CollisionPipeline.h"
#include "allpairs/collision/DiscreteIntersection.h"
#include "allpairs/collision/ElementIntersector.h"
#include "allpairs/collision/HostedModel.h"
#include "support/Boxes.h"
#include "support/FailingAllocation.h"
#include "support/Strategies.h"

namespace allpairs::collision {
namespace {

/// Models by name, since those of two scenes have two addresses.
using Names = std::vector<std::pair<std::string, std::string>>;

/// A component, its models and its method.
class Scene {
 public:
  explicit Scene(Strategy strategy) {
    std::size_t number = 0;
    for (const Box& box : test::toDouble(test::randomBoxes(300, 91))) {
      m_models.push_back(std::make_unique<BoxModel>(std::to_string(number), box));
      m_models.back()->setOwner(m_models.back().get());
      if (number % 3 == 0) m_models.back()->setGroups({static_cast<int>(number % 7)});
      m_models.back()->setSelfCollision(number++ % 5 == 0);
      m_list.push_back(m_models.back().get());
    }
    phase.setStrategy(strategy);
    phase.setIntersectionMethod(&m_method);
    m_pipeline.setIntersectionMethod(&m_method);
    m_pipeline.setBroadPhase(&phase);
  }

  void step() { static_cast<void>(m_pipeline.step(m_list)); }

  void add() {
    phase.beginBroadPhase();
    for (CollisionModel* model : m_list) phase.addCollisionModel(model);
  }

  void addOneByOne() {
    add();
    phase.endBroadPhase();
  }

  void move(double by) {
    for (std::size_t i = 0; i < m_models.size(); i += 20) {
      Box box = m_models[i]->boxes()[0];
      box.max[0] += by;
      m_models[i]->setBox(0, box);
    }
  }

  [[nodiscard]] Names names() {
    Names names;
    for (const auto& [a, b] : phase.getCollisionModelPairs()) names.emplace_back(a->getName(), b->getName());
    return names;
  }

  BruteForceBroadPhase phase;

 private:
  DiscreteIntersection m_method;
  CollisionPipeline m_pipeline;
  std::vector<std::unique_ptr<BoxModel>> m_models;
  std::vector<CollisionModel*> m_list;
};

class FailedComponentAllocation : public ::testing::TestWithParam<Strategy> {};

INSTANTIATE_TEST_SUITE_P(OfEachStrategy, FailedComponentAllocation, ::testing::ValuesIn(test::kStrategies));

TEST_P(FailedComponentAllocation, OfAFirstStepIsMadeUpForByTheNext) {
  Scene fresh(GetParam());
  fresh.step();
  const Names wanted = fresh.names();
  ASSERT_GT(wanted.size(), 200U);
  test::failEachAllocation(
      [&](test::Fault& fault) {
        Scene scene(GetParam());
        static_cast<void>(fault.during([&] { scene.step(); }));
        scene.step();
        ASSERT_EQ(scene.names(), wanted);
        scene.phase.verify();
      },
      5);
}

/// The other strategies allocate nothing in such a step.
TEST(FailedKeptAllocation, OfALaterStepIsMadeUpForByTheNext) {
  constexpr int kSteps = 3;  // a kept search comes after two, and later steps allocate nothing
  const auto stepOften = [](Scene& scene) {
    for (int i = 0; i < kSteps; ++i) {
      scene.step();
      scene.move(0.01);
    }
    scene.move(6.0);
  };
  Scene fresh(Strategy::Automatic);
  stepOften(fresh);
  fresh.step();
  const Names wanted = fresh.names();
  fresh.move(-6.0);
  fresh.step();
  const Names wantedNext = fresh.names();
  ASSERT_NE(wanted, wantedNext);
  test::failEachAllocation([&](test::Fault& fault) {
    Scene scene(Strategy::Automatic);
    stepOften(scene);
    static_cast<void>(fault.during([&] {
      scene.step();
      scene.addOneByOne();
    }));
    scene.step();
    ASSERT_EQ(scene.names(), wanted);
    scene.move(-6.0);
    scene.step();
    ASSERT_EQ(scene.names(), wantedNext);
    scene.phase.verify();
  });
}

TEST_P(FailedComponentAllocation, WhileModelsAreAddedLeavesTheNextStepRight) {
  Scene fresh(GetParam());
  fresh.addOneByOne();
  const Names wanted = fresh.names();
  test::failEachAllocation(
      [&](test::Fault& fault) {
        Scene scene(GetParam());
        if (fault.during([&] { scene.addOneByOne(); })) {
          ASSERT_EQ(scene.names(), wanted);
        }
        scene.addOneByOne();
        ASSERT_EQ(scene.names(), wanted);
      },
      5);
}

/// The exhaustive strategy finds pairs while models are added.
TEST(FailedReadingAllocation, IsMadeUpForByReadingAgain) {
  for (const Strategy strategy : {Strategy::Automatic, Strategy::Bvh}) {
    Scene fresh(strategy);
    fresh.addOneByOne();
    const Names wanted = fresh.names();
    test::failEachAllocation([&](test::Fault& fault) {
      Scene scene(strategy);
      scene.add();
      static_cast<void>(fault.during([&] { scene.phase.endBroadPhase(); }));
      ASSERT_EQ(scene.names(), wanted);
    });
  }
}

/// The pairs of two models, by a new component.
std::size_t pairsOf(CollisionModel& first, CollisionModel& second, Strategy strategy) {
  DiscreteIntersection method;
  BruteForceBroadPhase phase;
  phase.setIntersectionMethod(&method);
  phase.setStrategy(strategy);
  phase.beginBroadPhase();
  phase.addCollisionModel(&first);
  phase.addCollisionModel(&second);
  phase.verify();
  return phase.getCollisionModelPairs().size();
}

constexpr Box kCube{{0, 0, 0}, {1, 1, 1}};

TEST_P(FailedComponentAllocation, OfAModelsGroupsLeavesThoseThatItHad) {
  using Groups = std::vector<int>;
  for (const auto& [before, after] : {std::pair(Groups{}, Groups{1}), std::pair(Groups{1}, Groups{2})}) {
    test::failEachAllocation([&, before = before, after = after](test::Fault& fault) {
      BoxModel model("one", kCube);
      BoxModel other("other", kCube);
      model.setOwner(&model);
      model.setGroups(before);
      other.setGroups({1});
      const bool passed = fault.during([&] { model.setGroups(after); });
      const Groups& wanted = passed ? after : before;
      ASSERT_EQ(model.getGroups(), wanted);
      const bool collide = wanted != Groups{1};
      ASSERT_EQ(model.canCollideWith(&other), collide);
      ASSERT_EQ(pairsOf(model, other, GetParam()), collide ? 1U : 0U);
    });
  }
}

TEST_P(FailedComponentAllocation, OfABoundingTreeLeavesAModelThatCanBeUsedOn) {
  const Box moved{{0.5, 0.5, 0.5}, {9, 9, 9}};
  test::failEachAllocation([&](test::Fault& fault) {
    HostedModel model;
    BoxModel other("other", kCube);
    other.setOwner(&other);
    static_cast<void>(fault.during([&] {
      model.setBox(kCube);
      model.computeBoundingTree(2);
    }));
    model.setBox(moved);
    ASSERT_EQ(model.getFirst()->elementBox(0), moved);
    ASSERT_EQ(pairsOf(model, other, GetParam()), 1U);
    model.computeBoundingTree(2);
    ASSERT_EQ(model.getFirst()->elementBox(0), moved);
    ASSERT_EQ(pairsOf(other, model, GetParam()), 1U);
  });
  test::failEachAllocation([&](test::Fault& fault) {
    BoxModel model("many", std::vector<Box>(20, kCube));
    BoxModel other("other", kCube);
    other.setOwner(&other);
    static_cast<void>(fault.during([&] { model.computeBoundingTree(3); }));
    ASSERT_EQ(pairsOf(model, other, GetParam()), 1U);
  });
}

TEST(FailedMethodAllocation, OfAnIntersectorLeavesTheTable) {
  class First : public BoxModel {
   public:
    using BoxModel::BoxModel;
  };
  test::failEachAllocation([&](test::Fault& fault) {
    DiscreteIntersection method;
    First first("first", kCube);
    BoxModel second("second", kCube);
    const auto revision = method.revision();
    const auto intersector = std::make_shared<BoxIntersector>();
    const bool passed = fault.during([&] { method.add<First, BoxModel>(intersector); });
    bool swap = false;
    ElementIntersector* const wanted = passed ? intersector.get() : nullptr;
    ASSERT_EQ(method.findIntersector(&first, &second, swap), wanted);
    ASSERT_EQ(method.findIntersector(&second, &first, swap), wanted);
    ASSERT_EQ(method.revision() != revision, passed);
  });
}

}  // namespace
}  // namespace allpairs::collision
