// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "allpairs/Span.h"
#include "allpairs/collision/CollisionModel.h"
#include "allpairs/collision/Intersection.h"

namespace allpairs::collision {

/// Two models that may touch, each at the level at which it was added; the same model twice if it may touch itself.
using CollisionModelPair = std::pair<CollisionModel*, CollisionModel*>;

/// A broad phase: finds the pairs of collision models that need a closer test.
///
/// A step is beginBroadPhase(), any number of additions, endBroadPhase(). Models and methods are not owned, and
/// must outlive the use of the result.
class BroadPhaseDetection {
 public:
  BroadPhaseDetection() = default;
  BroadPhaseDetection(const BroadPhaseDetection&) = delete;
  BroadPhaseDetection& operator=(const BroadPhaseDetection&) = delete;
  BroadPhaseDetection(BroadPhaseDetection&&) = delete;
  BroadPhaseDetection& operator=(BroadPhaseDetection&&) = delete;
  virtual ~BroadPhaseDetection() = default;

  /// Reads the settings, once, before the first step.
  virtual void init() {}

  /// Reads the settings again.
  virtual void reinit() {}

  /// The intersection method. Not owned. With null, the default, adding a model throws InvalidArgument.
  virtual void setIntersectionMethod(Intersection* method) { m_intersectionMethod = method; }
  [[nodiscard]] Intersection* getIntersectionMethod() const { return m_intersectionMethod; }

  /// Starts a step: the list of pairs is empty afterwards.
  virtual void beginBroadPhase() = 0;

  /// Adds one model, by any of its levels. Computing its bounding tree, where that is not current, may destroy the
  /// levels between its root and its elements: a model that is added twice, also by one list, must be given by one of
  /// these two.
  virtual void addCollisionModel(core::CollisionModel* cm) = 0;

  /// Adds several models, in order.
  virtual void addCollisionModels(Span<core::CollisionModel* const> models) {
    for (core::CollisionModel* model : models) addCollisionModel(model);
  }

  /// Ends a step: the list of pairs is complete afterwards.
  virtual void endBroadPhase() {}

  /// The pairs among the models that were added so far in this step. Valid until the next addition or step.
  [[nodiscard]] virtual const std::vector<CollisionModelPair>& getCollisionModelPairs() = 0;

  /// Whether models must have levels of boxes below their roots.
  [[nodiscard]] virtual bool needsDeepBoundingTree() const { return true; }

 private:
  Intersection* m_intersectionMethod = nullptr;
};

}  // namespace allpairs::collision
