// SPDX-License-Identifier: MIT
// States, depths and containment against what is known of the shapes without FCL: closed forms, and many sampled
// points.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "FclExamine.h"
#include "Shapes.h"
#include "allpairs/Error.h"
#include "allpairs/collision/CapsuleModel.h"
#include "allpairs/collision/LineModel.h"
#include "allpairs/collision/PointModel.h"
#include "allpairs/collision/SphereModel.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

using collision::CapsuleModel;
using collision::LineModel;
using collision::PointModel;
using collision::SphereModel;

/// A cuboid of which each side is turned into four triangles around its middle: another mesh of the same shape.
std::unique_ptr<TriangleModel> otherMeshOfCube(const Vec3& at, double size) {
  const auto plain = cuboid(at, {at[0] + size, at[1] + size, at[2] + size});
  std::vector<Vec3> points = plain->positions();
  std::vector<TriangleModel::Triangle> triangles;
  const auto& halves = plain->triangles();
  for (std::size_t i = 0; i + 1 < halves.size(); i += 2) {
    const auto [a, b, c] = halves[i];  // a quadrilateral a b c d comes as a b c and a c d
    const auto d = halves[i + 1][2];
    const auto middle = static_cast<std::uint32_t>(points.size());
    points.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) points.back()[axis] = (points[a][axis] + points[c][axis]) / 2.0;
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, d), std::pair(d, a)})
      triangles.push_back({from, to, middle});
  }
  return std::make_unique<TriangleModel>("other", points, triangles);
}

TEST(FclStates, TheSameShapeInTheSamePlaceIsADuplicate) {
  const auto cube = unitCube({3, 4, 5});
  const auto copy = unitCube({3, 4, 5});
  const auto pair = examine(*cube, *copy);
  EXPECT_EQ(pair.state, ExactState::Duplicate);
  EXPECT_EQ(pair.depth, std::nullopt);
  EXPECT_EQ(pair.contactBox, (Box{{3, 4, 5}, {4, 5, 6}}));
  EXPECT_EQ(examine(*cube, *otherMeshOfCube({3, 4, 5}, 1.0)).state, ExactState::Duplicate) << "of other triangles";
  EXPECT_EQ(examine(*cube, *unitCube({3.0000002, 4, 5})).state, ExactState::Duplicate) << "as float32 has it";
  EXPECT_EQ(examine(*cube, *unitCube({3.001, 4, 5})).state, ExactState::Clash);
  EXPECT_EQ(examine(*ball({0, 0, 0}, 1.0), *ball({0, 0, 0}, 1.0)).state, ExactState::Duplicate);
  SphereModel round("round", {{0, 0, 0}, {5, 0, 0}}, {}, 1.0);
  SphereModel sameRound("sameRound", {{5, 0, 0}, {0, 0, 0}}, {}, 1.0);
  EXPECT_EQ(examine(round, sameRound).state, ExactState::Duplicate);
}

TEST(FclStates, TwoShapesInOneBoxAreNoDuplicates) {
  const auto cube = cuboid({-1, -1, -1}, {1, 1, 1});
  EXPECT_EQ(examine(*cube, *ball({0, 0, 0}, 1.0)).state, ExactState::Contained);
}

TEST(FclStates, ASheetWithAHoleIsNoDuplicateOfOneWithout) {
  const std::vector<Vec3> corners{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}};
  TriangleModel whole("whole", corners, {}, {{0, 1, 2, 3}});
  TriangleModel other("other", corners, {{1, 2, 3}, {1, 3, 0}});
  std::vector<Vec3> around = corners;
  for (const Vec3& corner : {Vec3{6, 1, 0}, {8, 1, 0}, {8, 2, 0}, {6, 2, 0}}) around.push_back(corner);
  TriangleModel holed("holed", around, {}, {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
  EXPECT_EQ(examine(whole, other).state, ExactState::Duplicate);
  EXPECT_EQ(examine(whole, holed).state, ExactState::Touching);
  EXPECT_EQ(examine(holed, whole).state, ExactState::Touching);
}

/// A model with a corner in the middle of each side of its triangles, as polygons with such corners leave it: triangles
/// whose three corners lie in a line, on either side of each other.
std::unique_ptr<TriangleModel> withCornersInSides(const TriangleModel& model) {
  std::vector<Vec3> points = model.positions();
  std::vector<TriangleModel::Triangle> triangles = model.triangles();
  for (const auto& corners : model.triangles()) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = corners[i];
      const std::uint32_t to = corners[(i + 1) % 3];
      const auto middle = static_cast<std::uint32_t>(points.size());
      points.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        points.back()[axis] = points[from][axis] / 4.0 + 3.0 * points[to][axis] / 4.0;
      }
      triangles.push_back({from, middle, to});
      triangles.push_back({to, middle, from});
    }
  }
  return std::make_unique<TriangleModel>("with corners in sides", points, triangles);
}

