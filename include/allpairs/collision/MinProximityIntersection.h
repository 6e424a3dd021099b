// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/collision/ProximityIntersection.h"

namespace allpairs::collision {

/// The smallest distance between two elements; the usual proximity method.
///
/// In the broad phase all proximity methods are the same.
class MinProximityIntersection : public ProximityIntersection {
 public:
  [[nodiscard]] std::string_view typeName() const override { return "MinProximityIntersection"; }
};

}  // namespace allpairs::collision
