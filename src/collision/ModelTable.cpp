// SPDX-License-Identifier: MIT
#include "ModelTable.h"

#include <algorithm>
#include <cmath>

#include "SortedSets.h"
#include "allpairs/Error.h"
#include "allpairs/collision/BoundingBoxModel.h"
#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/CapsuleModel.h"
#include "allpairs/collision/HostedModel.h"
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
         type == typeid(CapsuleModel) || type == typeid(TetrahedronModel) || type == typeid(HostedModel);
}

}  // namespace

ModelTable::ModelTable() : m_rootTypes{typeid(BoundingBoxModel)} {}

void ModelTable::clear() {
  if (m_size != 0) {
    ++m_step;
    m_sizeBefore = m_size;
  }
  m_size = 0;
  m_changedCount = 0;
  m_groupLists.clear();
  m_rootTypes.erase(m_rootTypes.begin() + 1, m_rootTypes.end());
  m_largestContactDistance = 0.0;
  m_allOurs = true;
  m_anySelfPair = false;
}

void ModelTable::lookUpType(const std::type_info& type) { m_lastType = {&type, isLibraryType(type)}; }

void ModelTable::add(CollisionModel* model, bool ours, bool selfPair) {
  const CollisionModel& last = *model->m_last;
  const Box box = last.m_hasRoot ? last.m_rootBox : last.elementBox(0);
  if (!ours && hasNan(box)) throw InvalidBox(m_size, last.describe() + ": its root box has a NaN");
  const std::uint16_t rootType = ours ? std::uint16_t{0} : rootTypeOf(*model);
  if (m_size == m_rows.size()) grow();
  const int flags = (last.m_simulated ? ModelRow::kSimulated : 0) |
                    (last.m_selfCollision ? ModelRow::kSelfCollision : 0) | (ours ? ModelRow::kDefaultRules : 0) |
                    (selfPair ? ModelRow::kSelfPair : 0);
  m_rows[m_size] = {model,
                    last.m_owner,
                    last.m_groupBits,
                    last.m_groups == nullptr ? 0U : noteGroups(last),
                    rootType,
                    static_cast<std::uint8_t>(flags)};
  noteChange(box, last.m_contactDistance);
  m_boxes[m_size] = box;
  m_contactDistances[m_size] = last.m_contactDistance;
  m_largestContactDistance = std::max(m_largestContactDistance, std::abs(last.m_contactDistance));
  m_allOurs = m_allOurs && ours;
  m_anySelfPair = m_anySelfPair || selfPair;
  ++m_size;
}

void ModelTable::noteChange(const Box& box, double contactDistance) {
  const bool same = m_size < m_sizeBefore && m_boxes[m_size] == box && m_contactDistances[m_size] == contactDistance;
  m_changed[m_changedCount] = static_cast<std::uint32_t>(m_size);
  m_changedCount += same ? 0U : 1U;
}

void ModelTable::grow() {
  const std::size_t size = std::max<std::size_t>(64, 2 * m_size);
  m_changed.resize(size);
  m_boxes.resize(size);
  m_contactDistances.resize(size);
  m_rows.resize(size);  // last: its size is the one that is looked at
}

std::uint32_t ModelTable::noteGroups(const CollisionModel& last) {
  if (m_groupLists.empty() || m_groupLists.back() != last.m_groups) m_groupLists.push_back(last.m_groups);
  return static_cast<std::uint32_t>(m_groupLists.size());
}

bool ModelTable::haveCommonGroup(const ModelRow& a, const ModelRow& b) const {
  return haveCommonMember(*m_groupLists[a.groups - 1], *m_groupLists[b.groups - 1]);
}

std::uint16_t ModelTable::rootTypeOf(const CollisionModel& model) {
  const std::type_index type = model.getFirst()->typeKey();
  const auto found = std::find(m_rootTypes.begin(), m_rootTypes.end(), type);
  const auto index = static_cast<std::uint16_t>(found - m_rootTypes.begin());
  if (found == m_rootTypes.end()) m_rootTypes.push_back(type);
  return index;
}

}  // namespace allpairs::collision
