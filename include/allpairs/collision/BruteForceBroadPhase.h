// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Executor.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Span.h"
#include "allpairs/StopFlag.h"
#include "allpairs/collision/BroadPhaseDetection.h"
#include "allpairs/collision/PairVerdict.h"

namespace allpairs::collision {

/// Statistics of a step of the broad phase.
struct BroadPhaseStatistics {
  std::uint64_t models = 0;           ///< Models that took part: not null, not empty, not outside the region.
  std::uint64_t pairs = 0;            ///< Pairs found, self pairs included.
  std::uint64_t candidates = 0;       ///< Pairs of models to which the rules were applied.
  std::uint64_t testsMade = 0;        ///< Tests of two boxes, or of the bounds of two groups of boxes.
  std::uint64_t testsOfAllPairs = 0;  ///< Tests of the double loop: n(n-1)/2.
};

/// Thrown by BruteForceBroadPhase::verify(): a pair is missing from one of the two lists, or at another position.
class VerificationError : public Error {
 public:
  using Error::Error;
};

/// Collision detection using extensive pair-wise tests: every pair of models is tested, by the boxes at their roots.
///
/// Each model that is added is tested against all that were added before it in the step. The result is that of the
/// double loop, pair by pair in its order and orientation, whatever the strategy: (1,0) (2,0) (2,1) (3,0) … for models
/// that all overlap, with (m,m) before the others of m if m may touch itself. A model's root box, flags, groups,
/// distance and owner are read when it is added, and again for each of its pairs by Strategy::Exhaustive and verify();
/// the rest of it must not change before the result is read. If a model has no bounding tree, or its positions were set
/// since, its root is computed then (without motion, also with a continuous method); where it was given by a level
/// above the elements, its pairs name the new root.
///
/// Geometry:  closed boxes, per axis, in double, as allpairs::overlap() with the method's distance.
/// Bad input: a root box with a NaN throws InvalidBox, which names the model; a missing method throws InvalidArgument.
///            Null and empty models are ignored.
/// Cost:      that of allpairs::OverlapSearch on the root boxes, plus the rules for each pair that overlaps; if few
///            models have moved since the last step, that of allpairs::World, which updates what has changed, instead
///            (docs/decisions/0013); n(n-1)/2 calls of the rules with Strategy::Exhaustive, or if the method cannot
///            bound its distance. In a steady state nothing is allocated.
/// Threads:   one step at a time per object; the search runs on the executor, rules and intersectors are called from
///            the calling thread.
/// Memory:    after a call that threw, whether std::bad_alloc or an exception of a model or method, reading the list of
///            pairs tries again, no pair comes twice, and the next step behaves like that of a new object. Of
///            addCollisionModels(), the models before the one that threw have been added; with Strategy::Exhaustive
///            also one whose addition threw for one of its pairs.
/// Callbacks: models and methods may use other objects; they must not call the broad phase that calls them.
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
  void addCollisionModels(Span<core::CollisionModel* const> models) override;
  void endBroadPhase() override;
  [[nodiscard]] const std::vector<CollisionModelPair>& getCollisionModelPairs() override;

  /// Whether each of the two models agrees to collide with the other. Null collides with nothing.
  [[nodiscard]] static bool keepCollisionBetween(core::CollisionModel* cm1, core::CollisionModel* cm2);

  /// False: roots are enough.
  [[nodiscard]] bool needsDeepBoundingTree() const override { return false; }

  /// The region that models must overlap to take part; read by init() and reinit().
  void setBox(const Vec3& min, const Vec3& max);
  void setBox(const Box& box);
  void clearBox();
  [[nodiscard]] const std::optional<Box>& getBox() const;

  /// The strategy; every strategy gives the same list. Exhaustive is the plain double loop: n(n-1)/2 pairs are
  /// tested one by one through virtual calls, as models are added. May change between steps.
  void setStrategy(Strategy strategy);
  [[nodiscard]] Strategy getStrategy() const;

  /// Whether Strategy::Automatic keeps boxes and pairs between steps; on by default. The cost of a step then depends on
  /// how many models move. The result does not change; memory is up to 300 bytes per model and 70 per pair.
  void setKeepsSearch(bool keeps);
  [[nodiscard]] bool getKeepsSearch() const;

  /// Runs the search in parallel; null means on the calling thread. Not owned.
  void setExecutor(Executor* executor);

  /// A flag that ends steps and verify() with Stopped soon after it is set; null, the default, means none. Not owned.
  /// What the broad phase holds then is as after any other exception.
  void setStop(const StopFlag* stop);

  /// Statistics since beginBroadPhase(); complete when the list of pairs is.
  [[nodiscard]] const BroadPhaseStatistics& statistics() const;

  /// Repeats the step with the plain double loop and throws VerificationError, which names the first pair that
  /// differs, if the lists are not equal. A method that is missing, or that was changed or exchanged since the first
  /// model of the step, throws InvalidArgument. Cost: n(n-1)/2 calls of the rules.
  void verify();

  /// Whether two models are a pair, and which rule says no: as of a step in which both are added, `older` first, by the
  /// rules of verify(). For a model and itself: whether it has a pair with itself. What the step has found stays.
  ///
  /// Bad input: as of addCollisionModel().
  [[nodiscard]] PairVerdict judge(core::CollisionModel* newer, core::CollisionModel* older);

 protected:
  /// Whether a model can collide with itself, by its flags and by its intersector.
  [[nodiscard]] bool doesSelfCollide(core::CollisionModel* cm);

  /// Whether a model overlaps the region; true if the method has no such test.
  [[nodiscard]] bool intersectWithBoxModel(core::CollisionModel* cm);

 private:
  struct State;

  /// Adds a model to a step, or says what keeps it out.
  PairRule add(State& step, core::CollisionModel* cm);

  /// What keeps a model from being a pair with itself.
  [[nodiscard]] PairRule selfRule(core::CollisionModel* cm) const;

  std::unique_ptr<State> m_state;
};

}  // namespace allpairs::collision
