// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "allpairs/BoxView.h"
#include "allpairs/Filter.h"
#include "allpairs/Pair.h"
#include "input/BoxReader.h"
#include "input/Options.h"
#include "kernels/Hits.h"

namespace allpairs::engine {

/// Whether each side accepts the other's category.
[[nodiscard]] inline bool acceptEachOther(std::uint32_t categoryA, std::uint32_t maskA, std::uint32_t categoryB,
                                          std::uint32_t maskB) noexcept {
  return ((categoryA & maskB) != 0) & ((categoryB & maskA) != 0);
}

/// The data of one side's boxes that a test reads: bounds, margins, and filters, `stride` values apart. Null means the
/// default.
struct TestedBoxes {
  const BoxView* boxes = nullptr;
  const std::uint32_t* categories = nullptr;
  const std::uint32_t* masks = nullptr;
  const std::uint32_t* groups = nullptr;
  std::size_t stride = 1;

  static TestedBoxes of(const BoxView& boxes, const FilterBits& bits) noexcept {
    const auto dataOf = [](std::span<const std::uint32_t> values) { return values.empty() ? nullptr : values.data(); };
    return {&boxes, dataOf(bits.categories), dataOf(bits.masks), dataOf(bits.groups)};
  }
  [[nodiscard]] bool isFiltered() const noexcept {
    return categories != nullptr || masks != nullptr || groups != nullptr;
  }
};

/// The tests of a pair that passed the float32 test: the exact test in double, if lanes were rounded, and the filter.
class PairTest {
 public:
  PairTest(const TestedBoxes& first, const TestedBoxes& second, double distance, const PairPredicate& accept)
      : m_first(first),
        m_second(second),
        m_distance(distance),
        m_accept(&accept),
        m_filtered(first.isFiltered() || second.isFiltered() || static_cast<bool>(accept)) {}

  static PairTest of(const Sets& sets, const OverlapOptions& options) {
    const Filter& filter = options.filter;
    return {TestedBoxes::of(sets.first, filter.first),
            TestedBoxes::of(sets.second, sets.one ? filter.first : filter.second), options.distance, filter.accept};
  }

  /// Set once the lanes are known.
  void requireExactTest(bool required) noexcept { setLanes(required, false, kNever); }

  /// The same for lanes as a reader makes them of bounds that are widened by this test's distance and margins: the
  /// kernels can tell which hits need the exact test. On a flat axis all boxes are the same point, which their lanes
  /// are exactly unless they are widened: there nothing is in doubt.
  void requireExactTestInDoubt(bool required, const BoxReader& lanes, const std::array<bool, 3>& isFlat = {}) noexcept {
    setLanes(required, lanes.roundsToNearest(), slackOf(lanes.origin()), isFlat);
  }

  /// The same for lanes that are rounded outward and relative to the origin.
  void requireExactTestInDoubt(bool required) noexcept { setLanes(required, false, slackOf({})); }

  /// From now on it keeps only pairs with first < second: for a part of a set against the whole set.
  void requireAscending() noexcept { m_ascending = true; }

  [[nodiscard]] bool leavesDoubts() const noexcept { return m_exact && m_slack < kNever; }

  /// More than the lanes of widened boxes may differ from what the exact test compares, beyond their rounding. On a
  /// flat axis no lane is below another, so that the test of the nearest float32 would leave every hit in doubt.
  [[nodiscard]] LaneSlack slack() const noexcept {
    LaneSlack slack{m_areNearest && m_isFlat == std::array<bool, 3>{}, {m_slack, m_slack, m_slack}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (m_isFlat[axis]) slack.most[axis] = 0.0F;
    }
    return slack;
  }

  /// Its two parts: the exact test of hits of one set, whichever of the two boxes comes first, and the filter.
  [[nodiscard]] PairTest boundsOfHits() const {
    PairTest test = *this;
    test.m_filtered = false;
    test.m_inAnyOrder = true;
    return test;
  }
  [[nodiscard]] PairTest withoutBounds() const {
    PairTest test = *this;
    test.m_exact = false;
    return test;
  }

