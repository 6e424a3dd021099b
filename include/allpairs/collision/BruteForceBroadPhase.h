// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Executor.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/collision/BroadPhaseDetection.h"

namespace allpairs::collision {

/// What a step of the broad phase did.
struct BroadPhaseStatistics {
  std::uint64_t models = 0;           ///< Models that took part: not null, not empty, not outside of the region.
  std::uint64_t pairs = 0;            ///< Pairs found, self pairs included.
  std::uint64_t candidates = 0;       ///< Pairs of models whose rules were asked.
  std::uint64_t testsMade = 0;        ///< Tests of two boxes, or of the bounds of two groups of them.
  std::uint64_t testsOfAllPairs = 0;  ///< What the double loop makes: n(n-1)/2.
};

/// BruteForceBroadPhase::verify() found a pair that one strategy gives and the other doesn't, or gives elsewhere.
class VerificationError : public Error {
 public:
  using Error::Error;
};

/// Collision detection using extensive pair-wise tests: every pair of models is tested, by the boxes at their roots.
///
/// Each model that is added is tested against all that were added before it in the step. The result is that of the
/// double loop, pair by pair in its order and orientation, whatever the strategy: (1,0) (2,0) (2,1) (3,0) … for models
/// that all overlap, with (m,m) before the others of m if m may touch itself. A model's root box, flags, groups,
/// distance and owner are read when it is added; it must not change otherwise before the result is read. A model that
/// has no bounding tree, or whose positions were set since, gets its root computed then (of a continuous method too:
/// without a step there is no motion).
///
/// Geometry:  closed boxes, per axis, in double, as allpairs::overlap() with the method's distance.
/// Bad input: a root box with a NaN throws InvalidBox that names the model; a missing method throws InvalidArgument.
///            Null and empty models are ignored.
/// Cost:      that of allpairs::OverlapSearch on the root boxes, and the rules for each pair that overlaps; where few models
///            have moved since the last step, that of allpairs::World, which follows what has changed, instead
///            (docs/decisions/0013); n(n-1)/2 calls of the rules with Strategy::Exhaustive, or if the method can't
///            bound its distance. Steps like those before allocate nothing.
/// Threads:   one step at a time per object; the search runs on the executor, rules and intersectors are called from
///            the calling thread.
/// Memory:    after a call that threw, std::bad_alloc or what a model or method throws included, the list of pairs is the
///            one before it, reading it tries again, and the next step gives what a new object gives.
/// Callbacks: models and methods may use other objects; they must not call the broad phase that asks them.
class BruteForceBroadPhase : public BroadPhaseDetection {
 public:
  BruteForceBroadPhase();
  ~BruteForceBroadPhase() override;

  /// Reads the region.
  ///
  /// Bad input: a box with a NaN, or one that does not have min < max on every axis, throws InvalidArgument.
  void init() override;

  /// Reads the region again.
  void reinit() override;

  void beginBroadPhase() override;
  void addCollisionModel(core::CollisionModel* cm) override;
  void addCollisionModels(std::span<core::CollisionModel* const> models) override;
  void endBroadPhase() override;
  [[nodiscard]] const std::vector<CollisionModelPair>& getCollisionModelPairs() override;

  /// Whether each of the two models lets the other collide with it. Null collides with nothing.
  [[nodiscard]] static bool keepCollisionBetween(core::CollisionModel* cm1, core::CollisionModel* cm2);

  /// False: roots are enough.
  [[nodiscard]] bool needsDeepBoundingTree() const override { return false; }

  /// The region that models must touch to take part; read by init() and reinit().
  void setBox(const Vec3& min, const Vec3& max);
  void setBox(const Box& box);
  void clearBox();
  [[nodiscard]] const std::optional<Box>& getBox() const;

  /// How pairs are found; every strategy gives the same list. Exhaustive is the plain double loop: n(n-1)/2 pairs are
  /// asked one by one through the virtual calls, as models are added. May change between steps.
  void setStrategy(Strategy strategy);
  [[nodiscard]] Strategy getStrategy() const;

  /// Whether Strategy::Automatic keeps boxes and pairs from one step to the next, as it does by default: a scene of which
  /// little moves then costs what moves. It changes no result, and takes up to 200 bytes a model and 70 a pair.
  void setKeepsSearch(bool keeps);
  [[nodiscard]] bool getKeepsSearch() const;

  /// Where the search runs in parallel; null means on the calling thread. Not owned.
  void setExecutor(Executor* executor);

  /// What was done since beginBroadPhase(); complete when the list of pairs is.
  [[nodiscard]] const BroadPhaseStatistics& statistics() const;

  /// Does the step's work again with the plain double loop and throws VerificationError, naming the first pair that
  /// differs, if the list is not the same. Cost: n(n-1)/2 calls of the rules.
  void verify();

 protected:
  /// Whether a model can collide with itself, by its flags and by its intersector.
  [[nodiscard]] bool doesSelfCollide(core::CollisionModel* cm);

  /// Whether a model touches the region; true if the method can't tell.
  [[nodiscard]] bool intersectWithBoxModel(core::CollisionModel* cm);

 private:
  struct State;
  std::unique_ptr<State> m_state;
};

}  // namespace allpairs::collision
