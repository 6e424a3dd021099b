// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/BoxView.h"
#include "allpairs/Neighbors.h"
#include "allpairs/OverlapOptions.h"
#include "kernels/Kernels.h"

namespace allpairs::engine {

/// The boxes to search: one set against itself, or two against each other.
struct Sets {
  explicit Sets(const BoxView& boxes) : first(boxes), second(boxes), one(true) {}
  Sets(const BoxView& a, const BoxView& b) : first(a), second(b), one(false) {}

  const BoxView& first;
  const BoxView& second;
  bool one;
};

/// Whether no box has categories, masks or a group.
[[nodiscard]] inline bool isEmpty(const FilterBits& bits) noexcept {
  return bits.categories.empty() && bits.masks.empty() && bits.groups.empty();
}

/// Whether only the bounds of boxes decide which of them are paired; then no option but the instruction set can be
/// invalid. An order or a strategy that is none is for checkOptions().
[[nodiscard]] inline bool onlyBoundsMatter(const Sets& sets, const OverlapOptions& options) noexcept {
  return options.order <= Order::Unordered && options.strategy <= Strategy::Bvh && options.distance == 0.0 &&
         !options.region && !options.filter.accept && isEmpty(options.filter.first) && isEmpty(options.filter.second) &&
         !sets.first.hasMargins() && !sets.second.hasMargins();
}

/// Throws InvalidArgument, with a message that names the setting, if options are invalid for these sets.
void checkOptions(const Sets& sets, const OverlapOptions& options);

/// The same for the rows of neighbors.
void checkRows(NeighborRows rows);

/// The kernels that the options select; throws InvalidArgument for an unavailable instruction set.
[[nodiscard]] const Kernels& chooseKernels(const OverlapOptions& options);

}  // namespace allpairs::engine
