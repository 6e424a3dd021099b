// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <mutex>
#include <thread>

namespace allpairs::engine {

/// The threads that do some work, while others wait for its end: what a callback in one of them calls must not wait.
///
/// Threads: all members from any thread.
class WorkingThreads {
 public:
  /// Counts the calling thread among them while it exists.
  class Mark {
   public:
    explicit Mark(WorkingThreads& threads) : m_threads(threads) {
      const std::lock_guard lock(m_threads.m_mutex);
      m_next = m_threads.m_first.exchange(this, std::memory_order_relaxed);
    }
    ~Mark() {
      const std::lock_guard lock(m_threads.m_mutex);
      Mark* const first = m_threads.m_first.load(std::memory_order_relaxed);
      if (first == this) {
        m_threads.m_first.store(m_next, std::memory_order_relaxed);
        return;
      }
      Mark* before = first;
      while (before->m_next != this) before = before->m_next;
      before->m_next = m_next;
    }
    Mark(const Mark&) = delete;
    Mark& operator=(const Mark&) = delete;

   private:
    friend class WorkingThreads;

    WorkingThreads& m_threads;
    std::thread::id m_thread = std::this_thread::get_id();
    Mark* m_next = nullptr;
  };

  /// Whether the calling thread is one of them.
  [[nodiscard]] bool haveThis() {
    if (m_first.load(std::memory_order_relaxed) == nullptr) return false;
    const std::lock_guard lock(m_mutex);
    for (const Mark* mark = m_first.load(std::memory_order_relaxed); mark != nullptr; mark = mark->m_next) {
      if (mark->m_thread == std::this_thread::get_id()) return true;
    }
    return false;
  }

 private:
  std::mutex m_mutex;
  std::atomic<Mark*> m_first = nullptr;  ///< Written under the mutex.
};

}  // namespace allpairs::engine
