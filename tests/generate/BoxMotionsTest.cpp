// SPDX-License-Identifier: MIT
#include "allpairs/generate/BoxMotions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "allpairs/Error.h"

namespace {

using allpairs::generate::boxMotions;
using allpairs::generate::MotionFrames;
using allpairs::generate::MotionRequest;

using Rows = std::vector<float>;

std::vector<Rows> framesOf(const MotionRequest& request, std::size_t count) {
  MotionFrames motion(request);
  std::vector<Rows> frames;
  for (std::size_t i = 0; i < count; ++i) {
    const auto rows = motion.next();
    frames.emplace_back(rows.begin(), rows.end());
  }
  return frames;
}

/// FNV-1a over the bits of the numbers, lowest byte first.
std::uint64_t hashOf(const std::vector<Rows>& frames) {
  std::uint64_t hash = 14695981039346656037U;
  for (const Rows& rows : frames) {
    for (const float value : rows) {
      const auto bits = std::bit_cast<std::uint32_t>(value);
      for (unsigned shift = 0; shift < 32; shift += 8) hash = (hash ^ (bits >> shift & 0xFFU)) * 1099511628211U;
    }
  }
  return hash;
}

std::size_t pairsIn(const Rows& rows) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < rows.size(); i += 6) {
    for (std::size_t j = 0; j < i; j += 6) {
      bool apart = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        apart |= rows[i + axis] > rows[j + 3 + axis] || rows[j + axis] > rows[i + 3 + axis];
      }
      count += apart ? 0 : 1;
    }
  }
  return count;
}

/// How far boxes move between two frames along an axis, on average, in sides of a box.
double meanMove(const Rows& from, const Rows& to, std::size_t axis) {
  double sum = 0.0;
  for (std::size_t i = axis; i < from.size(); i += 6) sum += std::abs(static_cast<double>(to[i] - from[i]));
  const double side = static_cast<double>(from[3] - from[0]);
  return sum / (side * static_cast<double>(from.size() / 6));
}

double meanHeight(const Rows& rows) {
  double sum = 0.0;
  for (std::size_t i = 2; i < rows.size(); i += 6) sum += static_cast<double>(rows[i]);
  return sum / static_cast<double>(rows.size() / 6);
}

class BoxMotions : public testing::TestWithParam<std::string> {};

TEST_P(BoxMotions, KeepEqualCubesThatFillATenthOfTheUnitCubeInIt) {
  const double side = std::cbrt(0.1 / 500);
  for (const Rows& rows : framesOf({GetParam(), 500, 3}, 700)) {
    ASSERT_EQ(rows.size(), 500U * 6U);
    for (std::size_t i = 0; i < rows.size(); i += 6) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        ASSERT_NEAR(static_cast<double>(rows[i + 3 + axis] - rows[i + axis]), side, 1e-6);
        ASSERT_GE(rows[i + axis], 0.0F);
        ASSERT_LE(rows[i + 3 + axis], 1.000001F);
      }
    }
  }
}

TEST_P(BoxMotions, AreTheSameForTheSameSeedAndOthersForAnother) {
  const auto frames = framesOf({GetParam(), 100, 5}, 40);
  EXPECT_EQ(framesOf({GetParam(), 100, 5}, 40), frames);
  EXPECT_NE(framesOf({GetParam(), 100, 6}, 40), frames);
}

TEST_P(BoxMotions, NeverCrowdABoxWithMoreThanAFewOthers) {
  const auto frames = framesOf({GetParam(), 1000, 2}, 1000);
  for (std::size_t i = 0; i < frames.size(); i += 50) EXPECT_LE(pairsIn(frames[i]), 6000U) << "frame " << i;
}

INSTANTIATE_TEST_SUITE_P(All, BoxMotions, testing::Values("brownian", "free-fall", "rotating-gravity"));

TEST(BoxMotionNames, AreTheThreeThatAreTested) {
  std::vector<std::string> names;
  for (const auto& motion : boxMotions()) names.emplace_back(motion.name);
  EXPECT_EQ(names, (std::vector<std::string>{"brownian", "free-fall", "rotating-gravity"}));
}

TEST(Brownian, MovesBoxesByATenthOfTheirSideAFrame) {
  const auto frames = framesOf({"brownian", 2000, 1}, 3);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(meanMove(frames[1], frames[2], axis), 0.1, 0.01);
}

TEST(FreeFall, SettlesOnTheFloorAndStaysThere) {
  const auto frames = framesOf({"free-fall", 1000, 1}, 1000);
  EXPECT_NEAR(meanHeight(frames.front()), 0.5, 0.05);
  EXPECT_LT(meanHeight(frames.back()), 0.15);
  EXPECT_EQ(frames[998], frames[999]);
}

TEST(RotatingGravity, NeverLetsBoxesRest) {
  const auto frames = framesOf({"rotating-gravity", 1000, 1}, 1000);
  for (std::size_t i = 100; i + 1 < frames.size(); i += 100) {
    EXPECT_GT(meanMove(frames[i], frames[i + 1], 0) + meanMove(frames[i], frames[i + 1], 2), 0.001) << "frame " << i;
  }
}

TEST(MotionFrames, AreTheSameBytesOnEveryMachine) {
  EXPECT_EQ(hashOf(framesOf({"brownian", 50, 1}, 20)), 13228325543449364042U);
  EXPECT_EQ(hashOf(framesOf({"free-fall", 50, 1}, 600)), 6689024234085305091U);
  EXPECT_EQ(hashOf(framesOf({"rotating-gravity", 50, 1}, 600)), 753659006972243787U);
}

TEST(MotionFrames, OfAnUnknownMotionOrTooManyBoxesAreRefused) {
  EXPECT_THROW(MotionFrames({"still", 10, 1}), allpairs::InvalidArgument);
  EXPECT_THROW(MotionFrames({"brownian", std::size_t{1} << 32U, 1}), allpairs::InvalidArgument);
}

TEST(MotionFrames, OfNoBoxesAreEmpty) { EXPECT_TRUE(MotionFrames({"free-fall", 0, 1}).next().empty()); }

}  // namespace
