// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <LinearMath/btScalar.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Span.h"
#include "allpairs/World.h"
#include "allpairs/bullet/Blocks.h"
#include "allpairs/bullet/BulletBroadphaseOptions.h"
#include "allpairs/bullet/CountingPairCache.h"
#include "allpairs/bullet/EarlyPairs.h"
#include "allpairs/bullet/OrderedPairCache.h"
#include "allpairs/bullet/PairDigest.h"
#include "allpairs/bullet/Vectors.h"

namespace allpairs {

/// A broad phase for Bullet on allpairs::World: give it to a btDiscreteDynamicsWorld in place of a btDbvtBroadphase.
///
/// After calculateOverlappingPairs() the pair cache holds the pairs whose boxes overlap and whose groups and masks, or
/// the cache's filter callback, let them collide: exactly those, without the margin that a btDbvtBroadphase adds, and
/// whatever others added to the cache or removed from it. Only pairs that begin or end change the cache. A box that
/// grows or moves gets its new pairs in that call, those of a ghost object at once (ImmediatePairs); destroying a proxy
/// removes its pairs at once. A change of group or mask counts from that call on, a filter callback that decides
/// differently when the box of one of the two next changes.
///
/// Geometry:  boxes are closed, in the precision of btScalar. One with a minimum above its maximum is empty: it has no
///            pairs, and nothing hits it. Rays, with the box that Bullet may give them, are tested in double.
/// Order:     pairs are in the order in which the cache got them, so that two runs with the same calls give the same.
///            With BulletBroadphaseOptions::number the order does not depend on earlier calls either.
/// Bad input: a proxy's box with a NaN throws InvalidBox; a number that is negative or taken, a number with a
///            pairCache, and a characterMargin that is negative or not finite, InvalidArgument. The call then has no
///            effect; a btCollisionWorld whose addCollisionObject() made it has the object in its list already,
///            without a proxy: remove it from the world before the next step.
/// Cost:      a step of allpairs::World, Bullet's own for each pair that begins or ends, and a pass over the proxies;
///            one over the cache if it is the user's, or was changed from outside. setAabb() with the same box costs
///            nothing, unless the proxy's pairs are added at once.
/// Threads:   rayTest() and aabbTest() may be called concurrently while nothing else runs, all others one at a time. A
///            callback may make such queries too, and must not add, move or remove proxies.
class BulletBroadphase : public btBroadphaseInterface {
 public:
  explicit BulletBroadphase(const BulletBroadphaseOptions& options = {})
      : m_executor(options.executor),
        m_immediatePairs(options.immediatePairs),
        m_characterMargin(options.characterMargin),
        m_number(options.number),
        m_world(makeWorld()),
        m_cache(options.pairCache) {
    if (!(m_characterMargin >= 0 && std::isfinite(m_characterMargin))) {
      throw InvalidArgument("BulletBroadphaseOptions: the margin of characters is negative or not finite");
    }
    if (m_number && m_cache != nullptr) {
      throw InvalidArgument("BulletBroadphaseOptions: pairs are ordered by number in the broad phase's own cache only");
    }
    if (m_cache != nullptr) return;
    if (m_number) {
      auto ordered = std::make_unique<OrderedPairCache>();
      m_ordered = ordered.get();
      m_ownCache = std::move(ordered);
    } else {
      m_ownCache = std::make_unique<CountingPairCache>();
    }
    m_cache = m_ownCache.get();
  }

  BulletBroadphase(const BulletBroadphase&) = delete;
  BulletBroadphase& operator=(const BulletBroadphase&) = delete;
  BulletBroadphase(BulletBroadphase&&) = delete;
  BulletBroadphase& operator=(BulletBroadphase&&) = delete;
  ~BulletBroadphase() override = default;

