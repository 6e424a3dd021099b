// SPDX-License-Identifier: MIT
// tinybvh's hierarchy over boxes. It answers rays, so that the search for boxes in its nodes is written here.
#define TINYBVH_IMPLEMENTATION
#include <tiny_bvh.h>

#include "BoxesInTree.h"
#include "SetPeer.h"

namespace allpairs::bench {

namespace {

class TinyBvhOfSets final : public SetSearch<float> {
 public:
  std::span<const Pair> find(const Sets<float>& sets) override {
    clear();
    const std::span<const float> searched = sets.areTwo ? sets.second : sets.first;
    const auto count = static_cast<std::uint32_t>(searched.size() / 6);
    if (count == 0) return m_pairs;
    std::vector<tinybvh::bvhvec4> corners;
    corners.reserve(2 * std::size_t{count});
    for (std::size_t i = 0; i < count; ++i) {
      const float* const row = searched.data() + 6 * i;
      corners.emplace_back(row[0], row[1], row[2], 0.0F);
      corners.emplace_back(row[3], row[4], row[5], 0.0F);
    }
    m_tree = std::make_unique<tinybvh::BVH>();
    m_tree->BuildAABB(corners.data(), count);
    findInTree(*this, sets, m_pairs);
    return m_pairs;
  }

  void clear() override {
    m_tree.reset();
    m_pairs = {};
  }

  // What findInTree asks.
  using NodeId = std::uint32_t;
  [[nodiscard]] static NodeId root() { return 0; }
  [[nodiscard]] bool reaches(NodeId id, const float* row) const {
    const auto& node = m_tree->bvhNode[id];
    return node.aabbMin.x <= row[3] && row[0] <= node.aabbMax.x && node.aabbMin.y <= row[4] &&
           row[1] <= node.aabbMax.y && node.aabbMin.z <= row[5] && row[2] <= node.aabbMax.z;
  }
  [[nodiscard]] bool isLeaf(NodeId id) const { return m_tree->bvhNode[id].isLeaf(); }
  [[nodiscard]] NodeId firstChild(NodeId id) const { return m_tree->bvhNode[id].leftFirst; }
  template <class Visit>
  void visitLeaf(NodeId id, Visit visit) const {
    const auto& node = m_tree->bvhNode[id];
    for (std::uint32_t k = 0; k < node.triCount; ++k) visit(m_tree->primIdx[node.leftFirst + k]);
  }

 private:
  std::unique_ptr<tinybvh::BVH> m_tree;
  std::vector<Pair> m_pairs;
};

}  // namespace

SetPeer<float> tinyBvhOfSets() {
  return {"tinybvh", {{"binned SAH", [] { return std::make_unique<TinyBvhOfSets>(); }}}};
}

}  // namespace allpairs::bench
