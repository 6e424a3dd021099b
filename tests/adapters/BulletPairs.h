// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace allpairs::test {

using ProxyPairs = std::vector<std::pair<const btBroadphaseProxy*, const btBroadphaseProxy*>>;

inline ProxyPairs sorted(ProxyPairs pairs) {
  for (auto& [first, second] : pairs) {
    if (second < first) std::swap(first, second);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// What a pair cache holds.
inline ProxyPairs pairsOf(btOverlappingPairCache& cache) {
  ProxyPairs pairs;
  const btBroadphasePairArray& held = cache.getOverlappingPairArray();
  for (int i = 0; i < held.size(); ++i) pairs.emplace_back(held[i].m_pProxy0, held[i].m_pProxy1);
  return sorted(std::move(pairs));
}

inline bool doBoxesOverlap(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (a.m_aabbMin[axis] > b.m_aabbMax[axis] || b.m_aabbMin[axis] > a.m_aabbMax[axis]) return false;
  }
  return true;
}

/// Whether two proxies must be a pair by their boxes, groups and masks.
inline bool isDemanded(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  return doBoxesOverlap(a, b) && (a.m_collisionFilterGroup & b.m_collisionFilterMask) != 0 &&
         (b.m_collisionFilterGroup & a.m_collisionFilterMask) != 0;
}

inline ProxyPairs demandedPairs(const std::vector<const btBroadphaseProxy*>& proxies) {
  ProxyPairs pairs;
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (isDemanded(*proxies[i], *proxies[j])) pairs.emplace_back(proxies[i], proxies[j]);
    }
  }
  return sorted(std::move(pairs));
}

/// What the pairs of a world must be after its boxes were last set.
inline ProxyPairs demandedPairs(const btCollisionWorld& world) {
  std::vector<const btBroadphaseProxy*> proxies;
  const btCollisionObjectArray& objects = world.getCollisionObjectArray();
  for (int i = 0; i < objects.size(); ++i) proxies.push_back(objects[i]->getBroadphaseHandle());
  return demandedPairs(proxies);
}

}  // namespace allpairs::test
