// SPDX-License-Identifier: MIT
#include "allpairs/collision/ProximityIntersection.h"

#include "allpairs/collision/BoundingBoxModel.h"

namespace allpairs::collision {

ProximityIntersection::ProximityIntersection() {
  setAlarmDistance(kDefaultAlarmDistance);
  setContactDistance(kDefaultContactDistance);
  add<BoundingBoxModel, BoundingBoxModel>(std::make_shared<BoxIntersector>());
}

void ProximityIntersection::setContactDistanceInBroadPhase(bool on) {
  m_contactDistanceInBroadPhase = on;
  settingsChanged();
}

double ProximityIntersection::distanceBetween(const CollisionModel& first, const CollisionModel& second) const {
  if (!m_contactDistanceInBroadPhase) return getAlarmDistance();
  return getAlarmDistance() + first.getContactDistance() + second.getContactDistance();
}

}  // namespace allpairs::collision
