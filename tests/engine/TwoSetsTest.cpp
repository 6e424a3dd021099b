// SPDX-License-Identifier: MIT
// Two sets that meet in a part of space only: boxes outside of it are left out before the search.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "allpairs/Overlaps.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "support/Boxes.h"
#include "support/Numbers.h"
#include "support/Oracle.h"
#include "support/Sanitizers.h"
#include "support/Strategies.h"

namespace allpairs {
namespace {

/// Boxes that fill a cube of the given side, at an offset in x.
std::vector<Box> boxesIn(std::size_t n, unsigned seed, double side, double offset) {
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(n, seed));
  double reach = 0.0;
  for (const Box& box : boxes) reach = std::max(reach, box.max[0]);
  for (Box& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] *= side / reach;
      box.max[axis] *= side / reach;
    }
    box.min[0] += offset;
    box.max[0] += offset;
  }
  return boxes;
}

std::vector<BoxF> inFloat(const std::vector<Box>& boxes) {
  std::vector<BoxF> result(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result[i].min[axis] = static_cast<float>(boxes[i].min[axis]);
      result[i].max[axis] = static_cast<float>(boxes[i].max[axis]);
    }
  }
  return result;
}

/// Both sets of a test, of which the larger is at least `kMet` boxes.
struct Meeting {
  std::vector<Box> first;
  std::vector<Box> second;
};

constexpr std::size_t kMany = 3000;

/// Double loops take most of the time; several threads search no fewer than 2,048.
constexpr std::size_t kMet = test::kIsSanitized ? 2100 : kMany;

std::vector<Meeting> meetings() {
  std::vector<Meeting> all{
      {boxesIn(kMet, 1, 20, 0), boxesIn(1, 2, 1, 7)},
      {boxesIn(1, 3, 2, 7), boxesIn(kMet, 4, 20, 0)},
      {boxesIn(kMet, 5, 20, 0), boxesIn(200, 6, 3, 9)},
      {boxesIn(1100, 7, 5, 3), boxesIn(kMet, 8, 20, 0)},
      {boxesIn(kMet, 9, 20, 0), boxesIn(kMet, 10, 20, 19)},   // meet at a face
      {boxesIn(kMet, 11, 20, 0), boxesIn(kMet, 12, 20, 40)},  // nowhere
      {boxesIn(kMet, 13, 20, 0), boxesIn(kMet, 14, 20, 0)},   // everywhere
      {boxesIn(kMet, 15, 20, 0), std::vector<Box>(3, kEmptyBox)},
      {boxesIn(kMet, 16, 20, 0), boxesIn(60, 17, 20, 0)},    // few that lie everywhere
      {boxesIn(kMet, 18, 15, 1), boxesIn(kMet, 19, 20, 0)},  // also in a part of space
  };
  all.back().first.resize(12);
  // Empty boxes have no say in what the bounds are, and infinite ones have.
  std::swap(all[2].second[5].min[1], all[2].second[5].max[1]);
  all[2].second[6] = kEmptyBox;
  all[3].first[17] = {{-test::kInfinity, 0, 0}, {test::kInfinity, 0.5, 0.5}};
  std::swap(all[4].first[17].min[2], all[4].first[17].max[2]);
  return all;
}

TEST(TwoSets, ThatMeetAnywhereGiveTheOraclesPairs) {
  for (const Meeting& meeting : meetings()) {
    const std::vector<Pair> expected = test::oracleBetween(meeting.first, meeting.second);
    for (const Strategy strategy : test::kStrategies) {
      OverlapOptions options;
      options.strategy = strategy;
      ASSERT_EQ(overlaps(meeting.first, meeting.second, options), expected);
      ASSERT_EQ(countOverlaps(meeting.first, meeting.second, options), expected.size());
      options.order = Order::BySecond;
      std::vector<Pair> bySecond = overlaps(meeting.first, meeting.second, options);
      ASSERT_TRUE(std::is_sorted(bySecond.begin(), bySecond.end(), test::isLessBySecond));
      std::sort(bySecond.begin(), bySecond.end());
      ASSERT_EQ(bySecond, expected);
    }
  }
}

TEST(TwoSets, InFloat32AndOnManyThreadsToo) {
  parallel::TbbExecutor threads(4);
  OverlapOptions options;
  options.executor = &threads;
  OverlapSearch search(options);
  for (const Meeting& meeting : meetings()) {
    const std::vector<BoxF> first = inFloat(meeting.first);
    const std::vector<BoxF> second = inFloat(meeting.second);
    const std::vector<Pair> expected = test::oracleBetween(test::toDouble(first), test::toDouble(second));
    ASSERT_EQ(test::toVector(search.find(first, second)), expected);
    ASSERT_EQ(search.count(first, second), expected.size());
  }
}

TEST(TwoSets, AsTwoArraysFarFromTheOriginOrOfTwoPrecisionsToo) {
  for (Meeting meeting : meetings()) {
    const std::vector<BoxF> firstInFloat = inFloat(meeting.first);
    const std::vector<BoxF> secondInFloat = inFloat(meeting.second);
    ASSERT_EQ(overlaps(firstInFloat, meeting.second),
              test::oracleBetween(test::toDouble(firstInFloat), meeting.second));
    ASSERT_EQ(overlaps(meeting.first, secondInFloat),
              test::oracleBetween(meeting.first, test::toDouble(secondInFloat)));
    std::vector<double> corners[4];
    for (std::vector<Box>* const set : {&meeting.first, &meeting.second}) {
      const std::size_t at = set == &meeting.first ? 0 : 2;
      for (Box& box : *set) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          corners[at].push_back(box.min[axis] += 1e7);
          corners[at + 1].push_back(box.max[axis] += 1e7);
        }
      }
    }
    const std::vector<Pair> expected = test::oracleBetween(meeting.first, meeting.second);
    ASSERT_EQ(overlaps(meeting.first, meeting.second), expected);
    ASSERT_EQ(overlaps(BoxView::fromCorners(corners[0], corners[1]), BoxView::fromCorners(corners[2], corners[3])),
              expected);
  }
}