  [[nodiscard]] bool needed() const noexcept { return m_exact || m_filtered || m_ascending; }
  [[nodiscard]] bool isFiltered() const noexcept { return m_filtered; }
  [[nodiscard]] bool exactTestNeeded() const noexcept { return m_exact; }

  /// A pair that is certain to touch needs no exact test.
  [[nodiscard]] bool keeps(Pair pair, bool isDoubtful = true) const {
    if (m_ascending && pair.first >= pair.second) return false;
    return (!m_exact || !isDoubtful || touches(pair)) && (!m_filtered || allows(pair));
  }

  /// Moves the pairs that it keeps to the front; returns their number. Of the pairs of hits only those in doubt need the
  /// exact test, if the kernels noted them.
  [[nodiscard]] std::size_t select(std::span<Pair> pairs, const Hits* hits = nullptr) const {
    if (!needed()) return pairs.size();
    const bool areNoted = hits != nullptr && hits->doubt != nullptr;
    if (areNoted && !m_filtered && !m_ascending) return selectInDoubt(pairs, {hits->doubt, hits->doubts});
    std::size_t kept = 0;
    std::size_t doubt = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Pair pair = pairs[i];
      const bool isDoubtful = !areNoted || (doubt < hits->doubts && hits->doubt[doubt] == i);
      doubt += isDoubtful ? 1U : 0U;
      if (keeps(pair, isDoubtful)) pairs[kept++] = pair;
    }
    return kept;
  }

  /// Calls use(i) for each of `size` pairs, pairAt(i), that does not touch. Their boxes lie in no order, and are
  /// prefetched.
  template <class PairAt, class Use>
  void forEachApart(std::size_t size, const PairAt& pairAt, const Use& use) const {
    for (std::size_t i = 0; i < size + kPrefetchDistance; ++i) {
      if (i < size) {
        prefetchBox(*m_first.boxes, pairAt(i).first);
        prefetchBox(*m_second.boxes, pairAt(i).second);
      }
      if (i < kPrefetchDistance) continue;
      const std::size_t tested = i - kPrefetchDistance;
      if (!touches(pairAt(tested))) use(tested);
    }
  }

  /// The exact test of a hit, of which neither box is empty.
  [[nodiscard]] bool touches(Pair pair) const {
    if (m_firstRows != nullptr)
      return touch(m_firstRows + std::size_t{6} * pair.first, m_secondRows + std::size_t{6} * pair.second);
    // The order of a sum is part of the contract: margins are added by the order of ids.
    if (m_inAnyOrder && pair.second < pair.first) std::swap(pair.first, pair.second);
    const double d = m_distance + m_first.boxes->margin(pair.first) + m_second.boxes->margin(pair.second);
    return overlap((*m_first.boxes)[pair.first], (*m_second.boxes)[pair.second], d);
  }

  /// Whether the filter allows a pair.
  [[nodiscard]] bool allows(Pair pair) const {
    const std::uint32_t all = 0xFFFFFFFFU;
    const std::size_t a = pair.first * m_first.stride;
    const std::size_t b = pair.second * m_second.stride;
    const auto at = [](const std::uint32_t* values, std::size_t i, std::uint32_t otherwise) {
      return values == nullptr ? otherwise : values[i];
    };
    if (!acceptEachOther(at(m_first.categories, a, all), at(m_first.masks, a, all), at(m_second.categories, b, all),
                         at(m_second.masks, b, all))) {
      return false;
    }
    const std::uint32_t group = at(m_first.groups, a, 0);
    if (group != 0 && group == at(m_second.groups, b, 0)) return false;
    return !*m_accept || (*m_accept)(pair.first, pair.second);
  }

  /// How many of some hits need the exact test.
  [[nodiscard]] std::size_t exactTestsOf(const Hits& hits) const noexcept {
    if (!m_exact) return 0;
    return hits.doubt != nullptr ? hits.doubts : hits.size;
  }

