// SPDX-License-Identifier: MIT
// Calls of a broad phase and of its pair cache in random order, as a world and its users may make them.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "BulletPairs.h"
#include "allpairs/bullet/BulletBroadphase.h"

namespace allpairs::test {
namespace {

/// Lets the proxies collide whose numbers have an even sum.
struct EvenSums : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
    return (a->getUid() + b->getUid()) % 2 == 0;
  }
};

/// Makes random calls of a broad phase, with proxies in a room where each overlaps some others.
class Caller {
 public:
  Caller(btBroadphaseInterface& broadphase, unsigned seed) : m_broadphase(broadphase), m_random(seed) {}
  ~Caller() {
    while (!m_proxies.empty()) destroy();
  }
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;

  void create() {
    const auto [min, max] = box();
    m_proxies.push_back(m_broadphase.createProxy(min, max, 0, nullptr, 1 << number(2), number(7), nullptr));
  }

  void move() {
    if (m_proxies.empty()) return;
    const auto [min, max] = box();
    m_broadphase.setAabb(any(), min, max, nullptr);
  }

  void destroy() {
    if (m_proxies.empty()) return;
    std::swap(m_proxies[static_cast<std::size_t>(number(static_cast<int>(m_proxies.size()) - 1))], m_proxies.back());
    m_broadphase.destroyProxy(m_proxies.back(), nullptr);
    m_proxies.pop_back();
  }

  /// One of all calls that change a broad phase, or its cache behind its back.
  void callAny() {
    if (m_proxies.size() < 2) return create();
    switch (number(13)) {
      case 0:
      case 1:
        return create();
      case 2:
      case 3:
      case 4:
      case 5:
        return move();
      case 6:
        return destroy();
      case 7:
        return m_broadphase.getOverlappingPairCache()->removeOverlappingPairsContainingProxy(any(), nullptr);
      case 8:
        return m_broadphase.getOverlappingPairCache()->cleanProxyFromPairs(any(), nullptr);
      case 9:
        any()->m_collisionFilterMask = number(7);
        return;
      case 10:
        any()->m_collisionFilterGroup = 1 << number(2);
        return;
      case 11:
        return changePair();
      case 12:
        return m_broadphase.getOverlappingPairCache()->sortOverlappingPairs(nullptr);
      default:
        if (number(9) == 0) switchFilter();
    }
  }

  /// What the cache must hold after calculateOverlappingPairs().
  [[nodiscard]] ProxyPairs demanded() const {
    if (!m_isFiltered) return demandedPairs({m_proxies.begin(), m_proxies.end()});
    ProxyPairs pairs;
    for (std::size_t i = 0; i < m_proxies.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const bool isAllowed = m_evenSums.needBroadphaseCollision(m_proxies[i], m_proxies[j]);
        if (isAllowed && doBoxesOverlap(*m_proxies[i], *m_proxies[j])) pairs.emplace_back(m_proxies[i], m_proxies[j]);
      }
    }
    return sorted(std::move(pairs));
  }

  [[nodiscard]] int number(int most) { return std::uniform_int_distribution<int>(0, most)(m_random); }

 private:
  btBroadphaseProxy* any() {
    return m_proxies[static_cast<std::size_t>(number(static_cast<int>(m_proxies.size()) - 1))];
  }

  /// Adds a pair that may be none, or removes one.
  void changePair() {
    btBroadphaseProxy* const a = any();
    btBroadphaseProxy* const b = any();
    if (a == b) return;
    if (number(1) == 0) {
      m_broadphase.getOverlappingPairCache()->addOverlappingPair(a, b);
    } else {
      m_broadphase.getOverlappingPairCache()->removeOverlappingPair(a, b, nullptr);
    }
  }

  void switchFilter() {
    m_isFiltered = !m_isFiltered;
    m_broadphase.getOverlappingPairCache()->setOverlapFilterCallback(m_isFiltered ? &m_evenSums : nullptr);
  }

  /// Few different coordinates, so that boxes often share a face.
  btScalar coordinate(int most) { return static_cast<btScalar>(number(most)) / 4; }
  std::pair<btVector3, btVector3> box() {
    const btVector3 min(coordinate(12), coordinate(12), coordinate(12));
    return {min, min + btVector3(coordinate(6), coordinate(6), coordinate(6))};
  }

  btBroadphaseInterface& m_broadphase;
  std::mt19937 m_random;
  std::vector<btBroadphaseProxy*> m_proxies;
  EvenSums m_evenSums;
  bool m_isFiltered = false;
};

constexpr unsigned kSeeds = 60;
constexpr int kCalls = 600;

/// Random calls with a cache of this kind, and after each calculateOverlappingPairs() the comparison.
template <class Cache>
void expectExactPairsAfterAnyCalls() {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    Cache cache;
    BulletBroadphase broadphase({.pairCache = &cache, .immediatePairs = static_cast<ImmediatePairs>(seed % 3)});
    Caller caller(broadphase, seed);
    for (int call = 0; call < kCalls; ++call) {
      caller.callAny();
      if (caller.number(3) != 0) continue;
      broadphase.calculateOverlappingPairs(nullptr);
      ASSERT_EQ(pairsOf(cache), caller.demanded()) << "seed " << seed << ", call " << call;
    }
  }
}

