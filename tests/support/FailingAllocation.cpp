// SPDX-License-Identifier: MIT
// The allocation functions of a test program, one of which fails on demand.
//
// With the GNU C library malloc and related functions are replaced, which is below everything: the C++ library, its
// exceptions, and other libraries. Under sanitizers, which have replaced these themselves, operator new is.
#include "support/FailingAllocation.h"

#include <atomic>
#include <cerrno>
#include <cstdlib>

namespace allpairs::test {
namespace {

std::atomic<std::int64_t> live{0};
std::atomic<bool> armed{false};
std::atomic<bool> failed{false};
std::atomic<std::uint64_t> left{0};
std::atomic<bool> onwards{false};

bool isToFail() noexcept {
  if (!armed.load(std::memory_order_relaxed)) return false;
  if (failed && onwards) return true;
  if (left.fetch_sub(1) != 1) return false;
  failed = true;
  return true;
}

void* counted(void* memory) noexcept {
  if (memory != nullptr) live.fetch_add(1, std::memory_order_relaxed);
  return memory;
}

void uncount(const void* memory) noexcept {
  if (memory != nullptr) live.fetch_sub(1, std::memory_order_relaxed);
}

}  // namespace

void startFailing(std::uint64_t k, Failing failing) noexcept {
  left = k;
  onwards = failing == Failing::Onwards;
  failed = false;
  armed = true;
}

bool stopFailing() noexcept {
  armed = false;
  return failed;
}

std::int64_t liveAllocations() noexcept { return live; }

}  // namespace allpairs::test

using allpairs::test::counted;
using allpairs::test::isToFail;
using allpairs::test::uncount;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ALLPAIRS_REPLACES_MALLOC 0
#elif defined(__has_feature)
#define ALLPAIRS_REPLACES_MALLOC !(__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#else
#define ALLPAIRS_REPLACES_MALLOC 1
#endif

#if ALLPAIRS_REPLACES_MALLOC

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): names are the C library's.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);

void* malloc(std::size_t size) noexcept {
  if (!isToFail()) return counted(__libc_malloc(size));
  errno = ENOMEM;
  return nullptr;
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  if (!isToFail()) return counted(__libc_calloc(count, size));
  errno = ENOMEM;
  return nullptr;
}

void* realloc(void* memory, std::size_t size) noexcept {
  if (isToFail()) {
    errno = ENOMEM;
    return nullptr;
  }
  void* const result = __libc_realloc(memory, size);
  if (memory == nullptr) counted(result);
  if (memory != nullptr && size == 0) uncount(memory);
  return result;
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  if (!isToFail()) return counted(__libc_memalign(alignment, size));
  errno = ENOMEM;
  return nullptr;
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept { return memalign(alignment, size); }

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  void* const result = memalign(alignment, size);
  if (result == nullptr) return ENOMEM;
  *memory = result;
  return 0;
}

void free(void* memory) noexcept {
  uncount(memory);
  __libc_free(memory);
}
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

#else

namespace {
void* allocate(std::size_t size, std::size_t alignment) noexcept {
  if (isToFail()) return nullptr;
  if (alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__) return counted(std::malloc(size == 0 ? 1 : size));
  return counted(std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment));
}

void* allocateOrThrow(std::size_t size, std::size_t alignment) {
  void* const memory = allocate(size, alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void release(void* memory) noexcept {
  uncount(memory);
  std::free(memory);
}
}  // namespace

using Alignment = std::align_val_t;

void* operator new(std::size_t size) { return allocateOrThrow(size, 1); }
void* operator new[](std::size_t size) { return allocateOrThrow(size, 1); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate(size, 1); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return allocate(size, 1); }
void* operator new(std::size_t size, Alignment a) { return allocateOrThrow(size, static_cast<std::size_t>(a)); }
void* operator new[](std::size_t size, Alignment a) { return allocateOrThrow(size, static_cast<std::size_t>(a)); }
void* operator new(std::size_t size, Alignment a, const std::nothrow_t&) noexcept {
  return allocate(size, static_cast<std::size_t>(a));
}
void* operator new[](std::size_t size, Alignment a, const std::nothrow_t&) noexcept {
  return allocate(size, static_cast<std::size_t>(a));
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete[](void* memory) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, Alignment) noexcept { release(memory); }
void operator delete[](void* memory, Alignment) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, Alignment) noexcept { release(memory); }
void operator delete[](void* memory, std::size_t, Alignment) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete(void* memory, Alignment, const std::nothrow_t&) noexcept { release(memory); }
void operator delete[](void* memory, Alignment, const std::nothrow_t&) noexcept { release(memory); }

#endif
