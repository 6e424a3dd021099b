// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/core/CollisionModel.h>

namespace sofa::core::collision {

class Intersection;

class ElementIntersector {
 public:
  ElementIntersector() = default;
  ElementIntersector(const ElementIntersector&) = delete;
  ElementIntersector& operator=(const ElementIntersector&) = delete;
  ElementIntersector(ElementIntersector&&) = delete;
  ElementIntersector& operator=(ElementIntersector&&) = delete;
  virtual ~ElementIntersector() = default;
  virtual bool canIntersect(CollisionElementIterator first, CollisionElementIterator second,
                            const Intersection* method) = 0;
};

class Intersection : public virtual objectmodel::BaseComponent {
 public:
  virtual ElementIntersector* findIntersector(CollisionModel* first, CollisionModel* second, bool& swap) = 0;
  [[nodiscard]] virtual SReal getAlarmDistance() const { return 0.0; }
};

}  // namespace sofa::core::collision
