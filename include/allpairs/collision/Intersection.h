// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string_view>
#include <typeindex>
#include <utility>

#include "allpairs/collision/CollisionModel.h"
#include "allpairs/collision/ElementIntersector.h"

namespace allpairs::collision {

/// How collision models are tested against each other: distances, and which intersector knows which types.
///
/// A method of the user's own derives from this, or from one of the methods that come with the library.
class Intersection {
 public:
  Intersection() = default;
  Intersection(const Intersection&) = delete;
  Intersection& operator=(const Intersection&) = delete;
  Intersection(Intersection&&) = delete;
  Intersection& operator=(Intersection&&) = delete;
  virtual ~Intersection() = default;

  /// How far apart, on each axis, things are when they begin to be of interest. Negative lets them sink in first.
  ///
  /// Bad input: NaN and -infinity throw InvalidArgument; infinity makes everything of interest.
  [[nodiscard]] double getAlarmDistance() const { return m_alarmDistance; }
  void setAlarmDistance(double distance);

  /// How far apart things are when they count as touching. Plays no part in the broad phase.
  ///
  /// Bad input: NaN and infinities throw InvalidArgument.
  [[nodiscard]] double getContactDistance() const { return m_contactDistance; }
  void setContactDistance(double distance);

  /// Whether boxes are to hold elements over the whole step instead of at its start.
  [[nodiscard]] virtual bool isContinuous() const { return m_continuous; }
  void setContinuous(bool continuous);

  /// The name of the method.
  [[nodiscard]] virtual std::string_view typeName() const { return "Intersection"; }

  /// The intersector for two models, or null if there is none. `swapModels` says whether it takes the second one first.
  ///
  /// By default it is looked up in the table under the models' type keys. The broad phase asks with roots.
  [[nodiscard]] virtual ElementIntersector* findIntersector(CollisionModel* first, CollisionModel* second,
                                                            bool& swapModels);

  /// Enters an intersector for two types of model, replacing any before; null takes it out. Unless the types are the
  /// same, or `bothWays` is false, it also serves (second, first), with the models swapped.
  void add(std::type_index first, std::type_index second, std::shared_ptr<ElementIntersector> intersector,
           bool bothWays = true);

  template <class First, class Second>
  void add(std::shared_ptr<ElementIntersector> intersector, bool bothWays = true) {
    add(typeid(First), typeid(Second), std::move(intersector), bothWays);
  }

  /// The distance at which the boxes of two models' elements count as near, in the order of the pair tested.
  [[nodiscard]] virtual double distanceBetween(const CollisionModel& first, const CollisionModel& second) const;

  /// How far apart two root boxes may be, per axis, for canIntersect() ever to be true, not counting the models' own
  /// contact distances; infinity, the default, says that it can't be bounded, and every pair is asked.
  [[nodiscard]] virtual double maximumDistance() const { return std::numeric_limits<double>::infinity(); }

  /// Whether the contact distances of both models come on top of maximumDistance().
  [[nodiscard]] virtual bool addsContactDistances() const { return false; }

  /// Grows with every change of a distance, a switch or the table.
  [[nodiscard]] std::uint64_t revision() const { return m_revision; }

 protected:
  /// For setters of derived classes: what the broad phase noted of this method is out of date.
  void settingsChanged() { ++m_revision; }

 private:
  struct Entry {
    std::shared_ptr<ElementIntersector> intersector;
    bool swap = false;
  };

  double m_alarmDistance = 0.0;
  double m_contactDistance = 0.0;
  bool m_continuous = false;
  std::uint64_t m_revision = 1;
  std::map<std::pair<std::type_index, std::type_index>, Entry> m_intersectors;
};

}  // namespace allpairs::collision
