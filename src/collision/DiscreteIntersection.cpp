// SPDX-License-Identifier: MIT
#include "allpairs/collision/DiscreteIntersection.h"

#include "allpairs/collision/BoundingBoxModel.h"

namespace allpairs::collision {

DiscreteIntersection::DiscreteIntersection() {
  add<BoundingBoxModel, BoundingBoxModel>(std::make_shared<ConeAwareBoxIntersector>());
}

}  // namespace allpairs::collision
