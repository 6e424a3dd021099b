// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "BlockReader.h"
#include "CurveOrder.h"
#include "Join.h"
#include "Kernels.h"
#include "LaneReader.h"
#include "Memory.h"
#include "allpairs/Executor.h"
#include "allpairs/Pair.h"

namespace allpairs::engine {

/// Builds the hierarchy over a set of boxes, and keeps its memory: at most 40 bytes a box.
///
/// Threads: parallel over the executor; the hierarchy does not depend on it.
class HierarchyBuilder {
 public:
  /// Orders, gathers and bounds the boxes; `hierarchy()` is the result until the next call.
  void build(const LaneReader& reader, const Kernels& kernels, Executor& executor);

  [[nodiscard]] const Hierarchy& hierarchy() const noexcept { return m_hierarchy; }

  /// Boxes from this place on are larger than most.
  [[nodiscard]] std::size_t firstLarge() const noexcept { return m_firstLarge; }

  /// Whether the lanes of all boxes are exactly the boxes.
  [[nodiscard]] bool exact() const noexcept { return m_exact; }

  /// The memory of the blocks, for another use; the hierarchy is no more.
  [[nodiscard]] std::span<Pair> takeMemory() noexcept;

  /// Adds levels of one node until there are `depth` of them, so that two hierarchies can be descended side by side.
  void deepen(std::size_t depth);

 private:
  void gather(const LaneReader& reader, const Kernels& kernels, std::span<const KeyedBox> order, Executor& executor);
  void gatherBlocks(const BlockReader& reader, std::span<const KeyedBox> order, std::size_t begin, std::size_t end);
  void gatherBoxes(const LaneReader& reader, std::span<const KeyedBox> order, std::size_t begin, std::size_t end);
  void bound(const Kernels& kernels, Executor& executor);

  CurveOrder m_order;
  Buffer<LaneBlock> m_blocks;
  Buffer<std::uint32_t> m_ids;
  Hierarchy m_hierarchy;
  std::size_t m_usedBlocks = 0;
  std::size_t m_firstLarge = 0;
  bool m_exact = true;
};

}  // namespace allpairs::engine
