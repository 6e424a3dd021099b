// SPDX-License-Identifier: MIT
#include "allpairs/bullet/BulletBroadphase.h"

#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "BulletPairs.h"
#include "allpairs/Error.h"

namespace allpairs::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A broad phase and the proxies in it, some of them moved, removed and added at random.
class Crowd {
 public:
  explicit Crowd(btOverlappingPairCache* cache = nullptr) : m_broadphase({.pairCache = cache}) {}

  ~Crowd() {
    for (btBroadphaseProxy* proxy : m_proxies) m_broadphase.destroyProxy(proxy, nullptr);
  }

  Crowd(const Crowd&) = delete;
  Crowd& operator=(const Crowd&) = delete;

  void add() {
    const auto [min, max] = box();
    m_proxies.push_back(m_broadphase.createProxy(min, max, 0, nullptr, 1 << number(3), number(7) + 1, nullptr));
  }

  void change() {
    for (btBroadphaseProxy* proxy : m_proxies) {
      if (number(2) == 0) continue;
      const auto [min, max] = box();
      m_broadphase.setAabb(proxy, min, max, nullptr);
    }
    const auto i = static_cast<std::size_t>(number(static_cast<int>(m_proxies.size()) - 1));
    m_broadphase.destroyProxy(m_proxies[i], nullptr);
    m_proxies[i] = m_proxies.back();
    m_proxies.pop_back();
    add();
    m_broadphase.calculateOverlappingPairs(nullptr);
  }

  [[nodiscard]] ProxyPairs demanded() const { return demandedPairs({m_proxies.begin(), m_proxies.end()}); }
  [[nodiscard]] ProxyPairs held() { return pairsOf(*m_broadphase.getOverlappingPairCache()); }

  BulletBroadphase& broadphase() { return m_broadphase; }
  std::vector<btBroadphaseProxy*>& proxies() { return m_proxies; }

  std::pair<btVector3, btVector3> box() {
    const btVector3 min(coordinate(), coordinate(), coordinate());
    return {min, min + btVector3(coordinate(), coordinate(), coordinate()) * btScalar(0.2)};
  }

 private:
  /// Few different ones, so that boxes often share a face.
  btScalar coordinate() { return static_cast<btScalar>(number(40)) / 4; }
  int number(int most) { return std::uniform_int_distribution<int>(0, most)(m_random); }

  std::mt19937 m_random{11};
  BulletBroadphase m_broadphase;
  std::vector<btBroadphaseProxy*> m_proxies;
};

btBroadphaseProxy* addUnitCube(BulletBroadphase& broadphase, btScalar x, int group = 1, int mask = -1) {
  return broadphase.createProxy({x, 0, 0}, {x + 1, 1, 1}, 0, nullptr, group, mask, nullptr);
}

struct Collector : btBroadphaseRayCallback {
  std::vector<const btBroadphaseProxy*> found;
  bool process(const btBroadphaseProxy* proxy) override {
    found.push_back(proxy);
    return true;
  }
};

TEST(BulletBroadphase, RandomChangesLeaveExactlyTheDemandedPairsInTheCache) {
  Crowd crowd;
  for (int i = 0; i < 150; ++i) crowd.add();
  for (int step = 0; step < 100; ++step) {
    crowd.change();
    ASSERT_EQ(crowd.held(), crowd.demanded()) << "seed 11, step " << step;
  }
}

TEST(BulletBroadphase, ACacheThatDefersRemovalHoldsTheSamePairs) {
  btSortedOverlappingPairCache cache;
  Crowd crowd(&cache);
  ASSERT_TRUE(cache.hasDeferredRemoval());
  for (int i = 0; i < 100; ++i) crowd.add();
  for (int step = 0; step < 50; ++step) {
    crowd.change();
    ASSERT_EQ(crowd.held(), crowd.demanded()) << "seed 11, step " << step;
  }
}

