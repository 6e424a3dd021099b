// SPDX-License-Identifier: MIT
// The instruction sets that the engine offers, against those that Highway finds by asking the processor itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "allpairs/Overlaps.h"
#include "hwy/highway.h"

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

}  // namespace
}  // namespace allpairs
