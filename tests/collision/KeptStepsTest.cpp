// SPDX-License-Identifier: MIT
// Steps of one broad phase after the other, of a scene that changes in every way between them: each step's list is that
// of a broad phase that has seen no step before, and of the double loop.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <random>

#include "Fixture.h"
#include "allpairs/collision/CollisionPipeline.h"
#include "allpairs/collision/DiscreteIntersection.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

using collision::BoxModel;
using collision::BruteForceBroadPhase;
using collision::CollisionModel;
using collision::CollisionModelPair;
using collision::DiscreteIntersection;
using collision::MinProximityIntersection;

/// What happens to a scene before a step.
struct Change {
  enum class Kind { Nothing, MoveFew, MoveAll, Flag, Contact, Append, RemoveLast, Remove, Insert, Swap, Alarm, Region };
  Kind kind = Kind::Nothing;
  unsigned seed = 0;
};

std::ostream& operator<<(std::ostream& out, const Change& change) {
  return out << '(' << static_cast<int>(change.kind) << ", " << change.seed << ')';
}

/// Models in a room of which a few touch each, under changes; more of them live than take part.
class ChangingScene {
 public:
  explicit ChangingScene(std::size_t size) : m_random(size) {
    m_method.setAlarmDistance(0.0);
    for (std::size_t i = 0; i < size; ++i) m_models.push_back(makeModel());
  }

  void apply(const Change& change);

  [[nodiscard]] std::vector<CollisionModelPair> step(BruteForceBroadPhase& phase) {
    phase.setIntersectionMethod(&m_method);
    phase.clearBox();
    if (m_hasRegion) phase.setBox({-10.0, -10.0, -10.0}, {4.0, 10.0, 10.0});
    phase.init();
    phase.beginBroadPhase();
    for (CollisionModel* model : m_models) phase.addCollisionModel(model);
    phase.endBroadPhase();
    return phase.getCollisionModelPairs();
  }

 private:
  [[nodiscard]] double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(m_random); }
  [[nodiscard]] std::size_t any() { return static_cast<std::size_t>(uniform() * static_cast<double>(m_models.size())); }
  [[nodiscard]] Box anyBox();
  CollisionModel* makeModel();
  static void place(CollisionModel& model, const Box& box) { dynamic_cast<BoxModel&>(model).setBox(0, box); }
  void changeList(Change::Kind kind);
  void changeModel(CollisionModel& model);

  std::mt19937_64 m_random;
  MinProximityIntersection m_method;
  std::vector<std::unique_ptr<BoxModel>> m_owned;
  std::vector<CollisionModel*> m_models;
  bool m_hasRegion = false;
};

Box ChangingScene::anyBox() {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = 5.0 * uniform();
    box.max[axis] = box.min[axis] + (uniform() < 0.02 ? -0.1 : uniform());
  }
  return box;
}

CollisionModel* ChangingScene::makeModel() {
  m_owned.push_back(std::make_unique<BoxModel>("", anyBox()));
  BoxModel* model = m_owned.back().get();
  model->setOwner(uniform() < 0.1 ? nullptr : model);
  model->setSelfCollision(uniform() < 0.1);
  model->setSimulated(uniform() < 0.9);
  if (uniform() < 0.3) model->setGroups({static_cast<int>(3.0 * uniform())});
  return model;
}

void ChangingScene::changeModel(CollisionModel& model) {
  const double which = uniform();
  if (which < 0.3) {
    model.setSimulated(!model.isSimulated());
  } else if (which < 0.6) {
    model.setSelfCollision(!model.getSelfCollision());
  } else {
    model.setGroups(model.getGroups().empty() ? std::vector<int>{1, 2} : std::vector<int>{});
  }
}

