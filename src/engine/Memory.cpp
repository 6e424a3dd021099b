// SPDX-License-Identifier: MIT
#include "Memory.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace allpairs::engine {

void adviseLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(__linux__)
  // Advice only: where it is not taken, the memory is as good, only slower to touch for the first time.
  static_cast<void>(madvise(memory, bytes, MADV_HUGEPAGE));
#endif
}

std::size_t& bufferAllocations() noexcept {
  thread_local std::size_t count = 0;
  return count;
}

}  // namespace allpairs::engine
