// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/collision/Intersection.h"

namespace allpairs::collision {

/// Base of the proximity methods: boxes are near if they are at most alarm distance + the contact
/// distances of both models apart, added in that order.
///
/// By default the alarm distance is 1 and the contact distance 0.5.
class ProximityIntersection : public Intersection {
 public:
  static constexpr double kDefaultAlarmDistance = 1.0;
  static constexpr double kDefaultContactDistance = 0.5;

  /// Whether the models' contact distances are added for root boxes, and those of further levels; on by default. For
  /// elements below a bounding tree they always are.
  [[nodiscard]] bool getContactDistanceInBroadPhase() const { return m_contactDistanceInBroadPhase; }
  void setContactDistanceInBroadPhase(bool on);

  [[nodiscard]] double distanceBetween(const CollisionModel& first, const CollisionModel& second) const override;
  [[nodiscard]] double maximumDistance() const override { return getAlarmDistance(); }
  [[nodiscard]] bool addsContactDistances() const override { return m_contactDistanceInBroadPhase; }

 protected:
  ProximityIntersection();

 private:
  bool m_contactDistanceInBroadPhase = true;
};

}  // namespace allpairs::collision
