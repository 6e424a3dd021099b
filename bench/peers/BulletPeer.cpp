// SPDX-License-Identifier: MIT
// Bullet's dynamic tree, used directly and as its broad phase with a pair cache, and its axis sweep. The sweep rounds
// bounds outward to a grid, so its pairs are tested again.
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <algorithm>

#include "BulletBoxes.h"
#include "Peer.h"

namespace allpairs::bench {

namespace {

/// The bare tree: boxes inserted one by one, or rebuilt from the top when all are in, then crossed with itself.
class DynamicTree final : public Search, private btDbvt::ICollide {
 public:
  explicit DynamicTree(bool rebuild) : m_rebuild(rebuild) {}

  std::span<const Pair> find(std::span<const float> rows) override {
    for (std::size_t i = 0; i < rows.size() / 6; ++i) {
      const float* const row = rows.data() + 6 * i;
      m_tree.insert(volumeOf(row), pointerOf(i));
    }
    if (m_rebuild) m_tree.optimizeTopDown();
    m_tree.collideTTpersistentStack(m_tree.m_root, m_tree.m_root, *this);
    return m_pairs;
  }

 private:
  using btDbvt::ICollide::Process;
  void Process(const btDbvtNode* a, const btDbvtNode* b) override {
    m_pairs.push_back({numberOf(a->data), numberOf(b->data)});
  }

  bool m_rebuild;
  btDbvt m_tree;
  std::vector<Pair> m_pairs;
};

/// A broad phase of Bullet's, with its cache of pairs.
template <class BroadPhase>
class CachedBroadPhase final : public Search {
 public:
  std::span<const Pair> find(std::span<const float> rows) override {
    m_broadPhase = make(rows);
    for (std::size_t i = 0; i < rows.size() / 6; ++i) addBox(rows.data() + 6 * i, i);
    m_broadPhase->calculateOverlappingPairs(nullptr);
    collect(rows);
    return m_pairs;
  }

 private:
  static std::unique_ptr<BroadPhase> make(std::span<const float> rows);

  void addBox(const float* row, std::size_t number) {
    constexpr int kShapeType = 0;
    constexpr int kGroup = 1;
    constexpr int kMask = 1;
    m_broadPhase->createProxy(corner(row), corner(row + 3), kShapeType, pointerOf(number), kGroup, kMask, nullptr);
  }

  void collect(std::span<const float> rows) {
    const btBroadphasePairArray& found = m_broadPhase->getOverlappingPairCache()->getOverlappingPairArray();
    m_pairs.reserve(static_cast<std::size_t>(found.size()));
    for (int k = 0; k < found.size(); ++k) {
      const std::uint32_t a = numberOf(found[k].m_pProxy0->m_clientObject);
      const std::uint32_t b = numberOf(found[k].m_pProxy1->m_clientObject);
      if (rowsOverlap(rows.data(), a, b)) m_pairs.push_back({a, b});
    }
  }

  std::unique_ptr<BroadPhase> m_broadPhase;
  std::vector<Pair> m_pairs;
};

template <>
std::unique_ptr<btDbvtBroadphase> CachedBroadPhase<btDbvtBroadphase>::make(std::span<const float>) {
  auto broadPhase = std::make_unique<btDbvtBroadphase>();
  broadPhase->m_deferedcollide = true;  // All at once, when all boxes are in.
  return broadPhase;
}

template <>
std::unique_ptr<bt32BitAxisSweep3> CachedBroadPhase<bt32BitAxisSweep3>::make(std::span<const float> rows) {
  btVector3 min = corner(rows.data());
  btVector3 max = corner(rows.data() + 3);
  for (std::size_t i = 0; i < rows.size() / 6; ++i) {
    min.setMin(corner(rows.data() + 6 * i));
    max.setMax(corner(rows.data() + 6 * i + 3));
  }
  return std::make_unique<bt32BitAxisSweep3>(min, max, static_cast<unsigned>(rows.size() / 6 + 1));
}

}  // namespace

Peer bulletPeer() {
  Peer peer{.name = "Bullet",
            .version = std::to_string(btGetVersion() / 100) + "." + std::to_string(btGetVersion() % 100),
            .settings = {}};
  peer.settings.push_back({"dbvt, inserted", [] { return std::make_unique<DynamicTree>(false); }});
  peer.settings.push_back({"dbvt, rebuilt top down", [] { return std::make_unique<DynamicTree>(true); }});
  peer.settings.push_back({"dbvt broad phase", [] { return std::make_unique<CachedBroadPhase<btDbvtBroadphase>>(); }});
  constexpr std::size_t kMostBoxesSwept = 10000;  // Each box is sorted in from the end: O(n^2).
  peer.settings.push_back(
      {"axis sweep", [] { return std::make_unique<CachedBroadPhase<bt32BitAxisSweep3>>(); }, kMostBoxesSwept});
  return peer;
}

}  // namespace allpairs::bench
