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

/// Any number of boxes with their ids, an array for each bound, padded behind the end for whole vectors.
///
/// Vectors are loaded up to kPadding values past the end and stored up to as many; `pad()` makes those harmless.
struct LaneList {
  static constexpr std::size_t kPadding = 64;

  std::array<float*, 6> bound{};
  std::uint32_t* id = nullptr;
  std::size_t size = 0;

  void set(std::size_t i, const LaneBox& box, std::uint32_t boxId) const noexcept {
    for (std::size_t row = 0; row < 6; ++row) bound[row][i] = box.bound[row];
    id[i] = boxId;
  }
  [[nodiscard]] LaneBox get(std::size_t i) const noexcept {
    LaneBox box;
    for (std::size_t row = 0; row < 6; ++row) box.bound[row] = bound[row][i];
    return box;
  }
  void pad() const noexcept {
    for (std::size_t i = size; i < size + kPadding; ++i) set(i, kNeverLanes, 0);
  }
};

/// The memory of a LaneList.
class LaneListBuffer {
 public:
  /// An empty list with room for `capacity` boxes and the padding.
  LaneList require(std::size_t capacity) {
    const std::size_t stride = (capacity + LaneList::kPadding + 15) / 16 * 16;
    m_bounds.require(6 * stride);
    m_ids.require(stride);
    LaneList list;
    for (std::size_t row = 0; row < 6; ++row) list.bound[row] = m_bounds.data() + row * stride;
    list.id = m_ids.data();
    return list;
  }

 private:
  Buffer<float> m_bounds;
  Buffer<std::uint32_t> m_ids;
};

}  // namespace allpairs::engine
