// SPDX-License-Identifier: MIT
#include "allpairs/BoxView.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/World.h"
#include "support/Boxes.h"
#include "support/Numbers.h"

namespace allpairs {
namespace {

using test::cube;
using ::testing::HasSubstr;

using test::kInfinity;
using test::kNan;

const std::vector<Box> kTwo{{{1, 2, 3}, {4, 5, 6}}, {{-1, -2, -3}, {7, 8, 9}}};

void expectTwo(const BoxView& set) {
  ASSERT_EQ(set.size(), 2U);
  EXPECT_EQ(set[0], kTwo[0]);
  EXPECT_EQ(set[1], kTwo[1]);
}

TEST(BoxView, IsTheSameFromBoxesRowsCornersAndStrides) {
  const std::vector<double> rows{1, 2, 3, 4, 5, 6, -1, -2, -3, 7, 8, 9};
  const std::vector<double> min{1, 2, 3, -1, -2, -3};
  const std::vector<double> max{4, 5, 6, 7, 8, 9};
  const std::vector<double> columns{1, -1, 2, -2, 3, -3, 4, 7, 5, 8, 6, 9};
  expectTwo(BoxView(kTwo));
  expectTwo(BoxView::fromRows(rows));
  expectTwo(BoxView::fromCorners(min, max));
  expectTwo(BoxView::fromStrided(2, CornerView<double>{columns.data(), 1, 2}, {columns.data() + 6, 1, 2}));
  const std::vector<float> rowsF(rows.begin(), rows.end());
  const std::vector<float> minF(min.begin(), min.end());
  const std::vector<float> maxF(max.begin(), max.end());
  expectTwo(BoxView::fromRows(rowsF));
  expectTwo(BoxView::fromCorners(minF, maxF));
}

TEST(BoxView, KnowsTheBoundsOfItsMargins) {
  BoxView set(kTwo);
  const auto expectMargins = [&](double first, double second, double least, double greatest) {
    EXPECT_EQ(set.margin(0), first);
    EXPECT_EQ(set.margin(1), second);
    EXPECT_EQ(set.leastMargin(), least);
    EXPECT_EQ(set.greatestMargin(), greatest);
  };
  expectMargins(0, 0, 0, 0);
  set.setMargin(-2);
  expectMargins(-2, -2, -2, -2);
  const std::vector<double> margins{3, -1};
  set.setMargins(margins);
  expectMargins(3, -1, -1, 3);
  set = set.slice(0, 2);
  set.setMargin(0.5);
  expectMargins(0.5, 0.5, 0.5, 0.5);
  set.setMargins(margins);
  set.setMargins({});
  expectMargins(0.5, 0.5, 0.5, 0.5);
}

TEST(BoxView, HasMarginsWhereOneIsNotZero) {
  const std::vector<BoxF> boxes(2, BoxF{{0, 0, 0}, {1, 1, 1}});
  BoxView set(boxes);
  EXPECT_FALSE(set.hasMargins());
  const std::vector<double> none{0.0, -0.0};
  set.setMargins(none);
  EXPECT_FALSE(set.hasMargins());
  World world;
  EXPECT_EQ(world.add(set).size(), 2U);
  const std::vector<double> one{0.0, -1e-300};
  set.setMargins(one);
  EXPECT_TRUE(set.hasMargins());
  EXPECT_THROW(static_cast<void>(world.add(set)), InvalidArgument);
}

TEST(BoxView, ReadsBackwardWithNegativeStrides) {
  const std::vector<double> rows{-1, -2, -3, 7, 8, 9, 1, 2, 3, 4, 5, 6};
  expectTwo(BoxView::fromStrided(2, CornerView<double>{rows.data() + 6, -6, 1}, {rows.data() + 9, -6, 1}));
}

TEST(BoxView, NamesTheBoxAndTheBoundThatIsNan) {
  std::vector<Box> boxes(5, cube(0, 0, 0));
  boxes[3].max[1] = kNan;
  try {
    const BoxView set(boxes);
    FAIL() << "a NaN was taken";
  } catch (const InvalidBox& error) {
    EXPECT_EQ(error.index(), 3U);
    EXPECT_STREQ(error.what(), "box 3: max y is not a number (NaN)");
    EXPECT_EQ(error.messageOf(5'000'000'000), "box 5000000000: max y is not a number (NaN)");
  }
}

TEST(BoxView, FindsANanInEachOfTheSixBoundsInBothPrecisions) {
  for (std::size_t bound = 0; bound < 6; ++bound) {
    std::array<double, 6> row{0, 0, 0, 1, 1, 1};
    row[bound] = kNan;
    std::array<float, 6> rowF{0, 0, 0, 1, 1, 1};
    rowF[bound] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(static_cast<void>(BoxView::fromRows(row)), InvalidBox) << bound;
    EXPECT_THROW(static_cast<void>(BoxView::fromRows(rowF)), InvalidBox) << bound;
  }
}

TEST(BoxView, FindsANanHoweverBoxesLieInMemory) {
  struct Strides {
    std::ptrdiff_t box;
    std::ptrdiff_t axis;
  };
  for (const auto& [box, axis] : {Strides{3, 1}, Strides{1, 5}, Strides{4, 1}, Strides{3, 16}}) {
    for (std::ptrdiff_t bound = 0; bound < 6; ++bound) {
      std::vector<double> values(96, 0.0);
      const std::ptrdiff_t corner = bound < 3 ? 0 : 48;
      values[static_cast<std::size_t>(corner + box + bound % 3 * axis)] = kNan;
      try {
        static_cast<void>(
            BoxView::fromStrided(2, CornerView<double>{values.data(), box, axis}, {values.data() + 48, box, axis}));
        ADD_FAILURE() << "a NaN was taken: " << box << ", " << axis << ", " << bound;
      } catch (const InvalidBox& error) {
        EXPECT_EQ(error.index(), 1U) << box << ", " << axis << ", " << bound;
      }
    }
  }
}

TEST(BoxView, TakesInfiniteAndEmptyBoxes) {
  const std::vector<Box> boxes{{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}}, kEmptyBox};
  EXPECT_EQ(BoxView(boxes).size(), 2U);
}

TEST(BoxView, RefusesSpansThatAreNoWholeNumberOfRows) {
  const std::vector<double> seven(7);
  const std::vector<double> six(6);
  const std::vector<double> three(3);
  EXPECT_THROW(static_cast<void>(BoxView::fromRows(seven)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(BoxView::fromCorners(six, three)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(BoxView::fromCorners(seven, seven)), InvalidArgument);
}

TEST(BoxView, RefusesCornersThatAreNotInMemory) {
  const double one = 0.0;
  const CornerView<double> there{&one, 0, 0};
  EXPECT_THROW(static_cast<void>(BoxView::fromStrided(1, CornerView<double>{}, there)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(BoxView::fromStrided(1, there, CornerView<double>{})), InvalidArgument);
  EXPECT_EQ(BoxView::fromStrided(0, CornerView<float>{}, CornerView<float>{}).size(), 0U);
}

TEST(BoxView, RefusesMoreBoxesThanAnIndexCanNumber) {
  const float one = 0.0F;
  const CornerView<float> sameForAll{&one, 0, 0};
  EXPECT_THROW(static_cast<void>(BoxView::fromStrided(std::size_t{1} << 32, sameForAll, sameForAll)), InvalidArgument);
}

TEST(BoxView, NamesTheBoxOfABadMargin) {
  BoxView set(kTwo);
  const std::vector<double> good{0.5, -0.25};
  set.setMargins(good);
  EXPECT_EQ(set.margin(0), 0.5);
  EXPECT_EQ(set.margin(1), -0.25);
  const std::vector<double> bad{0.0, kNan};
  const std::vector<double> tooMany(3);
  try {
    set.setMargins(bad);
    FAIL() << "a NaN was taken";
  } catch (const InvalidBox& error) {
    EXPECT_EQ(error.index(), 1U);
  }
  EXPECT_THROW(set.setMargins(tooMany), InvalidArgument);
  EXPECT_THROW(set.setMargin(kNan), InvalidArgument);
  EXPECT_THROW(set.setMargin(-kInfinity), InvalidArgument);
}

TEST(BoxView, SlicesKeepBoxesAndMargins) {
  std::vector<Box> boxes;
  std::vector<double> margins;
  for (int i = 0; i < 10; ++i) {
    boxes.push_back(cube(i, 0, 0));
    margins.push_back(i);
  }
  BoxView set(boxes);
  set.setMargins(margins);
  const BoxView part = set.slice(3, 7);
  ASSERT_EQ(part.size(), 4U);
  EXPECT_EQ(part[0], boxes[3]);
  EXPECT_EQ(part.margin(3), 6.0);
  EXPECT_THROW(static_cast<void>(set.slice(3, 11)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(set.slice(4, 3)), InvalidArgument);
}

}  // namespace
}  // namespace allpairs
