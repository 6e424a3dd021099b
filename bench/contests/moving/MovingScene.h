// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "allpairs/WorldTypes.h"

namespace allpairs::bench {

/// How the boxes of a scene move.
struct Motion {
  std::string name;
  double movingShare = 1.0;  ///< Of the boxes; the others rest.
  bool straight = true;      ///< In a straight line until they hit a wall; otherwise a new direction in each frame.
  double length = 0.1;       ///< Of a frame's way, in sides of a box.
};

/// Straight ways, random ones, and scenes of which little moves.
[[nodiscard]] std::span<const Motion> motions();

/// Cubes of side 1 that fill a tenth of a room and move in it: the density of Broadmark's scenes.
///
/// Reference: Y. Serpa, M. Rodrigues, "Broadmark: a testing framework for broad-phase collision detection algorithms",
///            Computer Graphics Forum 39, 2020.
class MovingScene {
 public:
  MovingScene(const Motion& motion, std::size_t boxes, std::uint64_t seed);

  /// The next frame.
  void advance();

  /// The boxes as rows of 6.
  [[nodiscard]] std::span<const float> rows() const noexcept { return m_rows; }

  /// Those that move, and their rows.
  [[nodiscard]] std::span<const BoxId> movingIds() const noexcept { return m_ids; }
  [[nodiscard]] std::span<const float> movingRows() const noexcept { return m_movingRows; }

 private:
  [[nodiscard]] double uniform() { return static_cast<double>(m_random() >> 11U) * 0x1p-53; }
  [[nodiscard]] std::array<double, 3> direction();
  void write();

  Motion m_motion;
  double m_side;
  std::mt19937_64 m_random;
  std::vector<std::array<double, 3>> m_centres;
  std::vector<std::array<double, 3>> m_velocities;
  std::vector<float> m_rows;
  std::vector<BoxId> m_ids;
  std::vector<float> m_movingRows;
};

}  // namespace allpairs::bench
