// SPDX-License-Identifier: MIT
// Two of Bullet's dynamic trees, crossed with each other.
#include "BulletBoxes.h"
#include "SetPeer.h"

namespace allpairs::bench {

namespace {

class BulletOfTwoSets final : public SetSearch<float>, private btDbvt::ICollide {
 public:
  explicit BulletOfTwoSets(bool rebuild) : m_rebuild(rebuild) {}

  std::span<const Pair> find(const Sets<float>& sets) override {
    clear();
    fill(m_first, sets.first);
    fill(m_second, sets.second);
    m_first.collideTT(m_first.m_root, m_second.m_root, *this);
    return m_pairs;
  }

  void clear() override {
    m_first.clear();
    m_second.clear();
    m_pairs = {};
  }

 private:
  void fill(btDbvt& tree, std::span<const float> rows) const {
    for (std::size_t i = 0; i < rows.size() / 6; ++i) tree.insert(volumeOf(rows.data() + 6 * i), pointerOf(i));
    if (m_rebuild) tree.optimizeTopDown();
  }

  using btDbvt::ICollide::Process;
  void Process(const btDbvtNode* a, const btDbvtNode* b) override {
    m_pairs.push_back({numberOf(a->data), numberOf(b->data)});
  }

  bool m_rebuild;
  btDbvt m_first;
  btDbvt m_second;
  std::vector<Pair> m_pairs;
};

}  // namespace

SetPeer<float> bulletOfTwoSets() {
  return {"Bullet",
          {{"dbvt, inserted", [] { return std::make_unique<BulletOfTwoSets>(false); }},
           {"dbvt, rebuilt top down", [] { return std::make_unique<BulletOfTwoSets>(true); }}}};
}

}  // namespace allpairs::bench