TEST(TwoSets, AreWidenedByTheDistanceAndTheirMarginsBeforeBoxesAreLeftOut) {
  const std::vector<Box> first = boxesIn(kMany, 21, 20, 0);
  const std::vector<Box> second = boxesIn(300, 22, 3, 21.5);
  ASSERT_TRUE(test::oracleBetween(first, second).empty());
  OverlapOptions options;
  options.distance = 2.0;
  const std::vector<Pair> expected = test::oracleBetween(first, second, 2.0);
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(overlaps(first, second, options), expected);
  EXPECT_EQ(overlaps(second, first, options).size(), expected.size());
  BoxView widened(second);
  widened.setMargin(2.0);
  EXPECT_EQ(overlaps(first, widened), expected);
  widened.setMargin(0.5);
  BoxView alsoWidened(first);
  const std::vector<double> margins(first.size(), 1.5);
  alsoWidened.setMargins(margins);
  EXPECT_EQ(overlaps(alsoWidened, widened), expected);
}

TEST(TwoSets, AreFilteredByTheIdsThatBoxesHaveInTheirSets) {
  const std::vector<Box> first = boxesIn(kMany, 31, 20, 0);
  const std::vector<Box> second = boxesIn(400, 32, 3, 9);
  std::vector<std::uint32_t> groups(first.size());
  for (std::size_t i = 0; i < groups.size(); ++i) groups[i] = static_cast<std::uint32_t>(1 + i % 3);
  const std::vector<std::uint32_t> others(second.size(), 2);
  std::vector<Pair> expected;
  for (const Pair pair : test::oracleBetween(first, second)) {
    if (groups[pair.first] != 2) expected.push_back(pair);
  }
  ASSERT_FALSE(expected.empty());
  OverlapOptions options;
  options.filter.first.groups = groups;
  options.filter.second.groups = others;
  EXPECT_EQ(overlaps(first, second, options), expected);
}

/// Boxes of any form: `flat` of three axes have no width and one place for all.
std::vector<Box> boxesOfAnyForm(std::size_t n, std::mt19937& random, std::size_t flat, double length) {
  std::uniform_real_distribution<double> uniform;
  std::vector<Box> boxes(n);
  for (Box& box : boxes) {
    // Some are much longer than most.
    const double longest = length * (uniform(random) < 0.05 ? 30.0 : 1.0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double place = axis < flat ? 0.5 : uniform(random);
      box.min[axis] = place;
      box.max[axis] = axis < flat ? place : place + longest * uniform(random);
    }
    if (uniform(random) < 0.02) std::swap(box.min[2], box.max[2]);
  }
  return boxes;
}

TEST(TwoSets, OfWhichFewLieAmongManyGiveTheOraclesPairs) {
  std::mt19937 random(51);
  for (int round = 0; round < (test::kIsSanitized ? 30 : 60); ++round) {
    const std::size_t n = 1100 + random() % 2000;
    const std::size_t m = 9 + random() % (n / 32 - 8);
    const std::size_t flat = random() % 4;
    std::vector<Box> many = boxesOfAnyForm(n, random, flat, 0.01 + 0.05 * static_cast<double>(random() % 3));
    std::vector<Box> few = boxesOfAnyForm(m, random, random() % 2 == 0 ? flat : 0, 0.02);
    if (round % 7 == 0) few[random() % m] = {{-test::kInfinity, 0, 0}, {test::kInfinity, 0.1, 0.1}};
    if (round % 5 == 0) many[random() % n] = {{-1e300, 0, 0}, {1e300, 1, 1}};
    const double distance = round % 4 == 3 ? 0.01 : 0.0;
    OverlapOptions options;
    options.distance = distance;
    ASSERT_EQ(overlaps(many, few, options), test::oracleBetween(many, few, distance)) << "round " << round;
    ASSERT_EQ(overlaps(few, many, options), test::oracleBetween(few, many, distance)) << "round " << round;
    const std::vector<BoxF> manyInFloat = inFloat(many);
    const std::vector<BoxF> fewInFloat = inFloat(few);
    ASSERT_EQ(overlaps(manyInFloat, fewInFloat),
              test::oracleBetween(test::toDouble(manyInFloat), test::toDouble(fewInFloat)))
        << "round " << round;
  }
}

TEST(TwoSets, OfWhichFewLieAmongManyNeedFewTests) {
  std::mt19937 random(52);
  const std::vector<Box> many = boxesOfAnyForm(kMany, random, 0, 0.01);
  const std::vector<Box> few = boxesOfAnyForm(20, random, 0, 0.01);
  OverlapSearch search;
  EXPECT_EQ(test::toVector(search.find(many, few)), test::oracleBetween(many, few));
  EXPECT_LT(search.statistics().boxTests, kMany * 20 / 8);
}

TEST(TwoSets, ThatMeetInASmallPartOfSpaceNeedFewTests) {
  const std::vector<Box> first = boxesIn(kMany, 41, 20, 0);
  const std::vector<Box> second = boxesIn(20, 42, 1, 9);
  OverlapSearch search;
  EXPECT_EQ(test::toVector(search.find(first, second)), test::oracleBetween(first, second));
  EXPECT_LT(search.statistics().boxTests, kMany * 20 / 50);
}

}  // namespace
}  // namespace allpairs
