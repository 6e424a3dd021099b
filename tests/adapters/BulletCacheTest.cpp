// SPDX-License-Identifier: MIT
// What a pair cache gets to hear of pairs: each that begins once, and of each that ends what Bullet keeps for it.
#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "BulletPairs.h"
#include "allpairs/bullet/BulletBroadphase.h"
#include "allpairs/bullet/EarlyPairs.h"

namespace allpairs::test {
namespace {

struct PairCounter : btOverlappingPairCallback {
  int begun = 0;
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy*, btBroadphaseProxy*) override {
    ++begun;
    return nullptr;
  }
  void* removeOverlappingPair(btBroadphaseProxy*, btBroadphaseProxy*, btDispatcher*) override { return nullptr; }
  void removeOverlappingPairsContainingProxy(btBroadphaseProxy*, btDispatcher*) override {}
};

/// A sorted cache takes a pair a second time if it is given one.
template <class Cache>
void expectEachPairOnce() {
  Cache cache;
  PairCounter counter;
  static_cast<btOverlappingPairCache&>(cache).setInternalGhostPairCallback(&counter);
  BulletBroadphase broadphase({.pairCache = &cache, .immediatePairs = ImmediatePairs::All});
  std::vector<btBroadphaseProxy*> proxies;
  for (const btScalar x : {btScalar(0), btScalar(0.5), btScalar(9)}) {
    proxies.push_back(broadphase.createProxy({x, 0, 0}, {x + 1, 1, 1}, 0, nullptr, 1, -1, nullptr));
  }
  for (int step = 0; step < 2; ++step) {
    for (auto* proxy : proxies) broadphase.setAabb(proxy, proxy->m_aabbMin, proxy->m_aabbMax, nullptr);
    EXPECT_EQ(pairsOf(cache), sorted({{proxies[0], proxies[1]}})) << step;
    broadphase.calculateOverlappingPairs(nullptr);
    EXPECT_EQ(pairsOf(cache), sorted({{proxies[0], proxies[1]}})) << step;
    EXPECT_EQ(counter.begun, 1) << step;
  }
  for (auto* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletCache, GetsAPairThatIsAddedAtOnceOnce) {
  expectEachPairOnce<btHashedOverlappingPairCache>();
  expectEachPairOnce<btSortedOverlappingPairCache>();
}

/// Puts two cubes into a world with this cache, and takes them apart.
template <class Cache>
void expectContactsToEnd() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  Cache cache;
  BulletBroadphase broadphase({.pairCache = &cache});
  btCollisionWorld world(&dispatcher, &broadphase, &configuration);
  btBoxShape cube(btVector3(1, 1, 1));
  btCollisionObject first;
  btCollisionObject second;
  for (btCollisionObject* object : {&first, &second}) {
    object->setCollisionShape(&cube);
    world.addCollisionObject(object);
  }
  world.performDiscreteCollisionDetection();
  EXPECT_EQ(dispatcher.getNumManifolds(), 1);
  btTransform away = btTransform::getIdentity();
  away.setOrigin({9, 0, 0});
  second.setWorldTransform(away);
  world.performDiscreteCollisionDetection();
  EXPECT_EQ(cache.getNumOverlappingPairs(), 0);
  EXPECT_EQ(dispatcher.getNumManifolds(), 0);
  for (btCollisionObject* object : {&first, &second}) world.removeCollisionObject(object);
}

TEST(BulletCache, LosesTheContactsOfAPairThatEnds) {
  expectContactsToEnd<btHashedOverlappingPairCache>();
  expectContactsToEnd<btSortedOverlappingPairCache>();
}

TEST(BulletCache, IsPutInOrderWhenItIsSortedBetweenSteps) {
  int next = 10;
  const auto number = [&next](const btBroadphaseProxy&) { return --next; };
  BulletBroadphase broadphase({.immediatePairs = ImmediatePairs::All, .number = number});
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 5; ++i) {
    proxies.push_back(broadphase.createProxy({0, 0, 0}, {1, 1, 1}, 0, nullptr, 1, -1, nullptr));
  }
  btOverlappingPairCache& cache = *broadphase.getOverlappingPairCache();
  cache.sortOverlappingPairs(nullptr);
  std::vector<std::pair<int, int>> held;
  for (int i = 0; i < cache.getNumOverlappingPairs(); ++i) {
    const btBroadphasePair& pair = cache.getOverlappingPairArray()[i];
    held.emplace_back(pair.m_pProxy0->getUid(), pair.m_pProxy1->getUid());
  }
  std::vector<std::pair<int, int>> expected;
  for (int a = 5; a < 10; ++a) {
    for (int b = a + 1; b < 10; ++b) expected.emplace_back(a, b);
  }
  EXPECT_EQ(held, expected);
  for (auto* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletCache, PairsThatComeAndGoBetweenStepsTakeTheMemoryOfAFew) {
  internal::EarlyPairs early;
  for (int i = 0; i < 1000; ++i) {
    early.reserve(2);
    early.add({4, 5});
    early.add({1, 2});
    early.reserve(1);
    early.add({1, 3});
  }
  EXPECT_LE(early.capacity(), 6U);
  early.sort();
  EXPECT_EQ(early.pairs(), (std::vector<Pair>{{1, 2}, {1, 3}, {4, 5}}));
}

}  // namespace
}  // namespace allpairs::test
