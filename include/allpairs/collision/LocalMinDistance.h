// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/collision/ProximityIntersection.h"

namespace allpairs::collision {

/// Only distances that are local minima between two surfaces.
///
/// The broad phase sees no difference between the proximity methods.
class LocalMinDistance : public ProximityIntersection {
 public:
  [[nodiscard]] std::string_view typeName() const override { return "LocalMinDistance"; }
};

}  // namespace allpairs::collision
