// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <cstdint>

namespace allpairs {

/// Bullet's hashed pair cache, which counts the calls that add or remove a pair: between two equal counts no pair was
/// added or removed. Its array of pairs is to be read only, as Bullet's is: the hash table knows nothing of changes.
class CountingPairCache : public btHashedOverlappingPairCache {
 public:
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* first, btBroadphaseProxy* second) override {
    ++m_changes;
    return btHashedOverlappingPairCache::addOverlappingPair(first, second);
  }

  void* removeOverlappingPair(btBroadphaseProxy* first, btBroadphaseProxy* second, btDispatcher* dispatcher) override {
    ++m_changes;
    return btHashedOverlappingPairCache::removeOverlappingPair(first, second, dispatcher);
  }

  [[nodiscard]] std::uint64_t changes() const { return m_changes; }

 private:
  std::uint64_t m_changes = 0;
};

}  // namespace allpairs