TEST(FclStates, TrianglesWithoutAnAreaChangeNothing) {
  const auto outer = cuboid({0, 0, 0}, {4, 4, 4});
  const auto seamed = withCornersInSides(*outer);
  for (const auto& inner : {cuboid({1, 1, 1}, {2, 3, 3}), cuboid({3, 1, 1}, {5, 2, 3}), cuboid({4, 1, 1}, {5, 2, 3}),
                            cuboid({4.5, 1, 1}, {5, 2, 3}), cuboid({-1, -1, -1}, {5, 5, 5})}) {
    const auto plain = examine(*outer, *inner);
    const auto pair = examine(*seamed, *inner);
    const auto both = examine(*seamed, *withCornersInSides(*inner));
    for (const auto& other : {pair, both}) {
      EXPECT_EQ(other.state, plain.state);
      EXPECT_NEAR(other.distance, plain.distance, kClose);
      EXPECT_NEAR(other.depth.value_or(-1.0), plain.depth.value_or(-1.0), kClose);
    }
  }
  EXPECT_EQ(examine(*outer, *seamed).state, ExactState::Duplicate);
}

TEST(FclStates, TrianglesWithoutAnAreaChangeNothingWhereRoundingGivesThemOne) {
  for (int i = 0; i < repeats(40); ++i) {
    const auto placed = [i](const TriangleModel& model) {
      auto result = turned(model, 0.1 * i + 0.05, 3.7);
      std::vector<Vec3> points = result->positions();
      for (Vec3& p : points) p = {p[0] + 18432.0, p[1] + 2048.0, p[2]};
      return std::make_unique<TriangleModel>("placed", points, result->triangles());
    };
    const auto outer = placed(*withCornersInSides(*cuboid({0, 0, 0}, {4, 4, 4})));
    const auto beside = examine(*outer, *placed(*withCornersInSides(*cuboid({4.5, 1, 1}, {5, 2, 3}))));
    EXPECT_EQ(beside.state, ExactState::Apart) << i;
    EXPECT_NEAR(beside.distance, 0.5 * 3.7, 1e-9) << i;
    EXPECT_EQ(examine(*outer, *placed(*withCornersInSides(*cuboid({1, 1, 1}, {2, 3, 3})))).state,
              ExactState::Contained);
    const auto into = examine(*outer, *placed(*withCornersInSides(*cuboid({3, 1, 1}, {5, 2, 3}))));
    EXPECT_EQ(into.state, ExactState::Clash) << i;
    EXPECT_NEAR(into.depth.value_or(0.0), 3.7, 1e-9) << i;
  }
}

/// A comb along x: teeth of 2 and gaps of 1, on a back below y = 1.
std::unique_ptr<TriangleModel> comb() {
  const std::vector<std::array<double, 2>> outline{{0, 0}, {8, 0}, {8, 4}, {6, 4}, {6, 1}, {5, 1},
                                                   {5, 4}, {3, 4}, {3, 1}, {2, 1}, {2, 4}, {0, 4}};
  // The outline's corners from left to right: a cap is its three teeth and its back.
  const std::vector<TriangleModel::Quad> cap{{0, 9, 10, 11}, {8, 5, 6, 7}, {4, 1, 2, 3}};
  const std::vector<TriangleModel::Triangle> back{{0, 8, 9}, {0, 5, 8}, {0, 4, 5}, {0, 1, 4}};
  std::vector<Vec3> points;
  for (const double z : {0.0, 4.0}) {
    for (const auto& [x, y] : outline) points.push_back({x, y, z});
  }
  std::vector<TriangleModel::Quad> quads;
  std::vector<TriangleModel::Triangle> triangles;
  for (const auto& [a, b, c, d] : cap) {
    quads.push_back({d, c, b, a});
    quads.push_back({a + 12, b + 12, c + 12, d + 12});
  }
  for (const auto& [a, b, c] : back) {
    triangles.push_back({c, b, a});
    triangles.push_back({a + 12, b + 12, c + 12});
  }
  for (std::uint32_t i = 0; i < 12; ++i) quads.push_back({i, (i + 1) % 12, (i + 1) % 12 + 12, i + 12});
  return std::make_unique<TriangleModel>("comb", points, triangles, quads);
}

