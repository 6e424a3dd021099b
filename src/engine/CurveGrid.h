// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "KeyedBox.h"
#include "LaneReader.h"

namespace allpairs::engine {

/// The grid that gives a box its place along the curve: cubic cells, since cells stretched to the extent of each axis
/// would make blocks of a flat scene wide and flat too.
///
/// The key is a class, for boxes much larger than most, above the place along Hilbert's curve of the cell of the box's
/// centre. Large boxes so come to lie with their like and do not blow up the bounds of blocks of small ones.
struct CurveGrid {
  static constexpr unsigned kMaxBitsPerAxis = 9;

  unsigned bitsPerAxis = kMaxBitsPerAxis;  ///< A few cells for each box: more would only make keys longer to sort.
  /// The axes in the order in which the curve takes them: the one that the boxes are least spread along first, since the
  /// curve crosses its middle only once; flat scenes lie on one side of it.
  std::array<std::uint32_t, 3> axes{0, 1, 2};

  std::array<float, 3> origin{};
  float scale = 0.0F;        ///< Cells per unit of length.
  float largeExtent = 0.0F;  ///< Boxes longer than this are of a class of their own.

  /// Where the class begins in a key, and how many of a key's low bits can differ.
  [[nodiscard]] unsigned classShift() const noexcept { return 3 * bitsPerAxis; }
  [[nodiscard]] unsigned keyBits() const noexcept { return classShift() + 3; }

  /// Fits a grid to a sample of the boxes.
  [[nodiscard]] static CurveGrid fit(const LaneReader& reader);

  /// Fits a grid to a sample of these boxes.
  [[nodiscard]] static CurveGrid fit(const LaneReader& reader, std::span<const KeyedBox> boxes);

  /// The class of a box that is longer than largeExtent, from 1 on: which axis it is long in, or how large it is.
  [[nodiscard]] std::uint32_t classOf(const LaneBox& box) const noexcept;
};

}  // namespace allpairs::engine
