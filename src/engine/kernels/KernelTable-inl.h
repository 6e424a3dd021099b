// SPDX-License-Identifier: MIT
// The table of one instruction set.

#if defined(ALLPAIRS_KERNEL_TABLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_KERNEL_TABLE_INL_H
#undef ALLPAIRS_KERNEL_TABLE_INL_H
#else
#define ALLPAIRS_KERNEL_TABLE_INL_H
#endif

#include <algorithm>

#include "kernels/CullKernel-inl.h"
#include "kernels/FlatKernel-inl.h"
#include "kernels/JoinKernel-inl.h"
#include "kernels/Kernels.h"
#include "kernels/QueryKernel-inl.h"
#include "kernels/ReadKernel-inl.h"
#include "kernels/WorldsKernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// Measured by few_benchmark (docs/decisions/0009): wide vectors test more pairs.
constexpr std::size_t kFlatBoxes = HWY_TARGET == HWY_SCALAR ? 72 : HWY_TARGET <= HWY_AVX2 ? 256 : 192;

/// The same of one set that is not read into lanes: more where vectors are wide.
constexpr std::size_t kPlainBoxes = kFlatBoxes + (HWY_TARGET <= HWY_AVX2 ? kFlatBoxes / 4 : 0);
static_assert(kPlainBoxes <= kMostFew);

/// Measured by worlds_benchmark with AVX-512, AVX2 and SSE4: vectors of AVX-512 test sixteen lanes of float32 at once,
/// which makes up for rounding to them sooner.
constexpr std::size_t kWideBoxes = HWY_TARGET <= HWY_AVX3 ? 96 : HWY_MAX(kFlatBoxes, 96);

/// Measured by dense_benchmark --axes 1, 2 and 3, with each instruction set.
constexpr double kTestsForPair = HWY_TARGET <= HWY_AVX2 ? 10.0 : 5.0;

const Kernels* kernelTable() {
  static const Kernels table{hwy::TargetName(HWY_TARGET),
                             kFlatBoxes,
                             kPlainBoxes,
                             kWideBoxes,
                             kTestsForPair,
                             &searchFlat,
                             {&touchBoxes<float>, &anyNan<float>, &searchWorlds<float>, &searchBetween<float>},
                             {&touchBoxes<double>, &anyNan<double>, &searchWorlds<double>, &searchBetween<double>},
                             &writeTouching,
                             &searchWideWorld,
                             &join,
                             &boundBlocks,
                             &writePairs,
                             &orderRows,
                             &orderPartners,
                             &curveKeys,
                             &readRun32,
                             &readFloat32,
                             &readWide32,
                             &readWide64,
                             &touchingLanes,
                             &markedLanes,
                             &meetingLanes,
                             &nearLanes,
                             &cheapestLane,
                             &touchingPlaces};
  return &table;
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_KERNEL_TABLE_INL_H