TEST(FclStates, WhatBridgesTheGapsOfASolidIsNotWithinIt) {
  const auto solid = comb();
  ASSERT_FALSE(examine(*solid, *unitCube({3.5, 2, 1})).isFirstOpen);
  for (const double radius : {0.01, 0.5}) {
    CapsuleModel bridge("bridge", {{{1, 2.5, 2}, {7, 2.5, 2}, radius}});
    EXPECT_EQ(examine(*solid, bridge).state, ExactState::Clash) << radius;
    CapsuleModel below("below", {{{1, 0.5, 2}, {7, 0.5, 2}, radius * 0.9}});
    EXPECT_EQ(examine(*solid, below).state, ExactState::Contained) << radius;
  }
  LineModel bridge("bridge", {{1, 2.5, 2}, {7, 2.5, 2}}, {{0, 1}});
  LineModel below("below", {{1, 0.5, 2}, {7, 0.5, 2}}, {{0, 1}});
  EXPECT_EQ(examine(*solid, bridge).state, ExactState::Clash);
  EXPECT_EQ(examine(*solid, below).state, ExactState::Contained);
  EXPECT_EQ(examine(*solid, *cuboid({1, 2, 1}, {7, 3, 2})).state, ExactState::Clash);
}

TEST(FclStates, LinesAndPointsAreDuplicatesOfTheSameAlone) {
  const std::vector<Vec3> corners{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  LineModel rising("rising", corners, {{0, 2}});
  LineModel cut("cut", {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}, {{2, 1}, {0, 1}});
  LineModel falling("falling", corners, {{1, 3}});
  EXPECT_EQ(examine(rising, cut).state, ExactState::Duplicate);
  EXPECT_EQ(examine(rising, falling).state, ExactState::Touching);
  LineModel outline("outline", corners, {{0, 1}, {1, 2}, {2, 3}, {3, 0}});
  TriangleModel sheet("sheet", corners, {}, {{0, 1, 2, 3}});
  EXPECT_EQ(examine(outline, sheet).state, ExactState::Touching);
  PointModel points("points", {{0, 0, 0}, {1, 0, 0}, {2, 2, 2}});
  PointModel others("others", {{0, 0, 0}, {1, 1, 0}, {2, 2, 2}});
  PointModel turnedAround("turned around", {{2, 2, 2}, {1, 0, 0}, {0, 0, 0}});
  EXPECT_EQ(examine(points, others).state, ExactState::Touching);
  EXPECT_EQ(examine(points, turnedAround).state, ExactState::Duplicate);
}

TEST(FclStates, WhatFillsTheHollowOfAnotherIsNotWithinIt) {
  const auto block = cuboid({0, 0, 0}, {10, 10, 10});
  const auto hollow = cuboid({4, 4, 4}, {6, 6, 6}, true);
  const auto outer = together({block.get(), hollow.get()});
  for (const auto& [reach, depth] : {std::pair(1.0, std::sqrt(3.0)), std::pair(2.0, 2.0)}) {
    const auto inner = cuboid({4 - reach, 4 - reach, 4 - reach}, {6 + reach, 6 + reach, 6 + reach});
    for (const auto& pair : {examine(*outer, *inner), examine(*inner, *outer)}) {
      EXPECT_EQ(pair.state, ExactState::Clash);
      EXPECT_THAT(pair.depth, ::testing::Optional(::testing::DoubleNear(depth, kClose)));
    }
  }
  EXPECT_EQ(examine(*outer, *cuboid({4, 4, 4}, {6, 6, 6})).state, ExactState::Touching);
  EXPECT_EQ(examine(*outer, *cuboid({1, 1, 1}, {3, 3, 3})).state, ExactState::Contained);
}

TEST(FclStates, WhatLiesWhollyInAnotherIsContainedEvenWhereSurfacesMeet) {
  const auto outer = cuboid({0, 0, 0}, {4, 4, 4});
  const auto corner = cuboid({0, 0, 0}, {1, 2, 3});
  for (const auto& pair : {examine(*outer, *corner), examine(*corner, *outer)}) {
    EXPECT_EQ(pair.state, ExactState::Contained);
    EXPECT_THAT(pair.depth, ::testing::Optional(::testing::DoubleNear(1.0, kClose)));
  }
  EXPECT_EQ(examine(*outer, *cuboid({3, 1, 1}, {4.25, 2, 2})).state, ExactState::Clash);
  EXPECT_EQ(examine(*outer, *cuboid({-1, 1, 1}, {5, 2, 2})).state, ExactState::Clash) << "through it";
}

TEST(FclStates, ABodyOfWhichOnlyAPartLiesInAnotherIsNotContained) {
  const auto outer = cuboid({0, 0, 0}, {4, 4, 4});
  const auto inner = cuboid({1, 1, 1}, {2, 2, 2});
  const auto beside = cuboid({6, 1, 1}, {7, 2, 2});
  EXPECT_EQ(examine(*outer, *together({inner.get(), beside.get()})).state, ExactState::Clash);
  SphereModel balls("balls", {{2, 2, 2}, {9, 2, 2}}, {}, 0.5);
  EXPECT_EQ(examine(*outer, balls).state, ExactState::Clash);
}

/// All faces of what the two share are faces of both: no point of one surface lies in the other.
TEST(FclStates, ASolidThatAnotherHasBesidesMoreIsContained) {
  const auto cube = cuboid({0, 0, 0}, {1, 1, 1});
  const auto beside = cuboid({4, 0, 0}, {5, 1, 1});
  const auto atAnEdge = cuboid({1, 1, 0}, {2, 2, 1});
  const auto above = cuboid({0, 0, 7}, {1, 1, 8});
  for (const double angle : {0.0, 0.3}) {
    const auto one = turned(*cube, angle);
    const auto two = turned(*together({cube.get(), beside.get()}), angle);
    const auto joined = turned(*together({cube.get(), atAnEdge.get()}), angle);
    const auto other = turned(*together({above.get(), cube.get()}), angle);
    for (const auto& [first, second] : {std::pair(&one, &two), {&two, &one}, {&one, &joined}, {&joined, &one}}) {
      const auto pair = examine(**first, **second);
      EXPECT_EQ(pair.state, ExactState::Contained);
      EXPECT_THAT(pair.depth, ::testing::Optional(::testing::DoubleNear(0.5, 1e-12)));
    }
    EXPECT_EQ(examine(*two, *other).state, ExactState::Clash) << "each has more";
    const auto faces = cuboid({1, 0, 0}, {4, 1, 1});
    EXPECT_EQ(examine(*two, *turned(*faces, angle)).state, ExactState::Touching) << "between them";
  }
}

TEST(FclStates, APlugThatReachesIntoTheSolidAroundItElsewhereIsNotContained) {
  const auto block = cuboid({0, 0, 0}, {10, 10, 10});
  const auto hollow = cuboid({4, 4, 4}, {6, 6, 6}, true);
  const auto outer = together({block.get(), hollow.get()});
  const auto plug = cuboid({4, 4, 4}, {6, 6, 6});
  const auto within = cuboid({1, 1, 1}, {2, 2, 2});
  const auto both = together({plug.get(), within.get()});
  EXPECT_EQ(examine(*both, *outer).state, ExactState::Clash);
  EXPECT_EQ(examine(*outer, *both).state, ExactState::Clash);
}

TEST(FclStates, EachOfTwoPartsInOnePlaceIsWithinTheOther) {
  SphereModel one("one", {{0, 0, 0}}, {}, 1.0);
  SphereModel two("two", {{0, 0, 0}, {10, 0, 0}}, {}, 1.0);
  SphereModel other("other", {{-10, 0, 0}, {0, 0, 0}}, {}, 1.0);
  EXPECT_EQ(examine(one, two).state, ExactState::Contained);
  EXPECT_EQ(examine(two, one).state, ExactState::Contained);
  EXPECT_EQ(examine(two, other).state, ExactState::Clash);
}

TEST(FclStates, ABallHoldsWhatNoPointOfReachesOutOfIt) {
  SphereModel round("round", {{0, 0, 0}}, {2.0});
  EXPECT_EQ(examine(round, *cuboid({-1, -1, -1}, {1, 1, 1})).state, ExactState::Contained);
  EXPECT_EQ(examine(round, *cuboid({-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2})).state, ExactState::Clash);
  SphereModel small("small", {{1, 0, 0}}, {1.0});
  SphereModel larger("larger", {{1, 0, 0}}, {1.125});
  EXPECT_EQ(examine(round, small).state, ExactState::Contained);
  EXPECT_EQ(examine(round, larger).state, ExactState::Clash);
}

TEST(FclStates, NobodyKnowsWhatIsWithinASurfaceThatIsNotClosed) {
  const auto open = openCube();
  const auto pair = examine(*open, *unitCube({0, 0, 0}));
  EXPECT_EQ(pair.state, ExactState::Undecided);
  EXPECT_EQ(pair.distance, 1.0);
  EXPECT_TRUE(pair.isFirstOpen);
  EXPECT_FALSE(pair.isSecondOpen);
  EXPECT_EQ(examine(*unitCube({0, 0, 0}), *open).state, ExactState::Undecided);
  EXPECT_EQ(examine(*open, *unitCube({5, 0, 0})).state, ExactState::Apart) << "beside it";
  const auto within = examine(*open, *cuboid({-3, -3, -3}, {3, 3, 3}));
  EXPECT_EQ(within.state, ExactState::Contained) << "a surface may well lie in a solid";
}

TEST(FclStates, AnOpenSurfaceThatAnotherPassesThroughClashesAsDeepAsNobodyKnows) {
  const auto pair = examine(*openCube(), *openCube());
  EXPECT_EQ(pair.state, ExactState::Duplicate);
  TriangleModel wall("wall", {{0, -9, -9}, {0, 9, -9}, {0, 0, 9}}, {{0, 1, 2}});
  const auto crossed = examine(*openCube(), wall);
  EXPECT_EQ(crossed.state, ExactState::Clash);
  EXPECT_EQ(crossed.depth, std::nullopt);
  TriangleModel lid("lid", {{2, -1, -1}, {2, 1, -1}, {2, 0, 1}}, {{0, 1, 2}});
  EXPECT_EQ(examine(*openCube(), lid).state, ExactState::Touching);
}

TEST(FclStates, WithinTheClearanceIsWhatIsApartByNoMore) {
  const auto cube = unitCube({0, 0, 0});
  const ExactOptions quarter{.clearance = 0.25};
  EXPECT_EQ(examine(*cube, *unitCube({1.25, 0, 0}), quarter).state, ExactState::WithinClearance);
  EXPECT_EQ(examine(*cube, *unitCube({1.375, 0, 0}), quarter).state, ExactState::Apart);
  EXPECT_EQ(examine(*cube, *unitCube({1.2, 1.2, 0}), quarter).state, ExactState::Apart) << "0.28, not 0.2 per axis";
  EXPECT_EQ(examine(*cube, *unitCube({1, 0, 0}), quarter).state, ExactState::Touching);
  EXPECT_THROW(FclNarrowPhase({.clearance = -1.0}), InvalidArgument);
}

TEST(FclStates, LinesGoWhereTheSurfacesCross) {
  const auto pair = examine(*unitCube({0, 0, 0}), *unitCube({0.75, 0.5, 0.25}), {.lineLimit = 1000});
  ASSERT_FALSE(pair.contactLines.empty());
  const Box shared{{0.75, 0.5, 0.25}, {1, 1, 1}};
  double length = 0.0;
  for (const auto& [from, to] : pair.contactLines) {
    EXPECT_TRUE(overlap({from, from}, shared, kClose));
    EXPECT_TRUE(overlap({to, to}, shared, kClose));
    length += std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
  }
  EXPECT_NEAR(length, 2 * (0.25 + 0.5 + 0.75), 1e-9) << "six edges of the cuboid that both share";
  EXPECT_TRUE(examine(*unitCube({0, 0, 0}), *unitCube({0.75, 0.5, 0.25})).contactLines.empty());
}

/// How far a point lies below the surface of a box; negative outside.
double depthIn(const Box& box, const Vec3& point) {
  double depth = box.max[0] - box.min[0];
  for (std::size_t axis = 0; axis < 3; ++axis)
    depth = std::min({depth, point[axis] - box.min[axis], box.max[axis] - point[axis]});
  return depth;
}

/// The greatest depth in `outer` of a grid of points on the surface of `inner`.
double sampledDepth(const Box& outer, const Box& inner) {
  constexpr int kSteps = 96;
  double deepest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        Vec3 point{};
        point[u] = inner.min[u] + (inner.max[u] - inner.min[u]) * i / kSteps;
        point[v] = inner.min[v] + (inner.max[v] - inner.min[v]) * j / kSteps;
        for (const double side : {inner.min[axis], inner.max[axis]}) {
          point[axis] = side;
          deepest = std::max(deepest, depthIn(outer, point));
        }
      }
    }
  }
  return deepest;
}