TEST(BulletBroadphase, CubesThatShareAFaceAreAPair) {
  BulletBroadphase broadphase;
  auto* const first = addUnitCube(broadphase, 0);
  auto* const second = addUnitCube(broadphase, 1);
  auto* const third = addUnitCube(broadphase, std::nextafter(btScalar(2), btScalar(3)));
  broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_EQ(pairsOf(*broadphase.getOverlappingPairCache()), sorted({{first, second}}));
  for (auto* proxy : {first, second, third}) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletBroadphase, GroupsAndMasksChangedInAProxyCountWhenItIsNextMoved) {
  BulletBroadphase broadphase;
  auto* const first = addUnitCube(broadphase, 0);
  auto* const second = addUnitCube(broadphase, 0, 2, 2);
  broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_EQ(broadphase.getOverlappingPairCache()->getNumOverlappingPairs(), 0);
  second->m_collisionFilterMask = -1;
  broadphase.setAabb(second, second->m_aabbMin, second->m_aabbMax, nullptr);
  broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_EQ(broadphase.getOverlappingPairCache()->getNumOverlappingPairs(), 1);
  for (auto* proxy : {first, second}) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletBroadphase, AProxyOfNoGroupOrMaskHasNoPairsAndIsHitByRaysAndBoxes) {
  BulletBroadphase broadphase;
  auto* const plain = addUnitCube(broadphase, 0, -1, -1);
  auto* const noMask = addUnitCube(broadphase, 0, 1, 0);
  auto* const noGroup = addUnitCube(broadphase, 0, 0, -1);
  const auto pairsAfterAStep = [&] {
    broadphase.calculateOverlappingPairs(nullptr);
    return pairsOf(*broadphase.getOverlappingPairCache());
  };
  EXPECT_THAT(pairsAfterAStep(), IsEmpty());
  Collector ray;
  broadphase.rayTest({-1, 0.5F, 0.5F}, {3, 0.5F, 0.5F}, ray);
  EXPECT_THAT(ray.found, ::testing::UnorderedElementsAre(plain, noMask, noGroup));
  Collector box;
  broadphase.aabbTest({0, 0, 0}, {1, 1, 1}, box);
  EXPECT_THAT(box.found, ::testing::UnorderedElementsAre(plain, noMask, noGroup));
  noMask->m_collisionFilterMask = -1;
  noMask->m_collisionFilterGroup = -1;
  broadphase.setAabb(noMask, noMask->m_aabbMin, noMask->m_aabbMax, nullptr);
  EXPECT_EQ(pairsAfterAStep(), sorted({{plain, noMask}}));
  noMask->m_collisionFilterGroup = 0;
  broadphase.setAabb(noMask, noMask->m_aabbMin, noMask->m_aabbMax, nullptr);
  EXPECT_THAT(pairsAfterAStep(), IsEmpty());
  for (auto* proxy : {plain, noMask, noGroup}) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletBroadphase, ClientsAreTakenForObjectsOnlyWhereTheyAreThereAndADispatcherIsToo) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  std::array<int, 256> noObject{};  // which would be a ghost, had it a type
  noObject.fill(btCollisionObject::CO_GHOST_OBJECT);
  for (const bool isDispatched : {true, false}) {
    BulletBroadphase broadphase;
    btDispatcher* const given = isDispatched ? &dispatcher : nullptr;
    void* const client = isDispatched ? nullptr : noObject.data();
    auto* const first = broadphase.createProxy({0, 0, 0}, {1, 1, 1}, 0, client, 1, -1, given);
    auto* const second = broadphase.createProxy({0, 0, 0}, {1, 1, 1}, 0, client, 1, -1, given);
    EXPECT_EQ(broadphase.getOverlappingPairCache()->getNumOverlappingPairs(), 0) << "before the step";
    broadphase.calculateOverlappingPairs(given);
    EXPECT_EQ(broadphase.getOverlappingPairCache()->getNumOverlappingPairs(), 1);
    for (auto* proxy : {first, second}) broadphase.destroyProxy(proxy, given);
  }
}

