// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"
#include "allpairs/Worlds.h"

namespace allpairs::engine {

/// Whether the values of a filter are those of one world, for all; throws InvalidArgument if they are neither that, nor
/// one for each box, nor none.
[[nodiscard]] bool isForOneWorld(std::span<const std::uint32_t> values, const Worlds& worlds, const char* name);

/// Which overlapping boxes of a world are pairs: the filter of the options, and the pairs that worlds ignore. What is
/// the same for all worlds is prepared once, as bits that the kernels read.
class WorldsFilter {
 public:
  explicit WorldsFilter(std::pmr::memory_resource* memory) : m_allowed(memory), m_ignored(memory) {}

  /// Checks the options, and prepares the filter of worlds of up to that many boxes. Worlds and options must outlive
  /// its use.
  void prepare(const Worlds& worlds, const OverlapOptions& options, std::size_t mostBoxes);

  /// For each box of a world, by index, the places of the boxes that it may be paired with; null if that differs from
  /// world to world, or nothing is filtered out.
  [[nodiscard]] const std::uint64_t* allowed() const noexcept { return m_allowed.empty() ? nullptr : m_allowed.data(); }

  /// Whether select() may remove pairs that allowed() has left.
  [[nodiscard]] bool selects() const noexcept { return m_selectsBits || m_selectsIgnored || hasAccept(); }

  /// Moves the pairs of a world that it keeps to the front; returns their number.
  [[nodiscard]] std::size_t select(std::size_t world, std::span<Pair> pairs) const;

  /// The filter of the options for one world.
  [[nodiscard]] FilterBits bitsOf(std::size_t world) const noexcept;

  [[nodiscard]] bool hasIgnored() const noexcept { return !m_ignored.empty(); }
  [[nodiscard]] bool isIgnored(Pair pair) const noexcept;

 private:
  [[nodiscard]] bool hasAccept() const noexcept { return static_cast<bool>(m_options->filter.accept); }
  void allowSome(const FilterBits& bits);

  const Worlds* m_worlds = nullptr;
  const OverlapOptions* m_options = nullptr;
  std::pmr::vector<std::uint64_t> m_allowed;
  std::pmr::vector<Pair> m_ignored;  ///< In order, and so are the two boxes of each.
  bool m_selectsBits = false;
  bool m_selectsIgnored = false;
};

}  // namespace allpairs::engine
