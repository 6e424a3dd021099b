// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <thread>

namespace allpairs::python {

/// Where a thread stays that gets the interpreter no more.
///
/// A daemon thread that is still at work when Python ends asks for it in vain. Before version 3.14 Python then ends the
/// thread by an exception that may pass no destructor, so that the whole process is aborted; later ones stop it here.
[[noreturn]] inline void waitForTheEnd() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// Whether this is the thread in which Python ends: it alone still has the interpreter then, as for the destructors of
/// what modules hold.
inline thread_local bool isEndingPython = false;

/// Once Python ends there is no interpreter for other threads to ask for: what is left of it is not to be touched.
inline void waitIfPythonHasEnded() {
  if (Py_IsInitialized() == 0 && !isEndingPython) waitForTheEnd();
}

/// Gives the interpreter to other threads while it lives.
class ReleasedGil {
 public:
  ReleasedGil() {
    isEndingPython = Py_IsInitialized() == 0;
    m_state = PyEval_SaveThread();
  }
  ~ReleasedGil() {
    waitIfPythonHasEnded();
    try {
      PyEval_RestoreThread(m_state);
    } catch (...) {
      waitForTheEnd();
    }
  }
  ReleasedGil(const ReleasedGil&) = delete;
  ReleasedGil& operator=(const ReleasedGil&) = delete;

 private:
  PyThreadState* m_state = nullptr;
};

/// Has the interpreter while it lives, in a thread that has released it or is not known to Python.
class HeldGil {
 public:
  HeldGil() {
    waitIfPythonHasEnded();
    try {
      m_state = PyGILState_Ensure();
    } catch (...) {
      waitForTheEnd();
    }
  }
  ~HeldGil() { PyGILState_Release(m_state); }
  HeldGil(const HeldGil&) = delete;
  HeldGil& operator=(const HeldGil&) = delete;

 private:
  PyGILState_STATE m_state{};
};

}  // namespace allpairs::python
