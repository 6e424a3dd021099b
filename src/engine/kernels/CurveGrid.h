// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kernels/Lanes.h"

namespace allpairs::engine {

/// The grid that determines a box's position along the curve: cubic cells, since cells stretched to the extent of each
/// axis would make blocks of a flat scene wide and flat too.
///
/// The key is a class, for boxes much larger than most, above the position along Hilbert's curve of the cell of the
/// box's centre. Large boxes are thus grouped together and do not enlarge the bounds of blocks of small ones.
///
/// Of boxes along a straight line the position on the widest axis is the key: as fine as cells of three axes, with
/// fewer bits.
struct CurveGrid {
  /// Keys then have 30 bits with the class, which three passes sort.
  static constexpr unsigned kMaxBitsPerAxis = 9;

  bool isLine = false;
  unsigned bitsPerAxis = kMaxBitsPerAxis;  ///< A few cells per box: more would only make the sort of the keys longer.
  /// The axes in the curve's order: the one with the smallest extent first, since the curve crosses its middle only
  /// once; flat scenes lie on one side of it.
  std::array<std::uint32_t, 3> axes{0, 1, 2};

  std::array<float, 3> origin{};
  float scale = 0.0F;        ///< Cells per unit of length.
  float largeExtent = 0.0F;  ///< Boxes longer than this belong to a class of their own.

  /// Where the class begins in a key, and how many of a key's low bits can differ.
  [[nodiscard]] unsigned classShift() const noexcept { return isLine ? bitsPerAxis : 3 * bitsPerAxis; }

  /// The class of a box that is longer than largeExtent, from 1 on: which axis it is long in, or how large it is.
  [[nodiscard]] std::uint32_t classOf(const LaneBox& box) const noexcept {
    const std::array<float, 3> extent{box.bound[3] - box.bound[0], box.bound[4] - box.bound[1],
                                      box.bound[5] - box.bound[2]};
    std::array<float, 3> sorted = extent;
    std::sort(sorted.begin(), sorted.end());
    // Long: the longest side is three times the next one.
    if (sorted[2] > 3.0F * sorted[1]) {
      return 1U + static_cast<std::uint32_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
    }
    if (sorted[2] <= 8.0F * largeExtent) return 4U;
    return sorted[2] <= 64.0F * largeExtent ? 5U : 6U;
  }
};

}  // namespace allpairs::engine
