// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstddef>

#include "allpairs/Executor.h"
#include "allpairs/parallel/TbbExecutor.h"

namespace allpairs::test {

/// A pool that is resized while it is used: it says something else each time, also that it has no threads, and always
/// runs four tasks at once.
class ChangingExecutor final : public Executor {
 public:
  static constexpr std::array<std::size_t, 5> kAnswers{1, 4, 0, 2, 9};

  /// The number of the first answer.
  explicit ChangingExecutor(std::size_t first) : m_asked(first) {}
  [[nodiscard]] std::size_t concurrency() const noexcept override { return kAnswers[m_asked++ % kAnswers.size()]; }
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override { m_pool.run(count, task); }

 private:
  mutable std::atomic<std::size_t> m_asked;
  parallel::TbbExecutor m_pool{4};
};

}  // namespace allpairs::test