TEST(BulletBroadphase, WhatIsNotFiniteHitsNothing) {
  constexpr btScalar kInfinite = std::numeric_limits<btScalar>::infinity();
  constexpr btScalar kNan = std::numeric_limits<btScalar>::quiet_NaN();
  BulletBroadphase broadphase;
  auto* const cube = addUnitCube(broadphase, 0, -1, -1);
  Collector found;
  for (const btScalar bad : {kInfinite, -kInfinite, kNan}) {
    broadphase.rayTest({-1, 0.5F, 0.5F}, {bad, 0.5F, 0.5F}, found);
    broadphase.rayTest({bad, 0.5F, 0.5F}, {3, 0.5F, 0.5F}, found);
    broadphase.rayTest({-1, 0.5F, 0.5F}, {3, bad, 0.5F}, found);
    broadphase.rayTest({-1, 0.5F, 0.5F}, {3, 0.5F, 0.5F}, found, {-1, -1, -1}, {1, bad, 1});
    broadphase.rayTest({-1, 0.5F, 0.5F}, {3, 0.5F, 0.5F}, found, {-1, -1, -1}, {1, 1, bad});
  }
  broadphase.aabbTest({0, 0, kNan}, {1, 1, 1}, found);
  EXPECT_THAT(found.found, IsEmpty());
  broadphase.aabbTest({-kInfinite, 0, 0}, {kInfinite, 1, 1}, found);
  EXPECT_THAT(found.found, ::testing::ElementsAre(cube));
  broadphase.destroyProxy(cube, nullptr);
}

TEST(BulletBroadphase, ABoxThatStaysIsNotMoved) {
  BulletBroadphase broadphase;
  auto* const proxy = broadphase.createProxy({0, 0, 0}, {1, 1, 1}, 0, nullptr, 1, -1, nullptr);
  broadphase.calculateOverlappingPairs(nullptr);
  broadphase.setAabb(proxy, {0, 0, 0}, {1, 1, 1}, nullptr);
  broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_EQ(broadphase.world().statistics().changed, 0U);
  broadphase.setAabb(proxy, {0, 0, 0}, {1, 1, 2}, nullptr);
  broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_EQ(broadphase.world().statistics().changed, 1U);
  broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletBroadphase, AFilterCallbackTakesThePlaceOfGroupsAndMasks) {
  struct Switch : btOverlapFilterCallback {
    bool isOn = true;
    bool needBroadphaseCollision(btBroadphaseProxy*, btBroadphaseProxy*) const override { return isOn; }
  } filter;
  BulletBroadphase broadphase;
  auto* const first = addUnitCube(broadphase, 0, 1, 0);
  auto* const second = addUnitCube(broadphase, 0, 1, 0);
  const auto pairsAfterMoving = [&] {
    broadphase.setAabb(first, first->m_aabbMin + btVector3(0, btScalar(0.125), 0), first->m_aabbMax, nullptr);
    broadphase.calculateOverlappingPairs(nullptr);
    return broadphase.getOverlappingPairCache()->getNumOverlappingPairs();
  };
  EXPECT_EQ(pairsAfterMoving(), 0);
  broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
  EXPECT_EQ(pairsAfterMoving(), 1);
  filter.isOn = false;
  EXPECT_EQ(pairsAfterMoving(), 0);
  filter.isOn = true;
  EXPECT_EQ(pairsAfterMoving(), 1);
  broadphase.getOverlappingPairCache()->setOverlapFilterCallback(nullptr);
  EXPECT_EQ(pairsAfterMoving(), 0);
  for (auto* proxy : {first, second}) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletBroadphase, AFilterCallbackIsAskedAgainWhereGroupOrMaskChanged) {
  struct OfOneGroup : btOverlapFilterCallback {
    bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
      return a->m_collisionFilterGroup == b->m_collisionFilterGroup &&
             a->m_collisionFilterMask == b->m_collisionFilterMask;
    }
  } filter;
  BulletBroadphase broadphase;
  broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
  auto* const first = addUnitCube(broadphase, 0, 0, 4);
  auto* const second = addUnitCube(broadphase, 0, 2, 4);
  const auto stepped = [&] {
    broadphase.calculateOverlappingPairs(nullptr);
    return pairsOf(*broadphase.getOverlappingPairCache());
  };
  EXPECT_THAT(stepped(), IsEmpty());
  second->m_collisionFilterGroup = 0;
  EXPECT_THAT(stepped(), SizeIs(1));
  first->m_collisionFilterMask = 0;
  EXPECT_THAT(stepped(), IsEmpty());
  second->m_collisionFilterMask = 0;
  EXPECT_THAT(stepped(), SizeIs(1));
  for (auto* proxy : {first, second}) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletBroadphase, TheGhostPairCallbackHearsOfEachPairThatBeginsAndEnds) {
  struct Counter : btOverlappingPairCallback {
    int begun = 0;
    int ended = 0;
    btBroadphasePair* addOverlappingPair(btBroadphaseProxy*, btBroadphaseProxy*) override {
      ++begun;
      return nullptr;
    }
    void* removeOverlappingPair(btBroadphaseProxy*, btBroadphaseProxy*, btDispatcher*) override {
      ++ended;
      return nullptr;
    }
    void removeOverlappingPairsContainingProxy(btBroadphaseProxy*, btDispatcher*) override {}
  } counter;
  BulletBroadphase broadphase;
  broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&counter);
  auto* const first = addUnitCube(broadphase, 0);
  auto* const second = addUnitCube(broadphase, btScalar(0.5));
  for (int step = 0; step < 3; ++step) broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_EQ(counter.begun, 1);
  EXPECT_EQ(counter.ended, 0);
  broadphase.setAabb(second, {5, 0, 0}, {6, 1, 1}, nullptr);
  broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_EQ(counter.ended, 1);
  for (auto* proxy : {first, second}) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletBroadphase, PairsThatOthersTookOutOfTheCacheComeBack) {
  BulletBroadphase broadphase;
  auto* const first = addUnitCube(broadphase, 0);
  auto* const second = addUnitCube(broadphase, btScalar(0.5));
  broadphase.calculateOverlappingPairs(nullptr);
  broadphase.getOverlappingPairCache()->removeOverlappingPair(first, second, nullptr);
  broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_EQ(broadphase.getOverlappingPairCache()->getNumOverlappingPairs(), 1);
  for (auto* proxy : {first, second}) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletBroadphase, ADestroyedProxyLosesItsPairsAtOnce) {
  BulletBroadphase broadphase;
  auto* const first = addUnitCube(broadphase, 0);
  auto* const second = addUnitCube(broadphase, btScalar(0.5));
  broadphase.calculateOverlappingPairs(nullptr);
  broadphase.destroyProxy(first, nullptr);
  EXPECT_EQ(broadphase.getOverlappingPairCache()->getNumOverlappingPairs(), 0);
  broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_EQ(broadphase.getOverlappingPairCache()->getNumOverlappingPairs(), 0);
  broadphase.destroyProxy(second, nullptr);
}

