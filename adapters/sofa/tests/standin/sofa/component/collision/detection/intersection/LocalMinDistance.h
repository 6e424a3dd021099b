// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/component/collision/detection/intersection/BaseProximityIntersection.h>

namespace sofa::component::collision::detection::intersection {

class LocalMinDistance : public BaseProximityIntersection {
 public:
  LocalMinDistance() { addBoxTest(*this); }
};

}  // namespace sofa::component::collision::detection::intersection
