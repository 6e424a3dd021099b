// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "LaneReader.h"

namespace allpairs::engine {

/// The grid that gives a box its place along the curve: cubic cells, since cells stretched to the extent of each axis
/// would make blocks of a flat scene wide and flat too.
///
/// The key is a class, for boxes much larger than most, above the Morton code of the cell of the box's centre. Large
/// boxes so come to lie with their like and do not blow up the bounds of blocks of small ones.
/// Reference: G. M. Morton, "A computer oriented geodetic data base", IBM, 1966.
class CurveGrid {
 public:
  static constexpr unsigned kMaxBitsPerAxis = 9;
  static constexpr unsigned kClassBits = 3;

  /// Fits a grid to a sample of the boxes.
  explicit CurveGrid(const LaneReader& reader);

  /// How many low bits of a key are used.
  [[nodiscard]] unsigned bits() const noexcept { return 3 * m_bits + kClassBits; }

  [[nodiscard]] std::uint32_t key(const LaneBox& box) const noexcept;

 private:
  struct Sample;

  void fitAxis(std::size_t axis, Sample& sample);
  [[nodiscard]] std::uint32_t cell(const LaneBox& box, std::size_t axis) const noexcept;
  [[nodiscard]] std::uint32_t sizeClass(const std::array<float, 3>& extent, float longest) const noexcept;

  std::array<float, 3> m_origin{};
  float m_scale = 0.0F;
  float m_width = 0.0F;
  float m_lastCell = 0.0F;
  float m_largeExtent = 0.0F;
  unsigned m_bits = 2;
};

}  // namespace allpairs::engine
