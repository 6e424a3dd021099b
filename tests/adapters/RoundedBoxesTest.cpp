// SPDX-License-Identifier: MIT
#include "allpairs/objects/RoundedBoxes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace allpairs::test {
namespace {

using Row = std::array<double, 6>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool overlap(const Row& a, const Row& b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a[axis] > b[3 + axis] || b[axis] > a[3 + axis]) return false;
  }
  return true;
}

double distance(const Row& a, const Row& b) {
  double square = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::fmax(0.0, std::fmax(a[axis] - b[3 + axis], b[axis] - a[3 + axis]));
    square += gap * gap;
  }
  return std::sqrt(square);
}

/// A box of about unit size within some range of an origin; one in ten is flat, and lies on a face of others.
Row anyBox(std::mt19937& random, double origin, double range) {
  std::uniform_real_distribution<double> place(-range, range);
  const bool isFlat = random() % 10 == 0;
  Row row{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    row[axis] = origin + (isFlat ? std::floor(place(random)) : place(random));
    row[3 + axis] = row[axis] + (isFlat ? 0.0 : 1.0 + place(random) / (2.0 * range));
  }
  return row;
}

class RoundedBoxesOf : public testing::TestWithParam<std::size_t> {};

TEST_P(RoundedBoxesOf, OverlapWhereTheBoxesDoAndSeldomElse) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  for (const double origin : {0.0, 1e7, -3e20}) {
    RoundedBoxes boxes;
    std::vector<Row> rows;
    for (std::size_t i = 0; i < GetParam(); ++i) {
      rows.push_back(anyBox(random, origin, 4.0));
      boxes.set(static_cast<BoxId>(i), rows.back().data());
    }
    ASSERT_EQ(boxes.size(), rows.size());
    std::size_t overlapping = 0;
    std::size_t found = 0;
    for (int query = 0; query < 100; ++query) {
      const Row box = anyBox(random, origin, 5.0);
      for (std::size_t i = 0; i < (rows.size() + 63) / 64 * 64; ++i) {
        const std::uint64_t bits = boxes.mayOverlap(i / 64, RoundedBoxes::rounded(box.data()));
        const bool isFound = (bits >> (i % 64) & 1U) != 0;
        const bool isExpected = i < rows.size() && overlap(rows[i], box);
        ASSERT_TRUE(isFound || !isExpected) << "box " << i << " of " << rows.size();
        ASSERT_TRUE(i < rows.size() || !isFound) << "box " << i << " of " << rows.size();
        overlapping += isExpected ? 1U : 0U;
        found += isFound ? 1U : 0U;
      }
    }
    if (origin == 0.0) {
      EXPECT_EQ(found, overlapping);  // no two bounds here are one when they are rounded
    }
  }
}

TEST_P(RoundedBoxesOf, TheNearestIsAsNearAsAnyButForTheRounding) {
  std::mt19937 random(static_cast<unsigned>(GetParam()) + 1);
  RoundedBoxes boxes;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < GetParam(); ++i) {
    rows.push_back(anyBox(random, 0.0, 20.0));
    boxes.set(static_cast<BoxId>(i), rows.back().data());
  }
  for (int query = 0; query < 100; ++query) {
    const Row box = anyBox(random, 0.0, 30.0);
    double least = kInfinity;
    for (const Row& row : rows) least = std::fmin(least, distance(row, box));
    const BoxId nearest = boxes.nearest(RoundedBoxes::rounded(box.data()));
    if (rows.empty()) {
      ASSERT_EQ(nearest, kNoBox);
      continue;
    }
    ASSERT_LT(nearest, rows.size());
    ASSERT_LE(distance(rows[nearest], box), 1.001 * least + 1e-5);
  }
}