double gapOf(const Box& a, const Box& b) {
  double squared = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::max({0.0, a.min[axis] - b.max[axis], b.min[axis] - a.max[axis]});
    squared += gap * gap;
  }
  return std::sqrt(squared);
}

bool isInside(const Box& outer, const Box& inner) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (inner.min[axis] < outer.min[axis] || inner.max[axis] > outer.max[axis]) return false;
  }
  return true;
}

/// What closed forms say of two cuboids. Their corners are eighths, so that many share faces.
ExactState knownState(const Box& a, const Box& b) {
  if (a == b) return ExactState::Duplicate;
  if (gapOf(a, b) > 0.0) return gapOf(a, b) <= 0.125 ? ExactState::WithinClearance : ExactState::Apart;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a.max[axis] == b.min[axis] || b.max[axis] == a.min[axis]) return ExactState::Touching;
  }
  return isInside(a, b) || isInside(b, a) ? ExactState::Contained : ExactState::Clash;
}

Box randomBox(std::mt19937& random, int most) {
  std::uniform_int_distribution<int> place(0, most);
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int a = place(random);
    int b = place(random);
    if (a == b) ++b;
    box.min[axis] = std::min(a, b) / 8.0;
    box.max[axis] = std::max(a, b) / 8.0;
  }
  return box;
}

