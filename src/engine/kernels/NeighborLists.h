// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>

#include "kernels/Hits.h"
#include "kernels/Lanes.h"
#include "memory/Memory.h"

namespace allpairs::engine {

/// Where a join puts the partners of each box of `first`, its neighbors, in ascending order: one list after the other, in
/// the order of the hierarchy.
struct NeighborLists {
  /// Which lists select() has to see.
  enum class Tested : std::uint8_t {
    None,
    InDoubt,  ///< Those with a hit that lanes cannot decide, because they were rounded.
    All,
  };

  Columns kept = Columns::All;  ///< Which partners, by their ids.
  Tested tested = Tested::None;
  unsigned idBits = 0;  ///< Ids of partners have no more.

  std::uint32_t* partners = nullptr;
  std::size_t size = 0;
  std::size_t capacity = 0;

  std::uint64_t* begin = nullptr;   ///< By id: where its list begins, plus `base`.
  std::uint32_t* length = nullptr;  ///< By id.
  std::uint64_t base = 0;

  void* receiver = nullptr;

  /// Moves the partners that are kept to the front; returns their number.
  std::size_t (*select)(NeighborLists& lists, std::uint32_t row, std::uint32_t* partners, std::size_t size) = nullptr;

  /// Provides a capacity of `more` beyond the size.
  void (*grow)(NeighborLists& lists, std::size_t more) = nullptr;

  /// Sorts numbers by their bits [begin, end), with as much memory again; returns where they are.
  std::uint64_t* (*sort)(std::uint64_t* from, std::uint64_t* to, std::size_t size, unsigned begin,
                         unsigned end) = nullptr;

  std::uint64_t exactTests = 0;

  void require(std::size_t more) {
    if (size + more > capacity) grow(*this, more);
  }
};

/// Working memory of a join that lists neighbors: the boxes near a node, with their ids, in an array for each bound.
class NeighborScratch {
 public:
  explicit NeighborScratch(std::pmr::memory_resource* memory)
      : keys(memory), id(memory), near(memory), hitBits(memory), hitIds(memory), m_bounds(memory) {}

  /// Room for so many boxes and for whole vectors after them; the contents are lost.
  void require(std::size_t boxes) {
    if (boxes + kVectorSlack > m_stride) {
      // Not a multiple of many boxes, which would bring the arrays to the same offset in their pages.
      const std::size_t stride = 2 * boxes / kFanOut * kFanOut + kVectorSlack + 2 * kFanOut;
      m_stride = 0;
      m_bounds.require(6 * stride);
      for (Buffer<std::uint32_t>* ids : {&id, &near, &hitBits, &hitIds}) ids->require(stride);
      m_stride = stride;
    }
    for (std::size_t row = 0; row < 6; ++row) bound[row] = m_bounds.data() + row * m_stride;
    size = boxes;
  }

  [[nodiscard]] LaneBox get(std::size_t i) const noexcept {
    LaneBox box;
    for (std::size_t row = 0; row < 6; ++row) box.bound[row] = bound[row][i];
    return box;
  }

  Buffer<std::uint64_t> keys;  ///< An id above a position, twice.

  std::array<float*, 6> bound{};
  Buffer<std::uint32_t> id;
  std::size_t size = 0;

  Buffer<std::uint32_t> near;     ///< The boxes that are near a leaf too.
  Buffer<std::uint32_t> hitBits;  ///< By box with a hit: a bit for each box of the leaf that it overlaps.
  Buffer<std::uint32_t> hitIds;

 private:
  Buffer<float> m_bounds;
  std::size_t m_stride = 0;
};

}  // namespace allpairs::engine
