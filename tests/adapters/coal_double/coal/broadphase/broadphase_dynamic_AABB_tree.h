// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <stdexcept>

#include "coal/broadphase/broadphase_collision_manager.h"

namespace coal {

/// No tree: a double loop over the boxes as they were when they were last read. As Coal's tree does, it takes the other
/// manager for one of its own kind, reads what that one has after its size(), and refuses to update all where a box is
/// flat.
class DynamicAABBTreeCollisionManager : public BroadPhaseCollisionManager {
 public:
  void registerObject(CollisionObject* object) override { m_bounds[object] = object->getAABB(); }
  void unregisterObject(CollisionObject* object) override { m_bounds.erase(object); }
  void setup() override {}
  void update() override {
    for (auto& [object, bounds] : m_bounds) {
      bounds = object->getAABB();
      for (int axis = 0; axis < 3; ++axis) {
        if (bounds.min_[axis] >= bounds.max_[axis]) throw std::invalid_argument("a flat box");
      }
    }
  }
  void update(CollisionObject* object) override { m_bounds.at(object) = object->getAABB(); }
  void update(const Objects& objects) override {
    for (CollisionObject* object : objects) m_bounds.at(object) = object->getAABB();
  }
  void clear() override { m_bounds.clear(); }
  void getObjects(Objects& objects) const override {
    objects.clear();
    for (const auto& [object, bounds] : m_bounds) objects.push_back(object);
  }
  using BroadPhaseCollisionManager::getObjects;

  void collide(CollisionObject* object, CollisionCallBackBase* callback) const override {
    callback->init();
    for (const auto& [own, bounds] : m_bounds) {
      if (bounds.overlap(object->getAABB()) && (*callback)(own, object)) return;
    }
  }
  void distance(CollisionObject* object, DistanceCallBackBase* callback) const override {
    callback->init();
    double least = std::numeric_limits<double>::max();
    for (const auto& [own, bounds] : m_bounds) {
      if (bounds.distance(object->getAABB()) < least && (*callback)(own, object, least)) return;
    }
  }
  void collide(CollisionCallBackBase* callback) const override {
    callback->init();
    for (auto first = m_bounds.begin(); first != m_bounds.end(); ++first) {
      for (auto second = std::next(first); second != m_bounds.end(); ++second) {
        if (first->second.overlap(second->second) && (*callback)(first->first, second->first)) return;
      }
    }
  }
  void distance(DistanceCallBackBase* callback) const override {
    callback->init();
    double least = std::numeric_limits<double>::max();
    for (auto first = m_bounds.begin(); first != m_bounds.end(); ++first) {
      for (auto second = std::next(first); second != m_bounds.end(); ++second) {
        const bool isNear = first->second.distance(second->second) < least;
        if (isNear && (*callback)(first->first, second->first, least)) return;
      }
    }
  }
  void collide(BroadPhaseCollisionManager* other, CollisionCallBackBase* callback) const override {
    callback->init();
    if (other->size() == 0) return;
    for (const auto& [own, bounds] : m_bounds) {
      for (const auto& [object, theirs] : static_cast<DynamicAABBTreeCollisionManager*>(other)->m_bounds) {
        if (bounds.overlap(theirs) && (*callback)(own, object)) return;
      }
    }
  }
  void distance(BroadPhaseCollisionManager* other, DistanceCallBackBase* callback) const override {
    callback->init();
    if (other->size() == 0) return;
    double least = std::numeric_limits<double>::max();
    for (const auto& [own, bounds] : m_bounds) {
      for (const auto& [object, theirs] : static_cast<DynamicAABBTreeCollisionManager*>(other)->m_bounds) {
        if (bounds.distance(theirs) < least && (*callback)(own, object, least)) return;
      }
    }
  }
  [[nodiscard]] bool empty() const override { return m_bounds.empty(); }
  [[nodiscard]] std::size_t size() const override { return m_bounds.size(); }

 private:
  std::map<CollisionObject*, AABB> m_bounds;
};

}  // namespace coal
