// SPDX-License-Identifier: MIT
#pragma once

#if __cplusplus < 202002L
#error "allpairs::FclNarrowPhase needs C++20: compile with -std=c++20, or link a CMake target with allpairs::fcl"
#else

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/collision/NarrowPhaseDetection.h"
#include "allpairs/collision/Vec3.h"

namespace allpairs {

/// The relation of two models, by their shapes instead of their boxes.
enum class ExactState : std::uint8_t {
  Apart,        ///< They are disjoint.
  Touching,     ///< Their surfaces intersect without penetration; or neither encloses a volume.
  Overlapping,  ///< They share volume, and their surfaces intersect.
  Contained,    ///< One lies within the other's volume, and their surfaces do not intersect.
  NotExamined,  ///< A model with itself, or of an unsupported type.
};

/// Whether the models touch in any way: a clash or a contact.
[[nodiscard]] constexpr bool isContact(ExactState state) noexcept {
  return state == ExactState::Touching || state == ExactState::Overlapping || state == ExactState::Contained;
}

/// Two models, looked at closely. Lengths are in the units of the models.
struct ExactPair {
  collision::CollisionModel* first = nullptr;
  collision::CollisionModel* second = nullptr;
  ExactState state = ExactState::NotExamined;

  /// Their Euclidean distance; 0 if they touch.
  double distance = 0.0;

  /// How far the deepest point found of one lies below the other's surface; 0 if they only touch. Empty if depth is
  /// undefined: for surfaces that enclose no volume.
  std::optional<double> depth{};

  /// Apart: the nearest point of each. Else: the deepest point, and the point of the other's surface nearest to it.
  collision::Vec3 pointOnFirst{};
  collision::Vec3 pointOnSecond{};

  /// A unit vector: the direction in which to move the first to separate them; if they are apart, away from the second.
  collision::Vec3 normal{};

  /// The number of pairs of elements (triangles, segments, points, balls) that intersect; 0 for a Contained pair.
  std::uint64_t contactCount = 0;

  /// Contact points: one for each intersecting pair of elements, evenly sampled if there are more than the limit.
  std::vector<collision::Vec3> contactPoints{};

  /// The box around all contact points, sampled or not; empty without any.
  Box contactBox = kEmptyBox;
};

/// Settings of FclNarrowPhase.
struct ExactOptions {
  /// Surfaces count as meeting if they are no further apart, and as overlapping if they reach deeper, than this part of
  /// the larger of the two models' greatest extents. A billionth: what is left of a double after some arithmetic.
  double tolerance = 1e-9;

  /// The maximum number of contact points of a pair.
  std::size_t contactLimit = 16;
};

/// A narrow phase that tests pairs of models by their shapes with the Flexible Collision Library.
///
/// Triangle, tetrahedron (by their boundary), line and point models, boxes, spheres and capsules; a model of the user's
/// own type is NotExamined. Each model's hierarchy is built when it is first in a pair, once in a step.
/// Geometry:  a mesh whose triangles close (each edge is shared by as many one way as the other, or by an even number
///            of them) is a solid, with holes where inner surfaces face inward; any other mesh is a surface without
///            volume. Where models stand now: contact distances and velocities play no part. The depth is that of the
///            deepest of the vertices, and of the middles of edges and triangles, of what lies in the other's box:
///            never more than the true one, and equal to it where a vertex or a flat face is deepest.
/// Bad input: a null model throws InvalidArgument; options that are negative or NaN too.
/// Cost:      per pair, FCL's distance or collision of the two, and for a pair that meets a distance for each vertex
///            that lies in the other.
/// Threads:   one step at a time per object; the search for inner points runs on the calling thread.
class FclNarrowPhase : public collision::NarrowPhaseDetection {
 public:
  explicit FclNarrowPhase(const ExactOptions& options = {});
  ~FclNarrowPhase() override;

  void beginNarrowPhase() override;
  void addCollisionPair(const collision::CollisionModelPair& pair) override;
  [[nodiscard]] bool needsDeepBoundingTree() const override { return false; }

  /// The pairs of this step, as they were added.
  [[nodiscard]] std::span<const ExactPair> pairs() const;

 private:
  struct State;
  std::unique_ptr<State> m_state;
};

}  // namespace allpairs

#endif