TEST(BulletProxyCalls, InAnyOrderLeaveExactlyTheDemandedPairsInAHashedCache) {
  expectExactPairsAfterAnyCalls<btHashedOverlappingPairCache>();
}

TEST(BulletProxyCalls, InAnyOrderLeaveExactlyTheDemandedPairsInASortedCache) {
  expectExactPairsAfterAnyCalls<btSortedOverlappingPairCache>();
}

TEST(BulletProxyCalls, InAnyOrderLeaveExactlyTheDemandedPairsInOrderIfProxiesHaveNumbers) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    int next = 0;
    const auto number = [&next](const btBroadphaseProxy&) { return ++next * 7919 % 10007; };
    BulletBroadphase broadphase({.immediatePairs = static_cast<ImmediatePairs>(seed % 3), .number = number});
    Caller caller(broadphase, seed);
    for (int call = 0; call < kCalls; ++call) {
      caller.callAny();
      if (caller.number(3) != 0) continue;
      broadphase.calculateOverlappingPairs(nullptr);
      btOverlappingPairCache& cache = *broadphase.getOverlappingPairCache();
      ASSERT_EQ(pairsOf(cache), caller.demanded()) << "seed " << seed << ", call " << call;
      std::vector<std::pair<int, int>> held;
      for (int i = 0; i < cache.getNumOverlappingPairs(); ++i) {
        const btBroadphasePair& pair = cache.getOverlappingPairArray()[i];
        held.emplace_back(pair.m_pProxy0->getUid(), pair.m_pProxy1->getUid());
      }
      ASSERT_TRUE(std::is_sorted(held.begin(), held.end())) << "seed " << seed << ", call " << call;
    }
  }
}

TEST(BulletProxyCalls, InAnyOrderLeaveANullCacheEmptyAndTheWorldWithItsPairs) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    btNullPairCache cache;
    BulletBroadphase broadphase({.pairCache = &cache, .immediatePairs = static_cast<ImmediatePairs>(seed % 3)});
    Caller caller(broadphase, seed);
    for (int call = 0; call < kCalls; ++call) {
      if (caller.number(9) < 8) {
        caller.move();
      } else {
        caller.create();
      }
      if (caller.number(3) != 0) continue;
      broadphase.calculateOverlappingPairs(nullptr);
      ASSERT_EQ(cache.getOverlappingPairArray().size(), 0);
      ProxyPairs pairs;
      for (const Pair& pair : broadphase.world().result().pairs) {
        pairs.emplace_back(broadphase.proxyOf(pair.first), broadphase.proxyOf(pair.second));
      }
      ASSERT_EQ(sorted(std::move(pairs)), caller.demanded()) << "seed " << seed << ", call " << call;
    }
  }
}

TEST(BulletProxyCalls, APairTakenOutBeforeAnotherProxyIsDestroyedComesBack) {
  BulletBroadphase broadphase;
  const auto add = [&](btScalar x) {
    return broadphase.createProxy({x, 0, 0}, {x + 1, 1, 1}, 0, nullptr, 1, -1, nullptr);
  };
  auto* const first = add(0);
  auto* const second = add(btScalar(0.5));
  auto* const third = add(9);
  broadphase.calculateOverlappingPairs(nullptr);
  broadphase.getOverlappingPairCache()->removeOverlappingPairsContainingProxy(first, nullptr);
  broadphase.destroyProxy(third, nullptr);
  broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_EQ(pairsOf(*broadphase.getOverlappingPairCache()), sorted({{first, second}}));
  for (auto* proxy : {first, second}) broadphase.destroyProxy(proxy, nullptr);
}

