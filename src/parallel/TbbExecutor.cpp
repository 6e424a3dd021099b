// SPDX-License-Identifier: MIT
#include "allpairs/parallel/TbbExecutor.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <optional>
#include <string>

#include "TaskFence.h"
#include "allpairs/Error.h"

namespace allpairs::parallel {
namespace {

int checkedThreads(std::size_t threads) {
  constexpr std::size_t kMost = 65535;
  if (threads > kMost) throw InvalidArgument(std::to_string(threads) + " threads; at most 65535 can be asked for");
  return threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads);
}

}  // namespace

struct TbbExecutor::Arena {
  explicit Arena(int threads) : tasks(threads) {
    // oneTBB starts no more workers than the machine has cores, and warns on standard error, unless it is told to.
    if (threads > tbb::info::default_concurrency()) {
      limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    }
  }

  std::optional<tbb::global_control> limit;
  tbb::task_arena tasks;
};

TbbExecutor::TbbExecutor(std::size_t threads) : m_arena(std::make_unique<Arena>(checkedThreads(threads))) {}

TbbExecutor::~TbbExecutor() = default;

std::size_t TbbExecutor::concurrency() const noexcept {
  return static_cast<std::size_t>(m_arena->tasks.max_concurrency());
}

void TbbExecutor::run(std::size_t count, FunctionRef<void(std::size_t)> task) {
  // A single task needs no other thread: entering the arena would take longer than most such tasks.
  if (count == 1) {
    task(0);
    return;
  }
  TaskFence fence;
  const auto runOne = [&](std::size_t i) {
    const TaskFence::Task mark(fence);
    task(i);
  };
  m_arena->tasks.execute([&] { tbb::parallel_for(std::size_t{0}, count, runOne, tbb::simple_partitioner()); });
}

}  // namespace allpairs::parallel
