// SPDX-License-Identifier: MIT
#include <Allpairs/MethodBridge.h>
#include <sofa/component/collision/detection/intersection/DiscreteIntersection.h>
#include <sofa/component/collision/detection/intersection/LocalMinDistance.h>
#include <sofa/component/collision/detection/intersection/MinProximityIntersection.h>
#include <sofa/component/collision/detection/intersection/NewProximityIntersection.h>
#include <sofa/component/collision/geometry/CubeCollisionModel.h>
#include <sofa/core/collision/Intersection.inl>

#include <cmath>
#include <limits>
#include <type_traits>
#include <typeinfo>

#if __has_include(<sofa/component/collision/detection/intersection/CCDTightInclusionIntersection.h>)
#define ALLPAIRS_SOFA_HAS_CCD
#include <sofa/component/collision/detection/intersection/CCDTightInclusionIntersection.h>
#endif

namespace allpairs::plugin {
namespace {

namespace intersection = sofa::component::collision::detection::intersection;
using sofa::component::collision::geometry::Cube;

/// Where SOFA computes in float its sums round otherwise than ours, and its own comparison must decide.
constexpr bool kSameNumbers = std::is_same_v<SReal, double>;

/// A method of SOFA's own, and what it does for two root boxes.
struct KnownMethod {
  const std::type_info* method = nullptr;
  const std::type_info* boxTest = nullptr;
  bool isDiscrete = false;  // no contact distances; a root asked about itself is judged by its cone of normals
};

template <class Method>
KnownMethod known(bool isDiscrete = false) {
  return {&typeid(Method), &typeid(sofa::core::collision::MemberElementIntersector<Cube, Cube, Method>), isDiscrete};
}

/// What is known of a method; all null if nothing is.
KnownMethod lookUp(const std::type_info& type) {
  const KnownMethod methods[] = {
      known<intersection::MinProximityIntersection>(),
      known<intersection::NewProximityIntersection>(),
      known<intersection::LocalMinDistance>(),
      known<intersection::DiscreteIntersection>(true),
#ifdef ALLPAIRS_SOFA_HAS_CCD
      known<intersection::CCDTightInclusionIntersection>(),
#endif
  };
  for (const KnownMethod& method : methods) {
    if (*method.method == type) return method;
  }
  return {};
}

/// Whether a method does for root boxes what its type says: compares them, within a finite distance.
bool comparesBoxes(const KnownMethod& type, sofa::core::collision::Intersection& method, const ModelPool& models) {
  if (!kSameNumbers || type.method == nullptr || models.firstBox() == nullptr) return false;
  if (!std::isfinite(method.getAlarmDistance())) return false;
  bool swap = false;
  const auto* test = method.findIntersector(models.firstBox(), models.firstBox(), swap);
  return test != nullptr && typeid(*test) == *type.boxTest;
}

}  // namespace

void AskingMethod::setMethod(sofa::core::collision::Intersection& method, bool bounded, bool addsContactDistances) {
  m_method = &method;
  m_bounded = bounded;
  m_addsContactDistances = addsContactDistances;
  if (bounded) setAlarmDistance(static_cast<double>(method.getAlarmDistance()));
  settingsChanged();
}

double AskingMethod::maximumDistance() const {
  return m_bounded ? getAlarmDistance() : std::numeric_limits<double>::infinity();
}

collision::ElementIntersector* AskingMethod::findIntersector(collision::CollisionModel* first,
                                                             collision::CollisionModel* second, bool& swapModels) {
  auto* intersector = m_method->findIntersector(hostOf(*first), hostOf(*second), swapModels);
  m_intersector.set(intersector, m_method);
  return intersector == nullptr ? nullptr : &m_intersector;
}

void AskingMethod::Intersector::set(sofa::core::collision::ElementIntersector* intersector,
                                    sofa::core::collision::Intersection* method) {
  m_intersector = intersector;
  m_method = method;
}

bool AskingMethod::Intersector::canIntersect(const collision::CollisionElement& first,
                                             const collision::CollisionElement& second,
                                             const collision::Intersection& /*method*/) const {
  return m_intersector->canIntersect(hostOf(*first.model)->begin(), hostOf(*second.model)->begin(), m_method);
}

collision::Intersection& MethodBridge::choose(sofa::core::collision::Intersection& method, const ModelPool& models) {
  const KnownMethod type = lookUp(typeid(method));
  const bool bounded = comparesBoxes(type, method, models);
  const bool needsCones = type.isDiscrete && models.anySelfCollision();
  if (!bounded || models.anyOddRoot() || needsCones) {
    m_asking.setMethod(method, bounded, !type.isDiscrete);
    return m_asking;
  }
  const auto distance = static_cast<double>(method.getAlarmDistance());
  collision::Intersection& ours = type.isDiscrete ? static_cast<collision::Intersection&>(m_discrete) : m_proximity;
  if (ours.getAlarmDistance() != distance) ours.setAlarmDistance(distance);
  return ours;
}

}  // namespace allpairs::plugin
