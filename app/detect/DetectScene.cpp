// SPDX-License-Identifier: MIT
#include <algorithm>
#include <unordered_map>

#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/collision/CollisionPipeline.h"
#include "cli/Timer.h"
#include "detect/Detection.h"

namespace allpairs::app {
namespace {

using collision::CollisionModel;

/// Appends pairs by the indices of their models, which a pair may name by any level.
void append(const std::vector<collision::CollisionModelPair>& pairs, const scene::SceneSearch& search,
            std::vector<Pair>& to) {
  std::unordered_map<const CollisionModel*, std::uint32_t> indices;
  for (std::size_t i = 0; i < search.models.size(); ++i)
    indices.emplace(search.models[i]->getLast(), static_cast<std::uint32_t>(search.indices[i]));
  to.reserve(to.size() + pairs.size());
  for (const auto& [first, second] : pairs) to.push_back({indices.at(first->getLast()), indices.at(second->getLast())});
}

void applyTo(collision::Intersection& method, const DetectionOptions& options) {
  if (options.distance) method.setAlarmDistance(*options.distance);
  if (options.clearance > 0.0 && options.clearance > method.getAlarmDistance())
    method.setAlarmDistance(options.clearance);
}

/// Runs one search, adds its pairs to the detection and its work to the statistics.
void run(const scene::SceneSearch& search, double timeStep, const DetectionOptions& options, Detection& detection) {
  const std::unique_ptr<Executor> executor = makeExecutor(options.threads, search.models.size());
  collision::BruteForceBroadPhase broadPhase;
  if (search.region) broadPhase.setBox(*search.region);
  broadPhase.setStrategy(options.strategy);
  broadPhase.setExecutor(executor.get());
  collision::CollisionPipeline pipeline;
  pipeline.setIntersectionMethod(search.intersection);
  pipeline.setBroadPhase(&broadPhase);
  pipeline.init();

  scene::DetectionStatistics& statistics = detection.statistics;
  const Timer timer;
  const auto& pairs = pipeline.step(search.models, timeStep);
  statistics.detectSeconds += timer.seconds();
  if (options.verify) broadPhase.verify();
  append(pairs, search, detection.ownPairs);
  statistics.threads = std::max<std::size_t>(statistics.threads, executor ? executor->concurrency() : 1);
  statistics.testsOfAllPairs += broadPhase.statistics().testsOfAllPairs;
  statistics.testsMade += broadPhase.statistics().testsMade;
  statistics.candidates += broadPhase.statistics().candidates;
}

}  // namespace

void apply(const DetectionOptions& options, scene::Scene& scene) {
  applyTo(*scene.intersection, options);
  if (options.region) scene.region = options.region;
  for (scene::ScenePipeline& pipeline : scene.pipelines) {
    applyTo(*pipeline.intersection, options);
    if (options.region) pipeline.region = options.region;
  }
}

Detection detectScene(scene::Scene& scene, const DetectionOptions& options) {
  apply(options, scene);
  Detection detection;
  const std::vector<scene::SceneSearch> searches = scene::searchesOf(scene);
  for (std::size_t i = 0; i < searches.size(); ++i) {
    const std::size_t before = detection.ownPairs.size();
    run(searches[i], scene.timeStep, options, detection);
    if (scene.pipelines.empty()) continue;
    detection.pipelines.push_back({.name = scene.pipelines[i].name,
                                   .method = std::string(searches[i].intersection->typeName()),
                                   .distance = searches[i].intersection->getAlarmDistance(),
                                   .region = searches[i].region,
                                   .models = searches[i].indices,
                                   .pairs = detection.ownPairs.size() - before});
  }
  detection.pairs = detection.ownPairs;
  detection.statistics.strategy = strategyName(options.strategy);
  detection.statistics.distance = scene.intersection->getAlarmDistance();
  detection.statistics.verified = options.verify;
  return detection;
}

}  // namespace allpairs::app
