// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/broadphase/broadphase_collision_manager.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/narrowphase/collision_object.h>

#include <limits>
#include <vector>

#include "allpairs/objects/HostManager.h"
#include "allpairs/objects/ObjectBroadPhase.h"

namespace allpairs {

/// Settings of FclBroadPhaseManager: an executor, and whether the pairs of collide() are ordered.
using FclBroadPhaseManagerOptions = ObjectBroadPhaseOptions;

/// FCL's types, for HostManager.
template <class S>
struct FclHost {
  using Object = ::fcl::CollisionObject<S>;
  using Base = ::fcl::BroadPhaseCollisionManager<S>;
  using Tree = ::fcl::DynamicAABBTreeCollisionManager<S>;

  /// All at once: one by one, FCL passes over boxes that have hardly changed.
  static void update(Tree& tree, const std::vector<Object*>& /*objects*/) { tree.Tree::update(); }
};

/// A broad phase for FCL: use it where you use an fcl::DynamicAABBTreeCollisionManager.
///
/// Callbacks get the pairs whose boxes overlap, each once: first the object that was registered first, where an object
/// takes the place of one that left; of a query with an object or a manager, first the one that is here. The order of
/// the pairs is the same each time. A callback that returns true ends the query.
///
/// For distances, a callback gets no pair twice, and near pairs early. It gets every pair whose boxes overlap, and
/// every pair whose boxes are no farther apart than the smallest distance that it has set so far. So a callback that
/// always sets the same distance, a threshold or 0, gets all pairs within it. One that sets a NaN gets nothing more, or
/// little.
///
/// Objects stay the caller's. Their boxes are read when they are registered and by update(), as in FCL's managers; an
/// octree counts with its box, like any other geometry. An object that is registered again, or that leaves without
/// having come, changes nothing else.
/// Other managers: a query with another manager takes that one's objects, of whatever kind it is. The other way round,
///            a DynamicAABBTreeCollisionManager takes this one as the other manager; size() keeps a tree for it. No
///            other manager of FCL may get this one: each takes the other for one of its own kind without asking.
/// Geometry:  boxes are closed, in the precision of S. An empty box has no pairs and no distance.
/// Bad input: a box with a NaN throws InvalidBox: an object that comes with one is not registered, nor are those behind
///            it in registerObjects(); one that was keeps the box that it had, and update() reads all others. No object,
///            a null pointer, is none.
/// Cost:      nothing is searched before it is asked for. The first collide() after a change finds the pairs, by a
///            search of all boxes or, where few change, by a step of allpairs::World; each further one is a pass over
///            them. The first queries with an object after a change scan all boxes; more, O(log n + found). A query
///            outside of all boxes since the last clear() ends at once.
/// Threads:   const members, queries, may be called concurrently while no other member runs. A callback may query the
///            manager, and must not register, update or unregister.
template <class S>
class FclBroadPhaseManager : public HostManager<FclHost<S>> {
 public:
  using Object = typename FclHost<S>::Object;
  using Base = typename FclHost<S>::Base;
  using CollisionCallBack = ::fcl::CollisionCallBack<S>;
  using DistanceCallBack = ::fcl::DistanceCallBack<S>;

  explicit FclBroadPhaseManager(const FclBroadPhaseManagerOptions& options = {}) : HostManager<FclHost<S>>(options) {}

  void collide(Object* object, void* data, CollisionCallBack callback) const override {
    objects().eachOverlapping(*object, [&](Object* own) { return callback(own, object, data); });
  }

  void distance(Object* object, void* data, DistanceCallBack callback) const override {
    S least = std::numeric_limits<S>::max();
    objects().eachNear(
        *object, [&](Object* own, S& now) { return callback(own, object, data, now); }, least);
  }

  void collide(void* data, CollisionCallBack callback) const override {
    objects().eachPair([&](Object* first, Object* second) { return callback(first, second, data); });
  }

  void distance(void* data, DistanceCallBack callback) const override {
    S least = std::numeric_limits<S>::max();
    objects().eachNearPair([&](Object* a, Object* b, S& now) { return callback(a, b, data, now); }, least);
  }

  void collide(Base* otherManager, void* data, CollisionCallBack callback) const override {
    if (otherManager == this) return collide(data, callback);
    const auto ask = [&](Object* own, Object* other) { return callback(own, other, data); };
    if (const auto* ours = dynamic_cast<const FclBroadPhaseManager*>(otherManager)) {
      objects().eachPairWith(ours->objects(), ask);
      return;
    }
    objects().eachPairWith(objectsOf(*otherManager), ask);
  }

  void distance(Base* otherManager, void* data, DistanceCallBack callback) const override {
    if (otherManager == this) return distance(data, callback);
    S least = std::numeric_limits<S>::max();
    const auto ask = [&](Object* own, Object* other, S& now) { return callback(own, other, data, now); };
    if (const auto* ours = dynamic_cast<const FclBroadPhaseManager*>(otherManager)) {
      objects().eachNearPairWith(ours->objects(), ask, least);
      return;
    }
    objects().eachNearPairWith(objectsOf(*otherManager), ask, least);
  }

 private:
  using HostManager<FclHost<S>>::objects;
  using HostManager<FclHost<S>>::objectsOf;
};

using FclBroadPhaseManagerf = FclBroadPhaseManager<float>;
using FclBroadPhaseManagerd = FclBroadPhaseManager<double>;

}  // namespace allpairs
