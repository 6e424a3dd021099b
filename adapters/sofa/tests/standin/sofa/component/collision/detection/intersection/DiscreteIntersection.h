// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/component/collision/detection/intersection/BaseProximityIntersection.h>

#include <numbers>

namespace sofa::component::collision::detection::intersection {

/// Boxes are near within the alarm distance, which is 0; a box asked about itself is judged by its cone of normals.
class DiscreteIntersection : public BoxMethod {
 public:
  DiscreteIntersection() { addBoxTest(*this); }

  virtual bool testIntersection(const Cube& first, const Cube& second, const core::collision::Intersection* current) {
    if (first.model == second.model) return first.data().coneAngle >= std::numbers::pi / 2.0;
    return areWithin(current->getAlarmDistance(), first, second);
  }
};

}  // namespace sofa::component::collision::detection::intersection
