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

/// How many bytes those allocations asked for in all.
[[nodiscard]] std::size_t& bufferBytes() noexcept;

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

  /// Makes room for `size` values and keeps what is there; at least doubles, so that appending is linear.
  ///
  /// Large blocks are moved by their pages where the system can; they may lose their alignment.
  void grow(std::size_t size) {
    if (size <= m_capacity) return;
    const std::size_t capacity = std::max(size, 2 * m_capacity);
    if (capacity > kMaxSize) throw std::bad_alloc();
    void* larger = std::realloc(m_data.get(), capacity * sizeof(T));
    if (larger == nullptr) throw std::bad_alloc();
    static_cast<void>(m_data.release());
    m_data.reset(static_cast<T*>(larger));
    m_capacity = capacity;
    ++bufferAllocations();
    bufferBytes() += capacity * sizeof(T);
    if (capacity * sizeof(T) >= 2 * kLargePage) adviseLargePages(larger, capacity * sizeof(T));
  }

  [[nodiscard]] T* data() const noexcept { return m_data.get(); }
  [[nodiscard]] std::size_t capacity() const noexcept { return m_capacity; }
  [[nodiscard]] T& operator[](std::size_t i) const noexcept { return m_data.get()[i]; }

 private:
  static constexpr std::size_t kAlignment = 64;
  static constexpr std::size_t kLargePage = std::size_t{2} << 20;
  static constexpr std::size_t kMaxSize = static_cast<std::size_t>(-1) / sizeof(T) / 4;

  static T* allocate(std::size_t size) {
    const std::size_t bytes = size * sizeof(T);
    const std::size_t alignment = bytes >= 2 * kLargePage ? kLargePage : kAlignment;
    const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    void* memory = size > kMaxSize ? nullptr : std::aligned_alloc(alignment, std::max(rounded, kAlignment));
    if (memory == nullptr) throw std::bad_alloc();
    ++bufferAllocations();
    bufferBytes() += rounded;
    if (alignment == kLargePage) adviseLargePages(memory, rounded);
    return static_cast<T*>(memory);
  }

  std::unique_ptr<T, FreeDeleter> m_data;
  std::size_t m_capacity = 0;
};

}  // namespace allpairs::engine