TEST(BulletBroadphase, RaysMeetBoxesFromNearToFarAndAtOnceAfterTheyMoved) {
  BulletBroadphase broadphase;
  auto* const far = addUnitCube(broadphase, 6);
  auto* const near = addUnitCube(broadphase, 2);
  auto* const aside = broadphase.createProxy({2, 3, 0}, {3, 4, 1}, 0, nullptr, 1, -1, nullptr);
  const auto hits = [&](const btVector3& to, btScalar radius = 0) {
    Collector collector;
    const btVector3 half(radius, radius, radius);
    broadphase.rayTest({0, btScalar(0.5), btScalar(0.5)}, to, collector, -half, half);
    return collector.found;
  };
  EXPECT_THAT(hits({10, btScalar(0.5), btScalar(0.5)}), ElementsAre(near, far));
  EXPECT_THAT(hits({4, btScalar(0.5), btScalar(0.5)}), ElementsAre(near));
  EXPECT_THAT(hits({-10, btScalar(0.5), btScalar(0.5)}), IsEmpty());
  EXPECT_THAT(hits({10, btScalar(0.5), btScalar(0.5)}, btScalar(2.5)), ElementsAre(near, aside, far));
  broadphase.setAabb(near, {8, 0, 0}, {9, 1, 1}, nullptr);
  EXPECT_THAT(hits({10, btScalar(0.5), btScalar(0.5)}), ElementsAre(far, near));
  for (auto* proxy : {far, near, aside}) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletBroadphase, ARayThatEndsInABoxMeetsItThoughItsLengthIsRounded) {
  BulletBroadphase broadphase;
  auto* const box = broadphase.createProxy({btScalar(0.5), -1, -1}, {btScalar(0.9), 1, 1}, 0, nullptr, 1, -1, nullptr);
  const auto hits = [&](const btVector3& from, const btVector3& to, btScalar reach) {
    Collector collector;
    broadphase.rayTest(from, to, collector, {-reach, 0, 0}, {reach, 0, 0});
    return collector.found;
  };
  EXPECT_THAT(hits({-16777216, 0, 0}, {1, 0, 0}, 0), ElementsAre(box));  // float32 has no 16777217
  EXPECT_THAT(hits({-16777216, 0, 0}, {btScalar(0.4), 0, 0}, btScalar(0.25)), ElementsAre(box));
  EXPECT_THAT(hits({-16777216, 0, 0}, {btScalar(0.4), 0, 0}, 0), IsEmpty());
  broadphase.destroyProxy(box, nullptr);
}

