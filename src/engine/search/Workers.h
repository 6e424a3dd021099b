// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <memory_resource>
#include <thread>
#include <vector>

namespace allpairs::engine {

/// What the tasks of a call work with, as many as its executor says that run concurrently: should more do, they wait.
/// Kept from call to call. A worker has a flag `busy`.
template <class Worker>
class Workers {
 public:
  explicit Workers(std::pmr::memory_resource* memory) : m_workers(memory) {}

  [[nodiscard]] std::pmr::memory_resource* memory() const noexcept { return m_workers.get_allocator().resource(); }
  [[nodiscard]] std::size_t size() const noexcept { return m_size; }
  [[nodiscard]] Worker& operator[](std::size_t i) const noexcept { return *m_workers[i]; }

  /// Begins a call that uses so many.
  void require(std::size_t count) {
    const std::pmr::polymorphic_allocator<Worker> allocator(memory());
    while (m_workers.size() < count) m_workers.push_back(std::allocate_shared<Worker>(allocator, memory()));
    m_size = count;
  }

  /// Calls use(index, worker) with a worker that no other task has meanwhile.
  template <class Use>
  void withOne(const Use& use) {
    const std::size_t index = claim();
    const auto clear = [](std::atomic_flag* busy) { busy->clear(std::memory_order_release); };
    const std::unique_ptr<std::atomic_flag, decltype(clear)> release(&m_workers[index]->busy, clear);
    use(index, *m_workers[index]);
  }

 private:
  std::size_t claim() {
    for (;;) {
      for (std::size_t i = 0; i < m_size; ++i) {
        if (!m_workers[i]->busy.test_and_set(std::memory_order_acquire)) return i;
      }
      std::this_thread::yield();
    }
  }

  /// Shared with nobody: so they are in the memory of the resource.
  std::pmr::vector<std::shared_ptr<Worker>> m_workers;
  std::size_t m_size = 0;  ///< Of this call.
};

}  // namespace allpairs::engine
