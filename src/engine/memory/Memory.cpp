// SPDX-License-Identifier: MIT
#include "memory/Memory.h"

#include "memory/Platform.h"

namespace allpairs::engine {
namespace {

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
