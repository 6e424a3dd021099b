// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "allpairs/Span.h"
#include "allpairs/collision/ExactPair.h"
#include "allpairs/collision/NarrowPhaseDetection.h"

namespace allpairs {

/// Settings of FclNarrowPhase.
struct ExactOptions {
  /// Surfaces count as meeting if they are no further apart, and as overlapping if they reach deeper, than this part of
  /// the larger of the two models' greatest extents. A billionth: what is left of a double after some arithmetic.
  double tolerance = 1e-9;

  /// Models count as the same shape in the same place if no point of either surface is further from the other's than
  /// this part of that extent. A millionth: what float32 leaves of coordinates that were the same once.
  double duplicateTolerance = 1e-6;

  /// Models that are apart by no more are WithinClearance.
  double clearance = 0.0;

  /// Models that reach into each other no deeper, and of which neither holds the other, are Touching: fits, and the
  /// facets of round parts.
  double leastDepth = 0.0;

  /// The maximum number of contact points, and of contact lines, of a pair.
  std::size_t contactLimit = 16;
  std::size_t lineLimit = 0;
};

/// A narrow phase that tests pairs of models by their shapes with the Flexible Collision Library.
///
/// Triangle, tetrahedron (by their boundary), line and point models, boxes, spheres and capsules, and what derives from
/// one of these; a model of any other type is NotExamined. Each model's hierarchy is built when it is first in a pair,
/// once in a step.
/// Geometry:  a mesh whose triangles close (each edge is shared by as many one way as the other, or by an even number
///            of them) is a solid, with holes where inner surfaces face inward; any other mesh is a surface without
///            volume, of which nothing is guessed: whether it encloses another model is Undecided. Where models stand
///            now: contact distances and velocities play no part. The depth of meshes and boxes is never more than
///            the true one, equal to it where a vertex or a flat face is deepest, and else no less than 0.99 of it,
///            unless that takes more than 500 measures of each model, or what is measured first is below a millionth
///            of the extent. Of balls and capsules it is that of their cores plus the radii, and may be more: of two,
///            the radii less the distance of the cores; of one whose core lies in a solid, the core's depth plus the
///            radius, however far the solid goes on.
/// Bad input: a null model throws InvalidArgument; options that are negative or NaN too.
/// Cost:      per pair, a search for where the two meet or are nearest, and for a pair that meets a distance for each
///            vertex that lies in the other, and up to 1,000 more. In models of many spheres, capsules or boxes, a
///            pair of these is looked at only if its boxes are no further apart than the nearest pair. If most are as
///            near as that, or triangles are long and lie across the axes, the time grows with the product of their
///            numbers. The memory grows with the parts, and with the pairs of parts that meet.
/// Threads:   one step at a time per object; the search for inner points runs on the calling thread.
/// Memory:    addCollisionPair() that throws std::bad_alloc leaves the pairs as they were.
class FclNarrowPhase : public collision::NarrowPhaseDetection {
 public:
  explicit FclNarrowPhase(const ExactOptions& options = {});
  ~FclNarrowPhase() override;

  void beginNarrowPhase() override;
  void addCollisionPair(const collision::CollisionModelPair& pair) override;
  [[nodiscard]] bool needsDeepBoundingTree() const override { return false; }

  /// The pairs of this step, as they were added.
  [[nodiscard]] Span<const ExactPair> pairs() const;

 private:
  struct State;
  std::unique_ptr<State> m_state;
};

}  // namespace allpairs
