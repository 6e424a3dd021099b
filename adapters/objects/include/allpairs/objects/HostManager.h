// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "allpairs/Pair.h"
#include "allpairs/objects/ObjectBroadPhase.h"

namespace allpairs {

/// A host's broad-phase manager without its queries, whose callbacks each host has of its own: objects that come, move
/// and go, in an ObjectBroadPhase.
///
/// It is also one of the host's own trees. The host's DynamicAABBTreeCollisionManager takes the other manager of a
/// query for one of its own kind without asking, calls its size(), and reads its tree. So here is such a tree, which is
/// empty and costs nothing until somebody calls size().
///
/// Host says what these are: Object, Base, Tree, and update(tree, objects), which has the tree read the boxes of those
/// objects, which are all that it has.
///
/// Threads: const members may be called concurrently while no other member runs.
template <class Host>
class HostManager : public Host::Tree {
 public:
  using Object = typename Host::Object;
  using Base = typename Host::Base;

  void registerObjects(const std::vector<Object*>& objects) override {
    m_objects.reserve(objects.size());
    for (Object* object : objects) registerObject(object);
  }

  void registerObject(Object* object) override {
    m_objects.add(object);
    noteTree();
  }

  void unregisterObject(Object* object) override {
    const BoxId number = m_objects.remove(object);
    if (number >= m_isInTree.size() || m_isInTree[number] == 0) return;
    Tree::unregisterObject(object);
    m_isInTree[number] = 0;
  }

  /// Nothing is left to do: each query finds what it needs.
  void setup() override {}

  void update() override {
    noteTree();
    m_objects.update();
  }

  void update(Object* object) override {
    noteTree();
    m_objects.update(object);
  }

  void update(const std::vector<Object*>& objects) override {
    noteTree();
    m_objects.update(objects);
  }

  void clear() override {
    m_objects.clear();
    if (!m_isInTree.empty()) Tree::clear();
    m_isInTree.clear();
    noteTree();
  }

  using Base::getObjects;

  /// The objects, in the order of their numbers.
  void getObjects(std::vector<Object*>& objects) const override { m_objects.rows().copyTo(objects); }

  [[nodiscard]] bool empty() const override { return m_objects.rows().size() == 0; }

  /// The first call after an update or a registration brings the host's tree up to date, which the host's trees read
  /// after they have called this: from the objects, which must all be alive.
  [[nodiscard]] std::size_t size() const override {
    bringTree();
    return m_objects.rows().size();
  }

 protected:
  explicit HostManager(const ObjectBroadPhaseOptions& options) : m_objects(options) {}

  [[nodiscard]] const ObjectBroadPhase<Object>& objects() const { return m_objects; }

  static std::vector<Object*> objectsOf(const Base& manager) {
    std::vector<Object*> objects;
    manager.getObjects(objects);
    return objects;
  }

 private:
  using Tree = typename Host::Tree;

  /// An object has come or moved.
  void noteTree() { m_isCurrent.store(false, std::memory_order_relaxed); }

  /// Brings the tree up to date with the boxes that the objects have now. The host calls size(), which is const.
  void bringTree() const {
    if (m_isCurrent.load(std::memory_order_acquire)) return;
    const std::lock_guard lock(m_bringing);
    if (m_isCurrent.load(std::memory_order_relaxed)) return;
    if (!empty()) const_cast<HostManager*>(this)->makeTree();  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    m_isCurrent.store(true, std::memory_order_release);
  }

  /// A tree that was not finished holds objects that nobody has noted: it is begun again by the next call.
  void makeTree() {
    try {
      bringIn();
    } catch (...) {
      Tree::clear();
      m_isInTree.clear();
      throw;
    }
  }

  void bringIn() {
    const ObjectRows<Object>& rows = m_objects.rows();
    m_isInTree.resize(rows.bound(), 0);
    std::vector<Object*> known;
    for (BoxId number = 0; number < rows.bound(); ++number) {
      if (m_isInTree[number] != 0) known.push_back(rows[number]);
    }
    Host::update(*this, known);
    // Balances it; the tree has called that of the manager, which does nothing. It takes a node whose squared size
    // overflows for none.
    if (haveSizes(known)) Tree::setup();
    for (BoxId number = 0; number < rows.bound(); ++number) {
      if (rows[number] == nullptr || m_isInTree[number] != 0) continue;
      Tree::registerObject(rows[number]);
      m_isInTree[number] = 1;
    }
  }

  /// Whether the square of the size of the box around all objects is a number.
  static bool haveSizes(const std::vector<Object*>& objects) {
    if (objects.empty()) return true;
    auto min = objects.front()->getAABB().min_;
    auto max = objects.front()->getAABB().max_;
    typename ObjectRows<Object>::S squares = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (const Object* object : objects) {
        min[axis] = std::min(min[axis], object->getAABB().min_[axis]);
        max[axis] = std::max(max[axis], object->getAABB().max_[axis]);
      }
      const auto side = max[axis] - min[axis];
      squares += side * side;
    }
    return std::isfinite(squares);
  }

  ObjectBroadPhase<Object> m_objects;
  std::vector<std::uint8_t> m_isInTree;  // by number
  mutable std::mutex m_bringing;
  mutable std::atomic<bool> m_isCurrent = false;
};

}  // namespace allpairs
