// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "Kernels.h"
#include "allpairs/Executor.h"
#include "world/KeptHierarchy.h"
#include "world/LevelStack.h"

namespace allpairs::engine {

/// A hierarchy over those boxes of another one that have changed, in the same order.
class ChangedBoxes {
 public:
  void gather(std::span<const BoxId> changed, KeptHierarchy& from, const Kernels& kernels, Executor& executor);

  [[nodiscard]] LevelStack& levels() noexcept { return m_levels; }

 private:
  std::vector<std::uint64_t> m_marked;  ///< A bit for each place of a changed box.
  LevelStack m_levels;
};

}  // namespace allpairs::engine
