// SPDX-License-Identifier: MIT
// FCL's dynamic tree, as nodes and as an array, updated in each frame.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>

#include "FclBoxes.h"
#include "MovingSearch.h"

namespace allpairs::bench {

namespace {

template <class Manager>
class FclSteps final : public MovingSearch {
 public:
  void start(const MovingScene& scene) override {
    const std::size_t count = scene.rows().size() / 6;
    m_boxes.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      m_boxes.emplace_back(scene.rows().data() + 6 * i, static_cast<std::uint32_t>(i));
    }
    std::vector<fcl::CollisionObjectd*> objects;
    for (BoxObject& box : m_boxes) objects.push_back(&box);
    m_manager.registerObjects(objects);
    m_manager.setup();
    for (const BoxId id : scene.movingIds()) m_moving.push_back(&m_boxes[id]);
  }

  /// All objects at once, or one by one if they are few: whichever its documentation has for the case.
  void step(const MovingScene& scene) override {
    for (const BoxId id : scene.movingIds()) m_boxes[id].set(scene.rows().data() + std::size_t{6} * id);
    if (m_moving.size() == m_boxes.size()) {
      m_manager.update();
    } else {
      m_manager.update(m_moving);
    }
    m_pairs.clear();
    m_manager.collide(&m_pairs, report);
  }

  void collect(const MovingScene& /*scene*/, std::vector<Pair>& pairs) override { pairs = m_pairs; }

 private:
  static bool report(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* pairs) {
    static_cast<std::vector<Pair>*>(pairs)->push_back(
        {static_cast<BoxObject*>(a)->number(), static_cast<BoxObject*>(b)->number()});
    return false;  // Go on.
  }

  std::vector<BoxObject, Eigen::aligned_allocator<BoxObject>> m_boxes;
  std::vector<fcl::CollisionObjectd*> m_moving;
  Manager m_manager;
  std::vector<Pair> m_pairs;
};

}  // namespace

void addFclContenders(std::vector<MovingContender>& contenders) {
  using Tree = fcl::DynamicAABBTreeCollisionManagerd;
  using ArrayTree = fcl::DynamicAABBTreeCollisionManager_Arrayd;
  contenders.push_back({"FCL", "dynamic tree", [] { return std::make_unique<FclSteps<Tree>>(); }});
  contenders.push_back({"FCL", "dynamic array tree", [] { return std::make_unique<FclSteps<ArrayTree>>(); }});
}

}  // namespace allpairs::bench
