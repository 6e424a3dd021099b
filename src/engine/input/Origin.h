// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "allpairs/BoxView.h"
#include "input/Sampling.h"

namespace allpairs::engine {

/// The point that the lanes of two sets are relative to: near the boxes if they are float64 and so far from the origin
/// that float32 would tell few of them apart, else the origin. Any point gives the same pairs.
///
/// Float64 boxes that are far only because of a few outliers in the sample keep the origin.
[[nodiscard]] inline std::array<double, 3> originFor(const BoxView& first, const BoxView& second) noexcept {
  /// Boxes farther from the origin than this many times the extent of the sample lose more bits than this has.
  constexpr double kFar = 16.0;
  constexpr std::size_t kMostSamples = 32;
  std::array<double, 3> origin{};
  const BoxView& set = first.size() < second.size() ? second : first;
  if (set.empty() || !(first.isFloat64() || second.isFloat64())) return origin;
  const std::size_t samples = std::min(kMostSamples, set.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double least = std::numeric_limits<double>::infinity();
    double greatest = -least;
    for (std::size_t part = 0; part < samples; ++part) {
      const Box box = set[sampleIndex(part, samples, set.size())];
      if (!std::isfinite(box.min[axis]) || !std::isfinite(box.max[axis])) continue;
      least = std::min(least, box.min[axis]);
      greatest = std::max(greatest, box.max[axis]);
    }
    if (least < greatest && std::abs(least) > kFar * (greatest - least)) origin[axis] = least;
  }
  return origin;
}

}  // namespace allpairs::engine
