// SPDX-License-Identifier: MIT
#pragma once

#include <map>

#include "Meeting.h"
#include "PartSearch.h"

namespace allpairs::exact {

/// Takes looks at pairs of parts in any order, and keeps those that change what is reported where pairs are looked at
/// by ascending distance of their boxes, until the next one's is more than the least of parts so far: each that is
/// nearer than all before it.
///
/// Only those that are as near as the nearest but for rounding can change it, so that the others are forgotten and the
/// memory does not grow with the pairs.
class LooksInOrder {
 public:
  /// Parts that meet have no distance, but their boxes may be apart by as much as the tolerance.
  LooksInOrder(const PartSearch& search, double within, double tolerance)
      : m_search(search), m_tolerance(tolerance), m_within(within) {}

  /// Takes what was found of a pair of which the boxes are apart. Returns within which distance of boxes others count,
  /// for PartSearch::visitApart().
  double add(const PartPair& parts, Meeting meeting);

  /// The looks that can change the report, in their order. Some of the others may be among them.
  [[nodiscard]] std::map<PartPair, Meeting> take();

 private:
  void keep(const PartPair& parts, Meeting meeting);

  const PartSearch& m_search;
  double m_tolerance;
  double m_within;
  std::map<PartPair, Meeting> m_nearest;  ///< In their order, each nearer than the one before.
  std::map<PartPair, Meeting> m_thick;    ///< The first that has a volume: where any meet, they have a depth then.
};

}  // namespace allpairs::exact
