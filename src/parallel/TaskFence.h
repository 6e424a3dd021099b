// SPDX-License-Identifier: MIT
#pragma once

#ifdef ALLPAIRS_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace allpairs::parallel {

/// Tells ThreadSanitizer what it cannot see, because oneTBB as packaged is not instrumented: tasks begin after the
/// fence was made, and have ended when it goes. It says nothing about two tasks, so a race between them is still found.
/// In other builds it does nothing.
class TaskFence {
 public:
  TaskFence() { release(&m_begin); }
  TaskFence(const TaskFence&) = delete;
  TaskFence& operator=(const TaskFence&) = delete;
  ~TaskFence() { acquire(&m_end); }

  /// Lives as long as one task runs, also when it throws.
  class Task {
   public:
    explicit Task(TaskFence& fence) : m_fence(fence) { acquire(&m_fence.m_begin); }
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;
    ~Task() { release(&m_fence.m_end); }

   private:
    TaskFence& m_fence;
  };

 private:
#ifdef ALLPAIRS_THREAD_SANITIZER
  static void acquire(char* address) { __tsan_acquire(address); }
  static void release(char* address) { __tsan_release(address); }
#else
  static void acquire(char*) {}
  static void release(char*) {}
#endif

  char m_begin = 0;  ///< Only its address is used.
  char m_end = 0;    ///< Only its address is used.
};

}  // namespace allpairs::parallel
