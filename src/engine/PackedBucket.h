// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "allpairs/Pair.h"

namespace allpairs::engine {

/// Up to so many pairs of a key are put in order by exchanging neighbours.
inline constexpr std::size_t kMostExchanged = 6;

/// Up to so many by a network.
inline constexpr std::size_t kMostInNetwork = 64;

/// Some pairs as numbers of 32 bits: what their keys differ in, above their other index. Grouped by key.
struct PackedBucket {
  /// The pairs of a key that has more than kMostExchanged, and no more than kMostInNetwork.
  struct Row {
    std::uint32_t begin = 0;
    std::uint32_t size = 0;
  };

  /// There is room for kMostInNetwork more numbers behind the end.
  std::uint32_t* values = nullptr;
  std::size_t size = 0;
  std::span<const Row> rows;
  bool isOrdered = false;  ///< Whether they are in order already; then no room is needed.

  /// Where they go as pairs, in order: to the place where the numbers begin, or to another.
  Pair* pairs = nullptr;
  std::uint32_t firstKey = 0;
  unsigned otherBits = 0;
  bool bySecond = false;
};

}  // namespace allpairs::engine
