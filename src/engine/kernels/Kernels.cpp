// SPDX-License-Identifier: MIT
// Compiles the kernels once for each instruction set that the compiler knows, and finds them by name.
#include "kernels/Kernels.h"

// Vectors whose length the compiler doesn't know cannot be members of a struct, which the kernels rely on; on
// processors with SVE the kernels for NEON run.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/Kernels.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
//
#include "kernels/KernelTable-inl.h"

#if HWY_ONCE

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

/// Those that this processor supports, and the scalar ones. Trivially destructible: searches may run after static
/// destructors.
struct KernelList {
  /// Those of the list, the ones that the build requires of processors, and the scalar ones.
  std::array<const Kernels*, std::size(kTargets) + 2> kernels{};
  std::array<std::string_view, std::size(kTargets) + 2> names{};
  std::size_t size = 0;

  void add(const Kernels& added) {
    kernels[size] = &added;
    names[size++] = added.name;
  }
};

KernelList availableKernels() {
  KernelList result;
  const std::int64_t supported = supportedTargets();
  for (const auto& [bit, table] : kTargets) {
    if (table != nullptr && (supported & bit) != 0) result.add(*table());
  }
  const Kernels* baseline = HWY_STATIC_DISPATCH(kernelTable)();
  if (result.size == 0 || result.kernels[result.size - 1] != baseline) result.add(*baseline);
  if (baseline->name != scalarKernels().name) result.add(scalarKernels());
  return result;
}

const KernelList& allKernels() {
  static const KernelList kernels = availableKernels();
  return kernels;
}

}  // namespace

const Kernels* findKernels(std::string_view instructionSet) {
  const KernelList& list = allKernels();
  if (instructionSet.empty()) return list.kernels.front();
  for (std::size_t i = 0; i < list.size; ++i) {
    if (list.names[i] == instructionSet) return list.kernels[i];
  }
  return nullptr;
}

std::span<const std::string_view> kernelNames() { return {allKernels().names.data(), allKernels().size}; }

}  // namespace allpairs::engine
#endif  // HWY_ONCE
