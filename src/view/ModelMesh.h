// SPDX-License-Identifier: MIT
#pragma once

#include "ViewScene.h"
#include "allpairs/collision/CollisionModel.h"

namespace allpairs::view {

/// Puts a model's shape behind those that are there: triangles, lines or points as they are; tetrahedra, spheres,
/// capsules and oriented boxes as triangles. A model of another type, or too much for a page, adds nothing but its
/// ends.
void addModel(ViewMesh& mesh, const collision::CollisionModel& model);

}  // namespace allpairs::view
