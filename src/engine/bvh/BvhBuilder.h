// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "allpairs/Executor.h"
#include "bvh/BvhLevels.h"
#include "bvh/HilbertSort.h"
#include "input/BoxReader.h"
#include "kernels/Lanes.h"

namespace allpairs::engine {

/// Builds the hierarchy over a set of boxes, and keeps its memory: at most 40 bytes per box.
///
/// Threads: parallel over the executor; the hierarchy does not depend on it.
class BvhBuilder {
 public:
  explicit BvhBuilder(std::pmr::memory_resource* memory) : m_order(memory), m_levels(memory) {}

  /// Orders, gathers and bounds the boxes; the hierarchy is valid until the next call.
  void build(const BoxReader& reader, Executor& executor);

  [[nodiscard]] BvhLevels& levels() noexcept { return m_levels; }

  /// Boxes from this position on are larger than most.
  [[nodiscard]] std::size_t firstLarge() const noexcept { return m_order.firstLarge(); }

  /// Whether the lanes of all boxes are exactly the boxes.
  [[nodiscard]] bool exact() const noexcept { return m_order.exact(); }

 private:
  void gather(const BoxReader& reader, std::span<const CurveKey> order, Executor& executor);

  HilbertSort m_order;
  BvhLevels m_levels;
};

}  // namespace allpairs::engine
