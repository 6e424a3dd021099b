// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>

#include "allpairs/parallel/TbbExecutor.h"

namespace allpairs::python {

/// Runs work on that many threads, 0 for as many as the machine runs at once; null for one, the calling thread.
[[nodiscard]] inline std::unique_ptr<Executor> executorOf(std::size_t threads) {
  return threads == 1 ? nullptr : std::make_unique<parallel::TbbExecutor>(threads);
}

}  // namespace allpairs::python