void ChangingScene::changeList(Change::Kind kind) {
  const auto at = m_models.begin() + static_cast<std::ptrdiff_t>(m_models.empty() ? 0 : any());
  if (kind == Change::Kind::Append) m_models.push_back(makeModel());
  if (kind == Change::Kind::Insert) m_models.insert(at, makeModel());
  if (m_models.empty()) return;
  if (kind == Change::Kind::RemoveLast) m_models.pop_back();
  if (kind == Change::Kind::Remove) m_models.erase(m_models.begin() + static_cast<std::ptrdiff_t>(any()));
  if (kind == Change::Kind::Swap) std::swap(m_models.front(), m_models[any()]);
}

void ChangingScene::apply(const Change& change) {
  m_random.seed(change.seed);
  if (change.kind == Change::Kind::Alarm) m_method.setAlarmDistance(0.1 * uniform());
  if (change.kind == Change::Kind::Region) m_hasRegion = !m_hasRegion;
  changeList(change.kind);
  if (m_models.empty()) return;
  for (CollisionModel* model : m_models) {
    if (change.kind == Change::Kind::MoveAll) place(*model, anyBox());
  }
  CollisionModel& model = *m_models[any()];
  if (change.kind == Change::Kind::MoveFew) place(model, anyBox());
  if (change.kind == Change::Kind::Flag) changeModel(model);
  if (change.kind == Change::Kind::Contact) model.setContactDistance(0.2 * uniform());
}

rc::Gen<Change> anyChange() {
  using Kind = Change::Kind;
  const auto kind = rc::gen::weightedElement<Kind>({{6, Kind::Nothing},
                                                    {8, Kind::MoveFew},
                                                    {1, Kind::MoveAll},
                                                    {4, Kind::Flag},
                                                    {2, Kind::Contact},
                                                    {3, Kind::Append},
                                                    {3, Kind::RemoveLast},
                                                    {1, Kind::Remove},
                                                    {1, Kind::Insert},
                                                    {1, Kind::Swap},
                                                    {1, Kind::Alarm},
                                                    {1, Kind::Region}});
  return rc::gen::build<Change>(rc::gen::set(&Change::kind, kind),
                                rc::gen::set(&Change::seed, rc::gen::inRange(0U, 1000000U)));
}

RC_GTEST_PROP(KeptSteps, AnySequenceOfStepsGivesTheListsOfStepsOnTheirOwn, ()) {
  const auto size = *rc::gen::inRange<std::size_t>(48, 80);
  const auto changes = *rc::gen::container<std::vector<Change>>(kIsSanitized ? 20 : 60, anyChange());
  ChangingScene scene(size);
  BruteForceBroadPhase kept;
  BruteForceBroadPhase plain;
  plain.setStrategy(Strategy::Exhaustive);
  for (const Change& change : changes) {
    scene.apply(change);
    const std::vector<CollisionModelPair> expected = scene.step(plain);
    RC_ASSERT(scene.step(kept) == expected);
  }
}

class KeptStep : public BroadPhaseTest {
 protected:
  /// Rows of cubes that touch the next ones.
  void addRow(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double x = static_cast<double>(i);
      add({{x, 0.0, 0.0}, {x + 1.0, 1.0, 1.0}});
    }
  }

  std::uint64_t testsOfStep() {
    m_phase.beginBroadPhase();
    m_phase.addCollisionModels(m_models);
    m_phase.endBroadPhase();
    return m_phase.statistics().testsMade;
  }

  void SetUp() override { m_phase.setIntersectionMethod(&m_method); }

  BruteForceBroadPhase m_phase;
};

TEST_F(KeptStep, ASceneAtRestIsTestedAgainInTheFirstStepsOnly) {
  addRow(300);
  EXPECT_GT(testsOfStep(), 0U);
  for (int i = 0; i < 5; ++i) testsOfStep();
  EXPECT_EQ(testsOfStep(), 0U);
  EXPECT_EQ(m_phase.getCollisionModelPairs().size(), 299U);
}

