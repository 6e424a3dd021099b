// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "Memory.h"

namespace allpairs::engine {

/// Boxes, or bounds, that lie together: the fan-out of the hierarchy, the same for every instruction set.
inline constexpr std::size_t kFanOut = 16;

/// The largest finite float32. Lanes never reach beyond it, so that a lane of +infinity below and -infinity above
/// overlaps nothing at all, an infinite box included.
inline constexpr float kLaneMax = std::numeric_limits<float>::max();
inline constexpr float kNever = std::numeric_limits<float>::infinity();

/// A box in float32, rounded outward: minx miny minz maxx maxy maxz.
struct LaneBox {
  std::array<float, 6> bound;
};

[[nodiscard]] inline bool touch(const LaneBox& a, const LaneBox& b) noexcept {
  bool result = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result = result && a.bound[axis] <= b.bound[axis + 3] && b.bound[axis] <= a.bound[axis + 3];
  }
  return result;
}

inline constexpr LaneBox kNeverLanes{{kNever, kNever, kNever, -kNever, -kNever, -kNever}};
inline constexpr LaneBox kEverythingLanes{{-kLaneMax, -kLaneMax, -kLaneMax, kLaneMax, kLaneMax, kLaneMax}};

/// Sixteen boxes, a row for each bound: what one vector, or a few, can test at once.
struct alignas(64) LaneBlock {
  std::array<std::array<float, kFanOut>, 6> bound;

  void set(std::size_t lane, const LaneBox& box) noexcept {
    for (std::size_t row = 0; row < 6; ++row) bound[row][lane] = box.bound[row];
  }
  [[nodiscard]] LaneBox get(std::size_t lane) const noexcept {
    LaneBox box;
    for (std::size_t row = 0; row < 6; ++row) box.bound[row] = bound[row][lane];
    return box;
  }
};

/// Up to so many boxes with their ids, an array for each bound: what stays in the first-level cache while it is tested.
///
/// The distance between the arrays is a constant, so that kernels reach them all from one register.
/// There is room behind the end for whole vectors: up to kPadding values are loaded, and masked off, or stored there.
template <std::size_t kBoxes>
struct alignas(64) LaneTileOf {
  static constexpr std::size_t kCapacity = kBoxes;
  static constexpr std::size_t kPadding = 64;

  std::array<std::array<float, kCapacity + kPadding>, 6> bound;
  std::array<std::uint32_t, kCapacity + kPadding> id;

  void set(std::size_t i, const LaneBox& box, std::uint32_t boxId) noexcept {
    for (std::size_t row = 0; row < 6; ++row) bound[row][i] = box.bound[row];
    id[i] = boxId;
  }
  [[nodiscard]] LaneBox get(std::size_t i) const noexcept {
    LaneBox box;
    for (std::size_t row = 0; row < 6; ++row) box.bound[row] = bound[row][i];
    return box;
  }
};

/// A tile of an exhaustive search, and a smaller one for the candidates of a join, which are seldom many.
using LaneTile = LaneTileOf<1024>;
using CandidateTile = LaneTileOf<512>;

/// Any number of boxes, in tiles of which only the last may be partly filled.
struct LaneList {
  LaneTile* tiles = nullptr;
  std::size_t size = 0;

  [[nodiscard]] LaneTile& tileOf(std::size_t i) const noexcept { return tiles[i / LaneTile::kCapacity]; }
  [[nodiscard]] LaneBox get(std::size_t i) const noexcept { return tileOf(i).get(i % LaneTile::kCapacity); }
  [[nodiscard]] std::uint32_t id(std::size_t i) const noexcept { return tileOf(i).id[i % LaneTile::kCapacity]; }

  /// How many tiles `size` boxes take.
  [[nodiscard]] static std::size_t tilesFor(std::size_t size) noexcept {
    return (size + LaneTile::kCapacity - 1) / LaneTile::kCapacity;
  }
};

}  // namespace allpairs::engine
