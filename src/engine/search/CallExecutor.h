// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "allpairs/Executor.h"
#include "allpairs/StopFlag.h"
#include "search/WorkingThreads.h"

namespace allpairs::engine {

/// Runs the tasks of one call on another executor. That is asked once how many run concurrently, since memory is laid
/// out by the answer, and a pool may be resized meanwhile. Once a flag is set, tasks throw Stopped.
class CallExecutor final : public Executor {
 public:
  /// Begins a call; null is a serial executor. The threads that run its tasks are counted among those that work, if
  /// these are given.
  [[nodiscard]] Executor& over(Executor* given, const StopFlag* stop, WorkingThreads* working = nullptr) noexcept {
    m_other = given != nullptr ? given : &m_serial;
    m_concurrency = std::max<std::size_t>(m_other->concurrency(), 1);
    m_stop = stop;
    m_working = working;
    return *this;
  }

  [[nodiscard]] std::size_t concurrency() const noexcept override { return m_concurrency; }

  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    if (m_stop == nullptr && m_working == nullptr) return m_other->run(count, task);
    m_other->run(count, [&](std::size_t i) {
      std::optional<WorkingThreads::Mark> mark;
      if (m_working != nullptr) mark.emplace(*m_working);
      checkStop(m_stop);
      task(i);
    });
  }

 private:
  SerialExecutor m_serial;
  Executor* m_other = nullptr;
  std::size_t m_concurrency = 1;
  const StopFlag* m_stop = nullptr;
  WorkingThreads* m_working = nullptr;
};

}  // namespace allpairs::engine
