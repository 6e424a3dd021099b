// SPDX-License-Identifier: MIT
// The order of pairs with BulletBroadphaseOptions::number: that of the numbers, whatever happened before.
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <btBulletDynamicsCommon.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "BulletBody.h"
#include "BulletPairs.h"
#include "allpairs/bullet/BulletBroadphase.h"

namespace allpairs::test {
namespace {

/// What a proxy is made of: its user pointer leads to it.
struct Named {
  int number = 0;
  btVector3 min{0, 0, 0};
  btVector3 max{0, 0, 0};
  btBroadphaseProxy* proxy = nullptr;
};

int numberOf(const btBroadphaseProxy& proxy) { return static_cast<const Named*>(proxy.m_clientObject)->number; }

using NumberPairs = std::vector<std::pair<int, int>>;

NumberPairs heldInOrder(btOverlappingPairCache& cache) {
  NumberPairs pairs;
  const btBroadphasePairArray& held = cache.getOverlappingPairArray();
  for (int i = 0; i < held.size(); ++i) pairs.emplace_back(numberOf(*held[i].m_pProxy0), numberOf(*held[i].m_pProxy1));
  return pairs;
}

/// All pairs of boxes that share a point, in ascending order.
NumberPairs demandedInOrder(const std::vector<Named>& boxes) {
  NumberPairs pairs;
  for (const Named& a : boxes) {
    for (const Named& b : boxes) {
      const bool isApart = a.max.x() < b.min.x() || b.max.x() < a.min.x() || a.max.y() < b.min.y() ||
                           b.max.y() < a.min.y() || a.max.z() < b.min.z() || b.max.z() < a.min.z();
      if (a.number < b.number && !isApart) pairs.emplace_back(a.number, b.number);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<Named> randomBoxes(std::size_t count, std::mt19937& random) {
  std::uniform_real_distribution<btScalar> place(0, 6);
  std::vector<Named> boxes(count);
  for (std::size_t i = 0; i < count; ++i) {
    boxes[i].number = static_cast<int>(i * 7919 % 1000003);  // neither dense nor ascending
    boxes[i].min = {place(random), place(random), place(random)};
    boxes[i].max = boxes[i].min + btVector3(1, 1, 1);
  }
  return boxes;
}

void create(BulletBroadphase& broadphase, Named& box, const btVector3& min, const btVector3& max) {
  box.proxy = broadphase.createProxy(min, max, 0, &box, 1, -1, nullptr);
}

/// Brings the boxes to where they belong by random calls, with steps between them.
void liveThrough(BulletBroadphase& broadphase, std::vector<Named>& boxes, std::mt19937& random) {
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), random);
  for (const std::size_t i : order) create(broadphase, boxes[i], boxes[i].max, boxes[i].max + btVector3(1, 1, 1));
  for (int round = 0; round < 6; ++round) {
    std::shuffle(order.begin(), order.end(), random);
    const auto some = order.begin() + static_cast<std::ptrdiff_t>(random() % order.size());
    for (auto i = order.begin(); i != some; ++i) broadphase.destroyProxy(boxes[*i].proxy, nullptr);
    if (round % 2 == 0) broadphase.calculateOverlappingPairs(nullptr);
    std::shuffle(order.begin(), some, random);
    for (auto i = order.begin(); i != some; ++i) create(broadphase, boxes[*i], boxes[*i].min, boxes[*i].max);
    if (round % 3 == 0) broadphase.calculateOverlappingPairs(nullptr);
  }
  std::shuffle(order.begin(), order.end(), random);
  for (const std::size_t i : order) broadphase.setAabb(boxes[i].proxy, boxes[i].min, boxes[i].max, nullptr);
  broadphase.calculateOverlappingPairs(nullptr);
}

TEST(BulletOrder, IsThatOfTheNumbersWhateverHappenedBefore) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    std::vector<Named> boxes = randomBoxes(1 + seed * 5, random);
    const NumberPairs demanded = demandedInOrder(boxes);
    for (int history = 0; history < 3; ++history) {
      const auto immediate = static_cast<ImmediatePairs>(history);
      BulletBroadphase broadphase({.immediatePairs = immediate, .number = numberOf});
      liveThrough(broadphase, boxes, random);
      ASSERT_EQ(heldInOrder(*broadphase.getOverlappingPairCache()), demanded) << "seed " << seed << ", " << history;
      for (const Named& box : boxes) broadphase.destroyProxy(box.proxy, nullptr);
    }
  }
}

TEST(BulletOrder, WithoutNumbersDependsOnHistory) {
  std::mt19937 random(1);
  std::vector<Named> boxes = randomBoxes(200, random);
  std::array<NumberPairs, 2> pairs;
  for (NumberPairs& held : pairs) {
    BulletBroadphase broadphase;
    liveThrough(broadphase, boxes, random);
    held = heldInOrder(*broadphase.getOverlappingPairCache());
    for (const Named& box : boxes) broadphase.destroyProxy(box.proxy, nullptr);
  }
  EXPECT_NE(pairs[0], pairs[1]);
}

TEST(BulletOrder, APairKeepsWhatBulletHasStoredInItAndIsFound) {
  std::mt19937 random(3);
  std::vector<Named> boxes = randomBoxes(150, random);
  BulletBroadphase broadphase({.number = numberOf});
  for (Named& box : boxes) create(broadphase, box, box.min, box.max);
  btOverlappingPairCache& cache = *broadphase.getOverlappingPairCache();
  std::map<std::pair<int, int>, int> stored;
  int next = 1;
  for (int step = 0; step < 60; ++step) {
    for (std::size_t i = static_cast<std::size_t>(step) % 7; i < boxes.size(); i += 7) {
      const btVector3 by(btScalar(0.3), btScalar(step % 3) / 5, btScalar(-0.2));
      boxes[i].min += by;
      boxes[i].max += by;
      broadphase.setAabb(boxes[i].proxy, boxes[i].min, boxes[i].max, nullptr);
    }
    broadphase.calculateOverlappingPairs(nullptr);
    const NumberPairs held = heldInOrder(cache);
    ASSERT_EQ(held, demandedInOrder(boxes)) << "step " << step;
    std::map<std::pair<int, int>, int> now;
    for (std::size_t i = 0; i < held.size(); ++i) {
      btBroadphasePair& pair = cache.getOverlappingPairArray()[static_cast<int>(i)];
      ASSERT_EQ(cache.findPair(pair.m_pProxy1, pair.m_pProxy0), &pair);
      const auto before = stored.find(held[i]);
      ASSERT_EQ(pair.m_internalTmpValue, before == stored.end() ? 0 : before->second) << "step " << step;
      if (before == stored.end()) pair.m_internalTmpValue = next++;
      now[held[i]] = pair.m_internalTmpValue;
    }
    stored = std::move(now);
    ASSERT_EQ(cache.findPair(boxes[0].proxy, boxes[1].proxy) != nullptr,
              stored.count({boxes[0].number, boxes[1].number}) != 0);
  }
  for (const Named& box : boxes) broadphase.destroyProxy(box.proxy, nullptr);
}

TEST(BulletOrder, IsWhatTheNarrowPhaseGetsAlsoAfterPairsWereAddedBetweenSteps) {
  struct Recorder : btOverlapCallback {
    NumberPairs pairs;
    bool processOverlap(btBroadphasePair& pair) override {
      pairs.emplace_back(numberOf(*pair.m_pProxy0), numberOf(*pair.m_pProxy1));
      return false;
    }
  };
  std::mt19937 random(5);
  std::vector<Named> boxes = randomBoxes(100, random);
  BulletBroadphase broadphase({.immediatePairs = ImmediatePairs::All, .number = numberOf});
  for (Named& box : boxes) create(broadphase, box, box.min, box.max);  // pairs, and no step
  for (const bool isDeterministic : {false, true}) {
    Recorder recorder;
    btDispatcherInfo info;
    info.m_deterministicOverlappingPairs = isDeterministic;
    broadphase.getOverlappingPairCache()->processAllOverlappingPairs(&recorder, nullptr, info);
    EXPECT_EQ(recorder.pairs, demandedInOrder(boxes));
  }
  broadphase.getOverlappingPairCache()->sortOverlappingPairs(nullptr);
  EXPECT_EQ(heldInOrder(*broadphase.getOverlappingPairCache()), demandedInOrder(boxes));
  for (const Named& box : boxes) broadphase.destroyProxy(box.proxy, nullptr);
}

TEST(BulletOrder, NumbersThatAreNegativeOrTakenAreRefusedAndChangeNothing) {
  BulletBroadphase broadphase({.number = numberOf});
  std::vector<Named> boxes(3);
  boxes[0].number = 4;
  boxes[1].number = -1;
  boxes[2].number = 4;
  create(broadphase, boxes[0], {0, 0, 0}, {1, 1, 1});
  EXPECT_THAT(
      [&] {
        create(broadphase, boxes[1], {0, 0, 0}, {1, 1, 1});
      },
      testing::ThrowsMessage<InvalidArgument>(testing::HasSubstr("the number -1 is negative")));
  EXPECT_THAT(
      [&] {
        create(broadphase, boxes[2], {0, 0, 0}, {1, 1, 1});
      },
      testing::ThrowsMessage<InvalidArgument>(testing::HasSubstr("the number 4 is another proxy's")));
  EXPECT_EQ(broadphase.world().size(), 1U);
  broadphase.destroyProxy(boxes[0].proxy, nullptr);
  const btScalar nan = std::numeric_limits<btScalar>::quiet_NaN();
  EXPECT_THROW(create(broadphase, boxes[2], {nan, 0, 0}, {1, 1, 1}), InvalidBox);
  create(broadphase, boxes[2], {0, 0, 0}, {1, 1, 1});  // the number is free again
  broadphase.destroyProxy(boxes[2].proxy, nullptr);
  broadphase.resetPool(nullptr);
  create(broadphase, boxes[2], {0, 0, 0}, {1, 1, 1});
  broadphase.destroyProxy(boxes[2].proxy, nullptr);
}

TEST(BulletOrder, NeedsTheCacheOfTheBroadPhase) {
  btHashedOverlappingPairCache cache;
  EXPECT_THAT([&] { BulletBroadphase({.pairCache = &cache, .number = numberOf}); },
              testing::ThrowsMessage<InvalidArgument>(testing::HasSubstr("own cache only")));
}

/// A heap of balls and boxes whose proxies are made again in any order before the first step.
class Heap {
 public:
  explicit Heap(unsigned history) : m_broadphase({.number = userIndexOf}) {
    m_world.getDispatchInfo().m_deterministicOverlappingPairs = true;
    add(m_floor, 0, {0, -1, 0});
    for (int i = 0; i < 400; ++i) {
      const auto column = btVector3(btScalar(i % 6), btScalar(i / 36), btScalar(i / 6 % 6)) * btScalar(1.1);
      const btVector3 askew(btScalar(0.07) * static_cast<btScalar>(i % 5), 1, btScalar(0.05) * btScalar(i % 7));
      add(i % 2 == 0 ? static_cast<btCollisionShape&>(m_box) : m_ball, 1, column + askew);
    }
    std::mt19937 random(history);
    std::vector<btRigidBody*> bodies;
    for (const auto& body : m_bodies) bodies.push_back(body.get());
    for (unsigned round = 0; round < history; ++round) {
      m_world.computeOverlappingPairs();  // from here on, an id that becomes free is another proxy's
      std::shuffle(bodies.begin(), bodies.end(), random);
      for (btRigidBody* body : bodies) {
        if (random() % 3 != 0) m_world.refreshBroadphaseProxy(body);
      }
    }
  }
  ~Heap() {
    for (const auto& body : m_bodies) m_world.removeRigidBody(body.get());
  }
  Heap(const Heap&) = delete;
  Heap& operator=(const Heap&) = delete;

