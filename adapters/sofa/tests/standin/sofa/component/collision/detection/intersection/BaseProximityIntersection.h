// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/component/collision/geometry/CubeCollisionModel.h>
#include <sofa/core/collision/Intersection.inl>

#include <memory>

namespace sofa::component::collision::detection::intersection {

using geometry::Cube;

/// Whether two boxes are at most a distance apart on every axis.
inline bool areWithin(SReal distance, const Cube& first, const Cube& second) {
  const auto& a = first.data();
  const auto& b = second.data();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a.minBBox[axis] > b.maxBBox[axis] + distance || b.minBBox[axis] > a.maxBBox[axis] + distance) return false;
  }
  return true;
}

/// A method that knows one intersector, for two roots that are boxes.
class BoxMethod : public core::collision::Intersection {
 public:
  core::collision::ElementIntersector* findIntersector(core::CollisionModel* first, core::CollisionModel* second,
                                                       bool& swap) override {
    swap = false;
    const bool boxes = typeid(*first) == typeid(geometry::CubeCollisionModel) &&
                       typeid(*second) == typeid(geometry::CubeCollisionModel);
    return boxes ? m_boxes.get() : nullptr;
  }
  void setBoxIntersector(std::unique_ptr<core::collision::ElementIntersector> boxes) { m_boxes = std::move(boxes); }

 private:
  std::unique_ptr<core::collision::ElementIntersector> m_boxes;
};

/// Boxes are near within the alarm distance and the contact distances of both.
class BaseProximityIntersection : public BoxMethod {
 public:
  [[nodiscard]] SReal getAlarmDistance() const override { return m_alarmDistance; }
  void setAlarmDistance(SReal distance) { m_alarmDistance = distance; }

  virtual bool testIntersection(const Cube& first, const Cube& second, const core::collision::Intersection* current) {
    const SReal distance =
        current->getAlarmDistance() + first.model->getContactDistance() + second.model->getContactDistance();
    return areWithin(distance, first, second);
  }

 private:
  SReal m_alarmDistance = 1.0;
};

template <class Method>
void addBoxTest(Method& method) {
  method.setBoxIntersector(std::make_unique<core::collision::MemberElementIntersector<Cube, Cube, Method>>(&method));
}

}  // namespace sofa::component::collision::detection::intersection