TEST_F(KeptStep, OneModelThatMovesCostsAFewTestsAndNotThoseOfAll) {
  addRow(300);
  const std::uint64_t first = testsOfStep();
  for (int i = 0; i < 5; ++i) testsOfStep();
  dynamic_cast<BoxModel&>(*m_models[100]).setBox(0, {{200.5, 0.0, 0.0}, {201.25, 1.0, 1.0}});
  EXPECT_LT(testsOfStep(), first / 4);
  EXPECT_EQ(m_phase.getCollisionModelPairs().size(), 299U);
}

TEST_F(KeptStep, ContactDistancesDoNotCountWhereTheMethodDoesNotAddThem) {
  DiscreteIntersection discrete;
  m_phase.setIntersectionMethod(&discrete);
  for (int i = 0; i < 300; ++i) add(unitBoxAt(1.25 * i)).setContactDistance(0.5);
  for (int i = 0; i < 8; ++i) {
    testsOfStep();
    EXPECT_TRUE(m_phase.getCollisionModelPairs().empty()) << "step " << i;
  }
}

TEST_F(KeptStep, RulesAreAskedAgainThoughNothingMoves) {
  addRow(100);
  for (int i = 0; i < 6; ++i) testsOfStep();
  for (collision::CollisionModel* model : m_models) model->setSimulated(model == m_models[40]);
  testsOfStep();
  EXPECT_EQ(m_phase.getCollisionModelPairs(),
            (std::vector<CollisionModelPair>{{m_models[40], m_models[39]}, {m_models[41], m_models[40]}}));
}

TEST_F(KeptStep, BeginningTwiceIsBeginningOnce) {
  addRow(300);
  for (int i = 0; i < 6; ++i) {
    m_phase.beginBroadPhase();
    testsOfStep();
  }
  EXPECT_EQ(m_phase.statistics().testsMade, 0U);
}

TEST_F(KeptStep, WithoutKeepingEachStepTestsAllAgain) {
  addRow(300);
  m_phase.setKeepsSearch(false);
  const std::uint64_t first = testsOfStep();
  for (int i = 0; i < 6; ++i) EXPECT_EQ(testsOfStep(), first);
  EXPECT_EQ(m_phase.getCollisionModelPairs().size(), 299U);
}

TEST_F(KeptStep, BoxesSweptOverTheStepAreKeptToo) {
  addRow(300);
  m_method.setContinuous(true);
  collision::CollisionPipeline pipeline;
  pipeline.setIntersectionMethod(&m_method);
  pipeline.setBroadPhase(&m_phase);
  for (int i = 0; i < 6; ++i) pipeline.step(m_models, 0.5);
  dynamic_cast<BoxModel&>(*m_models[0]).setVelocities({{5.0, 0.0, 0.0}});
  pipeline.step(m_models, 0.5);
  EXPECT_LT(m_phase.statistics().testsMade, 2U * 300U);  // The one that changed against all.
  const Numbers pairs = numbers(m_phase.getCollisionModelPairs());
  // From 0 to 3.5: the first cube now touches the second, third and fourth besides.
  EXPECT_EQ(Numbers(pairs.begin(), pairs.begin() + 6), (Numbers{{1, 0}, {2, 0}, {2, 1}, {3, 0}, {3, 2}, {4, 3}}));
  EXPECT_EQ(pairs.size(), 301U);
}

TEST_F(KeptStep, AStepThatIsReadInPartsDoesNotDisturbTheNextStep) {
  addRow(300);
  for (int i = 0; i < 6; ++i) testsOfStep();
  m_phase.beginBroadPhase();
  for (std::size_t i = 0; i < m_models.size(); ++i) {
    m_phase.addCollisionModel(m_models[i]);
    if (i == 200) {
      EXPECT_EQ(m_phase.getCollisionModelPairs().size(), 200U);
    }
  }
  EXPECT_EQ(m_phase.getCollisionModelPairs().size(), 299U);
  testsOfStep();
  EXPECT_EQ(m_phase.getCollisionModelPairs().size(), 299U);
}

}  // namespace
}  // namespace allpairs::test
