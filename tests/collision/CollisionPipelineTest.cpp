// SPDX-License-Identifier: MIT
#include "allpairs/collision/CollisionPipeline.h"

#include "Fixture.h"

namespace allpairs::test {
namespace {

using namespace collision;

/// Counts how often, and how deep, its bounding tree is made.
class CountingModel : public BoxModel {
 public:
  using BoxModel::BoxModel;
  void computeBoundingTree(int maxDepth) override {
    ++computed;
    depth = maxDepth;
    BoxModel::computeBoundingTree(maxDepth);
  }
  void computeContinuousBoundingTree(double dt, int maxDepth) override {
    ++swept;
    BoxModel::computeContinuousBoundingTree(dt, maxDepth);
  }

  int computed = 0;
  int swept = 0;
  int depth = -1;
};

class DeepNarrowPhase : public ElementNarrowPhase {
 public:
  [[nodiscard]] bool needsDeepBoundingTree() const override { return true; }
};

class Pipeline : public BroadPhaseTest {
 protected:
  Pipeline() {
    m_pipeline.setIntersectionMethod(&m_method);
    m_pipeline.setBroadPhase(&m_phase);
    for (int i = 0; i < 3; ++i) {
      m_counting.push_back(std::make_unique<CountingModel>("model", unitBoxAt(0.5 * i)));
      m_counting.back()->setOwner(m_counting.back().get());
      m_models.push_back(m_counting.back().get());
    }
  }

