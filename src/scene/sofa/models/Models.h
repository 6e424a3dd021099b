// SPDX-License-Identifier: MIT
#pragma once

#include "sofa/evaluation/Evaluation.h"
#include "sofa/models/ModelDescription.h"

namespace allpairs::scene::sofa {

/// Describes the collision model that a component is; throws Unplaceable if its elements cannot be computed.
[[nodiscard]] ModelDescription describeModel(Evaluation& evaluation, const Component& component);

}  // namespace allpairs::scene::sofa
