// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/collision/ProximityIntersection.h"

namespace allpairs::collision {

/// The smallest distance between two elements; the usual proximity method.
///
/// The broad phase sees no difference between the proximity methods.
class MinProximityIntersection : public ProximityIntersection {
 public:
  [[nodiscard]] std::string_view typeName() const override { return "MinProximityIntersection"; }
};

}  // namespace allpairs::collision
