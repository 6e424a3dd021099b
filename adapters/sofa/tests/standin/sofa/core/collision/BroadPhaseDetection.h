// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/core/CollisionModel.h>
#include <sofa/core/collision/Intersection.h>
#include <sofa/type/vector.h>

#include <utility>

namespace sofa::core::collision {

class BroadPhaseDetection : public virtual objectmodel::BaseComponent {
 public:
  using CollisionModelPair = std::pair<CollisionModel*, CollisionModel*>;

  virtual void setIntersectionMethod(Intersection* method) { intersectionMethod = method; }
  [[nodiscard]] virtual bool needsDeepBoundingTree() const { return true; }

  virtual void beginBroadPhase() { cmPairs.clear(); }
  virtual void addCollisionModel(CollisionModel* model) = 0;
  virtual void addCollisionModels(const type::vector<CollisionModel*>& models) {
    for (CollisionModel* model : models) addCollisionModel(model);
  }
  virtual void endBroadPhase() {}
  [[nodiscard]] type::vector<CollisionModelPair>& getCollisionModelPairs() { return cmPairs; }

 protected:
  Intersection* intersectionMethod = nullptr;
  type::vector<CollisionModelPair> cmPairs;
};

}  // namespace sofa::core::collision
