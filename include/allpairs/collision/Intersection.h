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

/// An intersection method, which tests collision models against each other: distances, and an intersector per pair of
/// types.
///
/// A custom method derives from this class, or from one of the library's methods.
class Intersection {
 public:
  Intersection() = default;
  Intersection(const Intersection&) = delete;
  Intersection& operator=(const Intersection&) = delete;
  Intersection(Intersection&&) = delete;
  Intersection& operator=(Intersection&&) = delete;
  virtual ~Intersection() = default;

  /// The largest gap on each axis at which two models are reported. A negative one requires that much overlap.
  ///
  /// Bad input: NaN and -infinity throw InvalidArgument; with infinity all models are reported.
  [[nodiscard]] double getAlarmDistance() const { return m_alarmDistance; }
  void setAlarmDistance(double distance);

  /// The distance at which models count as touching. Kept for the host; nothing in this library reads it.
  ///
  /// Bad input: NaN and infinities throw InvalidArgument.
  [[nodiscard]] double getContactDistance() const { return m_contactDistance; }
  void setContactDistance(double distance);

  /// Whether boxes bound elements over the whole step instead of at its start.
  [[nodiscard]] virtual bool isContinuous() const { return m_continuous; }
  void setContinuous(bool continuous);

  /// The name of the method.
  [[nodiscard]] virtual std::string_view typeName() const { return "Intersection"; }

  /// The intersector for two models, or null. `swapModels` is set if it takes the second one first.
  ///
  /// By default it is looked up in the table by the models' type keys. The broad phase passes roots.
  [[nodiscard]] virtual ElementIntersector* findIntersector(CollisionModel* first, CollisionModel* second,
                                                            bool& swapModels);

  /// Registers an intersector for two types of model, replacing an earlier one; null removes it. Unless the types are
  /// equal, or `bothWays` is false, it also serves (second, first), with the models swapped.
  void add(std::type_index first, std::type_index second, std::shared_ptr<ElementIntersector> intersector,
           bool bothWays = true);

  template <class First, class Second>
  void add(std::shared_ptr<ElementIntersector> intersector, bool bothWays = true) {
    add(typeid(First), typeid(Second), std::move(intersector), bothWays);
  }

  /// The distance at which the boxes of two models' elements count as near, in the order of the pair tested.
  [[nodiscard]] virtual double distanceBetween(const CollisionModel& first, const CollisionModel& second) const;

  /// The largest gap per axis between two root boxes at which canIntersect() can be true, without the models' own
  /// contact distances. Infinity, the default, means that there is no bound, and every pair is tested; NaN and
  /// -infinity are refused by the broad phase.
  [[nodiscard]] virtual double maximumDistance() const { return std::numeric_limits<double>::infinity(); }

  /// Whether the contact distances of both models are added to maximumDistance().
  [[nodiscard]] virtual bool addsContactDistances() const { return false; }

  /// Incremented by every change of a distance, a switch or the table.
  [[nodiscard]] std::uint64_t revision() const { return m_revision; }

 protected:
  /// For setters of derived classes: invalidates what the broad phase has cached of this method.
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
