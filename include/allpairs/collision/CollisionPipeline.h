// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "allpairs/collision/BroadPhaseDetection.h"
#include "allpairs/collision/NarrowPhaseDetection.h"

namespace allpairs::collision {

/// One step of collision detection after the other: reset, bounding trees, broad phase, narrow phase.
///
/// Nothing is owned: models, method and phases must outlive their use.
class CollisionPipeline {
 public:
  /// How many levels deep bounding trees are made, if anybody needs them.
  static constexpr int kDefaultDepth = 6;

  void setIntersectionMethod(Intersection* method);
  void setBroadPhase(BroadPhaseDetection* broadPhase);

  /// Null, the default, leaves the narrow phase out.
  void setNarrowPhase(NarrowPhaseDetection* narrowPhase);

  /// Bad input: a negative depth throws InvalidArgument.
  void setDepth(int depth);

  /// Gives both phases the method and has the broad phase read its settings. The first of the calls below does it where
  /// it has not been done since the last of the calls above.
  ///
  /// Bad input: a missing method or broad phase throws InvalidArgument.
  void init();

  /// Forgets the last step.
  void reset();

  /// Makes the bounding trees of the active models: of those that move in each step, of the others when they have none.
  /// Deep only if the broad or the narrow phase needs it; over a step of length dt if the method is continuous.
  void computeBoundingTrees(std::span<CollisionModel* const> models, double dt = 0.0);

  /// Runs broad and narrow phase on the models whose bounding trees were made.
  void detect();

  /// All of it: reset, bounding trees, both phases. The pairs are those of the broad phase.
  const std::vector<CollisionModelPair>& step(std::span<CollisionModel* const> models, double dt = 0.0);

 private:
  void computeBoundingTree(CollisionModel& model, double dt, int depth) const;
  void initOnce();

  Intersection* m_method = nullptr;
  BroadPhaseDetection* m_broadPhase = nullptr;
  NarrowPhaseDetection* m_narrowPhase = nullptr;
  int m_depth = kDefaultDepth;
  bool m_initialised = false;
  std::vector<CollisionModel*> m_active;
};

}  // namespace allpairs::collision
