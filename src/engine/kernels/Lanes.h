// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "memory/Memory.h"

namespace allpairs::engine {

/// Contiguous boxes or bounds: the fan-out of the hierarchy, the same for every instruction set
/// (docs/decisions/0003).
inline constexpr std::size_t kFanOut = 16;

/// Calls use(i) for each bit i that is set in a word, or in some.
template <class Use>
void forEachBit(std::uint64_t bits, const Use& use) {
  for (; bits != 0; bits &= bits - 1) use(static_cast<std::size_t>(std::countr_zero(bits)));
}
template <class Use>
void forEachBit(std::span<const std::uint64_t> words, const Use& use) {
  for (std::size_t i = 0; i < words.size(); ++i) forEachBit(words[i], [&](std::size_t bit) { use(64 * i + bit); });
}

/// Kernels load and store whole vectors: so many values after the end of an array may be read, or written and ignored.
inline constexpr std::size_t kVectorSlack = 64;

/// What lies in no order, such as the blocks and the lists of a box's partners and the boxes of pairs in doubt, is
/// prefetched so many ahead (dense_benchmark; allpairs bench uniform -n 1000000).
inline constexpr std::size_t kPrefetchDistance = 8;

/// Rows that kernels test at once: they share the loads of the columns, and a branch.
inline constexpr std::size_t kRowsAtOnce = 4;

/// The largest finite float32. Lanes never exceed it, so that a lane of +infinity below and -infinity above
/// overlaps nothing at all, an infinite box included.
inline constexpr float kLaneMax = std::numeric_limits<float>::max();
/// The minimum, and negated the maximum, of lanes that overlap nothing.
inline constexpr float kNever = std::numeric_limits<float>::infinity();

/// A box in float32, rounded outward or to the nearest (BoxReader): minx miny minz maxx maxy maxz.
struct LaneBox {
  std::array<float, 6> bound;
};

/// What overlaps nothing.
inline constexpr LaneBox kNeverLanes{{kNever, kNever, kNever, -kNever, -kNever, -kNever}};

/// The greatest float32 that is not above the value, kept within the finite ones; the lowest for a NaN. No branches.
[[nodiscard]] inline float roundDown(double value) noexcept {
  const auto most = static_cast<double>(kLaneMax);
  const double above = value > -most ? value : -most;
  const double inside = above < most ? above : most;
  const auto nearest = static_cast<float>(inside);
  // One float32 further down is one less for a positive number's bits and one more for a negative one's. Zero never has
  // to go down: a negative value that is rounded to zero becomes -0.
  const auto bits = std::bit_cast<std::int32_t>(nearest);
  const std::int32_t step = -1 - 2 * (bits >> 31);
  const std::int32_t isAbove = -static_cast<std::int32_t>(static_cast<double>(nearest) > inside);
  return std::bit_cast<float>(bits + (step & isAbove));
}

/// Whether a number is a finite float32.
[[nodiscard]] inline bool isFloat32(double value) noexcept {
  const auto most = static_cast<double>(kLaneMax);
  return -most <= value && value <= most && static_cast<double>(static_cast<float>(value)) == value;
}

/// The least float32 that is not below the value, kept within the finite ones; the greatest for a NaN.
[[nodiscard]] inline float roundUp(double value) noexcept { return -roundDown(-value); }

/// Box i of a row for each bound.
template <class Rows>
[[nodiscard]] LaneBox boxAt(const Rows& rows, std::size_t i) noexcept {
  return {{rows[0][i], rows[1][i], rows[2][i], rows[3][i], rows[4][i], rows[5][i]}};
}

template <class Rows>
void setBoxAt(Rows& rows, std::size_t i, const LaneBox& box) noexcept {
  for (std::size_t row = 0; row < 6; ++row) rows[row][i] = box.bound[row];
}

[[nodiscard]] inline float longestSide(const LaneBox& box) noexcept {
  float longest = 0.0F;
  for (std::size_t axis = 0; axis < 3; ++axis) longest = std::max(longest, box.bound[axis + 3] - box.bound[axis]);
  return longest;
}

/// Sixteen boxes, a row for each bound: what one vector, or a few, can test at once.
struct alignas(64) LaneBlock {
  std::array<std::array<float, kFanOut>, 6> bound;

  void set(std::size_t lane, const LaneBox& box) noexcept { setBoxAt(bound, lane, box); }
  [[nodiscard]] LaneBox get(std::size_t lane) const noexcept { return boxAt(bound, lane); }

  /// Has some lanes, as bits, overlap nothing.
  void clear(std::uint32_t lanes) noexcept {
    forEachBit(lanes, [this](std::size_t lane) { set(lane, kNeverLanes); });
  }

  /// Has all lanes overlap nothing.
  void clear() noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bound[axis].fill(kNever);
      bound[axis + 3].fill(-kNever);
    }
  }
};

/// Up to a fixed number of boxes with their ids, one array per bound, small enough for the first-level cache and for
/// the stack.
///
/// The distance between the arrays is a constant, so that kernels reach them all from one register.
struct alignas(64) LaneTile {
  static constexpr std::size_t kCapacity = 512;

