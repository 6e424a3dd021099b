// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "Join.h"
#include "Kernels.h"
#include "Memory.h"
#include "allpairs/Executor.h"

namespace allpairs::engine {

/// The memory of a hierarchy whose boxes change in place: blocks of boxes and, level upon level, their bounds.
class LevelStack {
 public:
  /// Makes room for so many places and empties all of them: their lanes overlap nothing, their ids are 0.
  void reset(std::size_t capacity);

  /// Has the first `places` count, of which none beyond the last ones were used; not more than the capacity.
  void resize(std::size_t places);

  [[nodiscard]] std::size_t places() const noexcept { return m_places; }
  [[nodiscard]] std::size_t capacity() const noexcept { return m_capacity; }
  [[nodiscard]] std::size_t blockCount() const noexcept { return (m_places + kFanOut - 1) / kFanOut; }
  [[nodiscard]] std::size_t depth() const noexcept { return m_depth; }

  [[nodiscard]] LaneBlock& block(std::size_t b) const noexcept { return m_levels[0][b]; }
  [[nodiscard]] std::uint32_t& id(std::size_t place) const noexcept { return m_ids[place]; }

  /// Bounds all blocks anew.
  void boundAll(const Kernels& kernels, Executor& executor);

  /// Bounds some blocks anew, by ascending number, and what is above them. The list is lost.
  void boundSome(std::span<std::uint32_t> blocks, const Kernels& kernels);

  /// The hierarchy, with levels of one node added on top of it until there are `depth`; null depth where it is empty.
  [[nodiscard]] Hierarchy hierarchy(std::size_t depth);
  [[nodiscard]] Hierarchy hierarchy() { return hierarchy(m_depth); }

 private:
  [[nodiscard]] std::size_t sizeOf(std::size_t level) const noexcept;
  [[nodiscard]] LaneBox boundsOf(const LaneBlock& block) const noexcept;

  std::array<Buffer<LaneBlock>, kMaxLevels> m_levels;
  std::array<std::size_t, kMaxLevels> m_clean{};  ///< By level: blocks from here on hold lanes that overlap nothing.
  Buffer<std::uint32_t> m_ids;
  std::size_t m_places = 0;
  std::size_t m_capacity = 0;
  std::size_t m_depth = 0;
  std::array<LaneBlock, kMaxLevels> m_tops;
};

}  // namespace allpairs::engine
