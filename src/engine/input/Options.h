// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

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

/// Whether a box with this margin reaches into the region that the options have, if any; no empty box reaches into one.
[[nodiscard]] inline bool reachesRegion(const Box& box, double margin, const OverlapOptions& options) noexcept {
  return !options.region || overlap(box, *options.region, options.distance + margin);
}

/// Throws InvalidArgument, with a message that names the setting, if options are invalid for these sets.
void checkOptions(const Sets& sets, const OverlapOptions& options);

// The same for some of them:
void checkSettings(const OverlapOptions& options);  ///< Those that any sets may have: all but the filter.
void checkDistance(double distance);
void checkOrder(Order order);
void checkOneSet(const Filter& filter);  ///< A filter for one set has no values for a second.

/// The same for the rows of neighbors.
void checkRows(NeighborRows rows);

/// The kernels for an instruction set, or the best for an empty name; throws InvalidArgument if it is not available.
[[nodiscard]] const Kernels& chooseKernels(std::string_view instructionSet);

}  // namespace allpairs::engine
