// SPDX-License-Identifier: MIT
#pragma once

#include <coal/broadphase/broadphase_collision_manager.h>
#include <coal/broadphase/broadphase_dynamic_AABB_tree.h>
#include <coal/collision_object.h>

#include <limits>
#include <vector>

#include "allpairs/objects/HostManager.h"
#include "allpairs/objects/ObjectBroadPhase.h"

namespace allpairs {

/// Settings of CoalBroadPhaseManager: an executor, and whether the pairs of collide() are ordered.
using CoalBroadPhaseManagerOptions = ObjectBroadPhaseOptions;

/// Coal's types, for HostManager.
struct CoalHost {
  using Object = ::coal::CollisionObject;
  using Base = ::coal::BroadPhaseCollisionManager;
  using Tree = ::coal::DynamicAABBTreeCollisionManager;

  /// One by one: all at once, Coal refuses boxes that are flat.
  static void update(Tree& tree, const std::vector<Object*>& objects) { tree.Tree::update(objects); }
};

/// A broad phase for Coal, the successor of hpp-fcl: use it where you use a coal::DynamicAABBTreeCollisionManager.
///
/// It is to Coal what FclBroadPhaseManager is to FCL, with the same promises; docs/fcl.md has them. In short: callbacks
/// get the pairs whose boxes overlap, each once, first the object that was registered first, where an object takes the
/// place of one that left, in an order that is the same each time; a distance callback gets every pair whose boxes
/// overlap or are within the smallest distance that it has set so far. A callback that returns true ends the query; its
/// init() is called before each.
///
/// Objects stay the caller's. Their boxes are read when they are registered and by update(). Planes, half-spaces and
/// octrees count with their boxes, which may be infinite, as in coal::NaiveCollisionManager.
/// Other managers: a query takes any manager as the other. A DynamicAABBTreeCollisionManager takes this one as the
///            other; no other manager of Coal may, for each takes the other for one of its own kind without asking.
/// Geometry:  boxes are closed, in double precision. An empty box has no pairs and no distance; a flat one is a box.
/// Bad input: a box with a NaN throws InvalidBox: an object that comes with one is not registered, nor are those behind
///            it in registerObjects(); one that was keeps the box that it had, and update() reads all others. No object,
///            a null pointer, is none.
/// Cost:      nothing is searched before it is asked for, as in FclBroadPhaseManager.
/// Threads:   const members, queries, may be called concurrently, each with a callback of its own, while no other
///            member runs. A callback may query the manager, and must not register, update or unregister.
class CoalBroadPhaseManager : public HostManager<CoalHost> {
 public:
  using CollisionCallBack = ::coal::CollisionCallBackBase;
  using DistanceCallBack = ::coal::DistanceCallBackBase;
  using S = ::coal::CoalScalar;

  explicit CoalBroadPhaseManager(const CoalBroadPhaseManagerOptions& options = {}) : HostManager(options) {}

  void collide(Object* object, CollisionCallBack* callback) const override {
    callback->init();
    objects().eachOverlapping(*object, [&](Object* own) { return (*callback)(own, object); });
  }

  void distance(Object* object, DistanceCallBack* callback) const override {
    callback->init();
    S least = std::numeric_limits<S>::max();
    objects().eachNear(
        *object, [&](Object* own, S& now) { return (*callback)(own, object, now); }, least);
  }

  void collide(CollisionCallBack* callback) const override {
    callback->init();
    objects().eachPair([&](Object* first, Object* second) { return (*callback)(first, second); });
  }

  void distance(DistanceCallBack* callback) const override {
    callback->init();
    S least = std::numeric_limits<S>::max();
    objects().eachNearPair([&](Object* a, Object* b, S& now) { return (*callback)(a, b, now); }, least);
  }

  void collide(Base* otherManager, CollisionCallBack* callback) const override {
    if (otherManager == this) return collide(callback);
    callback->init();
    const auto ask = [&](Object* own, Object* other) { return (*callback)(own, other); };
    if (const auto* ours = dynamic_cast<const CoalBroadPhaseManager*>(otherManager)) {
      objects().eachPairWith(ours->objects(), ask);
      return;
    }
    objects().eachPairWith(objectsOf(*otherManager), ask);
  }

  void distance(Base* otherManager, DistanceCallBack* callback) const override {
    if (otherManager == this) return distance(callback);
    callback->init();
    S least = std::numeric_limits<S>::max();
    const auto ask = [&](Object* own, Object* other, S& now) { return (*callback)(own, other, now); };
    if (const auto* ours = dynamic_cast<const CoalBroadPhaseManager*>(otherManager)) {
      objects().eachNearPairWith(ours->objects(), ask, least);
      return;
    }
    objects().eachNearPairWith(objectsOf(*otherManager), ask, least);
  }
};

}  // namespace allpairs
