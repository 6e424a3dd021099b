// SPDX-License-Identifier: MIT
// FCL's dynamic tree, as nodes and as an array, all boxes registered at once. FCL computes in double, which holds our
// floats exactly.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/config.h>

#include "FclBoxes.h"
#include "Peer.h"

namespace allpairs::bench {

namespace {

template <class Manager>
class FclSearch final : public Search {
 public:
  explicit FclSearch(int initLevel) { m_manager.tree_init_level = initLevel; }

  std::span<const Pair> find(std::span<const float> rows) override {
    const std::size_t count = rows.size() / 6;
    m_boxes.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      m_boxes.emplace_back(rows.data() + 6 * i, static_cast<std::uint32_t>(i));
    }
    std::vector<fcl::CollisionObjectd*> objects;
    objects.reserve(count);
    for (BoxObject& box : m_boxes) objects.push_back(&box);
    m_manager.registerObjects(objects);
    m_manager.setup();
    m_manager.collide(&m_pairs, report);
    return m_pairs;
  }

 private:
  static bool report(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* pairs) {
    static_cast<std::vector<Pair>*>(pairs)->push_back(
        {static_cast<BoxObject*>(a)->number(), static_cast<BoxObject*>(b)->number()});
    return false;  // Go on.
  }

  std::vector<BoxObject, Eigen::aligned_allocator<BoxObject>> m_boxes;
  Manager m_manager;
  std::vector<Pair> m_pairs;
};

}  // namespace

Peer fclPeer() {
  using Tree = fcl::DynamicAABBTreeCollisionManagerd;
  using ArrayTree = fcl::DynamicAABBTreeCollisionManager_Arrayd;
  Peer peer{.name = "FCL", .version = FCL_VERSION, .settings = {}};
  for (const int level : {0, 2}) {
    const std::string suffix = ", built top down to level " + std::to_string(level);
    peer.settings.push_back({"tree" + suffix, [level] { return std::make_unique<FclSearch<Tree>>(level); }});
    peer.settings.push_back({"array tree" + suffix, [level] { return std::make_unique<FclSearch<ArrayTree>>(level); }});
  }
  return peer;
}

}  // namespace allpairs::bench
