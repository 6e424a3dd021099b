// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "bvh/BvhLevels.h"
#include "kernels/Kernels.h"
#include "world/DynamicBvh.h"

namespace allpairs::engine {

/// A hierarchy over those boxes of another one that have changed, in the same order.
///
/// Those of one block there are one block here, however few: filled up with others from afar, its bounds would touch as
/// many boxes as all the blocks in between together.
class ChangedBoxes {
 public:
  explicit ChangedBoxes(std::pmr::memory_resource* memory) : m_marked(memory), m_levels(memory) {}

  void gather(std::span<const BoxId> changed, DynamicBvh& from, const Kernels& kernels, Executor& executor);

  [[nodiscard]] BvhLevels& levels() noexcept { return m_levels; }

  /// How many boxes it holds.
  [[nodiscard]] std::size_t size() const noexcept { return m_size; }

 private:
  std::pmr::vector<std::uint64_t> m_marked;  ///< A bit for each place of a changed box.
  bool m_marking = false;                    ///< Not all of them have been read.
  BvhLevels m_levels;
  std::size_t m_size = 0;
};

}  // namespace allpairs::engine
