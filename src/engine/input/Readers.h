// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "allpairs/BoxView.h"
#include "allpairs/OverlapOptions.h"
#include "input/BoxReader.h"
#include "input/Options.h"
#include "input/Sampling.h"

namespace allpairs::engine {

/// Of a sample of boxes, or of the minima of such.
template <class T>
using OriginSample = std::array<T, 32>;

/// Where most of some boxes are on an axis, if they are so far from zero that float32 would tell few of them apart, or
/// all at one number that float32 does not have; else zero. The others make no difference.
[[nodiscard]] inline double originOf(std::span<const Box> boxes, std::size_t axis) noexcept {
  /// Boxes farther from zero than this many times their extent lose more bits than this has.
  constexpr double kFarAway = 16.0;
  if (boxes.empty()) return 0.0;
  OriginSample<double> minima{};
  const auto end =
      std::transform(boxes.begin(), boxes.end(), minima.begin(), [&](const Box& b) { return b.min[axis]; });
  const auto middle = minima.begin() + (end - minima.begin()) / 2;
  std::nth_element(minima.begin(), middle, end);
  const double point = *middle;
  if (!std::isfinite(point)) return 0.0;
  double farthest = 0.0;
  std::size_t count = 0;
  for (const Box& box : boxes) {
    const double away = std::max(std::abs(box.min[axis] - point), std::abs(box.max[axis] - point));
    if (!(away * 2.0 * kFarAway < std::abs(point))) continue;
    farthest = std::max(farthest, away);
    ++count;
  }
  return 2 * count > boxes.size() && (farthest > 0.0 || !isFloat32(point)) ? point : 0.0;
}

/// The point that the lanes of two sets are relative to: near most boxes of the larger set, by a sample, if they are
/// float64 and far from the origin; else the origin. Any point gives the same pairs.
[[nodiscard]] inline std::array<double, 3> originFor(const BoxView& first, const BoxView& second) noexcept {
  const BoxView& set = first.size() < second.size() ? second : first;
  if (!(first.isFloat64() || second.isFloat64())) return {};
  OriginSample<Box> sample;
  std::size_t size = 0;
  const std::size_t parts = std::min(sample.size(), set.size());
  for (std::size_t part = 0; part < parts; ++part) {
    const Box box = set[sampleIndex(part, parts, set.size())];
    if (!isEmpty(box) && !hasNan(box)) sample[size++] = box;
  }
  const std::span<const Box> boxes(sample.data(), size);
  return {originOf(boxes, 0), originOf(boxes, 1), originOf(boxes, 2)};
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
