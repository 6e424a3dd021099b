// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/core/collision/Intersection.h>

namespace sofa::core::collision {

/// Asks a method's own test for two kinds of element.
template <class First, class Second, class Method>
class MemberElementIntersector : public ElementIntersector {
 public:
  explicit MemberElementIntersector(Method* method) : m_method(method) {}

  bool canIntersect(CollisionElementIterator first, CollisionElementIterator second,
                    const Intersection* current) override {
    return m_method->testIntersection(First(first), Second(second), current);
  }

 private:
  Method* m_method;
};

}  // namespace sofa::core::collision
