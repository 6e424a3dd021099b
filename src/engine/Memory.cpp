// SPDX-License-Identifier: MIT
#include "Memory.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace allpairs::engine {
namespace {

constexpr std::size_t kAlignment = 64;

std::size_t roundUp(std::size_t bytes, std::size_t unit) { return (bytes + unit - 1) / unit * unit; }

#if defined(__linux__)

constexpr std::size_t kLargePage = std::size_t{2} << 20;

/// From half a large page on, a large one costs less to touch than as many small ones.
bool isLarge(std::size_t bytes) { return bytes >= kLargePage / 2; }

/// Touches the pages of a block all at once, where the system can: one by one they take twice the time. No more than
/// advice.
void touchPages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(MADV_POPULATE_WRITE)
  constexpr std::size_t kPage = 4096;
  constexpr std::size_t kWorthACall = 16 * kPage;
  if (bytes < kWorthACall) return;
  const std::uintptr_t begin = roundUp(reinterpret_cast<std::uintptr_t>(memory), kPage);
  const std::uintptr_t end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / kPage * kPage;
  static_cast<void>(madvise(reinterpret_cast<void*>(begin), end - begin, MADV_POPULATE_WRITE));
#endif
}

/// Address space that begins at a large page.
char* reserve(std::size_t bytes, int protection) {
  const std::size_t taken = bytes + kLargePage;
  void* mapped = mmap(nullptr, taken, protection, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED) return nullptr;
  auto* begin = static_cast<char*>(mapped);
  const std::size_t before =
      roundUp(reinterpret_cast<std::uintptr_t>(begin), kLargePage) - reinterpret_cast<std::uintptr_t>(begin);
  if (before != 0) munmap(begin, before);
  if (before != kLargePage) munmap(begin + before + bytes, kLargePage - before);
  return begin + before;
}

void* allocateLarge(std::size_t bytes) {
  const std::size_t mapped = roundUp(bytes, kLargePage);
  char* memory = reserve(mapped, PROT_READ | PROT_WRITE);
  // Advice only: where it is not taken, the memory is as good, only slower to touch for the first time.
  if (memory != nullptr) static_cast<void>(madvise(memory, mapped, MADV_HUGEPAGE));
  return memory;
}

/// Moves the pages, not the contents: from one large page's border to another's, so that they stay large.
void* growLarge(void* memory, std::size_t bytes, std::size_t newBytes) {
  const std::size_t mapped = roundUp(newBytes, kLargePage);
  char* place = reserve(mapped, PROT_NONE);
  if (place == nullptr) return nullptr;
  void* moved = mremap(memory, roundUp(bytes, kLargePage), mapped, MREMAP_MAYMOVE | MREMAP_FIXED, place);
  if (moved != MAP_FAILED) return moved;
  munmap(place, mapped);
  return nullptr;
}

void freeLarge(void* memory, std::size_t bytes) { munmap(memory, roundUp(bytes, kLargePage)); }

#else

bool isLarge(std::size_t) { return false; }
void touchPages(void*, std::size_t) {}
void* allocateLarge(std::size_t) { return nullptr; }
void* growLarge(void*, std::size_t, std::size_t) { return nullptr; }
void freeLarge(void*, std::size_t) {}

#endif

}  // namespace

void* allocateMemory(std::size_t bytes) noexcept {
  return isLarge(bytes) ? allocateLarge(bytes) : std::aligned_alloc(kAlignment, roundUp(bytes, kAlignment));
}

void touchMemory(void* memory, std::size_t bytes) noexcept {
  if (!isLarge(bytes)) touchPages(memory, bytes);
}

void* growMemory(void* memory, std::size_t bytes, std::size_t newBytes) noexcept {
  if (isLarge(bytes)) return growLarge(memory, bytes, newBytes);
  void* larger = allocateMemory(newBytes);
  if (larger == nullptr) return nullptr;
  std::memcpy(larger, memory, bytes);
  std::free(memory);
  return larger;
}

void freeMemory(void* memory, std::size_t bytes) noexcept {
  isLarge(bytes) ? freeLarge(memory, bytes) : std::free(memory);
}

std::size_t& bufferAllocations() noexcept {
  thread_local std::size_t count = 0;
  return count;
}

std::size_t& bufferBytes() noexcept {
  thread_local std::size_t bytes = 0;
  return bytes;
}

}  // namespace allpairs::engine
