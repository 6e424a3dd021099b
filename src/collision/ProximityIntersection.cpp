// SPDX-License-Identifier: MIT
#include "allpairs/collision/ProximityIntersection.h"

#include "allpairs/collision/BoundingBoxModel.h"

namespace allpairs::collision {
namespace {

/// Whether a level is that of the elements, below boxes.
bool isBelowBoxes(const CollisionModel& level) { return level.getLast() == &level && level.getFirst() != &level; }

}  // namespace

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
  if (!m_contactDistanceInBroadPhase && !isBelowBoxes(first) && !isBelowBoxes(second)) return getAlarmDistance();
  return getAlarmDistance() + first.getContactDistance() + second.getContactDistance();
}

}  // namespace allpairs::collision
