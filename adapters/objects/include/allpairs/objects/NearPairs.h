// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "allpairs/BoxView.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Pair.h"
#include "allpairs/objects/ObjectRows.h"

namespace allpairs {

/// Two objects, by number, and how far their boxes are apart.
template <class S>
struct NearPair {
  S distance = S(0);
  Pair pair;

  friend bool operator<(const NearPair& a, const NearPair& b) {
    return std::pair(a.distance, a.pair) < std::pair(b.distance, b.pair);
  }
};

/// All pairs of objects from a first number on whose boxes are apart, and within a distance however the host rounds,
/// near ones first. Nothing where there are more than a few for each object: who asks about them may make the distance
/// smaller with each.
template <class Object>
[[nodiscard]] std::optional<std::vector<NearPair<typename ObjectRows<Object>::S>>> pairsApart(
    const ObjectRows<Object>& rows, BoxId begin, typename ObjectRows<Object>::S within) {
  using S = typename ObjectRows<Object>::S;
  constexpr std::size_t kMostOfEach = 4;
  const double most = std::max(rows.magnitude(), static_cast<double>(within));
  OverlapOptions options;
  options.order = Order::Unordered;
  options.distance = static_cast<double>(within) + 16.0 * static_cast<double>(std::numeric_limits<S>::epsilon()) * most;
  options.maxPairs = kMostOfEach * rows.size();
  if (!std::isfinite(options.distance)) return std::nullopt;
  std::vector<NearPair<S>> near;
  try {
    for (const Pair& pair : overlaps(BoxView::fromRows(rows.rows().subspan(std::size_t{6} * begin)), options)) {
      const Pair ids{begin + pair.first, begin + pair.second};
      const auto first = rows.bounds(ids.first);
      const auto second = rows.bounds(ids.second);
      if (!first.overlap(second)) near.push_back({first.distance(second), ids});
    }
  } catch (const LimitExceeded&) {
    return std::nullopt;
  }
  std::sort(near.begin(), near.end());
  return near;
}

}  // namespace allpairs
