// SPDX-License-Identifier: MIT
#include "memory/Memory.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace allpairs::engine {
namespace {

/// On x86 and on ARM with pages of 4 KiB.
constexpr std::size_t kLargePage = std::size_t{2} << 20;

/// Requests large pages for each aligned range within the block. If the system ignores the request, only first touches
/// are slower. Aligning blocks to large pages costs more than it gains (docs/decisions/0015).
void adviseLargePages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__)
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t begin = (address + kLargePage - 1) / kLargePage * kLargePage;
  const std::uintptr_t end = (address + bytes) / kLargePage * kLargePage;
  if (begin >= end) return;
  static_cast<void>(madvise(static_cast<char*>(memory) + (begin - address), end - begin, MADV_HUGEPAGE));
#endif
}

class LargePageMemory final : public std::pmr::memory_resource {
 private:
  /// Plain operator new guarantees it, and is faster.
  static bool isUsual(std::size_t alignment) { return alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__; }

  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    if (isUsual(alignment)) return ::operator new(bytes);
    void* memory = ::operator new(bytes, std::align_val_t{alignment});
    adviseLargePages(memory, bytes);
    return memory;
  }

  // Without the size: Clang 16 has no sized deallocation by default.
  void do_deallocate(void* memory, std::size_t /*bytes*/, std::size_t alignment) override {
    if (isUsual(alignment)) {
      ::operator delete(memory);
    } else {
      ::operator delete(memory, std::align_val_t{alignment});
    }
  }

  [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

/// Has no state and is never destroyed: objects that use it may outlive all other static objects.
union DefaultMemory {
  LargePageMemory memory;
  constexpr DefaultMemory() : memory() {}
  DefaultMemory(const DefaultMemory&) = delete;
  DefaultMemory& operator=(const DefaultMemory&) = delete;
  ~DefaultMemory() {}  // NOLINT(modernize-use-equals-default): the member's destructor isn't trivial
};

constinit DefaultMemory theDefault;

}  // namespace

std::pmr::memory_resource* defaultMemory() noexcept { return &theDefault.memory; }

}  // namespace allpairs::engine
