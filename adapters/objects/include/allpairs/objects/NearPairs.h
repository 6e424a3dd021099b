// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
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

/// All pairs of objects from a first number on whose boxes are apart, and within a distance however the host rounds.
/// Nothing where there are more than a few for each object: who asks may make the distance smaller with each of them.
template <class Object>
[[nodiscard]] std::optional<std::vector<NearPair<typename ObjectRows<Object>::S>>> pairsApart(
    const ObjectRows<Object>& rows, BoxId begin, typename ObjectRows<Object>::S within) {
  using S = typename ObjectRows<Object>::S;
  constexpr std::size_t kMostOfEach = 4;
  const double most = std::max(rows.magnitude(), static_cast<double>(within));
  const double reach =
      static_cast<double>(within) + 16.0 * static_cast<double>(std::numeric_limits<S>::epsilon()) * most;
  // Each box is widened by half of it, and by more than is lost when its distances from the origin become float32.
  const double extent = rows.extent();
  const double half = 0.5 * reach + 0x1p-22 * (extent + reach) + 0x1p-120;
  if (extent + half > 1e38) return std::nullopt;
  const auto by = static_cast<float>(half);
  const std::array<double, 3> origin = rows.origin();
  const Span<const S> wanted = rows.rows().subspan(std::size_t{6} * begin);
  std::vector<float> widened(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); i += 6) {
    for (std::size_t k = 0; k < 3; ++k) {
      widened[i + k] = static_cast<float>(static_cast<double>(wanted[i + k]) - origin[k]) - by;
      widened[i + 3 + k] = static_cast<float>(static_cast<double>(wanted[i + 3 + k]) - origin[k]) + by;
    }
  }
  OverlapOptions options;
  options.order = Order::Unordered;
  options.maxPairs = kMostOfEach * rows.size();
  std::vector<NearPair<S>> near;
  try {
    const std::vector<Pair> found = overlaps(BoxView::fromRows(widened), options);
    near.reserve(found.size());
    for (const Pair& pair : found) {
      const Pair ids{begin + pair.first, begin + pair.second};
      const auto first = rows.bounds(ids.first);
      const auto second = rows.bounds(ids.second);
      if (!first.overlap(second)) near.push_back({first.distance(second), ids});
    }
  } catch (const LimitExceeded&) {
    return std::nullopt;
  }
  return near;
}

}  // namespace allpairs
