// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <memory_resource>
#include <new>

namespace allpairs::test {

/// Memory of the C library that counts what is taken from it, and can be used up.
class CountingMemory final : public std::pmr::memory_resource {
 public:
  [[nodiscard]] std::size_t allocations() const noexcept { return m_allocations; }

  /// How many bytes were asked for in all, and are held now.
  [[nodiscard]] std::size_t bytes() const noexcept { return m_bytes; }
  [[nodiscard]] std::size_t held() const noexcept { return m_held; }

  /// From now on all allocations fail, or none.
  void setUsedUp(bool usedUp) noexcept { m_usedUp = usedUp; }

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    if (m_usedUp) throw std::bad_alloc();
    const std::size_t whole = (bytes + alignment - 1) / alignment * alignment;
    const std::size_t unit = std::max(alignment, sizeof(void*));
    void* memory = std::aligned_alloc(unit, std::max<std::size_t>(1, (whole + unit - 1) / unit) * unit);
    if (memory == nullptr) throw std::bad_alloc();
    ++m_allocations;
    m_bytes += bytes;
    m_held += bytes;
    return memory;
  }
  void do_deallocate(void* memory, std::size_t bytes, std::size_t /*alignment*/) override {
    m_held -= bytes;
    std::free(memory);
  }
  [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  std::atomic<std::size_t> m_allocations{0};
  std::atomic<std::size_t> m_bytes{0};
  std::atomic<std::size_t> m_held{0};
  std::atomic<bool> m_usedUp{false};
};

}  // namespace allpairs::test
