// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/core/CollisionModel.h>
#include <sofa/defaulttype/VecTypes.h>

namespace sofa::component::collision::geometry {
template <class Types>
class PointCollisionModel : public core::CollisionModel {};
}  // namespace sofa::component::collision::geometry
