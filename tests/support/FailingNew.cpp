// SPDX-License-Identifier: MIT
// A library to preload: operator new of a process, on all of its threads, which fails on demand. malloc doesn't, so
// that a host such as Python, whose own memory it is, goes on.
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

std::atomic<bool> armed{false};
std::atomic<bool> onwards{false};
std::atomic<bool> failed{false};
std::atomic<std::uint64_t> left{0};
std::atomic<std::size_t> leastSize{0};

bool isToFail(std::size_t size) noexcept {
  if (!armed || size < leastSize) return false;
  if (failed && onwards) return true;
  if (left.fetch_sub(1) != 1) return false;
  failed = true;
  return true;
}

void* allocate(std::size_t size, std::size_t alignment) noexcept {
  if (isToFail(size)) return nullptr;
  if (alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__) return std::malloc(size == 0 ? 1 : size);
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void* allocateOrThrow(std::size_t size, std::size_t alignment) {
  void* const memory = allocate(size, alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

/// Lets the k-th operator new from now on fail of those that want so many bytes, and those after it too if `andLater`.
extern "C" void allpairsTestFail(std::uint64_t k, bool andLater, std::size_t size) noexcept {
  left = k;
  leastSize = size;
  onwards = andLater;
  failed = false;
  armed = true;
}

/// Lets none fail any more; returns whether one has.
extern "C" bool allpairsTestStop() noexcept {
  armed = false;
  return failed;
}

using Alignment = std::align_val_t;

void* operator new(std::size_t size) { return allocateOrThrow(size, 1); }
void* operator new[](std::size_t size) { return allocateOrThrow(size, 1); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate(size, 1); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return allocate(size, 1); }
void* operator new(std::size_t size, Alignment a) { return allocateOrThrow(size, static_cast<std::size_t>(a)); }
void* operator new[](std::size_t size, Alignment a) { return allocateOrThrow(size, static_cast<std::size_t>(a)); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, Alignment) noexcept { std::free(memory); }
void operator delete[](void* memory, Alignment) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, Alignment) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, Alignment) noexcept { std::free(memory); }
