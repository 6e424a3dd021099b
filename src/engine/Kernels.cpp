// SPDX-License-Identifier: MIT
// Compiles the kernels once for each instruction set that the compiler knows, and finds them by name.
#include "Kernels.h"

// Vectors whose length the compiler doesn't know cannot be members of a struct, which the kernels rely on; on processors
// with SVE the kernels for NEON run.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
//
#include "KernelTable-inl.h"

#if HWY_ONCE

#include <vector>

namespace allpairs::engine {
namespace {

using TableFunction = const Kernels* (*)();

struct Target {
  std::int64_t bit;
  TableFunction table;
};

/// Best first; null where this build has none.
constexpr Target kTargets[] = {
    {HWY_AVX3_DL, HWY_CHOOSE_AVX3_DL(kernelTable)}, {HWY_AVX3, HWY_CHOOSE_AVX3(kernelTable)},
    {HWY_AVX2, HWY_CHOOSE_AVX2(kernelTable)},       {HWY_SSE4, HWY_CHOOSE_SSE4(kernelTable)},
    {HWY_SSSE3, HWY_CHOOSE_SSSE3(kernelTable)},     {HWY_NEON, HWY_CHOOSE_NEON(kernelTable)},
};

std::vector<const Kernels*> availableKernels() {
  std::vector<const Kernels*> result;
  for (const Target& target : kTargets) {
    if (target.table != nullptr && (hwy::SupportedTargets() & target.bit) != 0) result.push_back(target.table());
  }
  const Kernels* baseline = HWY_STATIC_DISPATCH(kernelTable)();
  if (result.empty() || result.back() != baseline) result.push_back(baseline);
  if (baseline->name != scalarKernels().name) result.push_back(&scalarKernels());
  return result;
}

const std::vector<const Kernels*>& allKernels() {
  static const std::vector<const Kernels*> kernels = availableKernels();
  return kernels;
}

std::vector<std::string_view> names() {
  std::vector<std::string_view> result;
  for (const Kernels* kernels : allKernels()) result.push_back(kernels->name);
  return result;
}

}  // namespace

const Kernels* findKernels(std::string_view instructionSet) {
  if (instructionSet.empty()) return allKernels().front();
  for (const Kernels* kernels : allKernels()) {
    if (kernels->name == instructionSet) return kernels;
  }
  return nullptr;
}

std::span<const std::string_view> kernelNames() {
  static const std::vector<std::string_view> result = names();
  return result;
}

}  // namespace allpairs::engine
#endif  // HWY_ONCE
