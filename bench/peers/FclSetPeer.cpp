// SPDX-License-Identifier: MIT
// FCL's dynamic tree, which computes in double, within one set and between two.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>

#include "FclBoxes.h"
#include "SetPeer.h"

namespace allpairs::bench {

namespace {

/// A manager of boxes; they must stay where they are.
template <class Manager>
class ManagedSet {
 public:
  template <class T>
  explicit ManagedSet(std::span<const T> rows) {
    m_boxes.reserve(rows.size() / 6);
    for (std::size_t i = 0; i < rows.size() / 6; ++i) {
      m_boxes.emplace_back(rows.data() + 6 * i, static_cast<std::uint32_t>(i));
    }
    std::vector<fcl::CollisionObjectd*> objects;
    objects.reserve(m_boxes.size());
    for (BoxObject& box : m_boxes) objects.push_back(&box);
    manager.registerObjects(objects);
    manager.setup();
  }

  Manager manager;

 private:
  std::vector<BoxObject, Eigen::aligned_allocator<BoxObject>> m_boxes;
};

template <class T, class Manager>
class FclOfSets final : public SetSearch<T> {
 public:
  std::span<const Pair> find(const Sets<T>& sets) override {
    clear();
    m_first = std::make_unique<ManagedSet<Manager>>(sets.first);
    if (sets.areTwo) {
      m_second = std::make_unique<ManagedSet<Manager>>(sets.second);
      m_first->manager.collide(&m_second->manager, &m_pairs, report);
    } else {
      m_first->manager.collide(&m_pairs, report);
    }
    return m_pairs;
  }

  void clear() override {
    m_first.reset();
    m_second.reset();
    m_pairs = {};
  }

 private:
  static bool report(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* pairs) {
    static_cast<std::vector<Pair>*>(pairs)->push_back(
        {static_cast<BoxObject*>(a)->number(), static_cast<BoxObject*>(b)->number()});
    return false;  // Go on.
  }

  std::unique_ptr<ManagedSet<Manager>> m_first;
  std::unique_ptr<ManagedSet<Manager>> m_second;
  std::vector<Pair> m_pairs;
};

}  // namespace

template <class T>
SetPeer<T> fclOfSets() {
  using Tree = fcl::DynamicAABBTreeCollisionManagerd;
  using ArrayTree = fcl::DynamicAABBTreeCollisionManager_Arrayd;
  return {"FCL",
          {{"tree", [] { return std::make_unique<FclOfSets<T, Tree>>(); }},
           {"array tree", [] { return std::make_unique<FclOfSets<T, ArrayTree>>(); }}}};
}

template SetPeer<float> fclOfSets<float>();
template SetPeer<double> fclOfSets<double>();

}  // namespace allpairs::bench
