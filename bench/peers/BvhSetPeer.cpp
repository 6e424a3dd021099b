// SPDX-License-Identifier: MIT
// The hierarchy of bvh (madmann91), version 2. It answers rays, so that the search for boxes in its nodes is written
// here.
#include <bvh/v2/bvh.h>
#include <bvh/v2/default_builder.h>
#include <bvh/v2/node.h>

#include "BoxesInTree.h"
#include "SetPeer.h"

namespace allpairs::bench {

namespace {

template <class T>
class BvhOfSets final : public SetSearch<T> {
  using Node = bvh::v2::Node<T, 3>;
  using Builder = bvh::v2::DefaultBuilder<Node>;
  using Vec = bvh::v2::Vec<T, 3>;
  using Box = bvh::v2::BBox<T, 3>;

 public:
  explicit BvhOfSets(typename Builder::Quality quality) { m_config.quality = quality; }

  std::span<const Pair> find(const Sets<T>& sets) override {
    clear();
    const std::span<const T> searched = sets.areTwo ? sets.second : sets.first;
    const std::size_t count = searched.size() / 6;
    if (count == 0) return m_pairs;
    std::vector<Box> boxes;
    std::vector<Vec> centers;
    boxes.reserve(count);
    centers.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const T* const row = searched.data() + 6 * i;
      boxes.emplace_back(Vec(row[0], row[1], row[2]), Vec(row[3], row[4], row[5]));
      centers.push_back(boxes.back().get_center());
    }
    m_tree = Builder::build(boxes, centers, m_config);
    findInTree(*this, sets, m_pairs);
    return m_pairs;
  }

  void clear() override {
    m_tree = {};
    m_pairs = {};
  }

  // What findInTree asks.
  using NodeId = std::size_t;
  [[nodiscard]] static NodeId root() { return 0; }
  [[nodiscard]] bool reaches(NodeId id, const T* row) const {
    const auto& bounds = m_tree.nodes[id].bounds;
    return bounds[0] <= row[3] && row[0] <= bounds[1] && bounds[2] <= row[4] && row[1] <= bounds[3] &&
           bounds[4] <= row[5] && row[2] <= bounds[5];
  }
  [[nodiscard]] bool isLeaf(NodeId id) const { return m_tree.nodes[id].is_leaf(); }
  [[nodiscard]] NodeId firstChild(NodeId id) const { return m_tree.nodes[id].index.first_id(); }
  template <class Visit>
  void visitLeaf(NodeId id, Visit visit) const {
    const auto index = m_tree.nodes[id].index;
    for (std::size_t k = 0; k < index.prim_count(); ++k) visit(m_tree.prim_ids[index.first_id() + k]);
  }

 private:
  typename Builder::Config m_config;
  bvh::v2::Bvh<Node> m_tree;
  std::vector<Pair> m_pairs;
};

}  // namespace

template <class T>
SetPeer<T> bvhOfSets() {
  using Quality = typename bvh::v2::DefaultBuilder<bvh::v2::Node<T, 3>>::Quality;
  return {"bvh v2",
          {{"low quality", [] { return std::make_unique<BvhOfSets<T>>(Quality::Low); }},
           {"medium quality", [] { return std::make_unique<BvhOfSets<T>>(Quality::Medium); }}}};
}

template SetPeer<float> bvhOfSets<float>();
template SetPeer<double> bvhOfSets<double>();

}  // namespace allpairs::bench