  [[nodiscard]] std::vector<btScalar> fall(int steps) {
    for (int step = 0; step < steps; ++step) m_world.stepSimulation(btScalar(1) / 60, 0);
    std::vector<btScalar> places;
    for (const auto& body : m_bodies) {
      const btTransform& pose = body->getWorldTransform();
      for (int axis = 0; axis < 3; ++axis) places.push_back(pose.getOrigin()[axis]);
      for (int axis = 0; axis < 4; ++axis) places.push_back(pose.getRotation()[axis]);
    }
    return places;
  }

 private:
  void add(btCollisionShape& shape, btScalar mass, const btVector3& place) {
    m_bodies.push_back(makeBody(shape, mass, place));
    m_bodies.back()->setUserIndex(static_cast<int>(m_bodies.size()) - 1);
    m_world.addRigidBody(m_bodies.back().get());
  }

  btDefaultCollisionConfiguration m_configuration;
  btCollisionDispatcher m_dispatcher{&m_configuration};
  btSequentialImpulseConstraintSolver m_solver;
  BulletBroadphase m_broadphase;
  btDiscreteDynamicsWorld m_world{&m_dispatcher, &m_broadphase, &m_solver, &m_configuration};
  btBoxShape m_floor{btVector3(60, 1, 60)};
  btBoxShape m_box{btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5))};
  btSphereShape m_ball{btScalar(0.5)};
  std::vector<std::unique_ptr<btRigidBody>> m_bodies;
};

TEST(BulletOrder, ASimulationIsTheSameToTheLastBitWhateverHappenedToTheProxiesBefore) {
  const std::vector<btScalar> places = Heap(0).fall(100);
  EXPECT_EQ(Heap(0).fall(100), places);
  EXPECT_EQ(Heap(1).fall(100), places);
  EXPECT_EQ(Heap(3).fall(100), places);
}

}  // namespace
}  // namespace allpairs::test
