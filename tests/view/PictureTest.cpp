// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <vector>

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

/// How far inside of a triangle a pixel is, at least; outside it is negative. `depth` is that of the triangle there.
double insideOf(const std::array<RasterPoint, 3>& corners, double x, double y, double& depth) {
  const auto areaOf = [](const RasterPoint& a, const RasterPoint& b, double px, double py) {
    return (b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x);
  };
  const auto& [a, b, c] = corners;
  const double area = areaOf(a, b, c.x, c.y);
  const double u = areaOf(b, c, x, y) / area;
  const double v = areaOf(c, a, x, y) / area;
  depth = u * a.depth + v * b.depth + (1.0 - u - v) * c.depth;
  return std::min({u, v, 1.0 - u - v});
}

TEST(Raster, TheNearestOfTrianglesThatCrossIsSeenAtEachPixel) {
  constexpr std::size_t kSide = 40;
  constexpr double kDoubt = 1e-6;
  std::mt19937 random(11);  // of the standard's own form, so the same everywhere
  const auto anywhere = [&random](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  for (int round = 0; round < 50; ++round) {
    std::vector<std::array<RasterPoint, 3>> triangles(3);
    const std::array<Colour, 3> colours{kRed, kBlue, Colour{0, 255, 0}};
    Raster raster(kSide, kSide, kWhite);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (RasterPoint& p : triangles[i]) p = {anywhere(-10, 50), anywhere(-10, 50), anywhere(0, 1)};
      raster.triangle(triangles[i], colours[i]);
    }
    for (std::size_t pixel = 0; pixel < kSide * kSide; ++pixel) {
      const std::size_t x = pixel % kSide;
      const std::size_t y = pixel / kSide;
      Colour expected = kWhite;
      double nearest = 1e9;
      bool isSure = true;
      for (std::size_t i = 0; i < triangles.size(); ++i) {
        double depth = 0.0;
        const double inside = insideOf(triangles[i], static_cast<double>(x), static_cast<double>(y), depth);
        isSure = isSure && std::abs(inside) > kDoubt && (inside < 0.0 || std::abs(depth - nearest) > kDoubt);
        if (inside < 0.0 || depth > nearest) continue;
        nearest = depth;
        expected = colours[i];
      }
      ASSERT_TRUE(!isSure || raster.at(x, y) == expected) << "round " << round << ", " << x << ' ' << y;
    }
  }
}

TEST(Raster, TrianglesThatShareEdgesLeaveNoPixelOut) {
  constexpr std::size_t kSide = 60;
  std::mt19937 random(12);
  const auto at = [&random](double middle) { return middle + static_cast<double>(random()) / 4294967296.0 - 0.5; };
  std::vector<RasterPoint> points;  // a grid that covers all of the picture, each point moved a little
  constexpr std::size_t kPoints = 16;
  for (std::size_t i = 0; i < kPoints * kPoints; ++i)
    points.push_back(
        {at(4.5 * static_cast<double>(i % kPoints) - 3.0), at(4.5 * static_cast<double>(i / kPoints) - 3.0), 0.0});
  Raster raster(kSide, kSide, kWhite);
  for (std::size_t i = 0; i + kPoints + 1 < points.size(); ++i) {
    if (i % kPoints == kPoints - 1) continue;
    raster.triangle({points[i], points[i + 1], points[i + kPoints]}, kRed);
    raster.triangle({points[i + kPoints + 1], points[i + kPoints], points[i + 1]}, kRed);
  }
  for (std::size_t pixel = 0; pixel < kSide * kSide; ++pixel)
    EXPECT_EQ(raster.at(pixel % kSide, pixel / kSide), kRed) << pixel % kSide << ' ' << pixel / kSide;
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
  Raster half(2, 1, kRed);
  raster.halveInto(half);
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
  const Raster picture = view::ClashPainter(scene).paint(clashes[0], cameraOf(scene, clashes[0]));
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

/// Adds a block as a shape.
void addBlock(view::ViewScene& scene, const Box& box) {
  view::ViewMesh& mesh = scene.mesh;
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size() / 3);
  for (unsigned corner = 0; corner < 8; ++corner) {
    for (unsigned axis = 0; axis < 3; ++axis)
      mesh.vertices.push_back((corner >> axis & 1U) != 0 ? box.max[axis] : box.min[axis]);
  }
  for (const std::uint32_t index : {0U, 2U, 1U, 1U, 2U, 3U, 4U, 5U, 6U, 5U, 7U, 6U, 0U, 1U, 4U, 1U, 5U, 4U,
                                    2U, 6U, 3U, 3U, 6U, 7U, 0U, 4U, 2U, 2U, 4U, 6U, 1U, 3U, 5U, 3U, 7U, 5U})
    mesh.triangles.push_back(base + index);
  mesh.triangleEnds.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
  mesh.lineEnds.push_back(0);
  mesh.pointEnds.push_back(0);
  scene.frames.front().boxes.push_back(box);
  scene.frames.front().flags.push_back(7);
  ++scene.modelCount;
}

