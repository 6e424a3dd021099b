// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/collision/Intersection.h"

namespace allpairs::collision {

/// Boxes are near if they are at most the alarm distance apart, by default 0; a nearly flat patch cannot touch itself.
class DiscreteIntersection : public Intersection {
 public:
  DiscreteIntersection();

  [[nodiscard]] std::string_view typeName() const override { return "DiscreteIntersection"; }
  [[nodiscard]] double maximumDistance() const override { return getAlarmDistance(); }
};

}  // namespace allpairs::collision
