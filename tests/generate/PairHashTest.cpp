// SPDX-License-Identifier: MIT
#include "PairHash.h"

#include <gtest/gtest.h>

namespace {

using allpairs::Pair;
using allpairs::measure::hashOfPairs;
using allpairs::measure::hexadecimal;
using allpairs::measure::normalised;

TEST(PairHash, OfNoPairsIsTheOffsetOfFnv1a) { EXPECT_EQ(hexadecimal(hashOfPairs({})), "cbf29ce484222325"); }

// python3: functools.reduce(lambda h, b: (h ^ b) * 0x100000001b3 % 2**64, struct.pack('<4I', 0, 1, 2, 66051), offset)
TEST(PairHash, IsFnv1aOverTheLittleEndianBytesOfThePairs) {
  const std::vector<Pair> pairs{{0, 1}, {2, 66051}};
  EXPECT_EQ(hexadecimal(hashOfPairs(pairs)), "1f812222bc0722e6");
}

TEST(PairHash, DependsOnTheOrderOfThePairs) {
  const std::vector<Pair> pairs{{0, 1}, {0, 2}};
  const std::vector<Pair> reversed{{0, 2}, {0, 1}};
  EXPECT_NE(hashOfPairs(pairs), hashOfPairs(reversed));
}

TEST(PairHash, NormalisedPairsAreInOrderAndOrientedUpwards) {
  const std::vector<Pair> pairs{{7, 3}, {1, 2}, {2, 0}, {3, 9}};
  const std::vector<Pair> expected{{0, 2}, {1, 2}, {3, 7}, {3, 9}};
  EXPECT_EQ(normalised(pairs), expected);
}

}  // namespace
