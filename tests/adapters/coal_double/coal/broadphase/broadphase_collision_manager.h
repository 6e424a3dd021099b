// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "coal/collision_object.h"

namespace coal {

struct CollisionCallBackBase {
  virtual ~CollisionCallBackBase() = default;
  virtual void init() {}
  virtual bool collide(CollisionObject* first, CollisionObject* second) = 0;
  virtual bool operator()(CollisionObject* first, CollisionObject* second) { return collide(first, second); }
};

struct DistanceCallBackBase {
  virtual ~DistanceCallBackBase() = default;
  virtual void init() {}
  virtual bool distance(CollisionObject* first, CollisionObject* second, CoalScalar& least) = 0;
  virtual bool operator()(CollisionObject* first, CollisionObject* second, CoalScalar& least) {
    return distance(first, second, least);
  }
};

class BroadPhaseCollisionManager {
 public:
  using Objects = std::vector<CollisionObject*>;

  BroadPhaseCollisionManager() = default;
  BroadPhaseCollisionManager(const BroadPhaseCollisionManager&) = delete;
  BroadPhaseCollisionManager& operator=(const BroadPhaseCollisionManager&) = delete;
  virtual ~BroadPhaseCollisionManager() = default;

  virtual void registerObjects(const Objects& objects) {
    for (CollisionObject* object : objects) registerObject(object);
  }
  virtual void registerObject(CollisionObject* object) = 0;
  virtual void unregisterObject(CollisionObject* object) = 0;
  virtual void setup() = 0;
  virtual void update() = 0;
  virtual void update(CollisionObject* /*object*/) { update(); }
  virtual void update(const Objects& /*objects*/) { update(); }
  virtual void clear() = 0;
  virtual void getObjects(Objects& objects) const = 0;
  [[nodiscard]] virtual Objects getObjects() const {
    Objects objects;
    getObjects(objects);
    return objects;
  }
  virtual void collide(CollisionObject* object, CollisionCallBackBase* callback) const = 0;
  virtual void distance(CollisionObject* object, DistanceCallBackBase* callback) const = 0;
  virtual void collide(CollisionCallBackBase* callback) const = 0;
  virtual void distance(DistanceCallBackBase* callback) const = 0;
  virtual void collide(BroadPhaseCollisionManager* other, CollisionCallBackBase* callback) const = 0;
  virtual void distance(BroadPhaseCollisionManager* other, DistanceCallBackBase* callback) const = 0;
  [[nodiscard]] virtual bool empty() const = 0;
  [[nodiscard]] virtual std::size_t size() const = 0;
};

}  // namespace coal
