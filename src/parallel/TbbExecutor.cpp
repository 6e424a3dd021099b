// SPDX-License-Identifier: MIT
#include "allpairs/parallel/TbbExecutor.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/version.h>
#if __has_include(<dlfcn.h>)
#include <dlfcn.h>
#endif

#include <atomic>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "TaskFence.h"
#include "allpairs/Error.h"

namespace allpairs::parallel {
namespace {

int checkedThreads(std::size_t threads) {
  constexpr std::size_t kMost = 9999;  // oneTBB ends the process where the system has no more threads
  if (threads > kMost) throw InvalidArgument(std::to_string(threads) + " threads; at most 9999 can be asked for");
  return threads == 0 ? tbb::info::default_concurrency() : static_cast<int>(threads);
}

/// The executor whose task runs on this thread; null for none.
thread_local const TbbExecutor* current = nullptr;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

/// Marks the task that runs.
class Inside {
 public:
  explicit Inside(const TbbExecutor* executor) noexcept : m_outer(std::exchange(current, executor)) {}
  ~Inside() { current = m_outer; }
  Inside(const Inside&) = delete;
  Inside& operator=(const Inside&) = delete;

 private:
  const TbbExecutor* m_outer;
};

/// oneTBB starts no more workers than the machine has cores, and warns on standard error, unless it is told to. Of
/// several limits it takes the least: the executors share one, the greatest that any of them needs. An arena is made
/// and ended under the same lock: oneTBB looks at the limit then.
class WorkerLimit {
 public:
  explicit WorkerLimit(std::size_t threads) : m_threads(threads) {
    const std::lock_guard lock(mutex());
    const auto place = shared().wanted.insert(threads);
    try {
      renew();
    } catch (...) {
      shared().wanted.erase(place);
      throw;
    }
  }
  WorkerLimit(const WorkerLimit&) = delete;
  WorkerLimit& operator=(const WorkerLimit&) = delete;
  ~WorkerLimit() {
    const std::lock_guard lock(mutex());
    shared().wanted.erase(shared().wanted.find(m_threads));
    try {
      renew();
    } catch (const std::bad_alloc&) {  // the limit of before is no less
    }
  }

  [[nodiscard]] static std::mutex& mutex() { return shared().mutex; }

 private:
  struct Shared {
    std::mutex mutex;
    std::multiset<std::size_t> wanted;
    std::size_t most = 0;
    std::unique_ptr<tbb::global_control> limit;
  };
  static Shared& shared() {
    static auto* const shared = new Shared;  // NOLINT(*-owning-memory): executors may be static
    return *shared;
  }
  static void renew() {
    Shared& all = shared();
    const std::size_t most = all.wanted.empty() ? 0 : *all.wanted.rbegin();
    if (most == all.most) return;
    auto limit =
        most == 0 ? nullptr : std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, most);
    all.limit = std::move(limit);
    all.most = most;
  }

  std::size_t m_threads;
};

/// Threads of oneTBB end some time after their work. A program that unloads us, and with us oneTBB, would have them run
/// in code that is gone: from the first executor on oneTBB stays loaded.
void keepLoaded() {
#if __has_include(<dlfcn.h>)
  static std::atomic<bool> isKept = false;
  if (isKept) return;
  Dl_info library{};
  // NOLINTNEXTLINE(*-reinterpret-cast): that is how the function takes addresses of functions.
  if (dladdr(reinterpret_cast<const void*>(&TBB_runtime_interface_version), &library) == 0) return;
  isKept = dlopen(library.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE) != nullptr;
#endif
}

}  // namespace

/// An arena for each call that runs at the same time: a thread that comes from outside would wait for a place in one
/// whose threads all wait, for a lock that it holds.
class TbbExecutor::Arenas {
 public:
  explicit Arenas(int threads) : m_threads(threads) {
    if (threads > tbb::info::default_concurrency()) m_limit.emplace(static_cast<std::size_t>(threads));
  }
  Arenas(const Arenas&) = delete;
  Arenas& operator=(const Arenas&) = delete;
  ~Arenas() {
    const std::lock_guard alone(WorkerLimit::mutex());
    m_all.clear();
  }

  [[nodiscard]] int threads() const noexcept { return m_threads; }

  template <class Work>
  void execute(const Work& work) {
    const auto putBack = [this](tbb::task_arena* arena) { put(arena); };
    const std::unique_ptr<tbb::task_arena, decltype(putBack)> arena(take(), putBack);
    arena->execute(work);
  }

 private:
  tbb::task_arena* take() {
    const std::lock_guard lock(m_mutex);
    if (m_idle.empty()) {
      m_idle.reserve(m_all.size() + 1);  // so that each can be put back
      auto arena = std::make_unique<tbb::task_arena>(m_threads);
      m_all.reserve(m_all.size() + 1);
      const std::lock_guard alone(WorkerLimit::mutex());
      arena->initialize();
      m_all.push_back(std::move(arena));
      return m_all.back().get();
    }
    tbb::task_arena* const arena = m_idle.back();
    m_idle.pop_back();
    return arena;
  }

  void put(tbb::task_arena* arena) noexcept {
    const std::lock_guard lock(m_mutex);
    m_idle.push_back(arena);
  }

  int m_threads;
  std::optional<WorkerLimit> m_limit;
  std::mutex m_mutex;
  std::vector<std::unique_ptr<tbb::task_arena>> m_all;
  std::vector<tbb::task_arena*> m_idle;
};

TbbExecutor::TbbExecutor(std::size_t threads) : m_arenas(std::make_unique<Arenas>(checkedThreads(threads))) {
  keepLoaded();
}

TbbExecutor::~TbbExecutor() = default;

std::size_t TbbExecutor::concurrency() const noexcept { return static_cast<std::size_t>(m_arenas->threads()); }

void TbbExecutor::run(std::size_t count, FunctionRef<void(std::size_t)> task) {
  // A single task needs no other thread: entering the arena would take longer than most such tasks.
  if (count == 1) {
    task(0);
    return;
  }
  TaskFence fence;
  const auto runOne = [&](std::size_t i) {
    const TaskFence::Task mark(fence);
    const Inside inside(this);
    task(i);
  };
  // Isolated: a thread that waits for its tasks takes none of other calls, which may need what it holds.
  const auto runAll = [&] {
    tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, count, runOne, tbb::simple_partitioner()); });
  };
  current == this ? runAll() : m_arenas->execute(runAll);
}

}  // namespace allpairs::parallel