TEST(BulletBroadphase, ABoxMeetsTheProxiesThatItTouches) {
  Crowd crowd;
  for (int i = 0; i < 200; ++i) crowd.add();
  for (int i = 0; i < 50; ++i) {
    const auto [min, max] = crowd.box();
    Collector collector;
    crowd.broadphase().aabbTest(min, max, collector);
    std::vector<const btBroadphaseProxy*> expected;
    btBroadphaseProxy probe(min, max, nullptr, -1, -1);
    for (btBroadphaseProxy* proxy : crowd.proxies()) {
      btBroadphaseProxy free(proxy->m_aabbMin, proxy->m_aabbMax, nullptr, -1, -1);
      if (isDemanded(probe, free)) expected.push_back(proxy);
    }
    EXPECT_THAT(collector.found, ::testing::UnorderedElementsAreArray(expected));
  }
}

TEST(BulletBroadphase, ACallbackMayAskAnotherQuestion) {
  BulletBroadphase broadphase;
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 20; ++i) proxies.push_back(addUnitCube(broadphase, btScalar(i) / 2));
  struct Curious : btBroadphaseAabbCallback {
    BulletBroadphase* broadphase = nullptr;
    std::size_t count = 0;
    bool process(const btBroadphaseProxy* proxy) override {
      Collector collector;
      broadphase->aabbTest(proxy->m_aabbMin, proxy->m_aabbMax, collector);
      count += collector.found.size();
      return true;
    }
  } curious;
  curious.broadphase = &broadphase;
  broadphase.aabbTest({0, 0, 0}, {2, 1, 1}, curious);
  EXPECT_EQ(curious.count, 3U + 4U + 5U + 5U + 5U);
  for (auto* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletBroadphase, ItsBoxHoldsAllProxiesAndIsAPointWithoutAny) {
  BulletBroadphase broadphase;
  btVector3 min(1, 1, 1);
  btVector3 max(1, 1, 1);
  broadphase.getBroadphaseAabb(min, max);
  EXPECT_TRUE(min.isZero() && max.isZero());
  auto* const first = addUnitCube(broadphase, 4);
  auto* const second = addUnitCube(broadphase, -3);
  broadphase.getBroadphaseAabb(min, max);
  EXPECT_EQ(min, btVector3(-3, 0, 0));
  EXPECT_EQ(max, btVector3(5, 1, 1));
  btVector3 lower;
  btVector3 upper;
  broadphase.getAabb(first, lower, upper);
  EXPECT_EQ(lower, btVector3(4, 0, 0));
  EXPECT_EQ(upper, btVector3(5, 1, 1));
  broadphase.destroyProxy(first, nullptr);
  broadphase.getBroadphaseAabb(min, max);
  EXPECT_EQ(min, btVector3(-3, 0, 0));
  EXPECT_EQ(max, btVector3(-2, 1, 1));
  broadphase.destroyProxy(second, nullptr);
  broadphase.getBroadphaseAabb(min, max);
  EXPECT_TRUE(min.isZero() && max.isZero());
}

