// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "allpairs/Executor.h"

namespace allpairs::parallel {

/// Runs tasks on oneTBB, in its own arena.
///
/// Threads: run() may be called from several threads at once, and from inside a task.
class TbbExecutor final : public Executor {
 public:
  /// `threads` includes the calling thread; 0 means one per hardware thread. More than that raise oneTBB's process-wide
  /// limit on its workers for the lifetime of the executor.
  ///
  /// Bad input: more than 65,535 threads throw InvalidArgument.
  explicit TbbExecutor(std::size_t threads = 0);
  ~TbbExecutor() override;

  [[nodiscard]] std::size_t concurrency() const noexcept override;
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override;

 private:
  struct Arena;
  std::unique_ptr<Arena> m_arena;
};

}  // namespace allpairs::parallel
