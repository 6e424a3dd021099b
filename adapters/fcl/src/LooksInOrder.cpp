// SPDX-License-Identifier: MIT
#include "LooksInOrder.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace allpairs::exact {

double LooksInOrder::add(const PartPair& parts, Meeting meeting) {
  const bool isMet = meeting.surfacesMeet || meeting.isDeep;
  m_within = std::min(m_within, isMet ? m_tolerance : meeting.distance);
  const bool isFirstThick = meeting.hasVolume && (m_thick.empty() || parts < m_thick.begin()->first);
  if (isFirstThick) m_thick = {{parts, meeting}};
  keep(parts, std::move(meeting));
  return m_search.withRounding(m_within);
}

void LooksInOrder::keep(const PartPair& parts, Meeting meeting) {
  const double most = m_search.withRounding(m_search.withRounding(m_within));
  if (meeting.distance > most) return;
  const auto next = m_nearest.lower_bound(parts);
  if (next != m_nearest.begin() && std::prev(next)->second.distance <= meeting.distance) return;
  const auto isNearer = [&](const auto& look) { return look.second.distance < meeting.distance; };
  m_nearest.erase(next, std::find_if(next, m_nearest.end(), isNearer));
  m_nearest.emplace(parts, std::move(meeting));
  while (m_nearest.begin()->second.distance > most) m_nearest.erase(m_nearest.begin());
}

std::map<PartPair, Meeting> LooksInOrder::take() {
  m_nearest.merge(m_thick);
  return std::move(m_nearest);
}

}  // namespace allpairs::exact
