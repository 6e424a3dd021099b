// SPDX-License-Identifier: MIT
#include "PairSearch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace allpairs::collision {
namespace {

/// How much a distance is widened, by the size of its summands, before the search: far more than any order in which the
/// three may be summed can round off (2^-51), and too little to let in more than a few pairs.
constexpr double kSearchSlack = 0x1p-48;

/// Pairs that the rules are asked about between two looks at the flag that ends a step.
constexpr std::size_t kAskedAtOnce = std::size_t{1} << 14;

void addTests(const OverlapStatistics& search, BroadPhaseStatistics& statistics) {
  statistics.testsMade += search.boxTests + search.groupTests;
}

}  // namespace

/// Whichever boxes are near: ask(newer, older) gives the pair of two rows, if there is one.
template <class Ask>
void PairSearch::askAll(std::size_t begin, std::vector<CollisionModelPair>& pairs, BroadPhaseStatistics& statistics,
                        const Ask& ask) const {
  for (std::size_t newer = begin; newer < m_models.size(); ++newer) {
    checkStop(m_stop);
    const ModelRow& row = m_models.row(newer);
    if (row.has(ModelRow::kSelfPair)) pairs.emplace_back(row.model, row.model);
    for (std::size_t older = 0; older < newer; ++older) {
      if (const auto pair = ask(newer, older)) pairs.push_back(*pair);
    }
    statistics.testsMade += newer;
    statistics.candidates += newer;
  }
}

void PairSearch::addPairs(std::size_t begin, std::vector<CollisionModelPair>& pairs, BroadPhaseStatistics& statistics) {
  if (m_strategy == Strategy::Exhaustive) {
    askAll(begin, pairs, statistics,
           [this](std::size_t newer, std::size_t older) { return m_rules.judge(newer, older).pair; });
  } else if (m_rules.maximumDistance() == std::numeric_limits<double>::infinity()) {
    askAll(begin, pairs, statistics,
           [this](std::size_t newer, std::size_t older) { return m_rules.ask(newer, older, false); });
  } else {
    askFound(begin, pairs, statistics);
  }
}

void PairSearch::setKept(bool kept) {
  if (kept == isKept()) return;
  m_kept.reset();
  if (kept) m_kept.emplace();
}

void PairSearch::askFound(std::size_t begin, std::vector<CollisionModelPair>& pairs, BroadPhaseStatistics& statistics) {
  Candidates withOlder = searchOlder(begin, statistics);
  Candidates withNewer = begin == 0 ? searchAll(statistics) : searchNewer(begin, statistics);
  statistics.candidates += withOlder.left.size() + withNewer.left.size();
  if (m_rules.arePlain() && begin == 0 && !m_models.anySelfPair()) {
    askAllOf(withNewer.left, withNewer, pairs);
    return;
  }
  for (std::size_t newer = begin; newer < m_models.size(); ++newer) {
    const ModelRow& row = m_models.row(newer);
    if (row.has(ModelRow::kSelfPair)) pairs.emplace_back(row.model, row.model);
    for (Candidates* candidates : {&withOlder, &withNewer}) {
      askAllOf(takeRow(newer, *candidates), *candidates, pairs);
    }
  }
}

void PairSearch::askAllOf(std::span<const Pair> found, const Candidates& offsets,
                          std::vector<CollisionModelPair>& pairs) {
  const bool plain = m_rules.arePlain();
  while (!found.empty()) {
    checkStop(m_stop);
    const std::span<const Pair> part = found.first(std::min(found.size(), kAskedAtOnce));
    plain ? askPlain(part, offsets, pairs) : askEach(part, offsets, pairs);
    found = found.subspan(part.size());
  }
}

std::span<const Pair> PairSearch::takeRow(std::size_t newer, Candidates& candidates) {
  const std::span<const Pair> left = candidates.left;
  std::size_t i = 0;
  while (i < left.size() && left[i].second + candidates.secondOffset == newer) ++i;
  candidates.left = left.subspan(i);
  return left.first(i);
}

void PairSearch::askPlain(std::span<const Pair> found, const Candidates& offsets,
                          std::vector<CollisionModelPair>& pairs) const {
  const bool decided = m_rules.searchIsExact();
  for (const Pair& pair : found) {
    const std::size_t newer = pair.second + offsets.secondOffset;
    const std::size_t older = pair.first + offsets.firstOffset;
    if (m_rules.areOneModel(newer, older) && !m_rules.ask(newer, older, decided)) continue;
    if (!m_rules.askPlain(newer, older, decided)) continue;
    pairs.emplace_back(m_models.row(newer).model, m_models.row(older).model);
  }
}

void PairSearch::askEach(std::span<const Pair> found, const Candidates& offsets,
                         std::vector<CollisionModelPair>& pairs) {
  const bool decided = m_rules.searchIsExact();
  for (const Pair& candidate : found) {
    const auto pair =
        m_rules.ask(candidate.second + offsets.secondOffset, candidate.first + offsets.firstOffset, decided);
    if (pair) pairs.push_back(*pair);
  }
}

PairSearch::Candidates PairSearch::searchOlder(std::size_t begin, BroadPhaseStatistics& statistics) {
  if (begin == 0) return {};
  m_betweenNewerAndOlder.setOptions(options());
  const std::span<const Pair> found = m_betweenNewerAndOlder.find(boxSet(0, begin), boxSet(begin, m_models.size()));
  addTests(m_betweenNewerAndOlder.statistics(), statistics);
  return {found, 0, begin};
}

PairSearch::Candidates PairSearch::searchAll(BroadPhaseStatistics& statistics) {
  if (!m_kept || m_strategy != Strategy::Automatic) return searchNewer(0, statistics);
  const bool addsContactDistances = m_rules.addsContactDistances() && m_models.anyContactDistance();
  const KeptSearch::Settings settings{searchDistance(), addsContactDistances, m_executor, m_stop};
  if (m_kept->isWorthIt(m_models, settings)) {
    const std::span<const Pair> found = m_kept->find(m_models);
    statistics.testsMade += m_kept->testsMade();
    return {found, 0, 0};
  }
  const Candidates found = searchNewer(0, statistics);
  m_kept->notePairs(found.left.size());
  return found;
}

PairSearch::Candidates PairSearch::searchNewer(std::size_t begin, BroadPhaseStatistics& statistics) {
  if (m_models.size() - begin < 2) return {};
  m_amongNewer.setOptions(options());
  const std::span<const Pair> found = m_amongNewer.find(boxSet(begin, m_models.size()));
  addTests(m_amongNewer.statistics(), statistics);
  return {found, begin, begin};
}

BoxView PairSearch::boxSet(std::size_t begin, std::size_t end) const {
  BoxView set(m_models.boxes().subspan(begin, end - begin));
  if (m_rules.addsContactDistances() && m_models.anyContactDistance()) {
    set.setMargins(m_models.contactDistances().subspan(begin, end - begin));
  }
  return set;
}

double PairSearch::searchDistance() const {
  const double distance = m_rules.maximumDistance();
  if (m_rules.searchIsExact()) return distance;
  const double contact = m_rules.addsContactDistances() ? m_models.largestContactDistance() : 0.0;
  return distance + (std::abs(distance) + 2.0 * contact) * kSearchSlack;
}

OverlapOptions PairSearch::options() const {
  OverlapOptions options;
  options.strategy = m_strategy;
  options.order = Order::BySecond;
  options.distance = searchDistance();
  options.executor = m_executor;
  options.stop = m_stop;
  return options;
}

}  // namespace allpairs::collision
