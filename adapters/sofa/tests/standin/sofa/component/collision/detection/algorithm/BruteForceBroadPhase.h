// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/component/collision/geometry/CubeCollisionModel.h>
#include <sofa/core/collision/BroadPhaseDetection.h>
#include <sofa/type/fixed_array.h>

#include <utility>
#include <vector>

namespace sofa::component::collision::detection::algorithm {

/// The double loop that the plugin is compared with.
class BruteForceBroadPhase : public core::collision::BroadPhaseDetection {
 public:
  SOFA_CLASS(BruteForceBroadPhase, core::collision::BroadPhaseDetection);

  core::objectmodel::Data<type::fixed_array<type::Vec3, 2>> d_box{this->initData(&d_box, "box", "")};

  /// For the test of `verify`: leaves out every pair from now on.
  static bool& isBroken() {
    static bool broken = false;
    return broken;
  }

  void beginBroadPhase() override {
    BroadPhaseDetection::beginBroadPhase();
    m_models.clear();
  }

  void addCollisionModel(core::CollisionModel* model) override {
    if (model == nullptr || model->empty() || !isInBox(model)) return;
    if (model->isSimulated()) test(model, model);
    for (core::CollisionModel* older : m_models) {
      if (model->isSimulated() || older->isSimulated()) test(model, older);
    }
    m_models.push_back(model);
  }

 private:
  void test(core::CollisionModel* first, core::CollisionModel* second) {
    core::CollisionModel* a = first->getLast();
    core::CollisionModel* b = second->getLast();
    if (!isBroken() && a->canCollideWith(b) && b->canCollideWith(a) && meet(first, second, false)) {
      cmPairs.emplace_back(first, second);
    }
  }

  /// Whether the method says that two roots may touch; puts them in its order.
  bool meet(core::CollisionModel*& first, core::CollisionModel*& second, bool otherwise) {
    bool swap = false;
    auto* intersector = intersectionMethod->findIntersector(first, second, swap);
    if (intersector == nullptr) return otherwise;
    if (swap) std::swap(first, second);
    return intersector->canIntersect(first->begin(), second->begin(), intersectionMethod);
  }

  bool isInBox(core::CollisionModel* model) {
    const auto& box = d_box.getValue();
    if (box[0][0] >= box[1][0]) return true;
    geometry::CubeCollisionModel region;
    region.resize(1);
    region.setParentOf(0, box[0], box[1]);
    core::CollisionModel* second = &region;
    return meet(model, second, true);
  }

  std::vector<core::CollisionModel*> m_models;
};

}  // namespace sofa::component::collision::detection::algorithm
