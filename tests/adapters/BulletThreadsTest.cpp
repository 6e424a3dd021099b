// SPDX-License-Identifier: MIT
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <btBulletDynamicsCommon.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "BulletPairs.h"
#include "allpairs/bullet/BulletBroadphase.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

/// Threads of oneTBB, which are known to have been given work.
class WatchedThreads final : public Executor {
 public:
  [[nodiscard]] std::size_t concurrency() const noexcept override { return m_threads.concurrency(); }
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    if (count > 1) ++m_divided;
    m_threads.run(count, task);
  }
  [[nodiscard]] std::size_t divided() const { return m_divided; }

 private:
  parallel::TbbExecutor m_threads{3};
  std::atomic<std::size_t> m_divided{0};
};

/// Boxes of which a tenth moves in each of a few steps: who is with whom after each step, by number, in order.
std::vector<std::vector<std::pair<int, int>>> pairsOfSteps(Executor* executor) {
  constexpr int kBoxes = kIsSanitized ? 15000 : 30000;  // enough to be divided among threads
  constexpr int kSteps = 4;
  std::mt19937 random(5);
  std::uniform_real_distribution<btScalar> place(0, 40);
  const auto anywhere = [&] { return btVector3(place(random), place(random), place(random)); };
  const btVector3 size(1, 1, 1);
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  BulletBroadphase broadphase({.executor = executor});
  std::vector<int> numbers(kBoxes);
  std::vector<btBroadphaseProxy*> proxies;
  for (int& number : numbers) {
    number = static_cast<int>(proxies.size());
    const btVector3 min = anywhere();
    // With a dispatcher the client would have to be a collision object.
    proxies.push_back(broadphase.createProxy(min, min + size, 0, &number, 1, -1, nullptr));
  }
  std::vector<std::vector<std::pair<int, int>>> steps;
  for (int step = 0; step < kSteps; ++step) {
    broadphase.calculateOverlappingPairs(&dispatcher);
    auto& pairs = steps.emplace_back();
    for (const auto& [first, second] : pairsOf(*broadphase.getOverlappingPairCache())) {
      const int a = *static_cast<const int*>(first->m_clientObject);
      const int b = *static_cast<const int*>(second->m_clientObject);
      pairs.emplace_back(std::min(a, b), std::max(a, b));
    }
    std::sort(pairs.begin(), pairs.end());
    for (std::size_t i = static_cast<std::size_t>(step); i < proxies.size(); i += 10) {
      const btVector3 min = anywhere();
      broadphase.setAabb(proxies[i], min, min + size, &dispatcher);
    }
  }
  for (btBroadphaseProxy* proxy : proxies) broadphase.destroyProxy(proxy, &dispatcher);
  return steps;
}

TEST(BulletThreads, FindThePairsOfOneThread) {
  WatchedThreads threads;
  const auto found = pairsOfSteps(&threads);
  EXPECT_GT(threads.divided(), 0U);
  EXPECT_GT(found.back().size(), 10000U);
  EXPECT_NE(found.front(), found.back());
  EXPECT_EQ(found, pairsOfSteps(nullptr));
}

/// What rays and boxes find among bodies and characters, by user index, in the order in which it is told.
struct Found : btBroadphaseRayCallback {
  std::vector<int> numbers;
  bool process(const btBroadphaseProxy* proxy) override {
    numbers.push_back(userIndexOf(*proxy));
    return true;
  }
};

/// Bodies, each tenth of them a character, which are asked about between two moves.
class AskedBodies {
 public:
  AskedBodies() : m_broadphase({.executor = &m_threads}) {
    for (int i = 0; i < kBodies; ++i) {
      const bool isCharacter = i % 10 == 0;
      auto& object = m_objects.emplace_back(isCharacter ? std::make_unique<btGhostObject>()
                                                        : std::make_unique<btCollisionObject>());
      object->setUserIndex(i);
      if (isCharacter) object->setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
      m_proxies.push_back(m_broadphase.createProxy({0, 0, 0}, {1, 1, 1}, 0, object.get(), 1, -1, &m_dispatcher));
    }
  }

  ~AskedBodies() {
    for (btBroadphaseProxy* proxy : m_proxies) m_broadphase.destroyProxy(proxy, &m_dispatcher);
  }

  AskedBodies(const AskedBodies&) = delete;
  AskedBodies& operator=(const AskedBodies&) = delete;

  void move() {
    for (btBroadphaseProxy* proxy : m_proxies) {
      const btVector3 min = anywhere();
      m_broadphase.setAabb(proxy, min, min + btVector3(1, 1, 1), &m_dispatcher);
    }
  }

  /// The same questions each time.
  [[nodiscard]] std::vector<int> ask() {
    std::mt19937 random(8);
    std::uniform_real_distribution<btScalar> place(0, kExtent);
    Found found;
    for (int i = 0; i < 50; ++i) {
      const btVector3 from(place(random), place(random), place(random));
      const btVector3 to(place(random), place(random), place(random));
      m_broadphase.rayTest(from, to, found, {-1, -1, -1}, {1, 1, 1});
      m_broadphase.aabbTest(from, from + btVector3(2, 2, 2), found);
    }
    return found.numbers;
  }

 private:
  static constexpr int kBodies = 2000;
  static constexpr btScalar kExtent = 20;

  btVector3 anywhere() {
    std::uniform_real_distribution<btScalar> place(0, kExtent);
    return {place(m_random), place(m_random), place(m_random)};
  }

  std::mt19937 m_random{6};
  parallel::TbbExecutor m_threads{2};
  btDefaultCollisionConfiguration m_configuration;
  btCollisionDispatcher m_dispatcher{&m_configuration};
  BulletBroadphase m_broadphase;
  std::vector<std::unique_ptr<btCollisionObject>> m_objects;
  std::vector<btBroadphaseProxy*> m_proxies;
};

TEST(BulletThreads, MayTestRaysAndBoxesAtTheSameTime) {
  AskedBodies bodies;
  for (int round = 0; round < 5; ++round) {
    bodies.move();
    std::vector<std::vector<int>> found(4);
    std::vector<std::thread> threads;
    threads.reserve(found.size());
    for (std::vector<int>& each : found) threads.emplace_back([&] { each = bodies.ask(); });
    for (std::thread& thread : threads) thread.join();
    const std::vector<int> expected = bodies.ask();
    EXPECT_GT(expected.size(), 1000U);
    EXPECT_THAT(found, ::testing::Each(expected)) << "round " << round;
  }
}

}  // namespace
}  // namespace allpairs::test
