// SPDX-License-Identifier: MIT
#include "allpairs/collision/BoundingBoxModel.h"

namespace allpairs::collision {

BoundingBoxModel::BoundingBoxModel(CollisionModel& model) { m_last = model.m_last; }

std::type_index BoundingBoxModel::typeKey() const {
  return getPrevious() == nullptr ? getLast()->rootTypeKey() : std::type_index(typeid(BoundingBoxModel));
}

}  // namespace allpairs::collision
