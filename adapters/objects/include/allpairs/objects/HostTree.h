// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "allpairs/Pair.h"
#include "allpairs/objects/ObjectRows.h"

namespace allpairs {

/// What a manager of ours is to its host's own trees. The host's DynamicAABBTreeCollisionManager takes the other manager
/// of a query for one of its own kind without asking, calls its size(), and reads its tree. So here is such a tree, which
/// is empty and costs nothing until somebody calls size().
///
/// Host says what these are: Object, Tree, and update(tree, objects), which has the tree read the boxes of those objects,
/// which are all that it has.
///
/// Threads: bringTree() may be called concurrently while no other member runs.
template <class Host>
class HostTree : public Host::Tree {
 protected:
  using Tree = typename Host::Tree;
  using Object = typename Host::Object;

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

  /// Brings the tree up to date with the boxes that the objects have now. The host calls size(), which is const.
  void bringTree(const ObjectRows<Object>& objects) const {
    if (m_isCurrent.load(std::memory_order_acquire)) return;
    const std::lock_guard lock(m_bringing);
    if (m_isCurrent.load(std::memory_order_relaxed)) return;
    if (objects.size() != 0)
      const_cast<HostTree*>(this)->bringIn(objects);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    m_isCurrent.store(true, std::memory_order_release);
  }

 private:
  void bringIn(const ObjectRows<Object>& objects) {
    m_isInTree.resize(objects.bound(), 0);
    std::vector<Object*> known;
    for (BoxId number = 0; number < objects.bound(); ++number) {
      if (m_isInTree[number] != 0) known.push_back(objects[number]);
    }
    Host::update(*this, known);
    Tree::setup();  // balances it; the tree has called that of the manager, which does nothing
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
