// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/collision/CollisionElement.h"

namespace allpairs::collision {

class Intersection;

/// Tests elements of two types of model against each other. Custom intersectors derive from this class.
///
/// Threads: const; the broad and narrow phases call it from one thread.
class ElementIntersector {
 public:
  ElementIntersector() = default;
  ElementIntersector(const ElementIntersector&) = delete;
  ElementIntersector& operator=(const ElementIntersector&) = delete;
  ElementIntersector(ElementIntersector&&) = delete;
  ElementIntersector& operator=(ElementIntersector&&) = delete;
  virtual ~ElementIntersector() = default;

  /// Whether two elements may touch according to the method. The broad phase calls it for root boxes, the narrow
  /// phase for elements whose boxes are near enough.
  [[nodiscard]] virtual bool canIntersect(const CollisionElement& first, const CollisionElement& second,
                                          const Intersection& method) const = 0;
};

/// Elements may touch if their boxes are within the method's distance of each other.
class BoxIntersector : public ElementIntersector {
 public:
  [[nodiscard]] bool canIntersect(const CollisionElement& first, const CollisionElement& second,
                                  const Intersection& method) const override;
};

/// As BoxIntersector, and an element may touch itself only if its cone of normals has a half-angle of at least pi/2.
class ConeAwareBoxIntersector : public BoxIntersector {
 public:
  [[nodiscard]] bool canIntersect(const CollisionElement& first, const CollisionElement& second,
                                  const Intersection& method) const override;
};

}  // namespace allpairs::collision