 private:
  void setLanes(bool required, bool areNearest, float slack, const std::array<bool, 3>& isFlat = {}) noexcept {
    m_exact = required;
    m_areNearest = areNearest;
    m_slack = slack;
    m_isFlat = isWidened() ? std::array<bool, 3>{} : isFlat;
    findRows();
  }

  [[nodiscard]] bool isWidened() const noexcept {
    return m_distance != 0.0 || m_first.boxes->hasMargins() || m_second.boxes->hasMargins();
  }

  /// The sums of a bound, the distance, margins and the origin are off by no more than some units in the last place of
  /// the largest of them; to those of the bound, the slack that is relative to lanes is enough. A box that shrinks may
  /// be inverted, whose lanes say nothing.
  [[nodiscard]] float slackOf(const std::array<double, 3>& origin) const noexcept {
    const BoxView& first = *m_first.boxes;
    const BoxView& second = *m_second.boxes;
    if (!isWidened()) return kQueryTiny;
    if (m_distance < 0.0 || first.leastMargin() < 0.0 || second.leastMargin() < 0.0) return kNever;
    double most = std::max(first.greatestMargin(), second.greatestMargin()) + 0.5 * m_distance;
    for (const double value : origin) most = std::max(most, std::abs(value));
    most *= 0x1p-42;
    return most < static_cast<double>(kLaneMax) ? kQueryTiny + static_cast<float>(most) : kNever;
  }

  /// Two rows of bounds; no branch is mispredicted, since most hits in doubt touch on some axes only by a hair.
  static bool touch(const double* a, const double* b) noexcept {
    return static_cast<bool>(static_cast<int>(a[0] <= b[3]) & static_cast<int>(b[0] <= a[3]) &
                             static_cast<int>(a[1] <= b[4]) & static_cast<int>(b[1] <= a[4]) &
                             static_cast<int>(a[2] <= b[5]) & static_cast<int>(b[2] <= a[5]));
  }

  /// Boxes as most searches have them, of which the bounds are all that matters.
  void findRows() noexcept {
    m_firstRows = m_exact && m_distance == 0.0 ? rowsOf(*m_first.boxes) : nullptr;
    m_secondRows = m_firstRows != nullptr ? rowsOf(*m_second.boxes) : nullptr;
    if (m_secondRows == nullptr) m_firstRows = nullptr;
  }
  static const double* rowsOf(const BoxView& boxes) noexcept {
    const bool isPlain = boxes.isFloat64() && boxes.float64().isPacked() && !boxes.hasMargins();
    return isPlain ? boxes.float64().min.data : nullptr;
  }

  /// Moves the pairs to the front of which the one at each of some positions, ascending, touches or is at no such
  /// position.
  [[nodiscard]] std::size_t selectInDoubt(std::span<Pair> pairs, std::span<const std::uint32_t> doubts) const {
    std::size_t kept = 0;
    std::size_t begin = 0;  // of those that have not been moved
    const auto moveUntil = [&](std::size_t end) {
      if (kept != begin) std::copy(pairs.data() + begin, pairs.data() + end, pairs.data() + kept);
      kept += end - begin;
    };
    forEachApart(
        doubts.size(), [&](std::size_t i) { return pairs[doubts[i]]; },
        [&](std::size_t i) {
          moveUntil(doubts[i]);
          begin = doubts[i] + 1;
        });
    moveUntil(pairs.size());
    return kept;
  }

  TestedBoxes m_first;
  TestedBoxes m_second;
  double m_distance;
  const PairPredicate* m_accept;
  bool m_exact = false;
  bool m_inAnyOrder = false;
  bool m_ascending = false;
  bool m_areNearest = false;
  float m_slack = kNever;
  std::array<bool, 3> m_isFlat{};
  const double* m_firstRows = nullptr;  ///< Rows of 6, if bounds are all that matters.
  const double* m_secondRows = nullptr;
  bool m_filtered;
};

}  // namespace allpairs::engine
