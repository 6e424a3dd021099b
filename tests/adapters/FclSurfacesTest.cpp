// SPDX-License-Identifier: MIT
// Surfaces that are not closed, and those that are drawn for either side: what crosses, and what has an inside.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "FclExamine.h"
#include "Shapes.h"

namespace allpairs::test {
namespace {

/// A square around the origin in the plane of two axes, of as many strips along the first as there are bounds less one.
TriangleModel sheet(std::size_t u, std::size_t v, const std::vector<double>& bounds) {
  std::vector<Vec3> points;
  for (const double bound : bounds) {
    for (const double side : {-1.0, 1.0}) {
      Vec3& point = points.emplace_back();
      point[u] = bound;
      point[v] = side;
    }
  }
  std::vector<TriangleModel::Quad> quads;
  for (std::uint32_t i = 0; i + 3 < points.size(); i += 2) quads.push_back({i, i + 1, i + 3, i + 2});
  return TriangleModel("sheet", points, {}, quads);
}

TEST(FclSurfaces, SheetsThatCrossClashAlsoAlongEdgesOfTheirTriangles) {
  for (const std::vector<double>& first : {std::vector<double>{-1, 1}, {-1, 0, 1}}) {
    for (const std::vector<double>& second : {std::vector<double>{-1, 1}, {-1, 0, 1}}) {
      auto flat = sheet(0, 1, first);
      auto upright = sheet(2, 1, second);
      EXPECT_EQ(examine(flat, upright).state, ExactState::Clash);
      EXPECT_EQ(examine(upright, flat).state, ExactState::Clash);
    }
  }
  auto flat = sheet(0, 1, {-1, 0, 1});
  auto standing = sheet(2, 1, {0, 1});
  EXPECT_EQ(examine(flat, standing).state, ExactState::Touching) << "it ends there";
  TriangleModel roof("roof", {{-1, -1, -1}, {-1, 1, -1}, {0, -1, 0}, {0, 1, 0}, {1, -1, -1}, {1, 1, -1}}, {},
                     {{0, 1, 3, 2}, {2, 3, 5, 4}});
  EXPECT_EQ(examine(flat, roof).state, ExactState::Touching) << "its ridge";
}

/// A model of which each triangle is there twice, once each way.
std::unique_ptr<TriangleModel> twoSided(const TriangleModel& model) {
  std::vector<TriangleModel::Triangle> triangles = model.triangles();
  for (const auto& [a, b, c] : model.triangles()) triangles.push_back({b, a, c});
  return std::make_unique<TriangleModel>("two-sided", model.positions(), triangles);
}

/// Two strips that go out from the y axis at these angles, in degrees.
TriangleModel folded(double first, double second) {
  std::vector<Vec3> points;
  const auto add = [&points](double x, double z) {
    for (const double y : {-1.0, 1.0}) points.push_back({x, y, z});
  };
  const double degree = std::numbers::pi / 180.0;
  add(std::cos(first * degree), std::sin(first * degree));
  add(0.0, 0.0);
  add(std::cos(second * degree), std::sin(second * degree));
  return TriangleModel("folded", points, {}, {{0, 1, 3, 2}, {2, 3, 5, 4}});
}

TEST(FclSurfaces, CrossWhereOneHangsAndTheOtherStandsOnAPartOfTheirLine) {
  TriangleModel divided("divided", {{-1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 10, 0}, {0, 10, 0}, {-1, 10, 0}}, {},
                        {{0, 1, 4, 5}, {1, 2, 3, 4}});
  const auto upright = [](double end, double begin) {
    return TriangleModel("upright", {{0, 0, 0}, {0, end, 0}, {0, 0, -2}, {0, begin, 0}, {0, 10, 0}, {0, 10, 2}},
                         {{0, 1, 2}, {3, 4, 5}});
  };
  auto overlapping = upright(6, 4);
  auto apart = upright(4, 6);
  EXPECT_EQ(examine(divided, overlapping).state, ExactState::Clash);
  EXPECT_EQ(examine(divided, apart).state, ExactState::Touching);
}

TEST(FclSurfaces, SingleTrianglesMeetWhicheverComesFirst) {
  TriangleModel upright(
      "upright",
      {{12.0, 0.0, 0.0}, {12.0, 1.6831921772672276, 11.187799787911224}, {12.0, 6.4354959825892255, 4.752303805321998}},
      {{0, 1, 2}});
  TriangleModel through(
      "through",
      {{8.0, 9.65324397388384, 7.128455707982997}, {8.0, 0.0, 0.0}, {16.0, 7.277092071222841, 10.34620369927761}},
      {{0, 1, 2}});
  EXPECT_EQ(examine(upright, through).state, ExactState::Clash);
  EXPECT_EQ(examine(through, upright).state, ExactState::Clash);
  TriangleModel corner("corner", {{5, 7, 11}, {8, 0, 12}, {8, 12, 16}}, {{0, 1, 2}});  // 5 7 11 lies in the other
  TriangleModel plane("plane", {{0, 16, 4}, {8, 4, 16}, {4, 4, 8}}, {{0, 1, 2}});
  EXPECT_EQ(examine(corner, plane).state, ExactState::Touching);
  EXPECT_EQ(examine(plane, corner).state, ExactState::Touching);
}

TEST(FclSurfaces, FoldedSheetsThatMeetAtTheirFoldsClashWhereTheyTakeTurnsAroundIt) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(0.0, 360.0);
  for (int i = 0; i < 200; ++i) {
    const double a = angle(random);
    const double b = angle(random);
    const double c = angle(random);
    const double d = angle(random);
    const auto isBetween = [&](double x) { return (x - a) * (x - b) < 0.0; };
    auto first = folded(a, b);
    auto second = folded(c, d);
    const ExactState expected = isBetween(c) != isBetween(d) ? ExactState::Clash : ExactState::Touching;
    EXPECT_EQ(examine(first, second).state, expected) << a << ' ' << b << ' ' << c << ' ' << d;
    EXPECT_EQ(examine(second, first).state, expected) << a << ' ' << b << ' ' << c << ' ' << d;
  }
  auto sheet = folded(0, 180);
  EXPECT_EQ(examine(sheet, *twoSided(sheet)).state, ExactState::Duplicate);
  EXPECT_EQ(examine(*twoSided(folded(20, 200)), *twoSided(folded(70, 250))).state, ExactState::Clash);
  auto bracket = folded(0, 90);
  EXPECT_EQ(examine(sheet, bracket).state, ExactState::Touching) << "one side lies on the other";
}

TEST(FclSurfaces, CrossAlongEdgesHoweverTheyAreTurned) {
  for (int i = 0; i < 40; ++i) {
    const auto flat = turned(sheet(0, 1, {-1, 0, 1}), 0.17 * i);
    const auto whole = turned(sheet(0, 1, {-1, 1}), 0.17 * i);
    const auto upright = turned(sheet(2, 1, {-1, 0, 1}), 0.17 * i);
    const auto standing = turned(sheet(2, 1, {0, 1}), 0.17 * i);
    const auto bent = turned(folded(30, 250), 0.17 * i);
    EXPECT_EQ(examine(*flat, *upright).state, ExactState::Clash) << i;
    EXPECT_EQ(examine(*whole, *upright).state, ExactState::Clash) << i;
    EXPECT_EQ(examine(*flat, *bent).state, ExactState::Clash) << i;
    EXPECT_EQ(examine(*flat, *standing).state, ExactState::Touching) << i;
    EXPECT_EQ(examine(*whole, *standing).state, ExactState::Touching) << i;
    EXPECT_EQ(examine(*twoSided(*flat), *twoSided(*upright)).state, ExactState::Clash) << i;
  }
}

TEST(FclSurfaces, TrianglesForEitherSideAreASolidOrASurfaceAsOnesForOne) {
  const auto outer = cuboid({0, 0, 0}, {4, 4, 4});
  const auto open = openCube();
  for (TriangleModel* model : {outer.get(), open.get()}) {
    for (const auto& inner : {cuboid({1, 1, 1}, {2, 2, 2}), cuboid({3, 1, 1}, {5, 2, 3}), cuboid({4, 1, 1}, {5, 2, 3}),
                              cuboid({7, 1, 1}, {8, 2, 3}), cuboid({-1, -1, -1}, {1.5, 1.5, 1.5})}) {
      const auto plain = examine(*model, *inner);
      const auto first = examine(*twoSided(*model), *inner);
      const auto both = examine(*twoSided(*model), *twoSided(*inner));
      for (const auto& pair : {first, both}) {
        EXPECT_EQ(pair.state, plain.state);
        EXPECT_EQ(pair.isFirstOpen, plain.isFirstOpen);
        EXPECT_NEAR(pair.distance, plain.distance, kClose);
        EXPECT_NEAR(pair.depth.value_or(-1.0), plain.depth.value_or(-1.0), kClose);
      }
    }
  }
}

TEST(FclSurfaces, OfWhatIsDrawnForEitherSideWithOtherTrianglesNobodyKnowsTheInside) {
  const auto one = cuboid({0, 0, 0}, {4, 4, 4});
  auto triangles = one->triangles();
  for (std::size_t i = 0; i + 1 < one->triangles().size(); i += 2) {
    const auto [a, b, c] = one->triangles()[i];  // a quadrilateral a b c d comes as a b c and a c d
    const auto d = one->triangles()[i + 1][2];
    triangles.push_back({d, c, b});
    triangles.push_back({d, b, a});
  }
  TriangleModel drawn("drawn", one->positions(), triangles);
  EXPECT_EQ(examine(drawn, *cuboid({1, 1, 1}, {2, 2, 2})).state, ExactState::Undecided);
  EXPECT_EQ(examine(drawn, *cuboid({3, 1, 1}, {5, 2, 2})).state, ExactState::Clash);
  EXPECT_EQ(examine(drawn, *cuboid({5, 1, 1}, {6, 2, 2})).state, ExactState::Apart);
}

TEST(FclSurfaces, APartAndItsMirrorImageAreSolid) {
  const auto left = cuboid({-5, 0, 0}, {-1, 4, 4});
  const auto right = cuboid({1, 0, 0}, {5, 4, 4}, true);
  const auto pair = together({left.get(), right.get()});
  for (const double x : {-4.0, 2.0}) {
    EXPECT_EQ(examine(*pair, *cuboid({x, 1, 1}, {x + 1, 2, 2})).state, ExactState::Contained) << x;
  }
}

}  // namespace
}  // namespace allpairs::test
