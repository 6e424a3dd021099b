// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <LinearMath/btScalar.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "allpairs/World.h"

namespace allpairs {

/// Settings of BulletBroadphase; the defaults are right for most worlds.
struct BulletBroadphaseOptions {
  /// Where Bullet keeps its pairs, not owned; null gives the broad phase a btHashedOverlappingPairCache of its own.
  btOverlappingPairCache* pairCache = nullptr;

  /// Runs parallel work; null means on the calling thread. Not owned.
  Executor* executor = nullptr;
};

/// A broad phase for Bullet on allpairs::World: give it to a btDiscreteDynamicsWorld in place of a btDbvtBroadphase.
///
/// After calculateOverlappingPairs() the pair cache holds the pairs whose boxes overlap and whose groups and masks, or
/// the cache's filter callback, let them collide: exactly those, without the margin that a btDbvtBroadphase adds. Only
/// pairs that begin or end change the cache. A box that grows or moves gets its new pairs in that call, not before;
/// destroying a proxy removes its pairs at once.
///
/// Geometry:  boxes are closed, in the precision of btScalar. Rays, with the box that Bullet may give them, are tested
///            in double.
/// Bad input: a box with a NaN throws InvalidBox.
/// Cost:      a step of allpairs::World, and Bullet's own for each pair that begins or ends.
/// Threads:   one call at a time per object, rayTest() and aabbTest() included. Their callbacks may make such queries
///            too, and must not add, move or remove proxies.
class BulletBroadphase : public btBroadphaseInterface {
 public:
  explicit BulletBroadphase(const BulletBroadphaseOptions& options = {})
      : m_executor(options.executor), m_world(makeWorld()), m_cache(options.pairCache) {
    if (m_cache != nullptr) return;
    m_ownCache = std::make_unique<btHashedOverlappingPairCache>();
    m_cache = m_ownCache.get();
  }

  BulletBroadphase(const BulletBroadphase&) = delete;
  BulletBroadphase& operator=(const BulletBroadphase&) = delete;
  BulletBroadphase(BulletBroadphase&&) = delete;
  BulletBroadphase& operator=(BulletBroadphase&&) = delete;
  ~BulletBroadphase() override = default;

  // NOLINTNEXTLINE(readability-function-size): the parameters are Bullet's.
  btBroadphaseProxy* createProxy(const btVector3& aabbMin, const btVector3& aabbMax, int /*shapeType*/, void* userPtr,
                                 int collisionFilterGroup, int collisionFilterMask,
                                 btDispatcher* /*dispatcher*/) override {
    const BoxId id = m_world.add(toBox(aabbMin, aabbMax), propertiesOf(collisionFilterGroup, collisionFilterMask));
    auto proxy = std::make_unique<Proxy>(aabbMin, aabbMax, userPtr, collisionFilterGroup, collisionFilterMask);
    proxy->m_uniqueId = static_cast<int>(id) + 1;  // dense, which suits the hash of the pair cache; 0 is Bullet's own
    proxy->knownGroup = collisionFilterGroup;
    proxy->knownMask = collisionFilterMask;
    if (m_proxies.size() <= id) m_proxies.resize(std::size_t{id} + 1);
    m_proxies[id] = std::move(proxy);
    return m_proxies[id].get();
  }

  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override {
    m_cache->removeOverlappingPairsContainingProxy(proxy, dispatcher);
    m_knownPairs = m_cache->getNumOverlappingPairs();
    const BoxId id = idOf(*proxy);
    m_world.remove(id);
    m_proxies[id].reset();
  }

  void setAabb(btBroadphaseProxy* proxy, const btVector3& aabbMin, const btVector3& aabbMax,
               btDispatcher* /*dispatcher*/) override {
    const BoxId id = idOf(*proxy);
    m_world.move(id, toBox(aabbMin, aabbMax));
    proxy->m_aabbMin = aabbMin;
    proxy->m_aabbMax = aabbMax;
    noteFilter(*m_proxies[id], id);
  }

