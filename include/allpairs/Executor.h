// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "allpairs/FunctionRef.h"

namespace allpairs {

/// Runs the parallel work of Allpairs: the interface between the engine and a thread pool or job system.
///
/// Results never depend on the executor: work is divided by data, and output is written by block, not by thread.
class Executor {
 public:
  Executor() = default;
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  Executor(Executor&&) = delete;
  Executor& operator=(Executor&&) = delete;
  virtual ~Executor() = default;

  /// The number of tasks that may run concurrently; 0 counts as 1. It determines how work is divided and how much memory
  /// each call takes for that, never the result. It is asked at the beginning of a call, and may change at any time.
  [[nodiscard]] virtual std::size_t concurrency() const noexcept = 0;

  /// Calls task(0) … task(count - 1), each once, in any order and on any thread, and returns when all are done. A thread
  /// that waits for its tasks here runs no tasks of other calls meanwhile: it may hold a lock that they wait for.
  ///
  /// Bad input: if tasks throw, one of their exceptions is rethrown here, once no task is running.
  virtual void run(std::size_t count, FunctionRef<void(std::size_t)> task) = 0;
};

/// Runs every task on the calling thread, in order. The default.
class SerialExecutor final : public Executor {
 public:
  [[nodiscard]] std::size_t concurrency() const noexcept override { return 1; }

  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    for (std::size_t i = 0; i < count; ++i) task(i);
  }
};

}  // namespace allpairs