  // NOLINTNEXTLINE(readability-function-size): the parameters are Bullet's.
  btBroadphaseProxy* createProxy(const btVector3& aabbMin, const btVector3& aabbMax, int /*shapeType*/, void* userPtr,
                                 int collisionFilterGroup, int collisionFilterMask, btDispatcher* dispatcher) override {
    if (hasNan(internal::toBox(aabbMin, aabbMax))) throw InvalidBox(0, "the box of a new proxy has a NaN");
    if (m_proxies.size() <= m_world.idBound()) m_proxies.add();
    Proxy made(aabbMin, aabbMax, userPtr, collisionFilterGroup, collisionFilterMask);
    made.m_uniqueId = 0;
    made.knownGroup = collisionFilterGroup;
    made.knownMask = collisionFilterMask;
    made.isThere = true;
    made.isGhost = isGhost(made, dispatcher);
    const std::vector<BoxId> near = nearTo(made, aabbMin, aabbMax);
    addToWorld(made);
    Proxy& proxy = m_proxies[made.id];
    proxy = made;
    try {
      addPairs(proxy, near);
    } catch (...) {  // of a filter callback
      destroyProxy(&proxy, dispatcher);
      throw;
    }
    return &proxy;
  }

  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override {
    m_cache->removeOverlappingPairsContainingProxy(proxy, dispatcher);
    const BoxId id = idOf(*proxy);
    m_world.remove(id);
    m_numbers.erase(proxy->m_uniqueId);
    m_proxies[id].isThere = false;
  }

  void setAabb(btBroadphaseProxy* proxy, const btVector3& aabbMin, const btVector3& aabbMax,
               btDispatcher* /*dispatcher*/) override {
    Proxy& own = m_proxies[idOf(*proxy)];
    if (!isImmediate(own) && own.m_aabbMin == aabbMin && own.m_aabbMax == aabbMax) return;
    m_world.move(idOf(own), reachOf(own, aabbMin, aabbMax));
    own.m_aabbMin = aabbMin;
    own.m_aabbMax = aabbMax;
    addPairs(own, nearTo(own, aabbMin, aabbMax));
  }

  void getAabb(btBroadphaseProxy* proxy, btVector3& aabbMin, btVector3& aabbMax) const override {
    aabbMin = proxy->m_aabbMin;
    aabbMax = proxy->m_aabbMax;
  }

  /// Calls the callback for each box that the ray, or the given box along the ray, hits: from near to far. Those of
  /// characters count without their margin. A ray of which an end, the length or the box is not finite hits none.
  // NOLINTNEXTLINE(readability-function-size): the parameters are Bullet's.
  void rayTest(const btVector3& rayFrom, const btVector3& rayTo, btBroadphaseRayCallback& rayCallback,
               const btVector3& aabbMin = btVector3(0, 0, 0), const btVector3& aabbMax = btVector3(0, 0, 0)) override {
    if (!internal::areFinite({rayFrom, rayTo, aabbMin, aabbMax})) return;
    const BoxSweep sweep = internal::sweepOf(internal::toBox(aabbMin, aabbMax), rayFrom, rayTo);
    if (!internal::isFinite(sweep.motion)) return;
    std::vector<SweepHit> hits = m_world.findAll(sweep);
    useOwnBoxes(sweep, hits);
    for (const SweepHit& hit : hits) rayCallback.process(&m_proxies[hit.id]);
  }

  /// Calls the callback for each box that overlaps another: none that has a NaN.
  void aabbTest(const btVector3& aabbMin, const btVector3& aabbMax, btBroadphaseAabbCallback& callback) override {
    const Box box = internal::toBox(aabbMin, aabbMax);
    if (hasNan(box)) return;
    for (const BoxId id : m_world.findOverlapping(box)) {
      if (internal::overlap(m_proxies[id], aabbMin, aabbMax)) callback.process(&m_proxies[id]);  // not only its reach
    }
  }

