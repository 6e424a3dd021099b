// SPDX-License-Identifier: MIT
// The eight methods of the seed, by name, signature and access. Most of this test is that it compiles.
#include <gtest/gtest.h>

#include <type_traits>

#include "Fixture.h"

namespace allpairs {
namespace {

using collision::BroadPhaseDetection;
using collision::BruteForceBroadPhase;

static_assert(std::is_base_of_v<BroadPhaseDetection, BruteForceBroadPhase>);
static_assert(std::is_same_v<core::CollisionModel, collision::CollisionModel>);
static_assert(std::is_same_v<decltype(&BruteForceBroadPhase::init), void (BruteForceBroadPhase::*)()>);
static_assert(std::is_same_v<decltype(&BruteForceBroadPhase::reinit), void (BruteForceBroadPhase::*)()>);
static_assert(std::is_same_v<decltype(&BruteForceBroadPhase::beginBroadPhase), void (BruteForceBroadPhase::*)()>);
static_assert(std::is_same_v<decltype(&BruteForceBroadPhase::addCollisionModel),
                             void (BruteForceBroadPhase::*)(core::CollisionModel*)>);
static_assert(
    std::is_same_v<decltype(&BruteForceBroadPhase::needsDeepBoundingTree), bool (BruteForceBroadPhase::*)() const>);
static_assert(std::is_same_v<decltype(&BruteForceBroadPhase::keepCollisionBetween),
                             bool (*)(core::CollisionModel*, core::CollisionModel*)>,
              "static");

template <class T>
concept ShowsProtectedMethods = requires(T& phase, core::CollisionModel* cm) { phase.doesSelfCollide(cm); } ||
                                requires(T& phase, core::CollisionModel* cm) { phase.intersectWithBoxModel(cm); };
static_assert(!ShowsProtectedMethods<BruteForceBroadPhase>);

/// Overrides what is virtual and reaches what is protected.
class Derived : public BruteForceBroadPhase {
 public:
  void init() override { ++inits; }
  void reinit() override { ++reinits; }
  void beginBroadPhase() override { ++begins; }
  void addCollisionModel(core::CollisionModel* /*cm*/) override { ++additions; }
  [[nodiscard]] bool needsDeepBoundingTree() const override { return true; }

  bool selfCollides(core::CollisionModel* cm) { return doesSelfCollide(cm); }
  bool inRegion(core::CollisionModel* cm) { return intersectWithBoxModel(cm); }

  static_assert(
      std::is_same_v<decltype(&Derived::doesSelfCollide), bool (BruteForceBroadPhase::*)(core::CollisionModel*)>);
  static_assert(
      std::is_same_v<decltype(&Derived::intersectWithBoxModel), bool (BruteForceBroadPhase::*)(core::CollisionModel*)>);

  int inits = 0;
  int reinits = 0;
  int begins = 0;
  int additions = 0;
};

TEST(SeedInterface, VirtualMethodsAreCalledThroughTheBaseClass) {
  Derived derived;
  BroadPhaseDetection& base = derived;
  base.init();
  base.reinit();
  base.beginBroadPhase();
  base.addCollisionModel(nullptr);
  EXPECT_TRUE(base.needsDeepBoundingTree());
  EXPECT_EQ(derived.inits + derived.reinits + derived.begins + derived.additions, 4);
}

TEST(SeedInterface, TheBroadPhaseNeedsNoDeepTreeAndABroadPhaseInGeneralDoes) {
  EXPECT_FALSE(BruteForceBroadPhase().needsDeepBoundingTree());
  EXPECT_TRUE(BruteForceBroadPhase().BroadPhaseDetection::needsDeepBoundingTree());
}

TEST(SeedInterface, ProtectedMethodsAnswerForADerivedClass) {
  collision::MinProximityIntersection method;
  collision::BoxModel model("m", test::unitBoxAt(0.0));
  model.computeBoundingTree();
  Derived derived;
  derived.setIntersectionMethod(&method);
  EXPECT_FALSE(derived.selfCollides(&model));
  model.setSelfCollision(true);
  EXPECT_TRUE(derived.selfCollides(&model));
  EXPECT_TRUE(derived.inRegion(&model)) << "without a region";
  derived.setBox({5.0, 5.0, 5.0}, {6.0, 6.0, 6.0});
  derived.BruteForceBroadPhase::reinit();
  EXPECT_FALSE(derived.inRegion(&model));
}

}  // namespace
}  // namespace allpairs
