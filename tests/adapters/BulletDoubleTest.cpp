// SPDX-License-Identifier: MIT
// The adapter in a Bullet of double precision.
#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "BulletPairs.h"
#include "allpairs/bullet/BulletBroadphase.h"

namespace allpairs::test {
namespace {

struct Collector : btBroadphaseRayCallback {
  std::vector<const btBroadphaseProxy*> found;
  bool process(const btBroadphaseProxy* proxy) override {
    found.push_back(proxy);
    return true;
  }
};

TEST(BulletDouble, BoxesThatFloat32CannotTellFromEachOtherArePairsOnlyWhereTheyOverlap) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> steps(0, 40);
  const auto place = [&] { return 1e6 + 1e-9 * steps(random); };
  BulletBroadphase broadphase;
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 100; ++i) {
    const btVector3 min(place(), place(), place());
    const btVector3 size(1e-9 * steps(random), 1e-9 * steps(random), 1e-9 * steps(random));
    proxies.push_back(broadphase.createProxy(min, min + size, 0, nullptr, 1, -1, nullptr));
  }
  broadphase.calculateOverlappingPairs(nullptr);
  const ProxyPairs demanded = demandedPairs({proxies.begin(), proxies.end()});
  EXPECT_GT(demanded.size(), 500U);
  EXPECT_LT(demanded.size(), 4000U);
  EXPECT_EQ(pairsOf(*broadphase.getOverlappingPairCache()), demanded);
  for (auto* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
}

TEST(BulletDouble, ARayWhoseLengthIsNotFiniteHitsNothing) {
  BulletBroadphase broadphase;
  auto* const box = broadphase.createProxy({0, 0, 0}, {1, 1, 1}, 0, nullptr, 1, -1, nullptr);
  const auto hits = [&](double from, double to) {
    Collector collector;
    broadphase.rayTest({from, 0.5, 0.5}, {to, 0.5, 0.5}, collector, {0, -1, -1}, {0, 1, 1});
    return collector.found;
  };
  const double most = std::numeric_limits<double>::max();
  EXPECT_THAT(hits(-most, most), ::testing::IsEmpty());
  EXPECT_THAT(hits(most, -most), ::testing::IsEmpty());
  EXPECT_THAT(hits(-most / 2, most / 2), ::testing::ElementsAre(box));
  broadphase.destroyProxy(box, nullptr);
}

}  // namespace
}  // namespace allpairs::test
