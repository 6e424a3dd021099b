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
  void requireExactTest(bool required) noexcept {
    m_exact = required;
    m_slack = kNever;
  }

  /// The same for lanes that are bounds, relative to a point and widened by this test's distance and margins: the kernels can
  /// tell which hits need the exact test.
  void requireExactTestInDoubt(bool required, const std::array<double, 3>& origin) noexcept {
    m_exact = required;
    m_slack = slackOf(origin);
  }

  [[nodiscard]] bool leavesDoubts() const noexcept { return m_exact && m_slack < kNever; }

  /// More than the lanes of widened boxes may differ from what the exact test compares, beyond their rounding.
  [[nodiscard]] float slack() const noexcept { return m_slack; }

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

  [[nodiscard]] bool needed() const noexcept { return m_exact || m_filtered; }
  [[nodiscard]] bool isFiltered() const noexcept { return m_filtered; }
  [[nodiscard]] bool exactTestNeeded() const noexcept { return m_exact; }

  /// A pair that is certain to touch needs no exact test.
  [[nodiscard]] bool keeps(Pair pair, bool isDoubtful = true) const {
    return (!m_exact || !isDoubtful || touches(pair)) && (!m_filtered || passes(pair));
  }

  /// Moves the pairs that it keeps to the front; returns their number.
  [[nodiscard]] std::size_t select(std::span<Pair> pairs) const {
    if (!needed()) return pairs.size();
    std::size_t kept = 0;
    for (const Pair pair : pairs) {
      if (keeps(pair)) pairs[kept++] = pair;
    }
    return kept;
  }

  /// The same for the pairs of some hits, of which only those in doubt need the exact test, if the kernels noted them.
  [[nodiscard]] std::size_t select(std::span<Pair> pairs, const Hits& hits) const {
    if (!m_filtered && exactTestsOf(hits) == 0) return pairs.size();
    return select(pairs, hits, [](Pair&) { return true; });
  }

  /// The same; isWanted(pair) may change a pair before it is tested.
  template <class IsWanted>
  [[nodiscard]] std::size_t select(std::span<Pair> pairs, const Hits& hits, const IsWanted& isWanted) const {
    std::size_t kept = 0;
    std::size_t doubt = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      Pair pair = pairs[i];
      const bool isDoubtful = hits.doubt == nullptr || (doubt < hits.doubts && hits.doubt[doubt] == i);
      doubt += isDoubtful ? 1U : 0U;
      if (isWanted(pair) && keeps(pair, isDoubtful)) pairs[kept++] = pair;
    }
    return kept;
  }

  /// How many of some hits need the exact test.
  [[nodiscard]] std::size_t exactTestsOf(const Hits& hits) const noexcept {
    if (!m_exact) return 0;
    return hits.doubt != nullptr ? hits.doubts : hits.size;
  }

 private:
  /// The sums of a bound, the distance, margins and the origin are off by no more than some units in the last place of the
  /// largest of them; to those of the bound, the slack that is relative to lanes is enough. A box that shrinks may be
  /// inverted, whose lanes say nothing.
  [[nodiscard]] float slackOf(const std::array<double, 3>& origin) const noexcept {
    const BoxView& first = *m_first.boxes;
    const BoxView& second = *m_second.boxes;
    if (m_distance == 0.0 && !first.hasMargins() && !second.hasMargins()) return kQueryTiny;
    if (m_distance < 0.0 || first.leastMargin() < 0.0 || second.leastMargin() < 0.0) return kNever;
    double most = std::max(first.greatestMargin(), second.greatestMargin()) + 0.5 * m_distance;
    for (const double value : origin) most = std::max(most, std::abs(value));
    most *= 0x1p-42;
    return most < static_cast<double>(kLaneMax) ? kQueryTiny + static_cast<float>(most) : kNever;
  }

  [[nodiscard]] bool touches(Pair pair) const {
    // The order of a sum is part of the contract: margins are added by the order of ids.
    if (m_inAnyOrder && pair.second < pair.first) std::swap(pair.first, pair.second);
    const double d = m_distance + m_first.boxes->margin(pair.first) + m_second.boxes->margin(pair.second);
    return overlap((*m_first.boxes)[pair.first], (*m_second.boxes)[pair.second], d);
  }

  [[nodiscard]] bool passes(Pair pair) const {
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

  TestedBoxes m_first;
  TestedBoxes m_second;
  double m_distance;
  const PairPredicate* m_accept;
  bool m_exact = false;
  bool m_inAnyOrder = false;
  float m_slack = kNever;
  bool m_filtered;
};

}  // namespace allpairs::engine
