// SPDX-License-Identifier: MIT
#pragma once

#include "sofa/evaluation/Evaluation.h"
#include "sofa/models/ModelDescription.h"

namespace allpairs::scene::sofa {

/// Whether SOFA makes a collision model: those of points, lines and triangles only after a state of points.
[[nodiscard]] bool isMade(Evaluation& evaluation, const Component& model);

/// Describes the collision model that a component is; throws Unplaceable if its elements cannot be computed.
[[nodiscard]] ModelDescription describeModel(Evaluation& evaluation, const Component& component);

}  // namespace allpairs::scene::sofa
