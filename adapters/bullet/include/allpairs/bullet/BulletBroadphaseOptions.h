// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <LinearMath/btScalar.h>

#include <cstdint>
#include <functional>

#include "allpairs/Executor.h"

namespace allpairs {

/// Whose new pairs BulletBroadphase adds as soon as a proxy is created or its box is set.
enum class ImmediatePairs : std::uint8_t {
  None,    ///< Nobody's: all pairs are added in calculateOverlappingPairs().
  Ghosts,  ///< Those of ghost objects, which character controllers move and ask between steps.
  All,     ///< Those of every proxy, as in a btDbvtBroadphase, at more than its cost: a query for each box that is set.
};

/// Settings of BulletBroadphase; the defaults are right for most worlds.
struct BulletBroadphaseOptions {
  /// Where Bullet keeps its pairs, not owned; null gives the broad phase a btHashedOverlappingPairCache of its own.
  btOverlappingPairCache* pairCache = nullptr;

  /// Runs parallel work; null means on the calling thread. Not owned.
  Executor* executor = nullptr;

  /// Unless it is None, proxies that are created with a dispatcher must have null or a btCollisionObject as their
  /// client object, as in all of Bullet's worlds.
  ImmediatePairs immediatePairs = ImmediatePairs::Ghosts;

  /// How far around its box a ghost object with CF_CHARACTER_OBJECT has pairs, unless immediatePairs is None. A
  /// btKinematicCharacterController looks only among the pairs of its ghost for what is in the way of a move; this is
  /// how far it sees, in a btDbvtBroadphase too. With 0 its pairs are exact.
  btScalar characterMargin = btScalar(0.05);

  /// If set, the order of the pairs does not depend on history: whatever was created, moved and destroyed before, and
  /// in whatever order, the pairs of the same boxes are in the same order. Called once for each proxy, in
  /// createProxy(): its number, not negative and unlike that of every other proxy, which becomes its m_uniqueId. Pairs
  /// are in ascending order of the number of their first proxy, then of the second; the first is the one with the lower
  /// number. Numbers that are small and dense suit Bullet's hash of pairs best. What is given is a copy of the proxy,
  /// gone after the call. userIndexOf() gives the user index of the collision object. Not together with a pairCache.
  std::function<int(const btBroadphaseProxy&)> number{};
};

/// For BulletBroadphaseOptions::number: the user index of the collision object that is the proxy's client, which may
/// not be null. The index has to be set before the object is added to a world: Bullet's default, -1, is refused.
inline int userIndexOf(const btBroadphaseProxy& proxy) {
  return static_cast<const btCollisionObject*>(proxy.m_clientObject)->getUserIndex();
}

}  // namespace allpairs
