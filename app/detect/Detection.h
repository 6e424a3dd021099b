// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/Executor.h"
#include "allpairs/Overlaps.h"
#include "allpairs/scene/BoxArray.h"
#include "allpairs/scene/Scene.h"
#include "allpairs/scene/WriteResult.h"

namespace allpairs::app {

/// How pairs are looked for, as the command line says.
struct DetectionOptions {
  std::optional<double> distance;
  std::optional<Box> region;
  double leastDepth = 0.0;  ///< Of shapes: what reaches no deeper into each other touches.
  double clearance = 0.0;  ///< Of shapes: boxes that are up to this far apart are candidates, whatever the distance is.
  Strategy strategy = Strategy::Automatic;
  std::size_t threads = 0;  ///< 0: as many as the machine runs at once.
  bool verify = false;
  std::span<const std::uint32_t> groups{};  ///< Of boxes: two of the same group are no pair.
};

/// The pairs of one detection. `pairs` lies in the memory of one of the members below it.
struct Detection {
  std::span<const Pair> pairs{};
  bool swapped = false;  ///< The pairs are to be read second first: newest model first.
  scene::DetectionStatistics statistics{};
  std::vector<scene::PipelineRecord> pipelines{};  ///< Of a scene that has several.
  std::unique_ptr<OverlapSearch> search{};
  std::vector<Pair> ownPairs{};
};

/// In which orientation and order the pairs of box arrays are wanted.
enum class BoxPairOrder : std::uint8_t {
  FirstBelowSecond,  ///< (first, second) with first < second, ascending: what .npy files hold.
  NewestFirst,       ///< As of collision models: for each box, in turn, its pairs with those before it.
};

/// The overlapping pairs of boxes, straight from the engine.
///
/// Bad input: with options.verify, strategies that disagree throw collision::VerificationError.
[[nodiscard]] Detection detectBoxes(const scene::BoxArray& boxes, BoxPairOrder order, const DetectionOptions& options);

/// The pairs of a scene's models that may touch, as the pipeline finds them. The distance replaces the method's alarm
/// distance, and the region that of the scene.
///
/// Bad input: with options.verify, strategies that disagree throw collision::VerificationError.
[[nodiscard]] Detection detectScene(scene::Scene& scene, const DetectionOptions& options);

/// Gives a scene the distance and the region of the command line, where they are given.
void apply(const DetectionOptions& options, scene::Scene& scene);

/// The strategy of a word of --strategy: auto, exhaustive or bvh.
[[nodiscard]] Strategy strategyOf(const std::string& name);

/// The word for a strategy on the command line.
[[nodiscard]] std::string strategyName(Strategy strategy);

/// What the engine is asked for where models are boxes.
[[nodiscard]] OverlapOptions overlapOptions(const DetectionOptions& options, Executor* executor);

/// An executor for that many threads if there is enough work for them; else null.
[[nodiscard]] std::unique_ptr<Executor> makeExecutor(std::size_t threads, std::size_t models);

}  // namespace allpairs::app
