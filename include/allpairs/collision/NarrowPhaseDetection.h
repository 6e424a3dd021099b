// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "allpairs/Executor.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Span.h"
#include "allpairs/collision/BroadPhaseDetection.h"

namespace allpairs::collision {

/// Two elements that may touch.
struct CollisionElementPair {
  CollisionElement first;
  CollisionElement second;

  friend bool operator==(const CollisionElementPair& a, const CollisionElementPair& b) {
    return a.first == b.first && a.second == b.second;
  }
  friend bool operator!=(const CollisionElementPair& a, const CollisionElementPair& b) { return !(a == b); }
};

/// A narrow phase: tests pairs of models more closely.
///
/// A step is beginNarrowPhase(), any number of additions, endNarrowPhase().
class NarrowPhaseDetection {
 public:
  NarrowPhaseDetection() = default;
  NarrowPhaseDetection(const NarrowPhaseDetection&) = delete;
  NarrowPhaseDetection& operator=(const NarrowPhaseDetection&) = delete;
  NarrowPhaseDetection(NarrowPhaseDetection&&) = delete;
  NarrowPhaseDetection& operator=(NarrowPhaseDetection&&) = delete;
  virtual ~NarrowPhaseDetection() = default;

  /// The intersection method. Not owned.
  virtual void setIntersectionMethod(Intersection* method) { m_intersectionMethod = method; }
  [[nodiscard]] Intersection* getIntersectionMethod() const { return m_intersectionMethod; }

  /// With a continuous method, elements are tested over a step of this length. 0, the default, means their current
  /// positions.
  ///
  /// Bad input: a number that is not finite throws InvalidArgument.
  void setTimeStep(double dt);
  [[nodiscard]] double getTimeStep() const { return m_dt; }

  virtual void beginNarrowPhase() = 0;
  virtual void addCollisionPair(const CollisionModelPair& pair) = 0;
  virtual void addCollisionPairs(Span<const CollisionModelPair> pairs) {
    for (const CollisionModelPair& pair : pairs) addCollisionPair(pair);
  }
  virtual void endNarrowPhase() {}

  /// Whether models must have levels of boxes below their roots.
  [[nodiscard]] virtual bool needsDeepBoundingTree() const { return true; }

 private:
  Intersection* m_intersectionMethod = nullptr;
  double m_dt = 0.0;
};

/// Finds the pairs of elements whose boxes are within the method's distance.
///
/// For two models in the order of the pair, or swapped if their intersector requires it; for a model with itself each
/// pair of elements once, lower index first. If the method has an intersector for the two models' types, its
/// canIntersect() is called for each pair.
///
/// Bad input: an element's box with a NaN throws InvalidBox, which names the model; a missing method or a
///            null model throws InvalidArgument.
/// Cost:      that of allpairs::OverlapSearch on the boxes of the elements, once per pair of models.
/// Threads:   one step at a time per object; the search runs on the executor.
/// Memory:    addCollisionPair() that throws, whether std::bad_alloc or an exception of an intersector, leaves the pairs
///            as they were; addCollisionPairs() leaves those of the pairs of models before that one.
class ElementNarrowPhase : public NarrowPhaseDetection {
 public:
  void beginNarrowPhase() override;
  void addCollisionPair(const CollisionModelPair& pair) override;
  [[nodiscard]] bool needsDeepBoundingTree() const override { return false; }

  /// The pairs of elements of this step, by pair of models as added, then by (first index, second index).
  [[nodiscard]] const std::vector<CollisionElementPair>& getElementPairs() const { return m_pairs; }

  /// Runs the search in parallel; null means on the calling thread. Not owned.
  void setExecutor(Executor* executor) { m_executor = executor; }

 private:
  void fillBoxes(const CollisionModel& model, std::vector<Box>& boxes) const;
  void report(CollisionModel* first, CollisionModel* second, Span<const Pair> found,
              const ElementIntersector* intersector);

  OverlapSearch m_search;
  Executor* m_executor = nullptr;
  std::vector<Box> m_firstBoxes;
  std::vector<Box> m_secondBoxes;
  std::vector<CollisionElementPair> m_pairs;
};

}  // namespace allpairs::collision