/// Whether a list has all pairs of another; both are sorted.
bool includes(const ProxyPairs& all, const ProxyPairs& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

TEST(BulletProxyCalls, WithImmediatePairsOfAllNoneIsEverMissingAsInADynamicTree) {
  BulletBroadphase ours({.immediatePairs = ImmediatePairs::All});
  btDbvtBroadphase theirs;
  for (btBroadphaseInterface* broadphase :
       {static_cast<btBroadphaseInterface*>(&ours), static_cast<btBroadphaseInterface*>(&theirs)}) {
    Caller caller(*broadphase, 7);
    for (int i = 0; i < 30; ++i) caller.create();
    for (int call = 0; call < 2000; ++call) {
      const int choice = caller.number(19);
      if (choice == 0) caller.create();
      if (choice == 1) caller.destroy();
      if (choice == 2) broadphase->calculateOverlappingPairs(nullptr);
      if (choice > 2) caller.move();
      ASSERT_TRUE(includes(pairsOf(*broadphase->getOverlappingPairCache()), caller.demanded())) << "call " << call;
    }
  }
}

TEST(BulletProxyCalls, AStepThatFailsIsMadeUpForByTheNext) {
  struct Fails : btOverlapFilterCallback {
    bool needBroadphaseCollision(btBroadphaseProxy* /*a*/, btBroadphaseProxy* /*b*/) const override {
      if (--calls == 0) throw std::runtime_error("not now");
      return true;
    }
    mutable int calls = 0;
  };
  int failures = 0;
  for (int failing = 1; failing < 60; ++failing) {
    Fails filter;
    BulletBroadphase broadphase;
    broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
    std::vector<btBroadphaseProxy*> proxies;
    const auto boxOf = [](int i, int step) {
      const auto x = btScalar(step == 0 ? i / 2 : i / 4);
      return std::pair(btVector3(x, 0, 0), btVector3(x + btScalar(0.5), 1, 1));
    };
    for (int i = 0; i < 12; ++i) {
      const auto [min, max] = boxOf(i, 0);
      proxies.push_back(broadphase.createProxy(min, max, 0, nullptr, 1, -1, nullptr));
    }
    broadphase.calculateOverlappingPairs(nullptr);
    for (std::size_t i = 0; i < proxies.size(); ++i) {
      const auto [min, max] = boxOf(static_cast<int>(i), 1);
      broadphase.setAabb(proxies[i], min, max, nullptr);
    }
    filter.calls = failing;
    try {
      broadphase.calculateOverlappingPairs(nullptr);
    } catch (const std::runtime_error&) {
      ++failures;
    }
    filter.calls = 0;
    broadphase.calculateOverlappingPairs(nullptr);
    EXPECT_EQ(pairsOf(*broadphase.getOverlappingPairCache()),
              demandedPairs(std::vector<const btBroadphaseProxy*>(proxies.begin(), proxies.end())))
        << "call " << failing << " of the filter failed";
    for (auto* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
  }
  EXPECT_GT(failures, 5);
}

/// Refuses some calls, whatever they ask about.
struct RefusesCalls : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* /*a*/, btBroadphaseProxy* /*b*/) const override {
    const int call = calls++;
    return call < begin || call >= end;
  }
  mutable int calls = 0;
  int begin = 0;
  int end = 0;
};

/// With a cache of the test's, or with the broad phase's own.
void expectRefusedPairsInTheNextStep(bool isOwn) {
  int refusedPairs = 0;
  for (int begin = 0; begin < 24; ++begin) {
    for (int end = begin; end <= 24; ++end) {
      RefusesCalls filter;
      filter.begin = begin;
      filter.end = end;
      btHashedOverlappingPairCache cache;
      BulletBroadphaseOptions options;
      if (!isOwn) options.pairCache = &cache;
      BulletBroadphase broadphase(options);
      broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
      std::vector<btBroadphaseProxy*> proxies;
      for (const btScalar x : {btScalar(0), btScalar(0.5), btScalar(1.25), btScalar(1.75)}) {
        proxies.push_back(broadphase.createProxy({x, 0, 0}, {x + 1, 1, 1}, 0, nullptr, 1, -1, nullptr));
      }
      broadphase.calculateOverlappingPairs(nullptr);
      refusedPairs += static_cast<int>(broadphase.world().result().pairs.size()) -
                      broadphase.getOverlappingPairCache()->getNumOverlappingPairs();
      filter.end = 0;
      broadphase.calculateOverlappingPairs(nullptr);
      ProxyPairs found;
      for (const Pair& pair : broadphase.world().result().pairs) {
        found.emplace_back(broadphase.proxyOf(pair.first), broadphase.proxyOf(pair.second));
      }
      EXPECT_EQ(pairsOf(*broadphase.getOverlappingPairCache()), sorted(found)) << begin << " to " << end;
      for (auto* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
    }
  }
  EXPECT_GT(refusedPairs, 0);
}

TEST(BulletProxyCalls, APairThatTheFilterRefusesOnlyWhenItIsAddedIsAddedInTheNextStep) {
  expectRefusedPairsInTheNextStep(true);
  expectRefusedPairsInTheNextStep(false);
}

TEST(BulletProxyCalls, AProxyWhosePairsFailIsNotThere) {
  struct Refuses : btOverlapFilterCallback {
    bool needBroadphaseCollision(btBroadphaseProxy* /*a*/, btBroadphaseProxy* /*b*/) const override {
      if (fails) throw std::runtime_error("asked too early");
      return true;
    }
    bool fails = true;
  } filter;
  BulletBroadphase broadphase({.immediatePairs = ImmediatePairs::All});
  broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&filter);
  const auto add = [&] { return broadphase.createProxy({0, 0, 0}, {1, 1, 1}, 0, nullptr, 1, -1, nullptr); };
  auto* const first = add();
  EXPECT_THROW((void)add(), std::runtime_error);
  EXPECT_EQ(broadphase.world().size(), 1U);
  filter.fails = false;
  auto* const second = add();
  broadphase.calculateOverlappingPairs(nullptr);
  EXPECT_EQ(pairsOf(*broadphase.getOverlappingPairCache()), sorted({{first, second}}));
  for (auto* proxy : {first, second}) broadphase.destroyProxy(proxy, nullptr);
}

}  // namespace
}  // namespace allpairs::test
