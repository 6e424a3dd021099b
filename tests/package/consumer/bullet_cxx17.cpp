// SPDX-License-Identifier: MIT
#include <allpairs/bullet/BulletBroadphase.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "DoubleLoop.h"

static_assert(__cplusplus == 201703L, "what is linked asks for another standard");

namespace {

btVector3 cornerOf(const Row& row, std::size_t begin) { return {row[begin], row[begin + 1], row[begin + 2]}; }

/// The pairs of the cache by the numbers that are the proxies' client objects.
Pairs heldPairs(allpairs::BulletBroadphase& broadphase, const std::vector<btBroadphaseProxy*>& proxies) {
  const auto numberOf = [&](const btBroadphaseProxy* proxy) {
    return static_cast<std::size_t>(std::find(proxies.begin(), proxies.end(), proxy) - proxies.begin());
  };
  Pairs pairs;
  const btBroadphasePairArray& held = broadphase.getOverlappingPairCache()->getOverlappingPairArray();
  for (int i = 0; i < held.size(); ++i) {
    pairs.push_back(std::minmax(numberOf(held[i].m_pProxy0), numberOf(held[i].m_pProxy1)));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

int main() {
  constexpr std::size_t kCount = 200;
  allpairs::BulletBroadphase broadphase;
  std::vector<btBroadphaseProxy*> proxies;
  for (const Row& row : someRows(kCount, 1)) {
    proxies.push_back(broadphase.createProxy(cornerOf(row, 0), cornerOf(row, 3), 0, nullptr, 1, 1, nullptr));
  }
  bool isRight = true;
  for (std::uint32_t step = 1; step < 6; ++step) {
    const std::vector<Row> rows = someRows(kCount, step);
    for (std::size_t i = 0; i < kCount; ++i) {
      broadphase.setAabb(proxies[i], cornerOf(rows[i], 0), cornerOf(rows[i], 3), nullptr);
    }
    broadphase.calculateOverlappingPairs(nullptr);
    const Pairs expected = byDoubleLoop(rows);
    isRight = isRight && !expected.empty() && heldPairs(broadphase, proxies) == expected;
  }
  for (btBroadphaseProxy* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
  return isRight ? EXIT_SUCCESS : EXIT_FAILURE;
}
