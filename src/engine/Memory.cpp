// SPDX-License-Identifier: MIT
#include "Memory.h"

#include <cstdint>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace allpairs::engine {

void adviseLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(__linux__)
  // Advice only: where it is not taken, the memory is as good, only slower to touch for the first time.
  constexpr std::uintptr_t kPage = 4096;
  const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + kPage - 1) / kPage * kPage;
  const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / kPage * kPage;
  static_cast<void>(madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE));
#endif
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
