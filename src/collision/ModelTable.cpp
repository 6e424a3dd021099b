// SPDX-License-Identifier: MIT
#include "ModelTable.h"

#include <algorithm>
#include <cmath>

#include "SortedSets.h"
#include "allpairs/Error.h"
#include "allpairs/collision/BoundingBoxModel.h"
#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/CapsuleModel.h"
#include "allpairs/collision/LineModel.h"
#include "allpairs/collision/OrientedBoxModel.h"
#include "allpairs/collision/PointModel.h"
#include "allpairs/collision/SphereModel.h"
#include "allpairs/collision/TetrahedronModel.h"
#include "allpairs/collision/TriangleModel.h"

namespace allpairs::collision {
namespace {

/// Whether a type is one of the library's own, and no subclass: then none of its virtual functions is overridden.
bool isLibraryType(const std::type_info& type) {
  return type == typeid(BoxModel) || type == typeid(TriangleModel) || type == typeid(LineModel) ||
         type == typeid(PointModel) || type == typeid(SphereModel) || type == typeid(OrientedBoxModel) ||
         type == typeid(CapsuleModel) || type == typeid(TetrahedronModel);
}

}  // namespace

void ModelTable::clear() {
  m_rows.clear();
  m_boxes.clear();
  m_contactDistances.clear();
  m_groupLists.clear();
  m_rootTypes.clear();
  m_largestContactDistance = 0.0;
}

bool ModelTable::isOurs(const CollisionModel& last) {
  const std::type_info& type = typeid(last);
  if (&type != m_lastType.type) m_lastType = {&type, isLibraryType(type)};
  return m_lastType.ours;
}

bool ModelTable::isEmpty(const CollisionModel& model) {
  const CollisionModel& last = *model.m_last;
  return last.m_treeIsCurrent && isOurs(last) ? last.m_levels.empty() : last.empty();
}

bool ModelTable::mayCollideWithItself(CollisionModel& model) {
  CollisionModel* last = model.m_last;
  return isOurs(*last) ? last->m_selfCollision : last->canCollideWith(last);
}

void ModelTable::add(CollisionModel* model, bool selfPair) {
  const CollisionModel& last = *model->m_last;
  const bool ours = isOurs(last);
  const Box box = ours || !last.m_levels.empty() ? last.m_rootBox : last.elementBox(0);
  if (hasNan(box)) throw InvalidBox(m_rows.size(), last.describe() + ": its root box has a NaN");
  ModelRow row{model, last.m_owner, last.m_groupBits, noteGroups(last), rootTypeOf(*model, ours), 0};
  row.flags = static_cast<std::uint8_t>((last.m_simulated ? ModelRow::kSimulated : 0) |
                                        (last.m_selfCollision ? ModelRow::kSelfCollision : 0) |
                                        (ours ? ModelRow::kDefaultRules : 0) | (selfPair ? ModelRow::kSelfPair : 0));
  m_rows.push_back(row);
  m_boxes.push_back(box);
  m_contactDistances.push_back(last.m_contactDistance);
  m_largestContactDistance = std::max(m_largestContactDistance, std::abs(last.m_contactDistance));
}

std::uint32_t ModelTable::noteGroups(const CollisionModel& last) {
  if (last.m_groups == nullptr) return 0;
  if (m_groupLists.empty() || m_groupLists.back() != last.m_groups) m_groupLists.push_back(last.m_groups);
  return static_cast<std::uint32_t>(m_groupLists.size());
}

bool ModelTable::haveCommonGroup(const ModelRow& a, const ModelRow& b) const {
  return haveCommonMember(*m_groupLists[a.groups - 1], *m_groupLists[b.groups - 1]);
}

std::uint16_t ModelTable::rootTypeOf(const CollisionModel& model, bool ours) {
  const std::type_index type = ours ? std::type_index(typeid(BoundingBoxModel)) : model.getFirst()->typeKey();
  const auto found = std::find(m_rootTypes.begin(), m_rootTypes.end(), type);
  const auto index = static_cast<std::uint16_t>(found - m_rootTypes.begin());
  if (found == m_rootTypes.end()) m_rootTypes.push_back(type);
  return index;
}

}  // namespace allpairs::collision
