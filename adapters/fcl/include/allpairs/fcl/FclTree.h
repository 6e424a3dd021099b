// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "allpairs/Pair.h"
#include "allpairs/fcl/FclObjects.h"

namespace allpairs {

/// What FclBroadPhaseManager is to FCL's trees. A DynamicAABBTreeCollisionManager takes the other manager of a query for
/// one of its own kind without asking, calls its size(), and reads its tree. So here is such a tree, which is empty and
/// costs nothing until somebody calls size().
///
/// Threads: bringTree() may be called concurrently while no other member runs.
template <class S>
class FclTree : public ::fcl::DynamicAABBTreeCollisionManager<S> {
 protected:
  using Tree = ::fcl::DynamicAABBTreeCollisionManager<S>;
  using Object = ::fcl::CollisionObject<S>;

  /// An object has come or moved.
  void noteTree() { m_isCurrent.store(false, std::memory_order_relaxed); }

  /// An object with this number leaves.
  void leaveTree(BoxId number, Object* object) {
    if (number >= m_isInTree.size() || m_isInTree[number] == 0) return;
    Tree::unregisterObject(object);
    m_isInTree[number] = 0;
  }

  void clearTree() {
    if (!m_isInTree.empty()) Tree::clear();
    m_isInTree.clear();
    noteTree();
  }

  /// Brings the tree up to date with the boxes that the objects have now. FCL calls size(), which is const.
  void bringTree(const FclObjects<S>& objects) const {
    if (m_isCurrent.load(std::memory_order_acquire)) return;
    const std::lock_guard lock(m_bringing);
    if (m_isCurrent.load(std::memory_order_relaxed)) return;
    if (objects.size() != 0)
      const_cast<FclTree*>(this)->bringIn(objects);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    m_isCurrent.store(true, std::memory_order_release);
  }

 private:
  void bringIn(const FclObjects<S>& objects) {
    m_isInTree.resize(objects.bound(), 0);
    Tree::update();
    Tree::setup();  // balances it; update() has called that of the manager, which does nothing
    for (BoxId number = 0; number < objects.bound(); ++number) {
      if (objects[number] == nullptr || m_isInTree[number] != 0) continue;
      Tree::registerObject(objects[number]);
      m_isInTree[number] = 1;
    }
  }

  std::vector<std::uint8_t> m_isInTree;  // by number
  mutable std::mutex m_bringing;
  mutable std::atomic<bool> m_isCurrent = false;
};

}  // namespace allpairs