  void calculateOverlappingPairs(btDispatcher* dispatcher) override {
    const bool wasLeft = std::exchange(m_isInStep, true);  // by an exception
    const bool isUntouched = m_ownCache != nullptr && m_ownCache->changes() == m_changes;
    noteFilterCallback();
    noteFilters();
    const StepResult step = m_world.step();
    removePairs(step, dispatcher);
    for (const Pair& pair : step.began) {
      if (!contains(m_early.pairs(), pair)) addPair(pair);
    }
    m_early.clear();
    noteChanges(step);
    const bool isExact = !wasLeft && (isUntouched ? hasAllOf(step) : isComplete());
    if (!isExact) restorePairs(step.pairs, dispatcher);
    if (m_ordered != nullptr) m_ordered->order();
    if (m_ownCache != nullptr) m_changes = m_ownCache->changes();
    m_isInStep = false;
  }

  btOverlappingPairCache* getOverlappingPairCache() override { return m_cache; }
  [[nodiscard]] const btOverlappingPairCache* getOverlappingPairCache() const override { return m_cache; }

  /// The box around all proxies; both corners are 0 without proxies.
  void getBroadphaseAabb(btVector3& aabbMin, btVector3& aabbMax) const override {
    aabbMin.setZero();
    aabbMax.setZero();
    bool isFirst = true;
    forEachProxy([&](const Proxy& proxy) {
      aabbMin = isFirst ? proxy.m_aabbMin : internal::minimum(aabbMin, proxy.m_aabbMin);
      aabbMax = isFirst ? proxy.m_aabbMax : internal::maximum(aabbMax, proxy.m_aabbMax);
      isFirst = false;
    });
  }

  /// Resets to the state of a new broad phase, with its numbering, if there are no proxies.
  void resetPool(btDispatcher* /*dispatcher*/) override {
    if (m_world.size() != 0) return;
    m_world = makeWorld();
    m_proxies.clear();
    m_wanted = {};
    m_early.clear();
  }

  void printStats() override {}

  /// The world that holds the boxes, those of characters with their margin, for its statistics and for queries that
  /// Bullet does not have. Add, move and remove boxes through this class only.
  [[nodiscard]] World& world() { return m_world; }

  /// The proxy of a box of world().
  [[nodiscard]] btBroadphaseProxy* proxyOf(BoxId id) const { return &m_proxies[id]; }

 private:
  struct Proxy : btBroadphaseProxy {
    using btBroadphaseProxy::btBroadphaseProxy;

    [[nodiscard]] bool hasKnownFilter() const {
      return m_collisionFilterGroup == knownGroup && m_collisionFilterMask == knownMask;
    }

    BoxId id = kNoBox;
    int knownGroup = 0;  ///< What the world was told.
    int knownMask = 0;
    bool isThere = false;  ///< Not destroyed.
    bool isGhost = false;
  };

  static BoxId idOf(const btBroadphaseProxy& proxy) { return static_cast<const Proxy&>(proxy).id; }

  World makeWorld() {
    WorldOptions options;
    options.executor = m_executor;
    options.accept = [this](BoxId a, BoxId b) {
      if (m_filter == nullptr) return !isOfNoGroup(m_proxies[a]) && !isOfNoGroup(m_proxies[b]);
      return m_filter->needBroadphaseCollision(&m_proxies[a], &m_proxies[b]);
    };
    return World(std::move(options));
  }

  /// Gives a proxy its id and its m_uniqueId.
  void addToWorld(Proxy& proxy) {
    if (m_number) takeNumber(proxy);
    try {
      proxy.id = m_world.add(reachOf(proxy, proxy.m_aabbMin, proxy.m_aabbMax),
                             propertiesOf(proxy.knownGroup, proxy.knownMask));
    } catch (...) {
      m_numbers.erase(proxy.m_uniqueId);
      throw;
    }
    // Ids are dense, which suits the hash of the pair cache; 0 is Bullet's own.
    if (!m_number) proxy.m_uniqueId = static_cast<int>(proxy.id) + 1;
  }

  void takeNumber(Proxy& proxy) {
    const int number = m_number(proxy);
    if (number < 0) throw InvalidArgument("BulletBroadphase: the number " + std::to_string(number) + " is negative");
    if (!m_numbers.insert(number).second) {
      throw InvalidArgument("BulletBroadphase: the number " + std::to_string(number) + " is another proxy's");
    }
    proxy.m_uniqueId = number;
  }

