// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#if !defined(__GNUC__) && !defined(__clang__) && defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace allpairs::engine {

// What systems and compilers have, and standard C++ has not. All of the engine that asks on which system it runs is here.

/// Requests large pages for each aligned range within a block. If the system ignores the request, or knows of none, only
/// first touches are slower. Aligning blocks to large pages costs more than it gains (docs/decisions/0015).
void adviseLargePages(void* memory, std::size_t bytes) noexcept;

/// Instruction sets that the processor and the system support, each with those before it.
enum class ProcessorLevel { Unknown, Baseline, Ssse3, Sse4, Avx2, Avx3, Avx3Dl };

/// As the C library found it at the start of the process; Unknown of one that does not tell, or of another processor than
/// x86. The processor itself takes a virtual machine some 70 microseconds to ask.
[[nodiscard]] ProcessorLevel processorLevel() noexcept;

/// Asks for a line of memory that is read soon, where the compiler has a word for that.
inline void prefetchLine([[maybe_unused]] const void* address) noexcept {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address);
#elif defined(_M_X64)
  _mm_prefetch(static_cast<const char*>(address), _MM_HINT_T0);
#endif
}

}  // namespace allpairs::engine