  void getAabb(btBroadphaseProxy* proxy, btVector3& aabbMin, btVector3& aabbMax) const override {
    aabbMin = proxy->m_aabbMin;
    aabbMax = proxy->m_aabbMax;
  }

  /// Calls the callback for each box that the ray, or the given box along the ray, hits: from near to far.
  // NOLINTNEXTLINE(readability-function-size): the parameters are Bullet's.
  void rayTest(const btVector3& rayFrom, const btVector3& rayTo, btBroadphaseRayCallback& rayCallback,
               const btVector3& aabbMin = btVector3(0, 0, 0), const btVector3& aabbMax = btVector3(0, 0, 0)) override {
    const BoxSweep sweep{.box = toBox(rayFrom + aabbMin, rayFrom + aabbMax), .motion = toArray(rayTo - rayFrom)};
    const auto hits = m_world.findAll(sweep);
    const std::vector<SweepHit> kept(hits.begin(), hits.end());  // the callback may ask the world something else
    for (const SweepHit& hit : kept) rayCallback.process(m_proxies[hit.id].get());
  }

  void aabbTest(const btVector3& aabbMin, const btVector3& aabbMax, btBroadphaseAabbCallback& callback) override {
    const auto found = m_world.findOverlapping(toBox(aabbMin, aabbMax));
    const std::vector<BoxId> kept(found.begin(), found.end());
    for (const BoxId id : kept) callback.process(m_proxies[id].get());
  }

  void calculateOverlappingPairs(btDispatcher* dispatcher) override {
    noteFilterCallback();
    const bool isChangedByOthers = m_cache->getNumOverlappingPairs() != m_knownPairs;
    const StepResult step = m_world.step();
    if (m_cache->hasDeferredRemoval()) {
      removeAtOnce(step.ended, dispatcher);
    } else {
      for (const Pair& pair : step.ended) removePair(pair, dispatcher);
    }
    if (isChangedByOthers) {
      restorePairs(step.pairs);
    } else {
      for (const Pair& pair : step.began) addPair(pair);
    }
    m_knownPairs = m_cache->getNumOverlappingPairs();
  }

  btOverlappingPairCache* getOverlappingPairCache() override { return m_cache; }
  [[nodiscard]] const btOverlappingPairCache* getOverlappingPairCache() const override { return m_cache; }

  /// The box around all proxies; both corners are 0 without proxies.
  void getBroadphaseAabb(btVector3& aabbMin, btVector3& aabbMax) const override {
    aabbMin.setZero();
    aabbMax.setZero();
    bool isFirst = true;
    for (const auto& proxy : m_proxies) {
      if (!proxy) continue;
      aabbMin = isFirst ? proxy->m_aabbMin : minimum(aabbMin, proxy->m_aabbMin);
      aabbMax = isFirst ? proxy->m_aabbMax : maximum(aabbMax, proxy->m_aabbMax);
      isFirst = false;
    }
  }

  /// Resets to the state of a new broad phase, with its numbering, if there are no proxies.
  void resetPool(btDispatcher* /*dispatcher*/) override {
    if (m_world.size() != 0) return;
    m_world = makeWorld();
    m_proxies.clear();
  }

  void printStats() override {}

  /// The world that holds the boxes, for its statistics and for queries that Bullet does not have. Add, move and remove
  /// boxes through this class only.
  [[nodiscard]] World& world() { return m_world; }

  /// The proxy of a box of world().
  [[nodiscard]] btBroadphaseProxy* proxyOf(BoxId id) const { return m_proxies[id].get(); }

 private:
  struct Proxy : btBroadphaseProxy {
    using btBroadphaseProxy::btBroadphaseProxy;

    int knownGroup = 0;  ///< What the world was told.
    int knownMask = 0;
  };

  static std::array<double, 3> toArray(const btVector3& v) {
    return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
  }
  static Box toBox(const btVector3& min, const btVector3& max) { return {toArray(min), toArray(max)}; }
  static BoxId idOf(const btBroadphaseProxy& proxy) { return static_cast<BoxId>(proxy.m_uniqueId - 1); }

