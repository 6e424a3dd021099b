// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/component/collision/detection/intersection/BaseProximityIntersection.h>

namespace sofa::component::collision::detection::intersection {

class NewProximityIntersection : public BaseProximityIntersection {
 public:
  NewProximityIntersection() { addBoxTest(*this); }
};

}  // namespace sofa::component::collision::detection::intersection
