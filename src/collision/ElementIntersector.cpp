// SPDX-License-Identifier: MIT
#include "allpairs/collision/ElementIntersector.h"

#include <numbers>

#include "allpairs/collision/Intersection.h"

namespace allpairs::collision {

bool BoxIntersector::canIntersect(const CollisionElement& first, const CollisionElement& second,
                                  const Intersection& method) const {
  return overlap(first.box(), second.box(), method.distanceBetween(*first.model, *second.model));
}

bool ConeAwareBoxIntersector::canIntersect(const CollisionElement& first, const CollisionElement& second,
                                           const Intersection& method) const {
  if (first == second && first.cone().halfAngle < std::numbers::pi / 2.0) return false;
  return BoxIntersector::canIntersect(first, second, method);
}

}  // namespace allpairs::collision