TEST_P(RoundedBoxesOf, TheNearestOfTheOthersIsNeverTheOneItself) {
  std::mt19937 random(static_cast<unsigned>(GetParam()) + 2);
  RoundedBoxes boxes;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < GetParam(); ++i) {
    rows.push_back(anyBox(random, 0.0, 20.0));
    boxes.set(static_cast<BoxId>(i), rows.back().data());
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double least = kInfinity;
    for (std::size_t j = 0; j < rows.size(); ++j) {
      if (j != i) least = std::fmin(least, distance(rows[j], rows[i]));
    }
    const BoxId nearest = boxes.nearest(RoundedBoxes::rounded(rows[i].data()), static_cast<BoxId>(i));
    if (rows.size() == 1) {
      ASSERT_EQ(nearest, kNoBox);
      continue;
    }
    ASSERT_NE(nearest, i);
    ASSERT_LT(nearest, rows.size());
    ASSERT_LE(distance(rows[nearest], rows[i]), 1.001 * least + 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Numbers, RoundedBoxesOf,
                         testing::Values(0, 1, 2, 3, 4, 5, 31, 32, 33, 63, 64, 65, 127, 130, 300));

TEST(RoundedBoxes, ThatHaveNoBoundsYetAndEmptyOnesAreOverlappedByEverythingOnly) {
  RoundedBoxes boxes;
  const Row unit{0, 0, 0, 1, 1, 1};
  boxes.set(5, unit.data());
  boxes.set(6, Row{kInfinity, kInfinity, kInfinity, -kInfinity, -kInfinity, -kInfinity}.data());
  EXPECT_EQ(boxes.size(), 7U);
  EXPECT_EQ(boxes.mayOverlap(0, {-1e30F, -1e30F, -1e30F, 1e30F, 1e30F, 1e30F}), 1U << 5U);
  constexpr float kAll = std::numeric_limits<float>::infinity();
  EXPECT_EQ(boxes.mayOverlap(0, {-kAll, -kAll, -kAll, kAll, kAll, kAll}), 0x7FU);
  EXPECT_EQ(boxes.nearest({7, 7, 7, 8, 8, 8}), 5U);
}

TEST(RoundedBoxes, KeepTheirBoundsWhenMoreCome) {
  RoundedBoxes boxes;
  for (BoxId i = 0; i < 1000; ++i) {
    const double at = 10.0 * i;
    boxes.set(i, Row{at, at, at, at + 1, at + 1, at + 1}.data());
  }
  for (BoxId i = 0; i < 1000; ++i) {
    const float at = 10.0F * static_cast<float>(i);
    ASSERT_EQ(boxes.mayOverlap(i / 64, {at, at, at, at, at, at}), std::uint64_t{1} << (i % 64));
    ASSERT_EQ(boxes.nearest({at, at, at, at, at, at}), i);
  }
}

TEST(RoundedBoxes, NoneIsNearABoxToInfinityThatIsNotThereOrEmpty) {
  constexpr float kAll = std::numeric_limits<float>::infinity();
  for (BoxId size = 1; size < 70; ++size) {
    RoundedBoxes boxes;
    for (BoxId i = 0; i < size; ++i) {
      const double at = 10.0 * i;
      boxes.set(i, Row{at, at, at, at + 1, at + 1, at + 1}.data());
    }
    boxes.set(size / 2, Row{kInfinity, kInfinity, kInfinity, -kInfinity, -kInfinity, -kInfinity}.data());
    for (const RoundedBoxes::Row& query : {RoundedBoxes::Row{-kAll, -kAll, -kAll, kAll, kAll, kAll},
                                           RoundedBoxes::Row{-kAll, -kAll, -kAll, kAll, kAll, -1}}) {
      const BoxId nearest = boxes.nearest(query);
      if (size == 1) {
        ASSERT_EQ(nearest, kNoBox);
        continue;
      }
      ASSERT_LT(nearest, size);
      ASSERT_NE(nearest, size / 2);
    }
  }
}

TEST(RoundedBoxes, NoneIsNearWhatIsInfinitelyFarAway) {
  RoundedBoxes boxes;
  boxes.set(0, Row{0, 0, 0, 1, 1, 1}.data());
  constexpr float kFar = std::numeric_limits<float>::infinity();
  EXPECT_EQ(boxes.nearest({kFar, 0, 0, kFar, 1, 1}), kNoBox);
  EXPECT_EQ(boxes.nearest({3e38F, 0, 0, 3e38F, 1, 1}), kNoBox);  // the square of its distance is infinite
  boxes.clear();
  EXPECT_EQ(boxes.nearest({0, 0, 0, 1, 1, 1}), kNoBox);
  EXPECT_EQ(boxes.size(), 0U);
}

}  // namespace
}  // namespace allpairs::test
