// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/collision/ProximityIntersection.h"

namespace allpairs::collision {

/// As MinProximityIntersection, with the closest features of each pair of elements.
///
/// In the broad phase all proximity methods are the same.
class NewProximityIntersection : public ProximityIntersection {
 public:
  [[nodiscard]] std::string_view typeName() const override { return "NewProximityIntersection"; }
};

}  // namespace allpairs::collision
