// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "allpairs/Span.h"
#include "allpairs/collision/BroadPhaseDetection.h"
#include "allpairs/collision/NarrowPhaseDetection.h"

namespace allpairs::collision {

/// Runs the stages of collision detection: reset, bounding trees, broad phase, narrow phase.
///
/// Nothing is owned: models, method and phases must outlive their use.
class CollisionPipeline {
 public:
  /// The depth of bounding trees, if a phase needs them.
  static constexpr int kDefaultDepth = 6;

  void setIntersectionMethod(Intersection* method);
  void setBroadPhase(BroadPhaseDetection* broadPhase);

  /// Null, the default, skips the narrow phase.
  void setNarrowPhase(NarrowPhaseDetection* narrowPhase);

  /// Bad input: a negative depth throws InvalidArgument.
  void setDepth(int depth);

  /// Passes the method to both phases and makes the broad phase read its settings. The calls below do it if a call
  /// above was made since.
  ///
  /// Bad input: a missing method or broad phase throws InvalidArgument.
  void init();

  /// Clears the results of the last step.
  void reset();

  /// Whether a model takes part in a step: one that is active and has elements.
  [[nodiscard]] static bool takes(const CollisionModel* model);

  /// Computes the bounding trees of the active models: in each step for those that move, once for the others.
  /// Deep only if the broad or the narrow phase needs it; over a step of length dt if the method is continuous. A model
  /// may be given by any of its levels; one that is in the list twice, by its root or its elements.
  ///
  /// A model that does not move keeps the tree that it has, even if another phase, method or depth would make it
  /// another one: call its boundsChanged() after such a change.
  void computeBoundingTrees(Span<CollisionModel* const> models, double dt = 0.0);

  /// Runs broad and narrow phase on the models whose bounding trees were made.
  void detect();

  /// Runs all stages: reset, bounding trees, both phases. Returns the pairs of the broad phase.
  const std::vector<CollisionModelPair>& step(Span<CollisionModel* const> models, double dt = 0.0);

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
