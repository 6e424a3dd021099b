// SPDX-License-Identifier: MIT
#include "memory/Platform.h"

#include "hwy/targets.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

#if ALLPAIRS_KNOWS_PROCESSOR && !defined(__aarch64__)
#define _Bool bool  // NOLINT(bugprone-reserved-identifier, readability-identifier-naming): the header is C.
#include <sys/platform/x86.h>
#undef _Bool
#endif

namespace allpairs::engine {

#if defined(__linux__)

void adviseLargePages(void* memory, std::size_t bytes) noexcept {
  constexpr std::size_t kLargePage = std::size_t{2} << 20;  // on x86 and on ARM with pages of 4 KiB
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t begin = (address + kLargePage - 1) / kLargePage * kLargePage;
  const std::uintptr_t end = (address + bytes) / kLargePage * kLargePage;
  if (begin >= end) return;
  static_cast<void>(madvise(static_cast<char*>(memory) + (begin - address), end - begin, MADV_HUGEPAGE));
}

#else

void adviseLargePages(void* /*memory*/, std::size_t /*bytes*/) noexcept {}

#endif

#ifdef CPU_FEATURE_ACTIVE

std::int64_t supportedTargets() noexcept {
  if (!CPU_FEATURE_ACTIVE(SSE3) || !CPU_FEATURE_ACTIVE(SSSE3)) return 0;
  const bool sse4 = CPU_FEATURE_ACTIVE(SSE4_1) && CPU_FEATURE_ACTIVE(SSE4_2) && CPU_FEATURE_ACTIVE(PCLMULQDQ) &&
                    CPU_FEATURE_ACTIVE(AES);
  if (!sse4) return HWY_SSSE3;
  const bool avx2 = CPU_FEATURE_ACTIVE(AVX) && CPU_FEATURE_ACTIVE(AVX2) && CPU_FEATURE_ACTIVE(LZCNT) &&
                    CPU_FEATURE_ACTIVE(BMI1) && CPU_FEATURE_ACTIVE(BMI2) && CPU_FEATURE_ACTIVE(FMA) &&
                    CPU_FEATURE_ACTIVE(F16C);
  if (!avx2) return HWY_SSSE3 | HWY_SSE4;
  const bool avx3 = CPU_FEATURE_ACTIVE(AVX512F) && CPU_FEATURE_ACTIVE(AVX512VL) && CPU_FEATURE_ACTIVE(AVX512DQ) &&
                    CPU_FEATURE_ACTIVE(AVX512BW) && CPU_FEATURE_ACTIVE(AVX512CD);
  if (!avx3) return HWY_SSSE3 | HWY_SSE4 | HWY_AVX2;
  const bool avx3dl = CPU_FEATURE_ACTIVE(AVX512_VNNI) && CPU_FEATURE_ACTIVE(VPCLMULQDQ) &&
                      CPU_FEATURE_ACTIVE(AVX512_VBMI) && CPU_FEATURE_ACTIVE(AVX512_VBMI2) && CPU_FEATURE_ACTIVE(VAES) &&
                      CPU_FEATURE_ACTIVE(AVX512_VPOPCNTDQ) && CPU_FEATURE_ACTIVE(AVX512_BITALG) &&
                      CPU_FEATURE_ACTIVE(GFNI);
  return HWY_SSSE3 | HWY_SSE4 | HWY_AVX2 | HWY_AVX3 | (avx3dl ? HWY_AVX3_DL : 0);
}

#elif ALLPAIRS_KNOWS_PROCESSOR

std::int64_t supportedTargets() noexcept { return 0; }

#else

std::int64_t supportedTargets() noexcept { return hwy::SupportedTargets(); }

#endif

}  // namespace allpairs::engine