TEST(BulletBroadphase, AnEmptiedOneStartsWithTheSameNumbersAgain) {
  BulletBroadphase broadphase;
  for (int round = 0; round < 2; ++round) {
    auto* const first = addUnitCube(broadphase, 0);
    auto* const second = addUnitCube(broadphase, 0);
    broadphase.calculateOverlappingPairs(nullptr);
    EXPECT_EQ(first->getUid(), 1);
    EXPECT_EQ(second->getUid(), 2);
    for (auto* proxy : {first, second}) broadphase.destroyProxy(proxy, nullptr);
    broadphase.resetPool(nullptr);
  }
}

TEST(BulletBroadphase, AnEmptiedOneForgetsThePairsThatWereAddedAtOnce) {
  BulletBroadphase broadphase({.immediatePairs = ImmediatePairs::All});
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 40; ++i) proxies.push_back(addUnitCube(broadphase, 0));
  for (auto* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
  broadphase.resetPool(nullptr);
  auto* const only = addUnitCube(broadphase, 0);
  broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_EQ(only->getUid(), 1);
  EXPECT_THAT(pairsOf(*broadphase.getOverlappingPairCache()), IsEmpty());
  broadphase.destroyProxy(only, nullptr);
}

TEST(BulletBroadphase, OneThatIsNotEmptyIsNotReset) {
  BulletBroadphase broadphase;
  auto* const first = addUnitCube(broadphase, 0);
  auto* const second = addUnitCube(broadphase, 0);
  broadphase.calculateOverlappingPairs(nullptr);
  broadphase.resetPool(nullptr);
  broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_THAT(pairsOf(*broadphase.getOverlappingPairCache()), SizeIs(1));
  EXPECT_EQ(broadphase.proxyOf(0), first);
  EXPECT_EQ(broadphase.proxyOf(1), second);
  for (auto* proxy : {first, second}) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletBroadphase, AnEmptyBoxHasNoPairsAndIsHitByNothing) {
  btCapsuleShape capsule(btScalar(0.5), 1);
  capsule.setLocalScaling({-1, 1, 1});
  btVector3 min;
  btVector3 max;
  capsule.getAabb(btTransform::getIdentity(), min, max);
  ASSERT_GT(min.x(), max.x()) << "Bullet gives a capsule that is mirrored another box";
  BulletBroadphase broadphase;
  auto* const mirrored = broadphase.createProxy(min, max, 0, nullptr, 1, -1, nullptr);
  auto* const around = broadphase.createProxy({-9, -9, -9}, {9, 9, 9}, 0, nullptr, 1, -1, nullptr);
  broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_THAT(pairsOf(*broadphase.getOverlappingPairCache()), IsEmpty());
  Collector collector;
  broadphase.rayTest({-20, 0, 0}, {20, 0, 0}, collector);
  broadphase.aabbTest({-1, -1, -1}, {1, 1, 1}, collector);
  EXPECT_THAT(collector.found, ElementsAre(around, around));
  for (auto* proxy : {mirrored, around}) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletBroadphase, RefusesABoxWithANaN) {
  BulletBroadphase broadphase;
  const btScalar nan = std::numeric_limits<btScalar>::quiet_NaN();
  auto* const proxy = addUnitCube(broadphase, 0);
  try {
    broadphase.createProxy({nan, 0, 0}, {1, 1, 1}, 0, nullptr, 1, -1, nullptr);
    FAIL() << "a NaN was taken";
  } catch (const InvalidBox& error) {
    EXPECT_STREQ(error.what(), "the box of a new proxy has a NaN");
  }
  EXPECT_THROW(broadphase.setAabb(proxy, {0, 0, 0}, {1, nan, 1}, nullptr), InvalidBox);
  EXPECT_EQ(proxy->m_aabbMax.y(), 1);
  broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletBroadphase, RefusesAMarginOfCharactersThatIsNone) {
  for (const btScalar margin :
       {btScalar(-0.2), std::numeric_limits<btScalar>::quiet_NaN(), std::numeric_limits<btScalar>::infinity()}) {
    BulletBroadphaseOptions options;
    options.characterMargin = margin;
    EXPECT_THROW(BulletBroadphase{options}, InvalidArgument) << margin;
  }
}

}  // namespace
}  // namespace allpairs::test
