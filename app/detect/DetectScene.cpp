// SPDX-License-Identifier: MIT
#include <unordered_map>

#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/collision/CollisionPipeline.h"
#include "cli/Timer.h"
#include "detect/Detection.h"

namespace allpairs::app {
namespace {

using collision::CollisionModel;

/// Models by their last levels, since a pair may name them by any level.
std::vector<Pair> indexed(const std::vector<collision::CollisionModelPair>& pairs,
                          const std::vector<CollisionModel*>& models) {
  std::unordered_map<const CollisionModel*, std::uint32_t> indices;
  for (std::uint32_t i = 0; i < models.size(); ++i) indices.emplace(models[i]->getLast(), i);
  std::vector<Pair> result;
  result.reserve(pairs.size());
  for (const auto& [first, second] : pairs) {
    result.push_back({indices.at(first->getLast()), indices.at(second->getLast())});
  }
  return result;
}

void configure(collision::BruteForceBroadPhase& broadPhase, scene::Scene& scene, const DetectionOptions& options,
               Executor* executor) {
  if (options.distance) scene.intersection->setAlarmDistance(*options.distance);
  if (options.region) scene.region = options.region;
  if (scene.region) broadPhase.setBox(*scene.region);
  broadPhase.setStrategy(options.strategy);
  broadPhase.setExecutor(executor);
}

}  // namespace

Detection detectScene(scene::Scene& scene, const DetectionOptions& options) {
  const std::unique_ptr<Executor> executor = makeExecutor(options.threads, scene.models.size());
  collision::BruteForceBroadPhase broadPhase;
  configure(broadPhase, scene, options, executor.get());
  collision::CollisionPipeline pipeline;
  pipeline.setIntersectionMethod(scene.intersection.get());
  pipeline.setBroadPhase(&broadPhase);
  pipeline.init();
  std::vector<CollisionModel*> models;
  for (const auto& model : scene.models) models.push_back(model.get());

  const Timer timer;
  const auto& pairs = pipeline.step(models, scene.timeStep);
  Detection detection{.statistics = {.detectSeconds = timer.seconds()}};
  if (options.verify) broadPhase.verify();
  detection.ownPairs = indexed(pairs, models);
  detection.pairs = detection.ownPairs;
  scene::DetectionStatistics& statistics = detection.statistics;
  statistics.strategy = strategyName(options.strategy);
  statistics.threads = executor ? executor->concurrency() : 1;
  statistics.distance = scene.intersection->getAlarmDistance();
  statistics.testsOfAllPairs = broadPhase.statistics().testsOfAllPairs;
  statistics.testsMade = broadPhase.statistics().testsMade;
  statistics.candidates = broadPhase.statistics().candidates;
  statistics.verified = options.verify;
  return detection;
}

}  // namespace allpairs::app
