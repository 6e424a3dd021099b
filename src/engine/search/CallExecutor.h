// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "allpairs/Executor.h"
#include "allpairs/StopFlag.h"

namespace allpairs::engine {

/// Runs the tasks of one call on another executor. That is asked once how many run concurrently, since memory is laid
/// out by the answer, and a pool may be resized meanwhile. Once a flag is set, tasks throw Stopped.
class CallExecutor final : public Executor {
 public:
  /// Begins a call; null is a serial executor.
  [[nodiscard]] Executor& over(Executor* given, const StopFlag* stop) noexcept {
    m_other = given != nullptr ? given : &m_serial;
    m_concurrency = std::max<std::size_t>(m_other->concurrency(), 1);
    m_stop = stop;
    return *this;
  }

  [[nodiscard]] std::size_t concurrency() const noexcept override { return m_concurrency; }

  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    if (m_stop == nullptr) return m_other->run(count, task);
    m_other->run(count, [&](std::size_t i) {
      checkStop(m_stop);
      task(i);
    });
  }

 private:
  SerialExecutor m_serial;
  Executor* m_other = nullptr;
  std::size_t m_concurrency = 1;
  const StopFlag* m_stop = nullptr;
};

}  // namespace allpairs::engine
