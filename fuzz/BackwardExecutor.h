// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "allpairs/Executor.h"

namespace allpairs::fuzz {

/// Cuts work as for three threads and runs it on the calling one, the last task first: parallel paths without luck.
class BackwardExecutor final : public Executor {
 public:
  [[nodiscard]] std::size_t concurrency() const noexcept override { return 3; }

  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    for (std::size_t i = count; i > 0; --i) task(i - 1);
  }
};

}  // namespace allpairs::fuzz
