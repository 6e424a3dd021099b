// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "allpairs/BoxView.h"
#include "allpairs/OverlapOptions.h"
#include "input/BoxReader.h"
#include "input/Options.h"
#include "input/Sampling.h"

namespace allpairs::engine {

/// The point that the lanes of two sets are relative to: near the boxes if they are float64 and so far from the origin
/// that float32 would tell few of them apart, else the origin. Any point gives the same pairs.
///
/// Float64 boxes that are far only because of a few outliers in the sample keep the origin. On an axis on which they
/// are all the same point, it is that point if float32 does not have it, so that its lanes are exact.
[[nodiscard]] inline std::array<double, 3> originFor(const BoxView& first, const BoxView& second) noexcept {
  /// Boxes farther from the origin than this many times the extent of the sample lose more bits than this has.
  constexpr double kFarAway = 16.0;
  std::array<double, 3> origin{};
  const BoxView& set = first.size() < second.size() ? second : first;
  if (set.empty() || !(first.isFloat64() || second.isFloat64())) return origin;
  const std::size_t samples = std::min<std::size_t>(32, set.size());
  Box bounds = kEmptyBox;
  for (std::size_t part = 0; part < samples; ++part) {
    const Box box = set[sampleIndex(part, samples, set.size())];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(box.min[axis]) || !std::isfinite(box.max[axis])) continue;
      bounds.min[axis] = std::min(bounds.min[axis], box.min[axis]);
      bounds.max[axis] = std::max(bounds.max[axis], box.max[axis]);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double extent = bounds.max[axis] - bounds.min[axis];
    const double point = bounds.min[axis];
    if (extent > 0.0 && std::abs(point) > kFarAway * extent) origin[axis] = point;
    if (extent == 0.0 && !isFloat32(point)) origin[axis] = point;
  }
  return origin;
}

/// The readers of two sets that are compared, or of one set twice: their lanes are relative to the same point.
struct Readers {
  BoxReader first;
  BoxReader second;
  bool one;

  static Readers of(const Sets& sets, const OverlapOptions& options, const Kernels& kernels) {
    Readers readers{{sets.first, options, kernels}, {sets.second, options, kernels}, sets.one};
    readers.first.setOrigin(originFor(sets.first, sets.second));
    readers.second.setOrigin(readers.first.origin());
    if (!readers.first.widens() && !readers.second.widens()) {
      readers.first.roundToNearest();
      readers.second.roundToNearest();
    }
    return readers;
  }

  /// The set of the index that pairs are ordered by, whose boxes are rows, and the other one.
  [[nodiscard]] const BoxReader& rows(Order order) const noexcept { return order == Order::BySecond ? second : first; }
  [[nodiscard]] const BoxReader& columns(Order order) const noexcept {
    return order == Order::BySecond ? first : second;
  }

  /// Reads all boxes for an exhaustive search, into tiles that it has for the columns and, of two sets, for the rows.
  /// Returns whether the lanes are exactly the boxes.
  bool readAll(Order order, FlatSearch& search) const {
    search.columns.size = columns(order).size();
    bool exact = columns(order).readAll(search.columns);
    if (one) {
      search.rows = search.columns;
      search.tested = order == Order::BySecond ? Columns::Preceding : Columns::Following;
    } else {
      search.rows.size = rows(order).size();
      exact &= rows(order).readAll(search.rows);
    }
    search.rowEnd = search.rows.size;
    return exact;
  }
};

}  // namespace allpairs::engine
