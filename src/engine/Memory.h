// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

namespace allpairs::engine {

struct FreeDeleter {
  void operator()(void* memory) const noexcept { std::free(memory); }
};

/// Asks for large pages behind a block of memory where the system has them: most of the time of a first touch is
/// spent on page faults. Does nothing elsewhere.
void adviseLargePages(void* memory, std::size_t bytes) noexcept;

/// How often a Buffer of this thread has allocated: for the tests that a second search allocates nothing.
[[nodiscard]] std::size_t& bufferAllocations() noexcept;

/// Uninitialised memory for n values, aligned to a cache line, that is kept until more is needed.
///
/// Not a std::vector because a vector would write every element before the engine does.
template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  /// Makes room for `size` values. What was there before is lost if the buffer has to grow.
  void require(std::size_t size) {
    if (size <= m_capacity) return;
    m_data.reset();
    m_capacity = 0;
    m_data.reset(allocate(size));
    m_capacity = size;
  }

  /// Makes room for `size` values and keeps the first `used`; grows by half at least, so that appending is linear.
  void grow(std::size_t size, std::size_t used) {
    if (size <= m_capacity) return;
    const std::size_t capacity = std::max(size, m_capacity + m_capacity / 2);
    std::unique_ptr<T, FreeDeleter> larger(allocate(capacity));
    std::copy_n(m_data.get(), used, larger.get());
    m_data = std::move(larger);
    m_capacity = capacity;
  }

  [[nodiscard]] T* data() const noexcept { return m_data.get(); }
  [[nodiscard]] std::size_t capacity() const noexcept { return m_capacity; }
  [[nodiscard]] T& operator[](std::size_t i) const noexcept { return m_data.get()[i]; }

 private:
  static constexpr std::size_t kAlignment = 64;
  static constexpr std::size_t kLargePage = std::size_t{2} << 20;

  static T* allocate(std::size_t size) {
    const std::size_t bytes = size * sizeof(T);
    const std::size_t alignment = bytes >= 2 * kLargePage ? kLargePage : kAlignment;
    const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    void* memory = size > static_cast<std::size_t>(-1) / sizeof(T) / 2
                       ? nullptr
                       : std::aligned_alloc(alignment, std::max(rounded, kAlignment));
    if (memory == nullptr) throw std::bad_alloc();
    ++bufferAllocations();
    if (alignment == kLargePage) adviseLargePages(memory, rounded);
    return static_cast<T*>(memory);
  }

  std::unique_ptr<T, FreeDeleter> m_data;
  std::size_t m_capacity = 0;
};

}  // namespace allpairs::engine