  std::array<std::array<float, kCapacity + kVectorSlack>, 6> bound;
  std::array<std::uint32_t, kCapacity + kVectorSlack> id;

  /// Leaves the id as it is.
  void set(std::size_t i, const LaneBox& box) noexcept { setBoxAt(bound, i, box); }
  [[nodiscard]] LaneBox get(std::size_t i) const noexcept { return boxAt(bound, i); }
};

/// Any number of boxes, in tiles of which only the last may be partly filled.
struct LaneList {
  LaneTile* tiles = nullptr;
  std::size_t size = 0;

  [[nodiscard]] LaneTile& tileOf(std::size_t i) const noexcept { return tiles[i / LaneTile::kCapacity]; }
  [[nodiscard]] LaneBox get(std::size_t i) const noexcept { return tileOf(i).get(i % LaneTile::kCapacity); }
  [[nodiscard]] std::uint32_t id(std::size_t i) const noexcept { return tileOf(i).id[i % LaneTile::kCapacity]; }

  /// The number of tiles for `size` boxes.
  [[nodiscard]] static std::size_t tilesFor(std::size_t size) noexcept {
    return (size + LaneTile::kCapacity - 1) / LaneTile::kCapacity;
  }
};

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

/// Added to, or subtracted from, a result in float32 so that it bounds the result in double: much more than its four
/// roundings can amount to, and than underflow can lose. The exactness of results rests on it too: it is what the lanes
/// that overlap for certain have to spare, at least eight units in the last place, unless they are the nearest float32.
inline constexpr float kQuerySlack = 0x1p-20F;
inline constexpr float kQueryTiny = 1e-36F;

/// How lanes differ from what they were rounded from.
struct LaneSlack {
  /// Whether they are the nearest float32 on all axes: then bounds are in the order of lanes that are not equal.
  bool areNearest = false;

  /// What those of each axis may differ by, beyond their rounding; 0 where they do not differ.
  std::array<float, 3> most{kQueryTiny, kQueryTiny, kQueryTiny};
};

/// A box that moves, or a ray, against sixteen boxes.
struct SweepLanes {
  enum class Axis : std::uint8_t {
    Rests,      ///< The boxes must overlap on this axis.
    Forward,    ///< The query moves to greater values,
    Backward,   ///< or to smaller ones.
    Unbounded,  ///< So fast or slow that float32 cannot decide: every box that is hit on the other axes may be hit.
  };

  std::array<float, 3> min;
  std::array<float, 3> max;
  std::array<float, 3> inverse{};  ///< Of the speed.
  std::array<Axis, 3> axis{};
};

/// Boxes one after the other in memory, as rows of six, or as rows of three in two arrays.
template <class T>
struct BoxRun {
  const T* min = nullptr;
  const T* max = nullptr;
  std::size_t stride = 6;  ///< From a box to the next: 6 or 3.
  std::size_t size = 0;

  /// From box `begin` on, at most as many as requested.
  [[nodiscard]] BoxRun part(std::size_t begin, std::size_t most) const noexcept {
    return {min + begin * stride, max + begin * stride, stride, std::min(most, size - begin)};
  }
};

/// Whether two boxes overlap, given their corners; no comparison is true of an empty box.
template <class T>
[[nodiscard]] bool areHit(const T* min, const T* max, const T* otherMin, const T* otherMax) noexcept {
  const bool x = std::max(min[0], otherMin[0]) <= std::min(max[0], otherMax[0]);
  const bool y = std::max(min[1], otherMin[1]) <= std::min(max[1], otherMax[1]);
  const bool z = std::max(min[2], otherMin[2]) <= std::min(max[2], otherMax[2]);
  return x & y & z;
}

/// The same of boxes of runs.
template <class T>
[[nodiscard]] bool areHit(const BoxRun<T>& a, std::size_t i, const BoxRun<T>& b, std::size_t j) noexcept {
  return areHit(a.min + i * a.stride, a.max + i * a.stride, b.min + j * b.stride, b.max + j * b.stride);
}

/// For each selection of lanes, as bits: where the bytes of the selected lanes are, one lane after the other. What
/// follows them is the first byte.
template <std::size_t kLanes, std::size_t kLaneBytes>
using LaneSelections = std::array<std::array<std::uint8_t, kLanes * kLaneBytes>, std::size_t{1} << kLanes>;

template <std::size_t kLanes, std::size_t kLaneBytes>
[[nodiscard]] constexpr LaneSelections<kLanes, kLaneBytes> laneSelections() {
  LaneSelections<kLanes, kLaneBytes> result{};
  for (std::size_t selection = 0; selection < result.size(); ++selection) {
    std::size_t size = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if ((selection >> lane & 1U) == 0) continue;
      for (std::size_t byte = 0; byte < kLaneBytes; ++byte) {
        result[selection][size++] = static_cast<std::uint8_t>(lane * kLaneBytes + byte);
      }
    }
  }
  return result;
}

/// Of vectors with 4 lanes the bytes, of those with 8 the lanes: what their instructions for a permutation take.
template <std::size_t kLanes, std::size_t kLaneBytes>
alignas(64) inline constexpr auto kLaneSelections = laneSelections<kLanes, kLaneBytes>();

}  // namespace allpairs::engine
