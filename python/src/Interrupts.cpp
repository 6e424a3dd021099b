// SPDX-License-Identifier: MIT
#include "Interrupts.h"

#include <pybind11/pybind11.h>

#include <condition_variable>
#include <exception>
#include <system_error>
#include <thread>

namespace allpairs::python {
namespace py = pybind11;
namespace {

/// A search of fewer boxes ends within half a second even if all of them overlap, and takes a millisecond if few do, of
/// which a thread would cost a tenth.
constexpr std::size_t kWorthWatching = 20'000;

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
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) return true;
  }
  return false;
}

}  // namespace

void Stopper::stop() {
  const std::lock_guard lock(m_mutex);
  m_isStopped = true;
  if (m_flag != nullptr) m_flag->set();
}

void Stopper::reset(StopFlag* flag) {
  const std::lock_guard lock(m_mutex);
  m_flag = flag;
  if (m_flag != nullptr) m_isStopped ? m_flag->set() : m_flag->clear();
}

void watchSignals(std::size_t boxes, FunctionRef<void(Stopper&)> work) {
  Stopper stopper;
  std::exception_ptr error;
  bool interrupted = false;
  {
    const py::gil_scoped_release release;
    std::optional<Running> running;
    try {
      if (boxes >= kWorthWatching) running.emplace(stopper, work, error);
    } catch (const std::system_error&) {
      // No other thread can be had.
    }
    if (!running) {
      work(stopper);
    } else if (isInterrupted(*running)) {
      interrupted = true;
      stopper.stop();
    }
  }
  if (interrupted) throw py::error_already_set();
  if (error) std::rethrow_exception(error);
}

}  // namespace allpairs::python
