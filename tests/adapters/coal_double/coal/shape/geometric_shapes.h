// SPDX-License-Identifier: MIT
#pragma once

#include "coal/collision_object.h"

namespace coal {

class Sphere : public CollisionGeometry {
 public:
  explicit Sphere(double ballRadius) : radius(ballRadius) {}

  double radius;
};

}  // namespace coal
