// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "allpairs/PairPredicate.h"
#include "allpairs/Span.h"

namespace allpairs {

/// Filter data of the boxes of one set; each span is empty, or as long as the set.
struct FilterBits {
  /// The categories of each box, as bits; if empty, every bit is set.
  Span<const std::uint32_t> categories{};

  /// The categories that each box accepts as partners; if empty, every bit is set.
  Span<const std::uint32_t> masks{};

  /// Boxes of the same non-zero group are never paired.
  Span<const std::uint32_t> groups{};
};

/// Excludes overlapping boxes from the result.
///
/// A pair is kept if each box's mask shares a bit with the other's category, the boxes are not in the same non-zero
/// group, and `accept`, if set, returns true.
/// Bad input: a span of the wrong length throws InvalidArgument when the filter is used.
/// Threads:   `accept` is called only for boxes that overlap, in unspecified order, and with a parallel executor from
///            several threads concurrently. It may be called more than once for a pair, and must not start work on the
///            executor of the search.
struct Filter {
  /// Of the set, or of the first of two sets.
  FilterBits first{};

  /// Of the second of two sets; with one set, it throws InvalidArgument.
  FilterBits second{};

  /// Called with (first, second) for each pair that passed all other filters.
  PairPredicate accept{};
};

}  // namespace allpairs
