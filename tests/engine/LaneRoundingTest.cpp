// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "kernels/Lanes.h"

namespace allpairs::engine {
namespace {

std::vector<double> awkwardDoubles() {
  std::vector<double> values{0.0,    -0.0, 1.0,    0.1,     -0.1,  1e-45,  -1e-45,     5e-324,     -5e-324,
                             1e-310, 1e38, 3.5e38, -3.5e38, 1e300, -1e300, 16777217.0, -16777217.0};
  values.push_back(std::numeric_limits<double>::infinity());
  values.push_back(-std::numeric_limits<double>::infinity());
  std::mt19937_64 generator(7);
  while (values.size() < 20000) {
    const auto value = std::bit_cast<double>(generator());
    if (!std::isnan(value)) values.push_back(value);
    const auto near = static_cast<float>(static_cast<double>(generator() % 2000000) * 1e-3 - 1000.0);
    values.push_back(static_cast<double>(near));
    values.push_back(std::nextafter(static_cast<double>(near), 1e9));
    values.push_back(std::nextafter(static_cast<double>(near), -1e9));
  }
  return values;
}

TEST(LaneRounding, RoundsToTheNearestFloat32OnTheRightSide) {
  for (const double value : awkwardDoubles()) {
    const double down = static_cast<double>(roundDown(value));
    const double up = static_cast<double>(roundUp(value));
    if (std::abs(value) > static_cast<double>(kLaneMax)) {
      EXPECT_EQ(std::abs(down), static_cast<double>(kLaneMax)) << value;
      EXPECT_EQ(down, up) << value;
      continue;
    }
    ASSERT_LE(down, value);
    ASSERT_GE(up, value);
    const double next = static_cast<double>(std::nextafter(static_cast<float>(down), kNever));
    ASSERT_TRUE(down == value || next > value) << value;
    ASSERT_TRUE(up == value ? down == value : up == next) << value;
  }
}

TEST(LaneRounding, ANanBecomesTheWidestBound) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(roundDown(nan), -kLaneMax);
  EXPECT_EQ(roundUp(nan), kLaneMax);
}

TEST(LaneList, HasNoMoreTilesThanItsBoxesTake) {
  EXPECT_EQ(LaneList::tilesFor(0), 0U);
  for (std::size_t size = 1; size <= 4 * LaneTile::kCapacity; ++size) {
    const std::size_t tiles = LaneList::tilesFor(size);
    ASSERT_GE(tiles * LaneTile::kCapacity, size);
    ASSERT_LT((tiles - 1) * LaneTile::kCapacity, size);
  }
}

}  // namespace
}  // namespace allpairs::engine
