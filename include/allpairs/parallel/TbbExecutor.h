// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "allpairs/Executor.h"

namespace allpairs::parallel {

/// Runs tasks on oneTBB, in arenas of its own.
///
/// Threads: run() may be called from several threads at once, and from inside a task. oneTBB's workers are shared by
///          all calls of the process: a task must not wait for another of its call. A thread that calls it runs tasks
///          of that call alone, and waits for no other call: it may hold a lock.
/// Unload:  from the first executor on, oneTBB stays loaded until the process ends, since its threads end after their
///          work; the library that made the executor may be unloaded.
class TbbExecutor final : public Executor {
 public:
  /// `threads` includes the calling thread; 0 means one per hardware thread. More than that raise oneTBB's process-wide
  /// limit on its workers for the lifetime of the executor. Beyond 256, what oneTBB was first used with in the process
  /// counts: it may start fewer threads, which it says on standard error.
  ///
  /// Bad input: more than 9,999 threads throw InvalidArgument.
  explicit TbbExecutor(std::size_t threads = 0);
  ~TbbExecutor() override;

  [[nodiscard]] std::size_t concurrency() const noexcept override;
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override;

 private:
  class Arenas;
  std::unique_ptr<Arenas> m_arenas;
};

}  // namespace allpairs::parallel
