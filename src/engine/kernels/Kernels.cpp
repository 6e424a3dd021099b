// SPDX-License-Identifier: MIT
// Compiles the kernels once for each instruction set that the compiler knows, and finds them by name.
#include "kernels/Kernels.h"

// Vectors whose length the compiler doesn't know cannot be members of a struct, which the kernels rely on; on
// processors with SVE the kernels for NEON run.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV | ALLPAIRS_UNWATCHED_TARGETS)
#ifndef ALLPAIRS_UNWATCHED_TARGETS  // those that a build with a sanitizer leaves out (src/engine/CMakeLists.txt)
#define ALLPAIRS_UNWATCHED_TARGETS 0
#endif

// Where Highway has no vectors for a processor, it would emulate them, with some compilers: the scalar kernels are faster
// (docs/decisions/0036).
#undef HWY_BROKEN_EMU128
#define HWY_BROKEN_EMU128 1

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/Kernels.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
//
#include "kernels/KernelTable-inl.h"

#if HWY_ONCE

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "memory/Platform.h"

namespace allpairs::engine {
namespace {

using TableFunction = const Kernels* (*)();

/// The bit of each target and its table, best first; null if this build has none.
constexpr std::pair<std::int64_t, TableFunction> kTargets[] = {
    {HWY_AVX3_DL, HWY_CHOOSE_AVX3_DL(kernelTable)}, {HWY_AVX3, HWY_CHOOSE_AVX3(kernelTable)},
    {HWY_AVX2, HWY_CHOOSE_AVX2(kernelTable)},       {HWY_SSE4, HWY_CHOOSE_SSE4(kernelTable)},
    {HWY_SSSE3, HWY_CHOOSE_SSSE3(kernelTable)},     {HWY_NEON, HWY_CHOOSE_NEON(kernelTable)},
};

/// Those of the list that this processor supports, the ones that the build requires of processors, and the scalar ones;
/// null behind the last one. Trivially destructible, as are their names: searches may run after static destructors.
using KernelList = std::array<const Kernels*, std::size(kTargets) + 2>;

KernelList availableKernels() {
  KernelList result{};
  std::size_t size = 0;
  const std::int64_t supported = supportedTargets();
  for (const auto& [bit, table] : kTargets) {
    if (table != nullptr && (supported & bit) != 0) result[size++] = table();
  }
  const Kernels* baseline = HWY_STATIC_DISPATCH(kernelTable)();
  if (size == 0 || result[size - 1] != baseline) result[size++] = baseline;
  if (baseline->name != scalarKernels().name) result[size] = &scalarKernels();
  return result;
}

const KernelList& allKernels() {
  static const KernelList kernels = availableKernels();
  return kernels;
}

}  // namespace

const Kernels* findKernels(std::string_view instructionSet) {
  for (const Kernels* kernels : allKernels()) {
    if (kernels != nullptr && (instructionSet.empty() || kernels->name == instructionSet)) return kernels;
  }
  return nullptr;
}

std::span<const std::string_view> kernelNames() {
  static const auto names = [] {
    std::array<std::string_view, std::tuple_size_v<KernelList>> result{};
    std::transform(allKernels().begin(), allKernels().end(), result.begin(),
                   [](const Kernels* kernels) { return kernels != nullptr ? kernels->name : std::string_view(); });
    return result;
  }();
  return std::span(names).first(static_cast<std::size_t>(std::find(names.begin(), names.end(), "") - names.begin()));
}

}  // namespace allpairs::engine
#endif  // HWY_ONCE
