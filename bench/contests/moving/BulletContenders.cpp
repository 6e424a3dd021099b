// SPDX-License-Identifier: MIT
// Bullet's dynamic tree: bare, with its leaves updated in place, and as its broad phase with a pair cache.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include "BulletBoxes.h"
#include "MovingSearch.h"

namespace allpairs::bench {

namespace {

class TreeSteps final : public MovingSearch, private btDbvt::ICollide {
 public:
  void start(const MovingScene& scene) override {
    for (std::size_t i = 0; i < scene.rows().size() / 6; ++i) {
      const float* const row = scene.rows().data() + 6 * i;
      m_leaves.push_back(m_tree.insert(volumeOf(row), pointerOf(i)));
    }
    m_tree.optimizeTopDown();
  }

  void step(const MovingScene& scene) override {
    for (const BoxId id : scene.movingIds()) {
      const float* const row = scene.rows().data() + std::size_t{6} * id;
      btDbvtVolume volume = volumeOf(row);
      m_tree.update(m_leaves[id], volume);
    }
    m_tree.optimizeIncremental(1 + m_tree.m_leaves / 100);
    m_pairs.clear();
    m_tree.collideTTpersistentStack(m_tree.m_root, m_tree.m_root, *this);
  }

  void collect(const MovingScene& /*scene*/, std::vector<Pair>& pairs) override { pairs = m_pairs; }

 private:
  using btDbvt::ICollide::Process;
  void Process(const btDbvtNode* a, const btDbvtNode* b) override {
    m_pairs.push_back({numberOf(a->data), numberOf(b->data)});
  }

  btDbvt m_tree;
  std::vector<btDbvtNode*> m_leaves;
  std::vector<Pair> m_pairs;
};

class BroadPhaseSteps final : public MovingSearch {
 public:
  void start(const MovingScene& scene) override {
    m_broadPhase.m_deferedcollide = true;  // All at once, when all boxes are in.
    for (std::size_t i = 0; i < scene.rows().size() / 6; ++i) {
      const float* const row = scene.rows().data() + 6 * i;
      m_proxies.push_back(m_broadPhase.createProxy(corner(row), corner(row + 3), 0, pointerOf(i), 1, 1, nullptr));
    }
    m_broadPhase.calculateOverlappingPairs(nullptr);
  }

  void step(const MovingScene& scene) override {
    for (const BoxId id : scene.movingIds()) {
      const float* const row = scene.rows().data() + std::size_t{6} * id;
      m_broadPhase.setAabb(m_proxies[id], corner(row), corner(row + 3), nullptr);
    }
    m_broadPhase.calculateOverlappingPairs(nullptr);
  }

  /// The cache holds pairs of enlarged boxes as well.
  void collect(const MovingScene& scene, std::vector<Pair>& pairs) override {
    const btBroadphasePairArray& found = m_broadPhase.getOverlappingPairCache()->getOverlappingPairArray();
    const auto overlaps = [&](std::size_t i, std::size_t j) {
      const float* const a = scene.rows().data() + 6 * i;
      const float* const b = scene.rows().data() + 6 * j;
      return a[0] <= b[3] && b[0] <= a[3] && a[1] <= b[4] && b[1] <= a[4] && a[2] <= b[5] && b[2] <= a[5];
    };
    for (int k = 0; k < found.size(); ++k) {
      const std::uint32_t a = numberOf(found[k].m_pProxy0->m_clientObject);
      const std::uint32_t b = numberOf(found[k].m_pProxy1->m_clientObject);
      if (overlaps(a, b)) pairs.push_back({a, b});
    }
  }

 private:
  btDbvtBroadphase m_broadPhase;
  std::vector<btBroadphaseProxy*> m_proxies;
};

}  // namespace

void addBulletContenders(std::vector<MovingContender>& contenders) {
  contenders.push_back({"Bullet", "dbvt, updated", [] { return std::make_unique<TreeSteps>(); }});
  contenders.push_back({"Bullet", "dbvt broad phase", [] { return std::make_unique<BroadPhaseSteps>(); }});
}

}  // namespace allpairs::bench
