// SPDX-License-Identifier: MIT
#include "PartSearch.h"

#include <algorithm>
#include <span>

#include "Enclosure.h"
#include "Meeting.h"
#include "allpairs/Overlaps.h"

namespace allpairs::exact {
namespace {

/// So many pairs are listed as fast as a search for the nearest is prepared.
constexpr std::size_t kFewPairs = 4096;

/// At this distance the boxes of all parts overlap that are no further apart than `limit`, whatever was rounded.
double reachFor(double limit, const ExactBody& first, const ExactBody& second) {
  constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();
  constexpr double kLeast = 1e-150;  // squares of lengths below are less precise than others
  return limit + kRounding * (first.reach + first.extent + second.reach + second.extent + limit) + kLeast;
}

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
  visitPairs(m_first.boxes, m_second.boxes, reachFor(0.0, m_first, m_second), visit);
}

std::vector<PartPair> PartSearch::after(const PartPair& last, double limit) {
  std::vector<PartPair> pairs;
  PartPair bound{.distance = limit};
  const auto add = [&](std::uint32_t first, std::uint32_t second) {
    const PartPair pair{distanceOf(first, second), first, second};
    if (pair <= last || pair >= bound) return;
    pairs.push_back(pair);
    if (pairs.size() < 2 * kMost) return;
    std::nth_element(pairs.begin(), pairs.begin() + kMost, pairs.end());
    bound = pairs[kMost];
    pairs.resize(kMost);
  };
  if (areFew(m_first, m_second)) {
    visitPairs(m_first.boxes, m_second.boxes, limit, add);
  } else {
    for (std::uint32_t i = 0; i < m_first.parts.size(); ++i) {
      for (const Neighbor& neighbor : allWithin(i, bound.distance)) add(i, neighbor.id);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<Neighbor> PartSearch::nearest(std::size_t first, std::size_t count) {
  if (m_world == nullptr) {
    auto world = std::make_unique<World>();
    static_cast<void>(world->add(std::span<const Box>(m_second.boxes)));
    m_world = std::move(world);
  }
  return m_world->findNearest(m_first.boxes[first], count);
}

std::vector<Neighbor> PartSearch::allWithin(std::size_t first, double limit) {
  constexpr std::size_t kAtFirst = 8;
  constexpr std::size_t kMore = 4;  // times as many
  const double reach = reachFor(limit, m_first, m_second);
  for (std::size_t count = kAtFirst;; count *= kMore) {
    std::vector<Neighbor> found = nearest(first, count);
    if (found.size() < count || found.back().distance > reach) return found;
  }
}

double PartSearch::likelyLimit() {
  double limit = std::numeric_limits<double>::infinity();
  if (areFew(m_first, m_second)) return limit;
  for (std::size_t i = 0; i < m_first.parts.size(); ++i) {
    for (const Neighbor& neighbor : nearest(i, 1)) {
      const double distance = distanceOf(i, neighbor.id);
      if (distance > 0.0) limit = std::min(limit, distance);
    }
  }
  return limit;
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
  visitPairs(leastCorners(first), leastCorners(second), reachFor(tolerance, first, second), compare);
  return areAll(isInSecond) && areAll(isInFirst);
}

}  // namespace allpairs::exact
