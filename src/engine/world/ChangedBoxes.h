// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "bvh/BvhLevels.h"
#include "kernels/Kernels.h"
#include "world/WorldForest.h"

namespace allpairs::engine {

/// A hierarchy over the changed boxes of another hierarchy, in the same order.
///
/// The changed boxes of one block form one block here, however few: if it were filled with distant boxes, its bounds
/// would overlap as many boxes as all the blocks in between together.
class ChangedBoxes {
 public:
  ChangedBoxes(std::pmr::memory_resource* memory, const Kernels& kernels)
      : m_kernels(&kernels), m_marked(memory), m_levels(memory) {}

  /// Those of the boxes that are in the hierarchy, one of the forest's.
  void gather(std::span<const BoxId> changed, const WorldForest& forest, const DynamicBvh& from, Executor& executor);

  [[nodiscard]] const BvhView& view() const noexcept { return m_levels.view(); }

  /// The number of its boxes.
  [[nodiscard]] std::size_t size() const noexcept { return m_size; }

 private:
  void append(const BvhView& source, std::size_t place);

  const Kernels* m_kernels;
  std::pmr::vector<std::uint64_t> m_marked;  ///< A bit for each place of a changed box.
  BvhLevels m_levels;
  std::size_t m_size = 0;
  std::size_t m_next = 0;         ///< Where the next box goes.
  std::size_t m_sourceBlock = 0;  ///< The block that the last one came from.
};

}  // namespace allpairs::engine
