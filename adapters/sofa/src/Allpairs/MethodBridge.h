// SPDX-License-Identifier: MIT
#pragma once

#include <Allpairs/ModelPool.h>
#include <sofa/core/collision/Intersection.h>

#include "allpairs/collision/DiscreteIntersection.h"
#include "allpairs/collision/MinProximityIntersection.h"

namespace allpairs::plugin {

/// One of SOFA's intersection methods as one of ours, whatever it does: each candidate is asked through SOFA's own
/// intersectors.
class AskingMethod final : public collision::Intersection {
 public:
  /// `bounded`: root boxes further apart than the method's alarm distance, which is finite, never intersect, not
  /// counting the roots' contact distances where those are added.
  void setMethod(sofa::core::collision::Intersection& method, bool bounded, bool addsContactDistances);

  [[nodiscard]] collision::ElementIntersector* findIntersector(collision::CollisionModel* first,
                                                               collision::CollisionModel* second,
                                                               bool& swapModels) override;
  [[nodiscard]] double maximumDistance() const override;
  [[nodiscard]] bool addsContactDistances() const override { return m_addsContactDistances; }
  [[nodiscard]] std::string_view typeName() const override { return "AskingMethod"; }

 private:
  /// Asks the intersector that was found last.
  class Intersector final : public collision::ElementIntersector {
   public:
    void set(sofa::core::collision::ElementIntersector* intersector, sofa::core::collision::Intersection* method);
    [[nodiscard]] bool canIntersect(const collision::CollisionElement& first, const collision::CollisionElement& second,
                                    const collision::Intersection& method) const override;

   private:
    sofa::core::collision::ElementIntersector* m_intersector = nullptr;
    sofa::core::collision::Intersection* m_method = nullptr;
  };

  sofa::core::collision::Intersection* m_method = nullptr;
  bool m_bounded = false;
  bool m_addsContactDistances = false;
  Intersector m_intersector;
};

/// Finds the method of ours that does for a step's models what SOFA's does.
///
/// SOFA's own methods are known by their type: they compare root boxes as our own methods do, which then stand for
/// them. A subclass, a user's method, or one whose comparison of boxes somebody has replaced may do anything, and is
/// asked.
class MethodBridge {
 public:
  /// The method to test a step's models with, as the pool describes them so far.
  [[nodiscard]] collision::Intersection& choose(sofa::core::collision::Intersection& method, const ModelPool& models);

 private:
  collision::MinProximityIntersection m_proximity;
  collision::DiscreteIntersection m_discrete;
  AskingMethod m_asking;
};

}  // namespace allpairs::plugin
