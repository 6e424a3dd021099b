// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernels/Lanes.h"

namespace allpairs::engine {

/// 16^8 = 2^32: no set needs more levels.
inline constexpr std::size_t kMaxLevels = 8;

/// One level of a hierarchy: `size` boxes or bounds in blocks of 16, the last one padded with lanes that never overlap.
struct Level {
  const LaneBlock* blocks = nullptr;
  std::size_t size = 0;

  [[nodiscard]] std::size_t blockCount() const noexcept { return (size + kFanOut - 1) / kFanOut; }
  [[nodiscard]] std::size_t fill(std::size_t block) const noexcept {
    return block + 1 < blockCount() ? kFanOut : size - block * kFanOut;
  }
};

/// A hierarchy of bounds over boxes in the order of a curve. Level 0 holds the boxes; entry i of level k + 1 bounds
/// block i of level k; the last level is one block.
struct BvhView {
  std::array<Level, kMaxLevels> level;
  std::size_t depth = 0;
  const std::uint32_t* ids = nullptr;  ///< The caller's index of each box of level 0.
};

}  // namespace allpairs::engine
