// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "LaneReader.h"
#include "PairSort.h"

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

TEST(PairSort, SortsSparseAndDensePairsByEitherIndex) {
  std::mt19937 generator(3);
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{50}, std::size_t{200000}}) {
    for (const std::uint32_t keys : {1U, 40U, 5000U, 3000000U}) {
      std::vector<Pair> expected(size);
      for (Pair& pair : expected) {
        pair = {static_cast<std::uint32_t>(generator() % keys), static_cast<std::uint32_t>(generator() % keys)};
      }
      for (const Order order : {Order::ByFirst, Order::BySecond}) {
        std::vector<Pair> pairs = expected;
        std::vector<Pair> spare(generator() % 2 == 0 ? size : 0);
        SerialExecutor serial;
        PairSort().sort(pairs, {keys, keys, order, spare}, serial);
        std::vector<Pair> sorted = expected;
        std::sort(sorted.begin(), sorted.end(), [&](Pair a, Pair b) {
          return order == Order::ByFirst ? a < b : Pair{a.second, a.first} < Pair{b.second, b.first};
        });
        ASSERT_TRUE(sorted == pairs) << size << ' ' << keys;
      }
    }
  }
}

}  // namespace
}  // namespace allpairs::engine
