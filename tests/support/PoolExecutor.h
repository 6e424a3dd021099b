// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "allpairs/Executor.h"

namespace allpairs::test {

/// Threads that allocate nothing once they are there.
class PoolExecutor final : public Executor {
 public:
  explicit PoolExecutor(std::size_t threads) {
    for (std::size_t i = 0; i < threads; ++i) m_threads.emplace_back([this] { work(); });
  }
  ~PoolExecutor() override {
    {
      const std::lock_guard lock(m_mutex);
      m_ended = true;
    }
    m_wake.notify_all();
    for (std::thread& thread : m_threads) thread.join();
  }
  PoolExecutor(const PoolExecutor&) = delete;
  PoolExecutor& operator=(const PoolExecutor&) = delete;
  PoolExecutor(PoolExecutor&&) = delete;
  PoolExecutor& operator=(PoolExecutor&&) = delete;

  [[nodiscard]] std::size_t concurrency() const noexcept override { return m_threads.size(); }

  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    std::unique_lock lock(m_mutex);
    m_task = &task;
    m_next = 0;
    m_count = count;
    m_running = count;
    m_wake.notify_all();
    m_done.wait(lock, [this] { return m_running == 0; });
    m_task = nullptr;
    if (const std::exception_ptr error = std::exchange(m_error, nullptr)) std::rethrow_exception(error);
  }

 private:
  void work() {
    std::unique_lock lock(m_mutex);
    for (;;) {
      m_wake.wait(lock, [this] { return m_ended || (m_task != nullptr && m_next < m_count); });
      if (m_ended) return;
      const std::size_t index = m_next++;
      const FunctionRef<void(std::size_t)> task = *m_task;
      lock.unlock();
      std::exception_ptr error;
      try {
        task(index);
      } catch (...) {
        error = std::current_exception();
      }
      lock.lock();
      if (error != nullptr && m_error == nullptr) m_error = error;
      error = nullptr;
      if (--m_running == 0) m_done.notify_all();
    }
  }

  std::mutex m_mutex;
  std::condition_variable m_wake;
  std::condition_variable m_done;
  FunctionRef<void(std::size_t)>* m_task = nullptr;
  std::size_t m_next = 0;
  std::size_t m_count = 0;
  std::size_t m_running = 0;
  bool m_ended = false;
  std::exception_ptr m_error;
  std::vector<std::thread> m_threads;
};

}  // namespace allpairs::test
