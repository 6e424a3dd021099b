// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "allpairs/Executor.h"

namespace allpairs::parallel {

/// Runs tasks on oneTBB, in an arena of its own.
///
/// Threads: run() may be called from several threads at once, and from inside a task.
class TbbExecutor final : public Executor {
 public:
  /// `threads` counts the calling thread; 0 means as many as the machine runs at once. More than the machine has raise
  /// oneTBB's limit on its workers, which is the process's, for the life of the executor.
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
