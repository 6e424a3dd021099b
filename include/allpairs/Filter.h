// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "allpairs/PairPredicate.h"

namespace allpairs {

/// What the boxes of one set say about whom they may pair with; a span is empty, or as long as the set.
struct FilterBits {
  /// What a box is, as bits; without it every bit is set.
  std::span<const std::uint32_t> categories{};

  /// Which categories a box accepts as partners; without it every bit is set.
  std::span<const std::uint32_t> masks{};

  /// Boxes of the same non-zero group are no pair.
  std::span<const std::uint32_t> groups{};
};

/// Which overlapping boxes are left out of the result.
///
/// A pair stays if each box's mask has a bit of the other's category, their groups are not the same non-zero one, and
/// `accept`, where given, says yes.
/// Bad input: a span of the wrong length throws InvalidArgument when the filter is used.
/// Threads:   `accept` is called for boxes that overlap only, in no particular order, and with a parallel executor from
///            several threads at once. It may be asked about a pair more than once, and must not start work on the
///            executor of the search.
struct Filter {
  /// Of the set, or of the first of two.
  FilterBits first{};

  /// Of the second of two sets; a search of one set refuses it with InvalidArgument.
  FilterBits second{};

  /// Asked with (first, second) of a pair that passed the rest.
  PairPredicate accept{};
};

}  // namespace allpairs
