// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "Lanes.h"
#include "Memory.h"

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
struct Hierarchy {
  std::array<Level, kMaxLevels> level;
  std::size_t depth = 0;
  const std::uint32_t* ids = nullptr;  ///< The caller's index of each box of level 0.
};

/// Working memory of a join, one per task that runs: at each level the candidates of the node in hand.
struct JoinScratch {
  struct PerLevel {
    std::vector<Buffer<CandidateTile>> tiles;
    std::vector<std::size_t> sizes;  ///< How many candidates are in each tile.
    std::size_t tileCount = 0;
    Buffer<std::uint32_t> partners;

    CandidateTile& nextTile() {
      if (tileCount == tiles.size()) {
        sizes.resize(tiles.size() + 1);
        tiles.emplace_back().require(1);
      }
      return tiles[tileCount++][0];
    }
  };
  std::array<PerLevel, kMaxLevels> level;
};

/// The part of a join that starts from some leaf blocks of `first`.
///
/// Each node of `first` is met, from the top down and from left to right, with the list of the nodes of `second` on its
/// level that touch it; in a join with itself, those from its own place on.
struct JoinTask {
  const Hierarchy* first = nullptr;
  const Hierarchy* second = nullptr;
  bool withItself = false;
  std::size_t leafBegin = 0;
  std::size_t leafEnd = 0;
  JoinScratch* scratch = nullptr;
};

}  // namespace allpairs::engine