  /// Whether no pair is demanded of a proxy, which rays and boxes hit all the same.
  static bool isOfNoGroup(const Proxy& proxy) { return proxy.knownGroup == 0 || proxy.knownMask == 0; }

  /// A filter callback takes the place of groups and masks. No query would find a box of no category or with no mask:
  /// its pairs are refused one by one.
  [[nodiscard]] BoxProperties propertiesOf(int group, int mask) const {
    if (m_filter != nullptr || group == 0 || mask == 0) return {};
    BoxProperties properties;
    properties.category = static_cast<std::uint32_t>(group);
    properties.mask = static_cast<std::uint32_t>(mask);
    return properties;
  }

  static const btCollisionObject& objectOf(const btBroadphaseProxy& proxy) {
    return *static_cast<const btCollisionObject*>(proxy.m_clientObject);
  }

  /// Bullet's worlds, which give a dispatcher, have collision objects as clients.
  [[nodiscard]] bool isGhost(const btBroadphaseProxy& proxy, const btDispatcher* dispatcher) const {
    if (m_immediatePairs == ImmediatePairs::None || proxy.m_clientObject == nullptr || dispatcher == nullptr) {
      return false;
    }
    return objectOf(proxy).getInternalType() == btCollisionObject::CO_GHOST_OBJECT;
  }

  /// Users set the flag before or after they add the object to a world.
  static bool isCharacter(const Proxy& proxy) {
    return proxy.isGhost && (objectOf(proxy).getCollisionFlags() & btCollisionObject::CF_CHARACTER_OBJECT) != 0;
  }

  [[nodiscard]] bool isImmediate(const Proxy& proxy) const {
    return proxy.isGhost || m_immediatePairs == ImmediatePairs::All;
  }

  /// Where a proxy has pairs: around characters, else in its box; nowhere if that is empty.
  [[nodiscard]] Box reachOf(const Proxy& proxy, const btVector3& min, const btVector3& max) const {
    if (!isCharacter(proxy)) return internal::toBox(min, max);
    return internal::toWidenedBox(min, max, m_characterMargin);
  }

  /// What hits the reach of a character need not hit its box, or does so later.
  void useOwnBoxes(const BoxSweep& sweep, std::vector<SweepHit>& hits) const {
    bool isChanged = false;
    for (SweepHit& hit : hits) {
      const Proxy& proxy = m_proxies[hit.id];
      const Box box = internal::toBox(proxy.m_aabbMin, proxy.m_aabbMax);
      if (!proxy.isGhost || m_world.box(hit.id) == box) continue;
      World alone;
      alone.add(box);
      hit.t = alone.findFirst(sweep).t;  // infinite where it is not hit
      isChanged = true;
    }
    if (isChanged) internal::sortHits(hits);
  }

  template <class Do>
  void forEachProxy(const Do& doWith) const {
    for (std::size_t i = 0; i < m_proxies.size(); ++i) {
      if (m_proxies[i].isThere) doWith(m_proxies[i]);
    }
  }

  /// Users change group and mask in the proxy itself.
  void noteFilters() {
    forEachProxy([this](Proxy& proxy) {
      if (proxy.hasKnownFilter()) return;
      const BoxId id = idOf(proxy);
      m_world.setProperties(id, propertiesOf(proxy.m_collisionFilterGroup, proxy.m_collisionFilterMask));
      m_world.invalidate(Span<const BoxId>(&id, 1));  // of no group, it may have the same properties
      proxy.knownGroup = proxy.m_collisionFilterGroup;
      proxy.knownMask = proxy.m_collisionFilterMask;
    });
  }

