// SPDX-License-Identifier: MIT
// Random scenes of every awkward kind, against the double loop of the contract. RapidCheck prints the seed and the
// smallest scene that fails.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "SceneGenerator.h"
#include "SceneOracle.h"
#include "SceneWorld.h"
#include "support/Strategies.h"

namespace allpairs {
namespace {

using collision::BruteForceBroadPhase;
using collision::CollisionModel;
using test::IndexPair;
using test::SceneSpec;
using test::SceneWorld;

using test::kStrategies;

std::vector<IndexPair> detectAtOnce(const SceneWorld& world, Strategy strategy) {
  BruteForceBroadPhase phase;
  world.prepare(phase);
  phase.setStrategy(strategy);
  phase.beginBroadPhase();
  phase.addCollisionModels(world.models());
  phase.endBroadPhase();
  phase.verify();
  return world.indices(phase.getCollisionModelPairs());
}

RC_GTEST_PROP(BroadPhaseProperty, AnySceneGivesTheDoubleLoopsListWithEveryStrategy, ()) {
  const SceneSpec scene = *test::anyScene();
  const SceneWorld world(scene);
  const std::vector<IndexPair> expected = world.firstPlaces(test::sceneOracle(scene));
  RC_CLASSIFY(scene.models.size() > 20, "more than 20 models");
  RC_CLASSIFY(!expected.empty(), "has pairs");
  RC_CLASSIFY(expected.size() > 20, "more than 20 pairs");
  for (const Strategy strategy : kStrategies) RC_ASSERT(detectAtOnce(world, strategy) == expected);
}

RC_GTEST_PROP(BroadPhaseProperty, WhatIsReadAtAnyPointIsTheListOfWhatWasAddedSoFar, ()) {
  const SceneSpec scene = *test::anyScene();
  const auto strategy = *rc::gen::elementOf(std::vector<Strategy>(std::begin(kStrategies), std::end(kStrategies)));
  const auto reads = *rc::gen::container<std::vector<bool>>(scene.models.size(), rc::gen::arbitrary<bool>());
  const SceneWorld world(scene);
  BruteForceBroadPhase phase;
  world.prepare(phase);
  phase.setStrategy(strategy);
  phase.beginBroadPhase();
  SceneSpec soFar = scene;
  soFar.models.clear();
  for (std::size_t i = 0; i < scene.models.size(); ++i) {
    phase.addCollisionModel(world.models()[i]);
    soFar.models.push_back(scene.models[i]);
    if (!reads[i]) continue;
    RC_ASSERT(world.indices(phase.getCollisionModelPairs()) == world.firstPlaces(test::sceneOracle(soFar)));
  }
  phase.endBroadPhase();
  RC_ASSERT(world.indices(phase.getCollisionModelPairs()) == world.firstPlaces(test::sceneOracle(scene)));
}

RC_GTEST_PROP(BroadPhaseProperty, SecondStepsAreNotTouchedByWhatCameBefore, ()) {
  const SceneSpec first = *test::anyScene();
  const SceneSpec second = *test::anyScene();
  const SceneWorld firstWorld(first);
  const SceneWorld secondWorld(second);
  BruteForceBroadPhase phase;
  for (const SceneWorld* world : {&firstWorld, &secondWorld, &firstWorld}) {
    world->prepare(phase);
    phase.beginBroadPhase();
    RC_ASSERT(phase.getCollisionModelPairs().empty());
    phase.addCollisionModels(world->models());
    phase.endBroadPhase();
    const SceneSpec& scene = world == &firstWorld ? first : second;
    RC_ASSERT(world->indices(phase.getCollisionModelPairs()) == world->firstPlaces(test::sceneOracle(scene)));
  }
}

/// The library's own path and the virtual one give the same: a scene of BoxModels, and of a user's models like them.
RC_GTEST_PROP(BroadPhaseProperty, UserTypesThatChangeNothingChangeNothing, ()) {
  SceneSpec scene = *test::anyScene();
  for (test::ModelSpec& model : scene.models) model.kind = test::Kind::Library;
  if (scene.method == test::Method::UserBounded) scene.method = test::Method::Proximity;
  const std::vector<IndexPair> ours = detectAtOnce(SceneWorld(scene), Strategy::Automatic);
  for (test::ModelSpec& model : scene.models) model.kind = test::Kind::User;
  if (scene.method == test::Method::Proximity) scene.method = test::Method::UserBounded;
  RC_ASSERT(detectAtOnce(SceneWorld(scene), Strategy::Automatic) == ours);
}

RC_GTEST_PROP(BroadPhaseProperty, RootsMayBeAddedInPlaceOfModels, ()) {
  const SceneSpec scene = *test::anyScene();
  const SceneWorld world(scene);
  BruteForceBroadPhase phase;
  world.prepare(phase);
  phase.beginBroadPhase();
  for (CollisionModel* model : world.models()) {
    if (model != nullptr && !model->hasBoundingTree()) model->computeBoundingTree(2);
    phase.addCollisionModel(model == nullptr ? nullptr : model->getFirst());
  }
  std::vector<collision::CollisionModelPair> pairs = phase.getCollisionModelPairs();
  for (auto& [first, second] : pairs) {
    RC_ASSERT(first == first->getFirst() && second == second->getFirst());
    first = first->getLast();
    second = second->getLast();
  }
  RC_ASSERT(world.indices(pairs) == world.firstPlaces(test::sceneOracle(scene)));
}

/// Of each two models, in the order in which they come, and of each with itself.
RC_GTEST_PROP(BroadPhaseProperty, AVerdictOnTwoModelsIsWhatTheListSays, ()) {
  SceneSpec scene = *test::anyScene();
  scene.models.resize(std::min<std::size_t>(scene.models.size(), 12));
  for (test::ModelSpec& model : scene.models) model.again = false;
  for (std::size_t i = 0; i < scene.models.size(); ++i) {
    SceneSpec alone = scene;
    for (std::size_t k = 0; k <= i; ++k) {
      alone.models = {scene.models[k]};
      if (k != i) alone.models.push_back(scene.models[i]);
      const SceneWorld world(alone);
      BruteForceBroadPhase phase;
      world.prepare(phase);
      const collision::PairVerdict verdict = phase.judge(world.models().back(), world.models().front());
      std::vector<IndexPair> pairs = test::sceneOracle(alone);
      if (k != i) std::erase_if(pairs, [](const IndexPair& pair) { return pair.first == pair.second; });
      RC_ASSERT(verdict.isPair() == !pairs.empty());
    }
  }
}

}  // namespace
}  // namespace allpairs
