// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>

namespace allpairs::engine {

/// Memory of some bytes, aligned to a cache line; large blocks to a large page, with large pages behind them where the
/// system has them: most of the time of a first touch is spent on page faults. Null if there is none.
///
/// On Linux, blocks that are freed are kept for the next of their size: up to 256 MiB for all threads, most of which the
/// system may take back, and 4 MiB of small ones for each.
[[nodiscard]] void* allocateMemory(std::size_t bytes) noexcept;

/// The block with its contents in a larger one. Large ones are moved by their pages where the system can. Null, and the
/// block as it was, if there is no memory.
[[nodiscard]] void* growMemory(void* memory, std::size_t bytes, std::size_t newBytes) noexcept;

/// Gives back what allocateMemory() or growMemory() returned.
void freeMemory(void* memory, std::size_t bytes) noexcept;

/// How often a Buffer of this thread has allocated: for the tests that a second search allocates nothing.
[[nodiscard]] std::size_t& bufferAllocations() noexcept;

/// How many bytes those allocations asked for in all.
[[nodiscard]] std::size_t& bufferBytes() noexcept;

/// What is allocated as blocks are, and not by the C library, which tidies up when a middling block comes back.
struct InBlock {
  static void* operator new(std::size_t size);
  static void operator delete(void* memory, std::size_t size) noexcept;
};

/// Uninitialised memory for n values, aligned to a cache line, that is kept until more is needed.
///
/// Not a std::vector because a vector would write every element before the engine does.
template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  Buffer() = default;
  Buffer(Buffer&& other) noexcept
      : m_data(std::exchange(other.m_data, nullptr)), m_capacity(std::exchange(other.m_capacity, 0)) {}
  Buffer& operator=(Buffer&& other) noexcept {
    std::swap(m_data, other.m_data);
    std::swap(m_capacity, other.m_capacity);
    return *this;
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  ~Buffer() { release(); }

  /// Makes room for `size` values. What was there before is lost if the buffer has to grow.
  void require(std::size_t size) {
    if (size <= m_capacity) return;
    release();
    hold(allocateMemory(bytesFor(size)), size);
  }

  /// Makes room for `size` values and keeps what is there; at least doubles, so that appending is linear.
  void grow(std::size_t size) {
    if (size <= m_capacity) return;
    const std::size_t capacity = std::max(size, 2 * m_capacity);
    const std::size_t bytes = bytesFor(capacity);
    hold(m_data == nullptr ? allocateMemory(bytes) : growMemory(m_data, m_capacity * sizeof(T), bytes), capacity);
  }

  [[nodiscard]] T* data() const noexcept { return m_data; }
  [[nodiscard]] std::size_t capacity() const noexcept { return m_capacity; }
  [[nodiscard]] T& operator[](std::size_t i) const noexcept { return m_data[i]; }

 private:
  static std::size_t bytesFor(std::size_t size) {
    if (size > static_cast<std::size_t>(-1) / sizeof(T) / 4) throw std::bad_alloc();
    return size * sizeof(T);
  }

  void hold(void* memory, std::size_t capacity) {
    if (memory == nullptr) throw std::bad_alloc();
    m_data = static_cast<T*>(memory);
    m_capacity = capacity;
    ++bufferAllocations();
    bufferBytes() += capacity * sizeof(T);
  }

  void release() noexcept {
    if (m_data != nullptr) freeMemory(m_data, m_capacity * sizeof(T));
    m_data = nullptr;
    m_capacity = 0;
  }

  T* m_data = nullptr;
  std::size_t m_capacity = 0;
};

}  // namespace allpairs::engine