  void noteFilterCallback() {
    btOverlapFilterCallback* const filter = m_cache->getOverlapFilterCallback();
    if (filter == m_filter) return;
    btOverlapFilterCallback* const before = std::exchange(m_filter, filter);
    try {
      forEachProxy([this](const Proxy& proxy) {
        const BoxId id = idOf(proxy);
        m_world.setProperties(id, propertiesOf(proxy.knownGroup, proxy.knownMask));
        m_world.invalidate(Span<const BoxId>(&id, 1));
      });
    } catch (...) {
      m_filter = before;  // the next step begins again
      throw;
    }
  }

  /// What overlaps a proxy in its new box, if its pairs are added at once; and room for them in m_early.
  [[nodiscard]] std::vector<BoxId> nearTo(const Proxy& proxy, const btVector3& min, const btVector3& max) {
    if (!isImmediate(proxy)) return {};
    std::vector<BoxId> near = m_world.findOverlapping(reachOf(proxy, min, max));
    m_early.reserve(near.size());
    return near;
  }

  /// Adds those of its pairs that the cache lacks. Those that a proxy no longer has stay until the next step.
  void addPairs(Proxy& proxy, Span<const BoxId> near) {
    const BoxId id = idOf(proxy);
    for (const BoxId other : near) {
      if (other == id || m_cache->findPair(&proxy, &m_proxies[other]) != nullptr) continue;
      const Pair pair{std::min(id, other), std::max(id, other)};
      if (m_cache->addOverlappingPair(&m_proxies[pair.first], &m_proxies[pair.second]) != nullptr) {
        m_early.add(pair);
      }
    }
  }

  /// A filter callback that refuses a pair now is asked again in the next step.
  void addPair(const Pair& pair) {
    btBroadphaseProxy* const first = &m_proxies[pair.first];
    btBroadphaseProxy* const second = &m_proxies[pair.second];
    if (m_cache->addOverlappingPair(first, second) != nullptr) return;
    if (!m_cache->needsBroadphaseCollision(first, second)) {
      m_world.invalidate(Span<const BoxId>(&pair.first, 1));
    } else if (m_cache->addOverlappingPair(first, second) == nullptr) {  // nor now that the filter wants it
      m_keepsPairs = m_cache->getNumOverlappingPairs() != 0;
    }
  }

  /// Those of a proxy that was destroyed are gone already.
  void removePair(const Pair& pair, btDispatcher* dispatcher) {
    Proxy* const first = &m_proxies[pair.first];
    Proxy* const second = &m_proxies[pair.second];
    if (first->isThere && second->isThere) m_cache->removeOverlappingPair(first, second, dispatcher);
  }

  /// Removes the pairs that ended, and those that were added early and are none.
  void removePairs(const StepResult& step, btDispatcher* dispatcher) {
    m_early.sort();
    m_ended.assign(step.ended.begin(), step.ended.end());
    for (const Pair& pair : m_early.pairs()) {
      if (!contains(step.pairs, pair) && !contains(step.ended, pair)) m_ended.push_back(pair);
    }
    std::sort(m_ended.begin(), m_ended.end());
    if (m_ended.empty()) return;
    if (m_cache->hasDeferredRemoval()) {
      removeIf([this](const btBroadphasePair& pair) { return contains(m_ended, idsOf(pair)); }, dispatcher);
    } else {
      for (const Pair& pair : m_ended) removePair(pair, dispatcher);
    }
  }

  /// What a cache that leaves the removal of pairs to the broad phase wants: one pass over all of them.
  template <class IsUnwanted>
  void removeIf(const IsUnwanted& isUnwanted, btDispatcher* dispatcher) {
    btBroadphasePairArray& pairs = m_cache->getOverlappingPairArray();
    int kept = 0;
    for (int i = 0; i < pairs.size(); ++i) {
      if (isUnwanted(pairs[i])) {
        m_cache->cleanOverlappingPair(pairs[i], dispatcher);
      } else {
        pairs[kept++] = pairs[i];
      }
    }
    pairs.resize(kept);
  }

  static bool contains(Span<const Pair> sorted, const Pair& pair) {
    return std::binary_search(sorted.begin(), sorted.end(), pair);
  }

