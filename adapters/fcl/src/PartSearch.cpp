// SPDX-License-Identifier: MIT
#include "PartSearch.h"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "Enclosure.h"
#include "Meeting.h"
#include "allpairs/Overlaps.h"
#include "allpairs/World.h"

namespace allpairs::exact {
namespace {

/// So many pairs are listed as fast as a search for the nearest is prepared.
constexpr std::size_t kFewPairs = 4096;

bool areFew(const ExactBody& first, const ExactBody& second) {
  return first.parts.size() * second.parts.size() <= kFewPairs;
}

/// Passes at least the pairs of boxes that overlap at a distance: of few, all. By ascending numbers.
void visitPairs(std::span<const Box> first, std::span<const Box> second, double distance,
                FunctionRef<void(std::uint32_t, std::uint32_t)> visitor) {
  if (first.size() * second.size() <= kFewPairs) {
    for (std::uint32_t i = 0; i < first.size(); ++i) {
      for (std::uint32_t j = 0; j < second.size(); ++j) visitor(i, j);
    }
    return;
  }
  const auto visit = [&](Span<const Pair> pairs) {
    for (const auto& [i, j] : pairs) visitor(i, j);
  };
  OverlapOptions options;
  options.distance = distance;
  streamOverlaps(first, second, visit, options);
}

/// Looks for the parts of two bodies that are apart: around each part of the one that has fewer, in a world of the
/// other's.
class ApartSearch {
 public:
  using Visitor = FunctionRef<double(const PartPair&)>;

  ApartSearch(const ExactBody& first, const ExactBody& second, const PartSearch& search, Visitor visitor)
      : m_isSwapped(first.parts.size() > second.parts.size()),
        m_few(m_isSwapped ? second : first),
        m_many(m_isSwapped ? first : second),
        m_search(search),
        m_visitor(visitor) {
    static_cast<void>(m_world.add(std::span<const Box>(m_many.boxes)));
  }

  void run(double within) {
    m_limit = m_search.withRounding(within);
    passNearest();
    std::sort(m_nearest.begin(), m_nearest.end());
    for (const PartPair& nearest : m_nearest) {
      if (nearest.distance > m_limit) return;
      passOthers(nearest);
    }
  }

 private:
  /// Of each part the nearest: they leave few others to pass, whatever the order of the parts is.
  void passNearest() {
    for (std::uint32_t part = 0; part < m_few.parts.size(); ++part) {
      PartPair nearest{.distance = m_limit};
      const auto take = [&](BoxId other) {
        const double distance = distanceOf(part, other);
        const bool isNearer = distance > 0.0 && distance <= nearest.distance;
        if (isNearer) nearest = {distance, part, other};
        return m_search.withRounding(nearest.distance);
      };
      visitNear(part, take);
      if (nearest.first != part) continue;  // none is as near as what was looked at before
      m_nearest.push_back(nearest);
      pass(nearest);
    }
  }

  void passOthers(const PartPair& nearest) {
    const auto look = [&](BoxId other) {
      const PartPair pair{distanceOf(nearest.first, other), nearest.first, other};
      const bool isWanted = pair.distance > 0.0 && pair.distance <= m_limit && other != nearest.second;
      if (isWanted) pass(pair);
      return m_search.withRounding(m_limit);
    };
    visitNear(nearest.first, look);
  }

  void visitNear(std::uint32_t part, FunctionRef<double(BoxId)> visit) const {
    m_world.visitNear(m_few.boxes[part], m_search.withRounding(m_limit), visit);
  }

  void pass(const PartPair& pair) {
    const double within = m_isSwapped ? m_visitor({pair.distance, pair.second, pair.first}) : m_visitor(pair);
    m_limit = m_search.withRounding(within);
  }

  [[nodiscard]] double distanceOf(std::uint32_t part, BoxId other) const {
    const ExactPart& few = *m_few.parts[part];
    const ExactPart& many = *m_many.parts[other];
    return m_isSwapped ? boxDistance(many, few) : boxDistance(few, many);
  }

  bool m_isSwapped;
  const ExactBody& m_few;
  const ExactBody& m_many;
  const PartSearch& m_search;
  Visitor m_visitor;
  World m_world;  ///< Of the boxes of the many parts, by their numbers.
  double m_limit = 0.0;
  std::vector<PartPair> m_nearest;  ///< Of the few parts with their nearest, in this order even where it is swapped.
};

/// Where the boxes of the parts begin.
std::vector<Box> leastCorners(const ExactBody& body) {
  std::vector<Box> corners;
  corners.reserve(body.parts.size());
  for (const auto& part : body.parts) corners.push_back({part->box().min, part->box().min});
  return corners;
}

bool areAll(const std::vector<bool>& flags) {
  return std::all_of(flags.begin(), flags.end(), [](bool flag) { return flag; });
}

}  // namespace

double PartSearch::distanceOf(std::size_t first, std::size_t second) const {
  return boxDistance(*m_first.parts[first], *m_second.parts[second]);
}

void PartSearch::visitMeeting(FunctionRef<void(const PartPair&)> visitor) const {
  const auto visit = [&](std::uint32_t first, std::uint32_t second) {
    if (distanceOf(first, second) == 0.0) visitor({0.0, first, second});
  };
  visitPairs(m_first.boxes, m_second.boxes, withRounding(0.0), visit);
}

void PartSearch::visitApart(double within, FunctionRef<double(const PartPair&)> visitor) const {
  if (areFew(m_first, m_second)) return visitFewApart(within, visitor);
  ApartSearch(m_first, m_second, *this, visitor).run(within);
}

void PartSearch::visitFewApart(double within, FunctionRef<double(const PartPair&)> visitor) const {
  std::vector<PartPair> pairs;
  const auto add = [&](std::uint32_t first, std::uint32_t second) {
    const PartPair pair{distanceOf(first, second), first, second};
    if (pair.distance > 0.0) pairs.push_back(pair);
  };
  visitPairs(m_first.boxes, m_second.boxes, 0.0, add);
  std::sort(pairs.begin(), pairs.end());
  for (const PartPair& pair : pairs) {
    if (pair.distance > withRounding(within)) return;
    within = visitor(pair);
  }
}

double PartSearch::withRounding(double distance) const {
  constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();
  constexpr double kLeast = 1e-150;  // squares of lengths below are less precise than others
  const double reach = m_first.reach + m_first.extent + m_second.reach + m_second.extent;
  return distance + kRounding * (reach + distance) + kLeast;
}

bool areSame(const ExactBody& first, const ExactBody& second, double tolerance) {
  const std::size_t count = first.parts.size();
  if (second.parts.size() != count) return false;
  if (!holds(first.box, second.box, tolerance) || !holds(second.box, first.box, tolerance)) return false;
  std::vector<bool> isInSecond(count, false);
  std::vector<bool> isInFirst(count, false);
  const auto compare = [&](std::uint32_t a, std::uint32_t b) {
    if (isInSecond[a] && isInFirst[b]) return;
    if (areSame(*first.parts[a], *second.parts[b], tolerance)) isInSecond[a] = isInFirst[b] = true;
  };
  visitPairs(leastCorners(first), leastCorners(second), PartSearch(first, second).withRounding(tolerance), compare);
  return areAll(isInSecond) && areAll(isInFirst);
}

}  // namespace allpairs::exact
