// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "allpairs/Executor.h"
#include "allpairs/StopFlag.h"

namespace allpairs::engine {

/// Runs tasks on another executor until a flag is set: from then on they throw Stopped.
class StoppableExecutor final : public Executor {
 public:
  /// Returns the executor to use: this one, or the given one if there is no flag. Null gives a serial one.
  [[nodiscard]] Executor& over(Executor* given, const StopFlag* stop) noexcept {
    m_other = given != nullptr ? given : &m_serial;
    m_stop = stop;
    return stop == nullptr ? *m_other : *this;
  }

  [[nodiscard]] std::size_t concurrency() const noexcept override { return m_other->concurrency(); }

  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    m_other->run(count, [&](std::size_t i) {
      checkStop(m_stop);
      task(i);
    });
  }

 private:
  SerialExecutor m_serial;
  Executor* m_other = nullptr;
  const StopFlag* m_stop = nullptr;
};

}  // namespace allpairs::engine
