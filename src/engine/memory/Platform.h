// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#if !defined(__GNUC__) && !defined(__clang__)
#include <atomic>
#if defined(_M_X64)
#include <xmmintrin.h>
#endif
#endif

// Whether supportedTargets() knows what this processor supports: by glibc, or because every one of the kind has the
// same.
#if defined(__aarch64__)
#define ALLPAIRS_KNOWS_PROCESSOR 1
#elif (defined(__x86_64__) || defined(__i386__)) && __has_include(<sys/platform/x86.h>)
#define ALLPAIRS_KNOWS_PROCESSOR 1
#else
#define ALLPAIRS_KNOWS_PROCESSOR 0
#endif

namespace allpairs::engine {

// What systems and compilers have, and standard C++ has not. All of the engine that asks on which system it runs is
// here.

/// Requests large pages for each aligned range within a block. If the system ignores the request, or knows of none,
/// only first touches are slower. Aligning blocks to large pages costs more than it gains (docs/decisions/0015).
void adviseLargePages(void* memory, std::size_t bytes) noexcept;

/// The targets of Highway that the processor and the system support, as bits; those that the build requires need not be
/// among them. As the C library found it at the start of the process: the processor itself takes a virtual machine some
/// 70 microseconds to ask, longer than most searches of few boxes.
[[nodiscard]] std::int64_t supportedTargets() noexcept;

/// Asks for a line of memory that is read soon, where the compiler has a word for that.
inline void prefetchLine([[maybe_unused]] const void* address) noexcept {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address);
#elif defined(_M_X64)
  _mm_prefetch(static_cast<const char*>(address), _MM_HINT_T0);
#endif
}

// A flag that threads share, and signal handlers: std::atomic_ref, which LLVM's standard library has since its version
// 19.
#if defined(__GNUC__) || defined(__clang__)
static_assert(__atomic_always_lock_free(sizeof(bool), nullptr));

inline void storeFlag(bool& flag, bool value) noexcept { __atomic_store_n(&flag, value, __ATOMIC_RELAXED); }
[[nodiscard]] inline bool loadFlag(const bool& flag) noexcept { return __atomic_load_n(&flag, __ATOMIC_RELAXED); }
#else
static_assert(std::atomic_ref<bool>::is_always_lock_free);

inline void storeFlag(bool& flag, bool value) noexcept {
  std::atomic_ref(flag).store(value, std::memory_order_relaxed);
}
[[nodiscard]] inline bool loadFlag(const bool& flag) noexcept {
  return std::atomic_ref(const_cast<bool&>(flag)).load(std::memory_order_relaxed);
}
#endif

}  // namespace allpairs::engine
