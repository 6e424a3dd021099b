// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "Clash.h"
#include "ClashPicture.h"
#include "Png.h"
#include "Raster.h"

namespace allpairs::test {
namespace {

using view::Colour;
using view::Raster;
using view::RasterPoint;

constexpr Colour kWhite{255, 255, 255};
constexpr Colour kRed{255, 0, 0};
constexpr Colour kBlue{0, 0, 255};

std::array<RasterPoint, 3> cornerTriangle(double depth) { return {{{0, 0, depth}, {9, 0, depth}, {0, 9, depth}}}; }

TEST(Raster, ATriangleFillsWhatItCoversAndNothingElse) {
  Raster raster(10, 10, kWhite);
  raster.triangle(cornerTriangle(1.0), kRed);
  for (std::size_t y = 0; y < 10; ++y) {
    for (std::size_t x = 0; x < 10; ++x) EXPECT_EQ(raster.at(x, y), x + y <= 9 ? kRed : kWhite) << x << ' ' << y;
  }
}

TEST(Raster, TheNearerTriangleIsSeenInEitherOrder) {
  Raster raster(10, 10, kWhite);
  raster.triangle(cornerTriangle(1.0), kRed);
  raster.triangle(cornerTriangle(2.0), kBlue);
  EXPECT_EQ(raster.at(1, 1), kRed);
  raster.triangle(cornerTriangle(0.5), kBlue);
  EXPECT_EQ(raster.at(1, 1), kBlue);
}

TEST(Raster, WhatLiesOutsideIsCutOff) {
  Raster raster(10, 10, kWhite);
  raster.triangle({{{-1e9, -1e9, 0}, {1e9, -1e9, 0}, {0, 1e9, 0}}}, kRed);
  raster.line({-1e12, 5, 0}, {1e12, 5, 0}, kBlue, 1.0);
  EXPECT_EQ(raster.at(0, 0), kRed);
  EXPECT_EQ(raster.at(9, 9), kRed);
  Raster empty(4, 4, kWhite);
  empty.triangle({{{std::numeric_limits<double>::quiet_NaN(), 0, 0}, {4, 0, 0}, {0, 4, 0}}}, kRed);
  EXPECT_EQ(empty.at(1, 1), kWhite);
}

TEST(Raster, HalvingTakesTheMean) {
  Raster raster(4, 2, kWhite);
  raster.triangle({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {0, 0, 0});
  const Raster half = raster.halved();
  EXPECT_EQ(half.width(), 2U);
  EXPECT_EQ(half.at(0, 0), (Colour{64, 64, 64}));  // three black of four
  EXPECT_EQ(half.at(1, 0), kWhite);
}

TEST(Png, BeginsWithItsMarkAndItsSize) {
  const std::string bytes = encodePng(Raster(300, 2, kRed));
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(bytes.substr(16, 8), (std::string{'\0', '\0', '\1', '\x2c', '\0', '\0', '\0', '\2'}));
}

view::ViewScene twoBoxes(const Box& a, const Box& b) {
  view::ViewScene scene;
  scene.modelCount = 2;
  scene.frames.push_back({.boxes = {a, b}, .flags = {7, 7}, .pairs = {{1, 0}}, .excluded = {}});
  return scene;
}

TEST(Picture, ShowsBothModelsAndWhatTheyShare) {
  const view::ViewScene scene = twoBoxes({{0, 0, 0}, {2, 2, 2}}, {{1, 1, 1}, {3, 3, 3}});
  const auto clashes = view::clashesOf(scene);
  const Raster picture = pictureOf(scene, clashes[0], cameraOf(scene, clashes[0]));
  std::size_t reds = 0;
  std::size_t blues = 0;
  std::size_t oranges = 0;
  for (std::size_t y = 0; y < picture.height(); ++y) {
    for (std::size_t x = 0; x < picture.width(); ++x) {
      const auto [r, g, b] = picture.at(x, y);
      reds += r > 180 && g < 90 && b < 90 ? 1U : 0U;
      blues += b > 150 && r < 60 ? 1U : 0U;
      oranges += r > 200 && g > 140 && b < 60 ? 1U : 0U;
    }
  }
  EXPECT_GT(reds, 100U);
  EXPECT_GT(blues, 100U);
  EXPECT_GT(oranges, 100U);
}

/// The mean place of what is red in the lower right corner of a picture, in pixels, or nothing.
std::optional<std::array<double, 2>> markIn(const Raster& picture) {
  std::array<double, 2> sum{};
  double count = 0.0;
  for (std::size_t y = picture.height() * 3 / 4; y < picture.height(); ++y) {
    for (std::size_t x = picture.width() * 3 / 4; x < picture.width(); ++x) {
      const auto [r, g, b] = picture.at(x, y);
      if (r < 200 || g > 90 || b > 90) continue;
      sum[0] += static_cast<double>(x);
      sum[1] += static_cast<double>(y);
      count += 1.0;
    }
  }
  if (count == 0.0) return std::nullopt;
  return std::array{sum[0] / count, sum[1] / count};
}

TEST(Picture, ACornerShowsWhereInTheWholeAClashIs) {
  view::ViewScene scene = twoBoxes({{0, 0, 0}, {2, 2, 2}}, {{1, 1, 1}, {3, 3, 3}});
  Raster white(640, 480, kWhite);
  view::Overview(scene).addTo(white, scene.frames[0].boxes[0]);
  EXPECT_FALSE(markIn(white)) << "two models are in the picture itself";
  scene.modelCount = 4;  // a row along x, which goes to the right in pictures, and something infinite
  scene.frames[0].boxes.push_back({{20, 1, 1}, {22, 3, 3}});
  scene.frames[0].boxes.push_back({{0, 0, 0}, {std::numeric_limits<double>::infinity(), 1, 1}});
  const view::Overview overview(scene);
  std::vector<std::array<double, 2>> marks;
  for (const std::size_t at : {0U, 1U, 2U, 3U}) {
    Raster picture(640, 480, kWhite);
    overview.addTo(picture, scene.frames[0].boxes[at]);
    const auto mark = markIn(picture);
    ASSERT_TRUE(mark) << at;
    marks.push_back(*mark);
  }
  EXPECT_LT(marks[0][0], marks[1][0]);
  EXPECT_LT(marks[1][0] + 50.0, marks[2][0]);
  Raster small(40, 30, kWhite);
  overview.addTo(small, scene.frames[0].boxes[0]);
  EXPECT_EQ(small.at(39, 29), kWhite) << "there is no room";
}

TEST(Clash, TheLargestOverlapComesFirstAndTheGuidIsTheSameEachTime) {
  view::ViewScene scene = twoBoxes({{0, 0, 0}, {2, 2, 2}}, {{1, 1, 1}, {3, 3, 3}});
  scene.modelCount = 3;
  scene.frames[0].boxes.push_back({{0, 0, 0.5}, {2, 2, 2}});
  scene.frames[0].pairs = {{1, 1}, {1, 0}, {2, 0}, {2, 1}};
  const auto clashes = view::clashesOf(scene);
  std::vector<Pair> pairs;
  std::vector<double> volumes;
  for (const view::Clash& clash : clashes) {
    pairs.push_back({clash.first, clash.second});
    volumes.push_back(clash.volume);
  }
  EXPECT_EQ(pairs, (std::vector<Pair>{{2, 0}, {1, 0}, {2, 1}, {1, 1}}));
  EXPECT_EQ(volumes, (std::vector<double>{6.0, 1.0, 1.0, 8.0}));
  EXPECT_EQ(clashes[0].guid, view::clashesOf(scene)[0].guid);
  EXPECT_NE(clashes[0].guid, clashes[1].guid);
}

TEST(Clash, NumbersHaveFiveDigitsAndAllBeforeThePoint) {
  // The same list is in web/test/rules.test.mjs, for the page.
  const std::vector<std::pair<double, std::string>> numbers{{0.0, "0"},
                                                            {0.125, "0.125"},
                                                            {102360.7, "102361"},
                                                            {4.97592, "4.9759"},
                                                            {99999.6, "100000"},
                                                            {-12.5, "-12.5"},
                                                            {1234.56, "1234.6"},
                                                            {0.00012345678, "0.00012346"},
                                                            {5.000000000000001, "5"},
                                                            {1e9, "1000000000"},
                                                            {0.1 + 0.2, "0.3"}};
  for (const auto& [value, text] : numbers) EXPECT_EQ(view::shortNumber(value), text);
}

TEST(Clash, BoxesThatAreApartShareNothingAndHaveTheGapBetweenThem) {
  const view::ViewScene scene = twoBoxes({{0, 0, 0}, {1, 1, 1}}, {{3, 0, 0}, {4, 1, 1}});
  const auto clashes = view::clashesOf(scene);
  EXPECT_EQ(clashes[0].overlap, (std::array<double, 3>{-2.0, 1.0, 1.0}));
  EXPECT_EQ(clashes[0].volume, 0.0);
  EXPECT_EQ(placeOf(scene, clashes[0]), (Box{{1, 0, 0}, {3, 1, 1}}));
}

}  // namespace
}  // namespace allpairs::test
