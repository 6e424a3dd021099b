// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <memory_resource>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "memory/Platform.h"

namespace allpairs::engine {

/// The default memory resource: aligned operator new. On Linux it requests large pages (2 MiB) for each aligned range
/// within a block, because page faults dominate the cost of first touches.
[[nodiscard]] std::pmr::memory_resource* defaultMemory() noexcept;

/// The memory resource of the options, or the default.
[[nodiscard]] inline std::pmr::memory_resource* memoryOr(std::pmr::memory_resource* memory) noexcept {
  return memory != nullptr ? memory : defaultMemory();
}

/// Whether the largest block of a search of so many boxes is asked for so amply that it is larger than all others
/// together. Only what is used of it is ever touched, but glibc returns freed memory at the end of its heap to the
/// system once it is more than twice the largest block that was freed before, up to 32 MiB: less, and the pages are
/// there for the next search (docs/decisions/0015).
[[nodiscard]] inline bool isAmple(const std::pmr::memory_resource* memory, std::size_t boxes) noexcept {
  return memory == defaultMemory() && boxes < std::size_t{1} << 17;
}

/// An array of objects that allocate from a resource.
template <class T, std::size_t kSize>
[[nodiscard]] std::array<T, kSize> makeArray(std::pmr::memory_resource* memory) {
  return [&]<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
    return std::array<T, kSize>{(static_cast<void>(kIndex), T(memory))...};
  }(std::make_index_sequence<kSize>());
}

/// Uninitialised memory for n values, aligned to a cache line, that is kept until more is needed.
///
/// Not a std::vector because a vector would write every element before the engine does.
template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  explicit Buffer(std::pmr::memory_resource* memory) noexcept : m_memory(memory) {}
  Buffer(Buffer&& other) noexcept
      : m_memory(other.m_memory),
        m_data(std::exchange(other.m_data, nullptr)),
        m_capacity(std::exchange(other.m_capacity, 0)) {}
  Buffer& operator=(Buffer&& other) noexcept {
    std::swap(m_memory, other.m_memory);
    std::swap(m_data, other.m_data);
    std::swap(m_capacity, other.m_capacity);
    return *this;
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  ~Buffer() { release(); }

  /// Allocates `size` values. The old contents are lost if the buffer has to grow, or fails to.
  void require(std::size_t size) {
    if (size <= m_capacity) return;
    release();
    m_data = allocate(size);
    m_capacity = size;
  }

  /// The same with room for some more, so that a fluctuating size soon allocates nothing.
  void requireAmply(std::size_t size) {
    if (size > m_capacity) require(size + size / 4 + 64);
  }

  /// Allocates `size` values and keeps the contents; at least doubles, so that appending is linear. If memory is
  /// exhausted, the buffer is unchanged.
  void grow(std::size_t size) {
    grow(size, [] {});
  }

  /// The same, which calls look() between pieces of the contents: copying all of many may take long. If that throws,
  /// the buffer is unchanged.
  template <class Look>
  void grow(std::size_t size, const Look& look) {
    if (size <= m_capacity) return;
    Buffer larger(m_memory);
    larger.require(std::max(size, 2 * m_capacity));
    for (std::size_t begin = 0; begin < m_capacity; begin += kCopiedAtOnce) {
      const std::size_t count = std::min(kCopiedAtOnce, m_capacity - begin);
      std::memcpy(static_cast<void*>(larger.m_data + begin), m_data + begin, count * sizeof(T));
      look();
    }
    *this = std::move(larger);
  }

  /// Releases the memory.
  void release() noexcept {
    if (m_data != nullptr) m_memory->deallocate(m_data, m_capacity * sizeof(T), kAlignment);
    m_data = nullptr;
    m_capacity = 0;
  }

  [[nodiscard]] T* data() const noexcept { return m_data; }
  [[nodiscard]] std::size_t capacity() const noexcept { return m_capacity; }
  [[nodiscard]] T& operator[](std::size_t i) const noexcept { return m_data[i]; }

 private:
  /// Some milliseconds, memory that is touched for the first time included.
  static constexpr std::size_t kCopiedAtOnce = (std::size_t{8} << 20) / sizeof(T);

  static constexpr std::size_t kAlignment = 64;  ///< A cache line, and the widest vector.

  [[nodiscard]] T* allocate(std::size_t size) const {
    if (size > static_cast<std::size_t>(-1) / sizeof(T) / 4) throw std::bad_alloc();
    return static_cast<T*>(m_memory->allocate(size * sizeof(T), kAlignment));
  }

  std::pmr::memory_resource* m_memory;
  T* m_data = nullptr;
  std::size_t m_capacity = 0;
};

/// Gives an empty vector memory for so many values, in large pages where they are many.
template <class T>
void reserve(std::vector<T>& values, std::size_t size) {
  values.reserve(size);
  adviseLargePages(values.data(), size * sizeof(T));
}

/// Appends values. What grows by itself is copied to small pages, one after the other touched for the first time.
template <class T>
void append(std::vector<T>& values, std::span<const T> added) {
  const std::size_t size = values.size() + added.size();
  if (size > values.capacity()) {
    std::vector<T> larger;
    reserve(larger, std::max(size, 2 * values.capacity()));
    larger.assign(values.begin(), values.end());
    values.swap(larger);
  }
  values.insert(values.end(), added.begin(), added.end());
}

}  // namespace allpairs::engine
