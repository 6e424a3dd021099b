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

/// A hierarchy over the changed boxes of another hierarchy, in the same order.
///
/// The changed boxes of one block form one block here, however few: if it were filled with distant boxes, its bounds
/// would overlap as many boxes as all the blocks in between together.
class ChangedBoxes {
 public:
  explicit ChangedBoxes(std::pmr::memory_resource* memory) : m_marked(memory), m_levels(memory) {}

  void gather(std::span<const BoxId> changed, DynamicBvh& from, const Kernels& kernels, Executor& executor);

  [[nodiscard]] BvhLevels& levels() noexcept { return m_levels; }

  /// The number of its boxes.
  [[nodiscard]] std::size_t size() const noexcept { return m_size; }

 private:
  std::pmr::vector<std::uint64_t> m_marked;  ///< A bit for each place of a changed box.
  bool m_marking = false;                    ///< Not all of them have been read.
  BvhLevels m_levels;
  std::size_t m_size = 0;
};

}  // namespace allpairs::engine