  static Pair idsOf(const btBroadphasePair& pair) {
    const BoxId a = idOf(*pair.m_pProxy0);
    const BoxId b = idOf(*pair.m_pProxy1);
    return {std::min(a, b), std::max(a, b)};
  }

  /// The pairs that the cache has to hold are those of before and the changes of the step.
  void noteChanges(const StepResult& step) {
    for (const Pair& pair : step.began) m_wanted.add(&m_proxies[pair.first], &m_proxies[pair.second]);
    for (const Pair& pair : step.ended) m_wanted.remove(&m_proxies[pair.first], &m_proxies[pair.second]);
  }

  /// Whether a cache that holds no other pairs holds all of them.
  [[nodiscard]] bool hasAllOf(const StepResult& step) const {
    return static_cast<std::size_t>(m_cache->getNumOverlappingPairs()) == step.pairs.size();
  }

  /// Whether the cache holds the pairs that it has to.
  [[nodiscard]] bool isComplete() const {
    if (m_ownCache == nullptr && !m_keepsPairs && m_cache->getNumOverlappingPairs() == 0) return true;
    internal::PairDigest held;
    const btBroadphasePairArray& pairs = m_cache->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); ++i) held.add(pairs[i].m_pProxy0, pairs[i].m_pProxy1);
    return held == m_wanted;
  }

  /// Undoes what others did to the cache: removes pairs that are none, adds missing ones, without contacts.
  void restorePairs(Span<const Pair> wanted, btDispatcher* dispatcher) {
    std::vector<std::uint8_t> isHeld(wanted.size(), 0);
    const auto isUnwanted = [&](const btBroadphasePair& pair) {
      const auto at = std::lower_bound(wanted.begin(), wanted.end(), idsOf(pair));
      if (at == wanted.end() || *at != idsOf(pair)) return true;
      return std::exchange(isHeld[static_cast<std::size_t>(at - wanted.begin())], std::uint8_t{1}) != 0;
    };
    if (m_cache->hasDeferredRemoval()) {
      removeIf(isUnwanted, dispatcher);
    } else {
      removeEach(isUnwanted, dispatcher);
    }
    m_wanted = {};
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      m_wanted.add(&m_proxies[wanted[i].first], &m_proxies[wanted[i].second]);
      if (isHeld[i] == 0) addPair(wanted[i]);
    }
  }

  template <class IsUnwanted>
  void removeEach(const IsUnwanted& isUnwanted, btDispatcher* dispatcher) {
    std::vector<std::pair<btBroadphaseProxy*, btBroadphaseProxy*> > unwanted;
    const btBroadphasePairArray& pairs = m_cache->getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); ++i) {
      if (isUnwanted(pairs[i])) unwanted.emplace_back(pairs[i].m_pProxy0, pairs[i].m_pProxy1);
    }
    for (const auto& [first, second] : unwanted) m_cache->removeOverlappingPair(first, second, dispatcher);
  }

  std::unique_ptr<CountingPairCache> m_ownCache;
  Executor* m_executor;
  ImmediatePairs m_immediatePairs;
  btScalar m_characterMargin;
  std::function<int(const btBroadphaseProxy&)> m_number;
  std::unordered_set<int> m_numbers;      // of all proxies, if they have numbers
  OrderedPairCache* m_ordered = nullptr;  // the own cache, if proxies have numbers
  btOverlapFilterCallback* m_filter = nullptr;
  internal::Blocks<Proxy> m_proxies;  // by id; one that was destroyed waits for a box with its id
  World m_world;
  btOverlappingPairCache* m_cache;
  bool m_keepsPairs = true;  // unlike a btNullPairCache that it was given
  bool m_isInStep = false;
  std::uint64_t m_changes = 0;    // of the own cache at the end of the last step
  internal::PairDigest m_wanted;  // of the pairs of the last step
  internal::EarlyPairs m_early;   // that were added to the cache since the last step
  std::vector<Pair> m_ended;
};

}  // namespace allpairs