/// A plate that a block hides from some sides, and another; a pair that is apart.
view::ViewScene threeBlocks() {
  view::ViewScene scene;
  scene.frames.emplace_back();
  scene.isExact = true;
  addBlock(scene, {{0, 0, 0}, {4, 4, 4}});
  addBlock(scene, {{3.5, 1, 1}, {4.5, 3, 1.2}});
  addBlock(scene, {{-0.5, -0.5, 1}, {0.2, 1, 2}});
  scene.frames.front().pairs = {{1, 0}, {2, 0}, {2, 1}};
  const auto clashAt = [](const Box& box, double depth) {
    ExactPair pair;
    pair.state = ExactState::Clash;
    pair.depth = depth;
    pair.pointOnFirst = box.min;
    pair.pointOnSecond = box.max;
    pair.contactLines = {{box.min, box.max}};
    pair.contactBox = box;
    return pair;
  };
  ExactPair apart;
  apart.state = ExactState::Apart;
  scene.exact = {clashAt({{4, 1, 1}, {4, 3, 1.2}}, 0.5), clashAt({{0, 0, 1}, {0, 1, 2}}, 0.2), apart};
  return scene;
}

using Camera = std::array<std::array<double, 3>, 4>;

std::vector<Camera> camerasOf(const view::ViewScene& scene) {
  std::vector<Camera> cameras;
  for (std::size_t pair = 0; pair < scene.exact.size(); ++pair) {
    const view::ParallelCamera camera = cameraOf(scene, view::clashOf(scene, pair));
    cameras.push_back({camera.centre, camera.direction, camera.up, {camera.height, 0.0, 0.0}});
  }
  return cameras;
}

TEST(Picture, SidesThatAreChosenAheadAreTheSame) {
  view::ViewScene scene = threeBlocks();
  const std::vector<Camera> expected = camerasOf(scene);
  EXPECT_NE(expected[0][1], expected[1][1]) << "each is hidden from where the other is seen";
  SerialExecutor executor;
  const auto chosen = [&scene] { return std::array{hasSide(scene, 0), hasSide(scene, 1), hasSide(scene, 2)}; };
  EXPECT_EQ(chosen(), (std::array{false, false, false}));
  view::chooseSides(scene, 1, executor);
  EXPECT_EQ(chosen(), (std::array{true, false, false})) << "the worst";
  EXPECT_EQ(camerasOf(scene), expected);
  view::chooseSides(scene, 9, executor);
  EXPECT_EQ(chosen(), (std::array{true, true, false}));
  EXPECT_EQ(camerasOf(scene), expected);
  scene.sides[0] = scene.sides[1];
  EXPECT_NE(camerasOf(scene)[0], expected[0]) << "they are used";
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
                                                            {std::numeric_limits<double>::quiet_NaN(), "NaN"},
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