TEST(FclStates, RandomCuboidsAreAsClosedFormsAndSampledPointsSay) {
  constexpr std::uint32_t kSeed = 17;
  constexpr double kGrid = 2.0 / 96;
  std::mt19937 random(kSeed);
  std::array<int, kExactStates> seen{};
  for (int i = 0; i < 300; ++i) {
    const Box a = randomBox(random, i % 3 == 0 ? 2 : 12);
    const Box b = randomBox(random, i % 3 == 0 ? 2 : 12);
    const auto pair = examine(*cuboid(a.min, a.max), *cuboid(b.min, b.max), {.clearance = 0.125});
    SCOPED_TRACE(::testing::Message() << "seed " << kSeed << ", pair " << i);
    ASSERT_EQ(pair.state, knownState(a, b));
    ++seen[static_cast<std::size_t>(pair.state)];
    EXPECT_NEAR(pair.distance, gapOf(a, b), 1e-9);
    if (pair.state != ExactState::Clash && pair.state != ExactState::Contained) continue;
    const double deepest = std::max(sampledDepth(a, b), sampledDepth(b, a));
    ASSERT_TRUE(pair.depth.has_value());
    EXPECT_LE(*pair.depth, deepest + kGrid) << "never more than the true one";
    EXPECT_GE(*pair.depth, 0.9 * deepest - kGrid);
  }
  for (const ExactState state : {ExactState::Duplicate, ExactState::Contained, ExactState::Clash, ExactState::Touching,
                                 ExactState::WithinClearance, ExactState::Apart}) {
    EXPECT_GT(seen[static_cast<std::size_t>(state)], 0) << stateName(state);
  }
}

TEST(FclStates, TheWorstComesFirst) {
  std::vector<ExactPair> pairs(7);
  pairs[0].state = ExactState::Apart;
  pairs[1] = {.state = ExactState::Clash, .depth = 0.25};
  pairs[2].state = ExactState::Touching;
  pairs[3].state = ExactState::Duplicate;
  pairs[4] = {.state = ExactState::Clash, .depth = 0.5};
  pairs[5] = {.state = ExactState::WithinClearance, .distance = 0.1};
  pairs[6] = {.state = ExactState::Contained, .depth = 0.1};
  EXPECT_EQ(worstFirst(pairs), (std::vector<std::size_t>{3, 6, 4, 1, 2, 5, 0}));
  EXPECT_EQ(countText(countStates(pairs)),
            "4 clashes (1 duplicate, 1 contained), 1 touching, 1 within the clearance, 1 apart");
  EXPECT_EQ(countText({}), "0 clashes");
}

}  // namespace
}  // namespace allpairs::test
