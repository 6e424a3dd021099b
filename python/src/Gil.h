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

/// Once Python has ended there is no interpreter to ask for: what is left of it is not to be touched.
inline void waitIfPythonHasEnded() {
  if (Py_IsInitialized() == 0) waitForTheEnd();
}

/// Gives the interpreter to other threads while it lives.
class ReleasedGil {
 public:
  ReleasedGil() : m_state(PyEval_SaveThread()) {}
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
  PyThreadState* m_state;
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
