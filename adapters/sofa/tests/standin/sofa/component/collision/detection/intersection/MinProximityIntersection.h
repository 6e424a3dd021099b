// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/component/collision/detection/intersection/BaseProximityIntersection.h>

namespace sofa::component::collision::detection::intersection {

class MinProximityIntersection : public BaseProximityIntersection {
 public:
  MinProximityIntersection() { addBoxTest(*this); }
};

}  // namespace sofa::component::collision::detection::intersection
