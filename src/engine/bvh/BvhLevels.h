// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "kernels/Kernels.h"
#include "kernels/Lanes.h"
#include "memory/Memory.h"

namespace allpairs::engine {

/// How many boxes ahead of those that are gathered into blocks others are prefetched (allpairs bench uniform -n
/// 1000000).
inline constexpr std::size_t kPrefetchBoxes = 32;

/// The blocks that so many boxes, or blocks of the level below, fill.
[[nodiscard]] inline std::size_t blockCountFor(std::size_t size) noexcept { return (size + kFanOut - 1) / kFanOut; }

/// The memory of a hierarchy: blocks of boxes and, level by level, their bounds. Boxes may be added and changed in
/// place.
class BvhLevels {
 public:
  explicit BvhLevels(std::pmr::memory_resource* memory) : m_blocks(memory), m_ids(memory) {}

  /// Allocates a number of places and empties them: their lanes overlap nothing, their ids are 0.
  void reset(std::size_t capacity);

  /// Has the first `places` count, of which none beyond the last ones were used; not more than the capacity.
  void resize(std::size_t places);

  /// Has the first `places` count, which are about to be written, all of them; empties only what is behind the last
  /// one.
  void resizeUnwritten(std::size_t places);

  [[nodiscard]] std::size_t places() const noexcept { return m_places; }
  [[nodiscard]] std::size_t capacity() const noexcept { return m_capacity; }
  [[nodiscard]] std::size_t blockCount() const noexcept { return blockCountFor(m_places); }

  [[nodiscard]] LaneBlock& block(std::size_t b) const noexcept { return m_blocks[b]; }
  /// The memory of the blocks, before they are written or when the hierarchy is no longer needed.
  template <class T>
  [[nodiscard]] std::span<T> memory() const noexcept {
    return {reinterpret_cast<T*>(m_blocks.data()), m_blocks.capacity() * sizeof(LaneBlock) / sizeof(T)};
  }
  [[nodiscard]] std::uint32_t& id(std::size_t place) const noexcept { return m_ids[place]; }

  /// Updates the bounds of all blocks.
  void boundAll(const Kernels& kernels, Executor& executor);

  /// Updates the bounds of some blocks, given by ascending number, and of their ancestors. Overwrites the list.
  void boundSome(std::span<std::uint32_t> blocks, const Kernels& kernels, Executor& executor);

  /// The hierarchy; of depth 0 if it is empty.
  [[nodiscard]] const BvhView& view() const noexcept { return m_view; }

 private:
  template <class Clean>
  void setPlaces(std::size_t places, const Clean& clean);

  Buffer<LaneBlock> m_blocks;                     ///< Those of boxes, and then level by level.
  std::array<LaneBlock*, kMaxLevels> m_levels{};  ///< Where those of each level begin.
  std::array<std::size_t, kMaxLevels> m_clean{};  ///< By level: blocks from here on hold lanes that overlap nothing.
  Buffer<std::uint32_t> m_ids;
  std::size_t m_places = 0;
  std::size_t m_capacity = 0;
  BvhView m_view;
  std::size_t m_boundedDepth = 0;  ///< The depth when all blocks were last bounded.
};

}  // namespace allpairs::engine
