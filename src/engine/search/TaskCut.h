// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "kernels/Lanes.h"

namespace allpairs::engine {

/// The maximum number of tasks per thread: several, since some take longer than others.
inline constexpr std::size_t kTasksPerThread = 16;

/// Divides the rows of an exhaustive search, or the leaf blocks of a join, into tasks of consecutive units, so that
/// their results can be concatenated in order.
class TaskCut {
 public:
  /// All in one task.
  explicit TaskCut(std::size_t units) : m_units(units), m_firstUnits(units) {}

  /// Rows against columns.
  static TaskCut ofRows(std::size_t rows, std::size_t columns, std::size_t threads) {
    constexpr std::size_t kMinTests = std::size_t{1} << 17;  // Some ten microseconds of work.
    TaskCut cut(rows);
    if (threads <= 1) return cut;
    const std::size_t rowsPerTask = 1 + kMinTests / std::max<std::size_t>(1, columns);
    cut.m_firstTasks = std::clamp<std::size_t>(rows / rowsPerTask, 1, kTasksPerThread * threads);
    return cut;
  }

  /// Leaf blocks, of which those from `firstLarge` on hold boxes larger than most: one of them may have as many
  /// partners as all the others. Of the others a task has those of a node, to which it descends once.
  static TaskCut ofLeaves(std::size_t leaves, std::size_t firstLarge, std::size_t threads) {
    TaskCut cut(leaves);
    if (threads <= 1 || leaves == 0) return cut;
    const std::size_t most = kTasksPerThread * threads;
    cut.m_firstUnits = std::min(firstLarge, leaves);
    cut.m_firstTasks = cut.m_firstUnits == 0 ? 0 : std::clamp<std::size_t>(cut.m_firstUnits / kFanOut, 1, most);
    cut.m_lastTasks = std::min(leaves - cut.m_firstUnits, most);
    return cut;
  }

  [[nodiscard]] std::size_t tasks() const noexcept { return m_firstTasks + m_lastTasks; }

  /// The first unit of a task; the next task begins where it ends.
  [[nodiscard]] std::size_t begin(std::size_t task) const noexcept {
    if (task < m_firstTasks) return m_firstUnits * task / m_firstTasks;
    if (m_lastTasks == 0) return m_units;
    return m_firstUnits + (m_units - m_firstUnits) * (task - m_firstTasks) / m_lastTasks;
  }

 private:
  std::size_t m_units;
  std::size_t m_firstUnits;
  std::size_t m_firstTasks = 1;
  std::size_t m_lastTasks = 0;
};

}  // namespace allpairs::engine
