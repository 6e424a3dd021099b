// SPDX-License-Identifier: MIT
// The instruction sets that the engine offers, against those that Highway finds by asking the processor itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/Overlaps.h"
#include "hwy/highway.h"
#include "kernels/Kernels.h"

namespace allpairs {
namespace {

TEST(Processor, HasTheInstructionSetsThatHighwayFinds) {
  std::vector<std::string> expected;
  for (const std::int64_t target : {HWY_AVX3_DL, HWY_AVX3, HWY_AVX2, HWY_SSE4, HWY_SSSE3, HWY_NEON}) {
    if ((HWY_TARGETS & target & hwy::SupportedTargets()) != 0) expected.emplace_back(hwy::TargetName(target));
  }
  // After them come the one that every processor of this kind has, unless it is among them, and the scalar one.
  const std::vector<std::string> offered(instructionSets().begin(), instructionSets().end());
  ASSERT_LE(expected.size(), offered.size());
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), offered.begin()));
  EXPECT_LE(offered.size(), expected.size() + 2);
  EXPECT_EQ(offered.back(), "SCALAR");
}

TEST(Processor, HasKernelsOfEachNameThatItOffersAndNoOthers) {
  std::vector<std::string_view> names(instructionSets().begin(), instructionSets().end());
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(engine::findKernels(""), engine::findKernels(names.front()));
  for (const std::string_view name : names) {
    const engine::Kernels* const found = engine::findKernels(name);
    ASSERT_NE(found, nullptr) << name;
    EXPECT_EQ(found->name, name);
  }
  EXPECT_EQ(engine::findKernels("none"), nullptr);
  EXPECT_EQ(engine::findKernels(names.front().substr(1)), nullptr);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());  // each once
}

}  // namespace
}  // namespace allpairs
