// SPDX-License-Identifier: MIT
#include "Interrupts.h"

#include <pybind11/pybind11.h>

#include <condition_variable>
#include <exception>
#include <system_error>
#include <thread>

#include "Gil.h"
#include "allpairs/Error.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

/// From so many boxes on a search takes at least a millisecond, so that another thread costs it a few percent.
constexpr std::size_t kWorthWatching = 20'000;

/// The same of a search that runs on threads, which costs as much to begin; with fewer boxes it ends within a fifth of
/// a second even if all of them overlap.
constexpr std::size_t kWorthWatchingThreads = 2'000;

/// Looks of a search between two readings of the clock; no more than some milliseconds of work lie between two looks.
constexpr std::size_t kLooksAtOnce = 8;

/// Other threads of Python may make a question wait for the GIL, for 5 ms each time.
constexpr std::chrono::milliseconds kBetweenQuestions{50};

/// Work in a thread of its own, which has ended when this goes.
class Running {
 public:
  Running(Stopper& stopper, FunctionRef<void(Stopper&)> work, std::exception_ptr& error)
      : m_thread([this, &stopper, work, &error] {
          try {
            work(stopper);
          } catch (...) {
            error = std::current_exception();
          }
          const std::lock_guard lock(m_mutex);
          m_isDone = true;
          m_changed.notify_all();
        }) {}
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  ~Running() { m_thread.join(); }

  /// Whether it is done, within the time between two looks.
  [[nodiscard]] bool isSoonDone() {
    std::unique_lock lock(m_mutex);
    return m_changed.wait_for(lock, kBetweenLooks, [this] { return m_isDone; });
  }

 private:
  std::mutex m_mutex;
  std::condition_variable m_changed;
  bool m_isDone = false;
  std::thread m_thread;  // the last: it uses the others
};

/// Whether a signal handler raised an exception, which then is Python's current one, before the work was done.
bool isInterrupted(Running& running) {
  while (!running.isSoonDone()) {
    const HeldGil held;
    if (PyErr_CheckSignals() != 0) return true;
  }
  return false;
}

/// Runs work in another thread, or in this one if no other can be had; returns whether a signal handler raised an
/// exception, which then is Python's current one.
bool isInterruptedElsewhere(FunctionRef<void(Stopper&)> work) {
  Stopper stopper(Stopper::Asks::Nobody);
  std::exception_ptr error;
  {
    const ReleasedGil released;
    std::optional<Running> running;
    try {
      running.emplace(stopper, work, error);
    } catch (const std::system_error&) {
      work(stopper);
      return false;
    }
    if (isInterrupted(*running)) {
      stopper.stop();
      return true;
    }
  }
  if (error) std::rethrow_exception(error);
  return false;
}

/// Runs work in this thread; returns whether Ctrl-C stopped it, which Python then is about to handle.
bool isInterruptedHere(FunctionRef<void(Stopper&)> work) {
  Stopper stopper(Stopper::Asks::Python);
  const ReleasedGil released;
  try {
    work(stopper);
  } catch (const Stopped&) {
    if (stopper.isInterrupted()) return true;
    throw;
  }
  return false;
}

}  // namespace

bool CallFlag::operator()() const noexcept { return m_stopper != nullptr && m_stopper->ask(); }

Stopper::~Stopper() {
  if (m_isInterrupted) PyErr_SetInterrupt();
}

/// Handlers do not run here: they may use the object that is searched.
bool Stopper::ask() {
  if (m_asker != std::this_thread::get_id()) return false;
  if (m_isInterrupted || ++m_looks % kLooksAtOnce != 0) return m_isInterrupted;
  const auto now = std::chrono::steady_clock::now();
  if (now - m_asked < kBetweenQuestions) return false;
  m_asked = now;
  const HeldGil held;
  m_isInterrupted = PyOS_InterruptOccurred() != 0;
  if (m_isInterrupted) stop();  // for other threads
  return m_isInterrupted;
}

void Stopper::stop() {
  const std::lock_guard lock(m_mutex);
  m_isStopped = true;
  if (m_flag != nullptr) m_flag->m_flag.set();
}

void Stopper::reset(CallFlag* flag) {
  const std::lock_guard lock(m_mutex);
  if (m_flag != nullptr) {
    m_flag->m_stopper = nullptr;
    m_flag->m_flag.clear();  // what other calls do with the object goes on
  }
  m_flag = flag;
  if (m_flag == nullptr) return;
  m_flag->m_stopper = this;
  m_isStopped ? m_flag->m_flag.set() : m_flag->m_flag.clear();
}

void watchSignals(std::size_t boxes, Runs runs, FunctionRef<void(Stopper&)> work) {
  if (boxes < (runs == Runs::Alone ? kWorthWatching : kWorthWatchingThreads)) {
    if (!isInterruptedHere(work)) return;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  if (isInterruptedElsewhere(work)) throw py::error_already_set();
}

}  // namespace allpairs::python
