// SPDX-License-Identifier: MIT
#include "PairRules.h"

#include <typeinfo>
#include <utility>

#include "allpairs/Error.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/collision/DiscreteIntersection.h"
#include "allpairs/collision/LocalMinDistance.h"
#include "allpairs/collision/MinProximityIntersection.h"
#include "allpairs/collision/NewProximityIntersection.h"

namespace allpairs::collision {
namespace {

/// Whether a method is one of the library's own, and no subclass: then none of its virtual functions is overridden.
bool isLibraryMethod(const Intersection& method) {
  const std::type_info& type = typeid(method);
  return type == typeid(MinProximityIntersection) || type == typeid(DiscreteIntersection) ||
         type == typeid(NewProximityIntersection) || type == typeid(LocalMinDistance);
}

/// Whether an intersector does nothing for two different elements but to compare their boxes.
bool onlyComparesBoxes(const ElementIntersector& intersector) {
  const std::type_info& type = typeid(intersector);
  return type == typeid(BoxIntersector) || type == typeid(ConeAwareBoxIntersector);
}

}  // namespace

void PairRules::setMethod(Intersection* method) {
  const double distance = method->maximumDistance();
  if (!isDistance(distance)) {
    throw InvalidArgument("the intersection method's maximum distance is NaN or -infinity");
  }
  m_method = method;
  m_revision = method->revision();
  m_maximumDistance = distance;
  m_addsContactDistances = method->addsContactDistances();
  m_methodIsOurs = isLibraryMethod(*method);
  m_types = 0;
}

PairRule PairRules::ruleOfRoots(CollisionModel* first, CollisionModel* second, Intersection& method) {
  CollisionModel* firstRoot = first->getFirst();
  CollisionModel* secondRoot = second->getFirst();
  bool swap = false;
  const ElementIntersector* intersector = method.findIntersector(firstRoot, secondRoot, swap);
  if (intersector == nullptr) return PairRule::NoIntersector;
  if (swap) std::swap(firstRoot, secondRoot);
  return intersector->canIntersect({firstRoot, 0}, {secondRoot, 0}, method) ? PairRule::None : PairRule::Apart;
}

std::optional<CollisionModelPair> PairRules::ask(std::size_t newer, std::size_t older, bool boxesAreNear) {
  const ModelRow& a = m_models.row(newer);
  const ModelRow& b = m_models.row(older);
  if (!(a.has(ModelRow::kSimulated) || b.has(ModelRow::kSimulated)) || !keeps(a, b)) return std::nullopt;
  const Link link = linkOf(a, b);
  if (link.kind == Kind::None) return std::nullopt;
  const std::size_t first = link.swap ? older : newer;
  const std::size_t second = link.swap ? newer : older;
  const CollisionModelPair pair{m_models.row(first).model, m_models.row(second).model};
  if (link.kind == Kind::Boxes && !areOneModel(newer, older)) {
    if (!boxesAreNear && !this->boxesAreNear(first, second)) return std::nullopt;
    return pair;
  }
  const CollisionElement firstRoot{pair.first->getFirst(), 0};
  const CollisionElement secondRoot{pair.second->getFirst(), 0};
  if (!link.intersector->canIntersect(firstRoot, secondRoot, *m_method)) return std::nullopt;
  return pair;
}

/// Which rule of canCollideWith() it is that did not let two models collide.
PairRule PairRules::refusalOf(const ModelRow& a, const ModelRow& b) {
  if (!a.has(ModelRow::kDefaultRules) || !b.has(ModelRow::kDefaultRules)) return PairRule::Refused;
  return a.owner == b.owner ? PairRule::OneOwner : PairRule::CommonGroup;
}

PairRules::Judgement PairRules::judge(std::size_t newer, std::size_t older) const {
  const ModelRow& a = m_models.row(newer);
  const ModelRow& b = m_models.row(older);
  if (!a.model->isSimulated() && !b.model->isSimulated()) return {PairRule::NotSimulated};
  if (!BruteForceBroadPhase::keepCollisionBetween(a.model->getLast(), b.model->getLast())) return {refusalOf(a, b)};
  const Link link = findLink(a.model, b.model);
  if (link.intersector == nullptr) return {PairRule::NoIntersector};
  CollisionModelPair pair{a.model, b.model};
  if (link.swap) std::swap(pair.first, pair.second);
  const CollisionElement first{pair.first->getFirst(), 0};
  const CollisionElement second{pair.second->getFirst(), 0};
  if (!link.intersector->canIntersect(first, second, *m_method)) return {PairRule::Apart};
  return {PairRule::None, pair};
}

bool PairRules::keeps(const ModelRow& newer, const ModelRow& older) const {
  const auto lets = [this](const ModelRow& a, const ModelRow& b) {
    if (a.has(ModelRow::kDefaultRules)) return m_models.letsCollide(a, b);
    return a.model->getLast()->canCollideWith(b.model->getLast());
  };
  return lets(newer, older) && lets(older, newer);
}

bool PairRules::arePlain() {
  if (!m_methodIsOurs || !m_models.isPlain() || m_models.size() == 0) return false;
  const Link link = linkOf(m_models.row(0), m_models.row(0));
  return link.kind == Kind::Boxes && !link.swap;
}

void PairRules::countTypes() {
  if (m_types == m_models.typeCount()) return;
  const std::size_t types = m_models.typeCount();
  m_types = 0;  // until there are links
  m_links.assign(types * types, Link{});
  m_types = types;
}

PairRules::Link PairRules::linkOf(const ModelRow& newer, const ModelRow& older) {
  // A user's findIntersector() may look beyond types. What was found before the method changed may be destroyed.
  if (!m_methodIsOurs || m_method->revision() != m_revision) return findLink(newer.model, older.model);
  countTypes();
  Link& link = m_links[newer.type * m_types + older.type];
  if (link.kind == Kind::Unknown) link = findLink(newer.model, older.model);
  return link;
}

PairRules::Link PairRules::findLink(CollisionModel* newer, CollisionModel* older) const {
  Link link;
  link.intersector = m_method->findIntersector(newer->getFirst(), older->getFirst(), link.swap);
  if (link.intersector == nullptr) {
    link.kind = Kind::None;
  } else {
    link.kind = m_methodIsOurs && onlyComparesBoxes(*link.intersector) ? Kind::Boxes : Kind::Custom;
  }
  return link;
}

bool PairRules::boxesAreNear(std::size_t first, std::size_t second) const {
  double distance = m_maximumDistance;
  if (m_addsContactDistances) {
    const std::span<const double> distances = m_models.contactDistances();
    distance = distance + distances[first] + distances[second];
  }
  return overlap(m_models.box(first), m_models.box(second), distance);
}

}  // namespace allpairs::collision