  static btVector3 minimum(btVector3 a, const btVector3& b) {
    a.setMin(b);
    return a;
  }
  static btVector3 maximum(btVector3 a, const btVector3& b) {
    a.setMax(b);
    return a;
  }

  World makeWorld() {
    WorldOptions options;
    options.executor = m_executor;
    options.accept = [this](BoxId a, BoxId b) {
      return m_filter == nullptr || m_filter->needBroadphaseCollision(m_proxies[a].get(), m_proxies[b].get());
    };
    return World(std::move(options));
  }

  /// A filter callback takes the place of groups and masks.
  [[nodiscard]] BoxProperties propertiesOf(int group, int mask) const {
    if (m_filter != nullptr) return {};
    return {.category = static_cast<std::uint32_t>(group), .mask = static_cast<std::uint32_t>(mask)};
  }

  /// Users change group and mask in the proxy itself.
  void noteFilter(Proxy& proxy, BoxId id) {
    if (proxy.m_collisionFilterGroup == proxy.knownGroup && proxy.m_collisionFilterMask == proxy.knownMask) return;
    proxy.knownGroup = proxy.m_collisionFilterGroup;
    proxy.knownMask = proxy.m_collisionFilterMask;
    m_world.setProperties(id, propertiesOf(proxy.knownGroup, proxy.knownMask));
  }

  void noteFilterCallback() {
    btOverlapFilterCallback* const filter = m_cache->getOverlapFilterCallback();
    if (filter == m_filter) return;
    m_filter = filter;
    for (BoxId id = 0; id < m_proxies.size(); ++id) {
      if (!m_proxies[id]) continue;
      m_world.setProperties(id, propertiesOf(m_proxies[id]->knownGroup, m_proxies[id]->knownMask));
      m_world.invalidate(std::span<const BoxId>(&id, 1));
    }
  }

  void addPair(const Pair& pair) {
    m_cache->addOverlappingPair(m_proxies[pair.first].get(), m_proxies[pair.second].get());
  }

  /// Those of a proxy that was destroyed are gone already.
  void removePair(const Pair& pair, btDispatcher* dispatcher) {
    btBroadphaseProxy* const first = m_proxies[pair.first].get();
    btBroadphaseProxy* const second = m_proxies[pair.second].get();
    if (first != nullptr && second != nullptr) m_cache->removeOverlappingPair(first, second, dispatcher);
  }

  /// What a cache that leaves the removal of pairs to the broad phase wants: one pass over all of them.
  void removeAtOnce(std::span<const Pair> ended, btDispatcher* dispatcher) {
    btBroadphasePairArray& pairs = m_cache->getOverlappingPairArray();
    int kept = 0;
    for (int i = 0; i < pairs.size(); ++i) {
      if (std::binary_search(ended.begin(), ended.end(), idsOf(pairs[i]))) {
        m_cache->cleanOverlappingPair(pairs[i], dispatcher);
      } else {
        pairs[kept++] = pairs[i];
      }
    }
    pairs.resize(kept);
  }

  static Pair idsOf(const btBroadphasePair& pair) {
    const BoxId a = idOf(*pair.m_pProxy0);
    const BoxId b = idOf(*pair.m_pProxy1);
    return {std::min(a, b), std::max(a, b)};
  }

  /// Pairs were removed from the cache, or added, from outside: adds missing pairs again, without contacts.
  void restorePairs(std::span<const Pair> pairs) {
    for (const Pair& pair : pairs) {
      if (m_cache->findPair(m_proxies[pair.first].get(), m_proxies[pair.second].get()) == nullptr) addPair(pair);
    }
  }

  std::unique_ptr<btOverlappingPairCache> m_ownCache;
  Executor* m_executor;
  btOverlapFilterCallback* m_filter = nullptr;
  std::vector<std::unique_ptr<Proxy>> m_proxies;  // by id; null where a proxy was destroyed
  World m_world;
  btOverlappingPairCache* m_cache;
  int m_knownPairs = 0;  // what the cache held when it was last looked at
};

}  // namespace allpairs
