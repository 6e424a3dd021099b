// SPDX-License-Identifier: MIT
#include "allpairs/collision/CollisionModel.h"

#include <algorithm>
#include <cmath>

#include "BoundingTreeBuilder.h"
#include "SortedSets.h"
#include "allpairs/Error.h"
#include "allpairs/collision/BoundingBoxModel.h"

namespace allpairs::collision {

CollisionModel::CollisionModel(std::string name) : m_name(std::move(name)) {}
CollisionModel::~CollisionModel() = default;

Box CollisionModel::elementSweptBox(std::size_t index, double /*dt*/) const { return elementBox(index); }
NormalCone CollisionModel::elementCone(std::size_t /*index*/) const { return {}; }
NormalCone CollisionModel::elementSweptCone(std::size_t index, double /*dt*/) const { return elementCone(index); }
std::string_view CollisionModel::typeName() const { return "CollisionModel"; }
std::type_index CollisionModel::typeKey() const { return typeid(*this); }
std::type_index CollisionModel::rootTypeKey() const { return typeid(BoundingBoxModel); }

bool CollisionModel::canCollideWith(CollisionModel* other) {
  if (getOwner() == other->getOwner()) return getSelfCollision();
  if ((m_last->m_groupBits & other->m_last->m_groupBits) == 0) return true;
  return !haveCommonMember(getGroups(), other->getGroups());
}

void CollisionModel::computeBoundingTree(int maxDepth) {
  if (this != m_last) return m_last->computeBoundingTree(maxDepth);
  BoundingTreeBuilder(*this, 0.0, false).build(maxDepth);
}

void CollisionModel::computeContinuousBoundingTree(double dt, int maxDepth) {
  if (this != m_last) return m_last->computeContinuousBoundingTree(dt, maxDepth);
  if (!std::isfinite(dt)) throw InvalidArgument(describe() + ": the length of the step is not a finite number");
  BoundingTreeBuilder(*this, dt, true).build(maxDepth);
}

void CollisionModel::setRoot(const Box& box, const NormalCone& cone) {
  if (hasNan(box)) throw InvalidBox(0, describe() + ": its root box has a NaN");
  BoundingTreeBuilder::setRoot(*m_last, box, cone);
}

// Levels that are not linked are left over from a bounding tree that was not finished.
CollisionModel* CollisionModel::getFirst() { return m_last->m_hasLevels ? m_last->m_levels.front().get() : m_last; }

const CollisionModel* CollisionModel::getFirst() const {
  return m_last->m_hasLevels ? m_last->m_levels.front().get() : m_last;
}

const std::vector<int>& CollisionModel::getGroups() const {
  static const std::vector<int> kNone;
  return m_last->m_groups ? *m_last->m_groups : kNone;
}

void CollisionModel::setGroups(std::vector<int> groups) {
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  std::uint64_t bits = 0;
  for (const int group : groups) bits |= std::uint64_t{1} << (static_cast<unsigned>(group) % 64U);
  std::shared_ptr<const std::vector<int>> made;
  if (!groups.empty()) made = std::make_shared<const std::vector<int>>(std::move(groups));
  // Nothing below throws.
  m_last->m_groups = std::move(made);
  m_last->m_groupBits = bits;
}

void CollisionModel::addGroup(int group) {
  std::vector<int> groups = getGroups();
  groups.push_back(group);
  setGroups(std::move(groups));
}

void CollisionModel::setContactDistance(double distance) {
  if (!std::isfinite(distance)) throw InvalidArgument(describe() + ": the contact distance is not a finite number");
  m_last->m_contactDistance = distance;
  boundsChanged();
}

std::string CollisionModel::describe() const {
  if (!getName().empty()) return "model '" + getName() + "'";
  return "model of type " + std::string(m_last->typeName());
}

}  // namespace allpairs::collision
