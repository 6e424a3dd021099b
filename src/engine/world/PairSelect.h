// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "allpairs/Box.h"
#include "allpairs/Pair.h"
#include "allpairs/WorldTypes.h"
#include "world/BoxStore.h"

namespace allpairs::engine {

/// What a pair whose lanes overlap must pass still: the exact test in double, where lanes were rounded, and the filters.
///
/// The two boxes of a pair are of the same store, or of two.
struct PairSelect {
  const BoxStore& first;
  const BoxStore& second;
  const std::function<bool(BoxId, BoxId)>& accept;
  double distance = 0.0;
  bool exactTest = false;

  /// Moves the pairs that pass to the front; returns how many there are.
  [[nodiscard]] std::size_t select(std::span<Pair> pairs) const {
    const bool filtered = first.filtered() || second.filtered();
    if (!exactTest && !filtered && !accept) return pairs.size();
    std::size_t kept = 0;
    for (const Pair pair : pairs) {
      if (exactTest && !touches(pair)) continue;
      if (filtered && !mayPair(first.filter(pair.first), second.filter(pair.second))) continue;
      if (accept && !accept(pair.first, pair.second)) continue;
      pairs[kept++] = pair;
    }
    return kept;
  }

 private:
  [[nodiscard]] bool touches(Pair pair) const noexcept {
    const double d = distance + first.margin(pair.first) + second.margin(pair.second);
    return overlap(first.box(pair.first), second.box(pair.second), d);
  }
};

}  // namespace allpairs::engine