  BruteForceBroadPhase m_phase;
  CollisionPipeline m_pipeline;
  std::vector<std::unique_ptr<CountingModel>> m_counting;
};

TEST_F(Pipeline, AStepGivesTheBroadPhasesPairs) {
  EXPECT_EQ(numbers(m_pipeline.step(m_models)), (Numbers{{1, 0}, {2, 0}, {2, 1}}));
}

TEST_F(Pipeline, InactiveModelsAreLeftOut) {
  m_counting[1]->setActive(false);
  EXPECT_EQ(numbers(m_pipeline.step(m_models)), (Numbers{{2, 0}}));
  EXPECT_EQ(m_counting[1]->computed, 0);
}

TEST_F(Pipeline, NullAndEmptyModelsAreLeftOut) {
  CountingModel empty("empty", std::vector<Box>{});
  m_models.insert(m_models.begin() + 1, {nullptr, &empty});
  EXPECT_EQ(numbers(m_pipeline.step(m_models)), (Numbers{{3, 0}, {4, 0}, {4, 3}}));
  EXPECT_EQ(empty.computed, 0);
}

TEST_F(Pipeline, AModelMayBeGivenByAnyOfItsLevels) {
  BoxModel model("many", std::vector<Box>(16, unitBoxAt(0.25)));
  model.setOwner(&model);
  for (const std::size_t above : {0U, 1U, 2U}) {
    model.computeBoundingTree(3);
    CollisionModel* level = model.getFirst();
    for (std::size_t i = 0; i < above; ++i) level = level->getNext();
    const std::vector<CollisionModel*> models{level, m_models[0]};
    const std::vector<CollisionModelPair> wanted{{m_models[0], &model}};
    EXPECT_EQ(m_pipeline.step(models), wanted);  // its tree has one level now
  }
}

TEST_F(Pipeline, TreesOfModelsThatDoNotMoveAreMadeOnce) {
  m_counting[0]->setMoving(false);
  for (int i = 0; i < 3; ++i) m_pipeline.step(m_models);
  EXPECT_EQ(m_counting[0]->computed, 1);
  EXPECT_EQ(m_counting[1]->computed, 3);
}

TEST_F(Pipeline, TreesAreDeepOnlyIfAPhaseNeedsIt) {
  ElementNarrowPhase shallow;
  m_pipeline.setNarrowPhase(&shallow);
  m_pipeline.init();
  m_pipeline.step(m_models);
  EXPECT_EQ(m_counting[0]->depth, 0);
  DeepNarrowPhase deep;
  m_pipeline.setNarrowPhase(&deep);
  m_pipeline.setDepth(4);
  m_pipeline.init();
  m_pipeline.step(m_models);
  EXPECT_EQ(m_counting[0]->depth, 4);
  m_pipeline.setDepth(0);
  m_pipeline.step(m_models);
  EXPECT_EQ(m_counting[0]->depth, 0);
}

TEST_F(Pipeline, AContinuousMethodSeesTheWholeStep) {
  m_method.setContinuous(true);
  BoxModel far("far", unitBoxAt(10.0));
  far.setOwner(&far);
  far.setVelocities({{-8.0, 0.0, 0.0}});
  m_models = {m_counting[0].get(), &far};
  EXPECT_EQ(numbers(m_pipeline.step(m_models, 0.5)), Numbers{});
  EXPECT_EQ(numbers(m_pipeline.step(m_models, 1.25)), (Numbers{{1, 0}}));
  EXPECT_EQ(m_counting[0]->swept, 2);
}

TEST_F(Pipeline, TheNarrowPhaseIsGivenThePairsOfTheBroadPhase) {
  ElementNarrowPhase narrow;
  m_pipeline.setNarrowPhase(&narrow);
  m_pipeline.step(m_models);
  ASSERT_EQ(narrow.getElementPairs().size(), 3U);
  EXPECT_EQ(narrow.getElementPairs()[0].first.model, m_models[1]);
  EXPECT_EQ(narrow.getElementPairs()[0].second.model, m_models[0]);
}

TEST_F(Pipeline, ARegionCountsAlsoIfThePhaseHadItsMethodAlready) {
  m_phase.setIntersectionMethod(&m_method);
  m_phase.setBox(Box{{100, 100, 100}, {101, 101, 101}});
  EXPECT_EQ(numbers(m_pipeline.step(m_models)), Numbers{});
  CollisionPipeline methodLast;
  methodLast.setBroadPhase(&m_phase);
  methodLast.setIntersectionMethod(&m_method);
  m_phase.setBox(Box{{0, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(numbers(methodLast.step(m_models)), (Numbers{{1, 0}, {2, 0}, {2, 1}}));
}

TEST_F(Pipeline, ARegionThatIsSetAfterAStepWaitsForInit) {
  EXPECT_EQ(numbers(m_pipeline.step(m_models)), (Numbers{{1, 0}, {2, 0}, {2, 1}}));
  m_phase.setBox(Box{{100, 100, 100}, {101, 101, 101}});
  EXPECT_EQ(numbers(m_pipeline.step(m_models)), (Numbers{{1, 0}, {2, 0}, {2, 1}}));
  m_pipeline.init();
  EXPECT_EQ(numbers(m_pipeline.step(m_models)), Numbers{});
}

TEST_F(Pipeline, ANarrowPhaseMayBeSetAfterAStep) {
  static_cast<void>(m_pipeline.step(m_models));
  ElementNarrowPhase narrow;
  m_pipeline.setNarrowPhase(&narrow);
  EXPECT_EQ(numbers(m_pipeline.step(m_models)), (Numbers{{1, 0}, {2, 0}, {2, 1}}));
}

TEST_F(Pipeline, ANarrowPhaseOfTwoPipelinesUsesTheMethodOfTheOneThatRuns) {
  MinProximityIntersection wide;
  wide.setAlarmDistance(5.0);
  BruteForceBroadPhase otherPhase;
  CollisionPipeline other;
  ElementNarrowPhase narrow;
  other.setIntersectionMethod(&wide);
  other.setBroadPhase(&otherPhase);
  other.setNarrowPhase(&narrow);
  m_pipeline.setNarrowPhase(&narrow);
  BoxModel pair("two boxes", {unitBoxAt(0.0), unitBoxAt(4.0)});
  pair.setOwner(&pair);
  m_models = {m_counting[0].get(), &pair};
  for (int i = 0; i < 2; ++i) {
    static_cast<void>(m_pipeline.step(m_models));
    EXPECT_EQ(narrow.getElementPairs().size(), 1U);
    static_cast<void>(other.step(m_models));
    EXPECT_EQ(narrow.getElementPairs().size(), 2U);
  }
}

TEST_F(Pipeline, AMissingMethodOrBroadPhaseIsAnError) {
  CollisionPipeline pipeline;
  EXPECT_THROW(pipeline.step(m_models), InvalidArgument);
  pipeline.setIntersectionMethod(&m_method);
  EXPECT_THROW(pipeline.init(), InvalidArgument);
  EXPECT_THROW(pipeline.setDepth(-1), InvalidArgument);
}

}  // namespace
}  // namespace allpairs::test
