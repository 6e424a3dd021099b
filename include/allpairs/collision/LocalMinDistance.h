// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/collision/ProximityIntersection.h"

namespace allpairs::collision {

/// Considers only distances that are local minima between two surfaces.
///
/// In the broad phase all proximity methods are the same.
class LocalMinDistance : public ProximityIntersection {
 public:
  [[nodiscard]] std::string_view typeName() const override { return "LocalMinDistance"; }
};

}  // namespace allpairs::collision
