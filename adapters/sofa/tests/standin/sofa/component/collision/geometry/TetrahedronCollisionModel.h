// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/core/CollisionModel.h>

namespace sofa::component::collision::geometry {
class TetrahedronCollisionModel : public core::CollisionModel {};
}  // namespace sofa::component::collision::geometry
