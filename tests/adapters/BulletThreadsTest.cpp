// SPDX-License-Identifier: MIT
#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <random>
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

}  // namespace
}  // namespace allpairs::test
