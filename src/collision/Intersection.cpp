// SPDX-License-Identifier: MIT
#include "allpairs/collision/Intersection.h"

#include <cmath>

#include "allpairs/Error.h"

namespace allpairs::collision {

void Intersection::setAlarmDistance(double distance) {
  if (!isDistance(distance)) throw InvalidArgument("the alarm distance is NaN or -infinity");
  m_alarmDistance = distance;
  settingsChanged();
}

void Intersection::setContactDistance(double distance) {
  if (!std::isfinite(distance)) throw InvalidArgument("the method's contact distance is not a finite number");
  m_contactDistance = distance;
  settingsChanged();
}

void Intersection::setContinuous(bool continuous) {
  m_continuous = continuous;
  settingsChanged();
}

ElementIntersector* Intersection::findIntersector(CollisionModel* first, CollisionModel* second, bool& swapModels) {
  swapModels = false;
  const auto found = m_intersectors.find({first->typeKey(), second->typeKey()});
  if (found == m_intersectors.end()) return nullptr;
  swapModels = found->second.swap;
  return found->second.intersector.get();
}

void Intersection::add(std::type_index first, std::type_index second, std::shared_ptr<ElementIntersector> intersector,
                       bool bothWays) {
  // Both places before either is filled: nothing has changed if there is no memory for one.
  Entry& entry = m_intersectors[{first, second}];
  if (bothWays) m_intersectors[{second, first}] = {intersector, true};
  entry = {std::move(intersector), false};
  settingsChanged();
}

double Intersection::distanceBetween(const CollisionModel& /*first*/, const CollisionModel& /*second*/) const {
  return m_alarmDistance;
}

}  // namespace allpairs::collision
