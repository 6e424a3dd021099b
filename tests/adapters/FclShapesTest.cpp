// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "FclExamine.h"
#include "Shapes.h"
#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/CapsuleModel.h"
#include "allpairs/collision/LineModel.h"
#include "allpairs/collision/OrientedBoxModel.h"
#include "allpairs/collision/PointModel.h"
#include "allpairs/collision/SphereModel.h"
#include "allpairs/collision/TetrahedronModel.h"
#include "allpairs/fcl/FclNarrowPhase.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

using namespace collision;

TEST(FclShapes, SpheresAreAsFarAndAsDeepAsTheirCentresSay) {
  SphereModel first("first", {{0, 0, 0}}, {1.0});
  SphereModel apart("apart", {{3, 4, 0}}, {2.0});
  SphereModel deep("deep", {{0, 0, 2.5}}, {2.0});
  SphereModel touching("touching", {{3, 0, 0}}, {2.0});
  EXPECT_NEAR(examine(first, apart).distance, 2.0, kClose);
  const auto pair = examine(first, deep);
  EXPECT_EQ(pair.state, ExactState::Clash);
  EXPECT_NEAR(pair.depth.value_or(0.0), 0.5, kClose);
  EXPECT_NEAR(pair.normal[2], -1.0, kClose);
  EXPECT_EQ(examine(first, touching).state, ExactState::Touching);
}

TEST(FclShapes, OfManySpheresTheDeepestCounts) {
  SphereModel first("first", {{0, 0, 0}, {10, 0, 0}, {20, 0, 0}}, {}, 1.0);
  SphereModel second("second", {{0, 1.9, 0}, {10, 1.5, 0}, {20, 5, 0}}, {}, 1.0);
  const auto pair = examine(first, second);
  EXPECT_NEAR(pair.depth.value_or(0.0), 0.5, kClose);
  EXPECT_EQ(pair.contactCount, 2U);
  SphereModel third("third", {{0, 4, 0}, {10, 3, 0}}, {}, 1.0);
  EXPECT_NEAR(examine(first, third).distance, 1.0, kClose);
}

TEST(FclShapes, ASphereOnAMeshIsAsDeepAsItReachesBelowTheSurface) {
  const auto cube = cuboid({-4, -4, -4}, {4, 4, 4});
  SphereModel above("above", {{0, 0, 5}}, {0.75});
  SphereModel resting("resting", {{1, 1, 5}}, {1.0});
  SphereModel sunk("sunk", {{0, 0, 4.5}}, {0.75});
  SphereModel deeper("deeper", {{0, 0, 3.5}}, {0.75});
  SphereModel within("within", {{0, 0, 2}}, {0.75});
  EXPECT_NEAR(examine(above, *cube).distance, 0.25, kClose);
  EXPECT_EQ(examine(resting, *cube).state, ExactState::Touching);
  EXPECT_EQ(examine(sunk, *cube).state, ExactState::Clash);
  EXPECT_NEAR(examine(sunk, *cube).depth.value_or(0.0), 0.25, kClose);
  EXPECT_EQ(examine(deeper, *cube).state, ExactState::Clash);
  EXPECT_NEAR(examine(deeper, *cube).depth.value_or(0.0), 1.25, kClose);
  EXPECT_EQ(examine(within, *cube).state, ExactState::Contained);
  EXPECT_NEAR(examine(within, *cube).depth.value_or(0.0), 2.75, kClose);
}

auto isAt(const Vec3& v) {
  using ::testing::DoubleNear;
  return ::testing::ElementsAre(DoubleNear(v[0], kClose), DoubleNear(v[1], kClose), DoubleNear(v[2], kClose));
}

/// Checks what is said of a thick model that reaches into another, either way around.
void expectDeep(CollisionModel& thick, CollisionModel& other, double depth, const Vec3& deepest, const Vec3& surface,
                const Vec3& normal, const std::vector<Vec3>& contacts) {
  const auto pair = examine(thick, other);
  EXPECT_THAT(pair.depth, ::testing::Optional(::testing::DoubleNear(depth, kClose)));
  EXPECT_THAT(pair.pointOnFirst, isAt(deepest));
  EXPECT_THAT(pair.pointOnSecond, isAt(surface));
  EXPECT_THAT(pair.normal, isAt(normal));
  const auto swapped = examine(other, thick);
  EXPECT_EQ(swapped.depth, pair.depth);
  EXPECT_THAT(swapped.pointOnFirst, isAt(surface));
  EXPECT_THAT(swapped.pointOnSecond, isAt(deepest));
  EXPECT_THAT(swapped.normal, isAt(plus({0, 0, 0}, normal, -1.0)));
  for (const auto& either : {pair, swapped}) {
    EXPECT_EQ(either.contactCount, contacts.size());
    ASSERT_EQ(either.contactPoints.size(), contacts.size());
    for (std::size_t i = 0; i < contacts.size(); ++i) EXPECT_THAT(either.contactPoints[i], isAt(contacts[i]));
    EXPECT_EQ(isEmpty(either.contactBox), contacts.empty());
  }
}

TEST(FclShapes, OfABallThatSinksIntoASolidTheDeepestPointIsItsLowest) {
  BoxModel box("box", Box{{-5, -5, -10}, {5, 5, 0}});
  for (const double z : {0.5, 0.01, 0.0, -0.01, -0.5, -0.875}) {
    SCOPED_TRACE(z);
    SphereModel round("round", {{0.5, 0.25, z}}, {1.0});
    expectDeep(round, box, 1.0 - z, {0.5, 0.25, z - 1.0}, {0.5, 0.25, 0}, {0, 0, 1}, {{0.5, 0.25, 0}});
  }
  SphereModel within("within", {{0.5, 0.25, -1.5}}, {1.0});
  expectDeep(within, box, 2.5, {0.5, 0.25, -2.5}, {0.5, 0.25, 0}, {0, 0, 1}, {});
}

TEST(FclShapes, OfACapsuleThatSinksIntoASolidTheDeepestPointIsItsLowest) {
  BoxModel box("box", Box{{-5, -5, -10}, {5, 5, 0}});
  for (const double z : {0.5, 0.0, -0.5, -3.0}) {  // the lower end of the core, of which the other is above
    SCOPED_TRACE(z);
    CapsuleModel upright("upright", {{{0.5, 0.25, 2.0}, {0.5, 0.25, z}, 1.0}});
    expectDeep(upright, box, 1.0 - z, {0.5, 0.25, z - 1.0}, {0.5, 0.25, 0}, {0, 0, 1}, {{0.5, 0.25, 0}});
  }
}

TEST(FclShapes, OfACapsuleThatCrossesASheetTheDepthIsFromTheSheetToItsSurface) {
  TriangleModel sheet("sheet", {{-4, -4, 0}, {4, -4, 0}, {0, 8, 0}}, {{0, 1, 2}});
  CapsuleModel flat("flat", {{{-1, 0.5, 0}, {1, 0.5, 0}, 0.5}});
  CapsuleModel slanted("slanted", {{{-1, 0.5, -1}, {1, 0.5, 1}, 0.5}});
  CapsuleModel upright("upright", {{{0, 0.5, -1}, {0, 0.5, 1}, 0.5}});
  const double part = std::sqrt(0.5);
  EXPECT_THAT(examine(flat, sheet).normal, isAt({0, 0, 1}));
  EXPECT_THAT(examine(slanted, sheet).normal, isAt({-part, 0, part}));
  EXPECT_NEAR(examine(upright, sheet).normal[2], 0.0, kClose);
  for (CapsuleModel* capsule : {&flat, &slanted, &upright}) {
    const auto pair = examine(*capsule, sheet);
    EXPECT_THAT(pair.depth, ::testing::Optional(0.5));
    EXPECT_THAT(pair.pointOnFirst, isAt(plus(pair.pointOnSecond, pair.normal, -0.5)));
    EXPECT_NEAR(pair.pointOnSecond[2], 0.0, kClose);
    EXPECT_NEAR(dot(pair.normal, pair.normal), 1.0, kClose);
  }
}

TEST(FclShapes, BallsAndCapsulesInOnePlaceHaveANormalAllTheSame) {
  SphereModel round("round", {{1, 2, 3}}, {1.0});
  SphereModel larger("larger", {{1, 2, 3}}, {3.0});
  const auto pair = examine(round, larger);
  EXPECT_THAT(pair.depth, ::testing::Optional(4.0));
  EXPECT_EQ(pair.normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(pair.pointOnFirst, (Vec3{1, 2, 2}));
  EXPECT_EQ(pair.pointOnSecond, (Vec3{1, 2, 6}));
  CapsuleModel along("along", {{{-5, 2, 3}, {7, 2, 3}, 0.5}});
  const auto through = examine(round, along);
  EXPECT_THAT(through.depth, ::testing::Optional(1.5));
  EXPECT_NEAR(through.normal[0], 0.0, kClose);
  EXPECT_NEAR(dot(through.normal, through.normal), 1.0, kClose);
  CapsuleModel across("across", {{{1, -6, 3}, {1, 12, 3}, 0.25}});
  EXPECT_THAT(examine(along, across).normal, isAt({0, 0, 1}));
}

TEST(FclShapes, WhatLiesFreeInABallOrACapsuleHasNoContactWithIt) {
  SphereModel around("around", {{0, 0, 0}}, {5.0});
  SphereModel free("free", {{0, 0, 1}}, {1.0});
  expectDeep(free, around, 5.0, {0, 0, 0}, {0, 0, 5}, {0, 0, 1}, {});
  CapsuleModel capsule("capsule", {{{-9, 0, 0}, {9, 0, 0}, 5.0}});
  expectDeep(free, capsule, 5.0, {0, 0, 0}, {0, 0, 5}, {0, 0, 1}, {});
  BoxModel box("box", Box{{-1, -1, 1}, {1, 1, 2}});
  EXPECT_EQ(examine(box, around).state, ExactState::Contained);
  EXPECT_EQ(examine(box, around).contactCount, 0U);
  EXPECT_EQ(examine(around, box).contactCount, 0U);
  EXPECT_TRUE(examine(around, box).contactPoints.empty());
  SphereModel touching("touching", {{0, 0, 4}}, {1.0});
  expectDeep(touching, around, 2.0, {0, 0, 3}, {0, 0, 5}, {0, 0, 1}, {{0, 0, 5}});
}

TEST(FclShapes, TheContactOfTwoBallsIsTheMiddleOfTheCircleInWhichTheyMeet) {
  SphereModel first("first", {{0, 0, 0}}, {5.0});
  SphereModel second("second", {{0, 0, 4}}, {3.0});  // in the circle of radius 3 around (0, 0, 4)
  const auto pair = examine(first, second);
  ASSERT_EQ(pair.contactPoints.size(), 1U);
  EXPECT_THAT(pair.contactPoints.front(), isAt({0, 0, 4}));
  EXPECT_THAT(examine(second, first).contactPoints.front(), isAt({0, 0, 4}));
}

double distanceTo(const Capsule& core, const Vec3& point) {
  const Vec3 along = plus(core.end, core.begin, -1.0);
  const double squared = dot(along, along);
  const double at = squared > 0.0 ? std::clamp(dot(plus(point, core.begin, -1.0), along) / squared, 0.0, 1.0) : 0.0;
  const Vec3 way = plus(point, plus(core.begin, along, at), -1.0);
  return std::sqrt(dot(way, way));
}

/// On a grid, where cores often meet, lie in a line, or are parallel.
TEST(FclShapes, ThePointsOfBallsAndCapsulesLieOnTheirSurfacesAsFarApartAsTheDepth) {
  constexpr std::uint32_t kSeed = 11;
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> grid(-2, 2);
  std::uniform_real_distribution<double> radius(0.25, 3.0);
  const auto place = [&] { return Vec3{double(grid(random)), double(grid(random)), double(grid(random))}; };
  const auto isInOrOn = [](const Capsule& capsule, const Vec3& point) {
    return distanceTo(capsule, point) <= capsule.radius + 1e-9;
  };
  int deep = 0;
  for (int i = 0; i < repeats(2000); ++i) {
    SCOPED_TRACE(::testing::Message() << "seed " << kSeed << ", " << i);
    Capsule a{place(), place(), radius(random)};
    Capsule b{place(), place(), radius(random)};
    if (i % 3 == 0) a.end = a.begin;
    if (i % 4 == 0) b.end = b.begin;
    CapsuleModel first("first", {a});
    CapsuleModel second("second", {b});
    const auto pair = examine(first, second);
    for (const Vec3& point : pair.contactPoints) EXPECT_TRUE(isInOrOn(a, point) && isInOrOn(b, point));
    if (!pair.depth || *pair.depth == 0.0) continue;
    ++deep;
    EXPECT_NEAR(dot(pair.normal, pair.normal), 1.0, kClose);
    EXPECT_NEAR(distanceTo(a, pair.pointOnFirst), a.radius, 1e-9);
    EXPECT_NEAR(distanceTo(b, pair.pointOnSecond), b.radius, 1e-9);
    const Vec3 reached = plus(pair.pointOnFirst, pair.normal, *pair.depth);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(reached[axis], pair.pointOnSecond[axis], 1e-9);
  }
  EXPECT_GT(deep, repeats(1000));
}

/// Of lines along cores, whose direction is the core's but for rounding.
TEST(FclShapes, ThePointsOfCapsulesLieOnTheirSurfacesHoweverLargeTheyAre) {
  constexpr std::uint32_t kSeed = 13;
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> grid(-3, 3);
  for (const double scale : {1e-6, 1.0, 1e8}) {
    const auto place = [&] {
      return Vec3{scale * 0.9 * grid(random), scale * 0.7 * grid(random), scale * 0.3 * grid(random)};
    };
    int deep = 0;
    for (int i = 0; i < repeats(400); ++i) {
      SCOPED_TRACE(::testing::Message() << "seed " << kSeed << ", " << i << ", scale " << scale);
      Capsule core{place(), place(), 0.2 * scale * (1 + i % 5)};
      if (core.begin == core.end) core.end[0] += scale;
      const Vec3 way = plus(core.end, core.begin, -1.0);
      CapsuleModel round("round", {core});
      LineModel line("line",
                     {plus(core.begin, way, 0.1 * (i % 10) - 0.5), plus(core.begin, {1e-3 * scale, 0, 0}),
                      plus(core.begin, way, 0.9 + 0.1 * (i % 5))},
                     {{0, i % 2 == 0 ? 2U : 1U}});
      for (const bool isTurned : {false, true}) {
        const auto pair = isTurned ? examine(line, round) : examine(round, line);
        if (!pair.depth || *pair.depth == 0.0) continue;
        ++deep;
        EXPECT_NEAR(dot(pair.normal, pair.normal), 1.0, kClose);
        EXPECT_NEAR(distanceTo(core, isTurned ? pair.pointOnSecond : pair.pointOnFirst), core.radius, 1e-6 * scale);
      }
    }
    EXPECT_GT(deep, repeats(200)) << scale;
  }
}

TEST(FclShapes, ACapsuleWithACoreWhoseDirectionIsLostIsABall) {
  CapsuleModel least("least", {{{0, 0, 0}, {1e-200, 0, 0}, 1.0}});
  SphereModel round("round", {{0, 0, 0}}, {2.0});
  const auto pair = examine(least, round);
  EXPECT_THAT(pair.normal, isAt({0, 0, 1}));
  EXPECT_THAT(pair.pointOnFirst, isAt({0, 0, -1}));
}

/// The same of balls and cuboids, with middles on the surface, within and outside.
TEST(FclShapes, ThePointsOfBallsAndCuboidsLieOnTheirSurfacesAsFarApartAsTheDepth) {
  constexpr std::uint32_t kSeed = 12;
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<int> grid(-3, 3);
  std::uniform_real_distribution<double> radius(0.25, 2.0);
  const auto cube = cuboid({-2, -2, -2}, {2, 2, 2});
  int deep = 0;
  for (int i = 0; i < repeats(400); ++i) {
    SCOPED_TRACE(::testing::Message() << "seed " << kSeed << ", " << i);
    const Vec3 middle{double(grid(random)), double(grid(random)), double(grid(random))};
    SphereModel round("round", {middle}, {radius(random)});
    const auto pair = examine(round, *cube);
    const auto farthest = [](const Vec3& p) { return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}); };
    for (const Vec3& point : pair.contactPoints) EXPECT_NEAR(farthest(point), 2.0, 1e-9);
    if (!pair.depth || *pair.depth == 0.0) continue;
    ++deep;
    EXPECT_NEAR(dot(pair.normal, pair.normal), 1.0, kClose);
    EXPECT_NEAR(distanceTo({middle, middle, 0.0}, pair.pointOnFirst), round.radii()[0], 1e-9);
    EXPECT_NEAR(farthest(pair.pointOnSecond), 2.0, 1e-9);
    const Vec3 reached = plus(pair.pointOnFirst, pair.normal, *pair.depth);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(reached[axis], pair.pointOnSecond[axis], 1e-9);
  }
  EXPECT_GT(deep, repeats(100));
}

TEST(FclShapes, CapsulesAreThickSegments) {
  CapsuleModel along("along", {{{-5, 0, 0}, {5, 0, 0}, 0.5}});
  CapsuleModel across("across", {{{0, -5, 2}, {0, 5, 2}, 0.5}});
  CapsuleModel crossing("crossing", {{{0, -5, 0.75}, {0, 5, 0.75}, 0.5}});
  EXPECT_NEAR(examine(along, across).distance, 1.0, kClose);
  EXPECT_NEAR(examine(along, crossing).depth.value_or(0.0), 0.25, kClose);
  const auto cube = cuboid({-1, -1, -3}, {1, 1, -1});
  EXPECT_NEAR(examine(along, *cube).distance, 0.5, kClose);
}

TEST(FclShapes, BoxesAreSolids) {
  BoxModel box("box", Box{{0, 0, 0}, {1, 1, 1}});
  BoxModel boxes("boxes", std::vector<Box>{{{5, 5, 5}, {6, 6, 6}}, {{0.9, 0.5, 0}, {2, 2, 2}}});
  EXPECT_NEAR(examine(box, boxes).depth.value_or(0.0), 0.1, kClose);
  OrientedBoxModel turned(
      "turned", {OrientedBox::turned({3, 0.5, 0.5},
                                     {0, 0, std::sin(std::acos(-1.0) / 8), std::cos(std::acos(-1.0) / 8)}, {1, 1, 1})});
  EXPECT_NEAR(examine(box, turned).distance, 2.0 - std::sqrt(2.0), kClose);
  BoxModel endless("endless", Box{{0, 0, 0}, {1, 1, std::numeric_limits<double>::infinity()}});
  EXPECT_EQ(examine(box, endless).state, ExactState::NotExamined);
}

TEST(FclShapes, TetrahedraAreSolidsByTheirBoundary) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {4, 4, 4}};
  TetrahedronModel two("two", points, {{0, 1, 2, 3}, {1, 2, 4, 3}});
  SphereModel within("within", {{1.2, 1.2, 1.2}}, {0.0});
  SphereModel outside("outside", {{-1, 1, 1}}, {0.25});
  EXPECT_EQ(examine(two, within).state, ExactState::Contained);
  EXPECT_NEAR(examine(two, outside).distance, 0.75, kClose);
}

TEST(FclShapes, ATetrahedronThatIsThereTwiceIsThereOnce) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {4, 4, 4}};
  SphereModel within("within", {{0.6, 0.6, 0.8}}, {0.0});
  for (const TetrahedronModel::Tetrahedron& again : {TetrahedronModel::Tetrahedron{0, 1, 2, 3}, {3, 0, 2, 1}}) {
    TetrahedronModel one("one", points, {{0, 1, 2, 3}, again});
    TetrahedronModel two("two", points, {{0, 1, 2, 3}, {1, 2, 4, 3}, again});
    for (TetrahedronModel* model : {&one, &two}) {
      const auto pair = examine(within, *model);
      EXPECT_EQ(pair.state, ExactState::Contained);
      EXPECT_THAT(pair.depth, ::testing::Optional(::testing::DoubleNear(0.6, kClose)));
      EXPECT_FALSE(pair.isSecondOpen);
    }
  }
}

TEST(FclShapes, PointsAndLinesTouchAndAreContained) {
  const auto cube = unitCube({0, 0, 0});
  PointModel points("points", {{0.5, 0.5, 0.75}, {3, 3, 3}});
  PointModel inner("inner", {{0.5, 0.5, 0.75}, {0.25, 0.5, 0.5}});
  PointModel onFace("onFace", {{0.5, 0.5, 1.0}});
  LineModel line("line", {{0.5, 0.5, 1.5}, {0.5, 0.5, 3.0}}, {{0, 1}});
  LineModel through("through", {{0.5, 0.25, -1.0}, {0.5, 0.25, 3.0}}, {{0, 1}});
  EXPECT_EQ(examine(points, *cube).state, ExactState::Clash) << "one of the two points lies outside";
  EXPECT_EQ(examine(inner, *cube).state, ExactState::Contained);
  EXPECT_NEAR(examine(points, *cube).depth.value_or(0.0), 0.25, kClose);
  EXPECT_EQ(examine(onFace, *cube).state, ExactState::Touching);
  EXPECT_NEAR(examine(line, *cube).distance, 0.5, kClose);
  EXPECT_EQ(examine(through, *cube).state, ExactState::Clash);
  EXPECT_NEAR(examine(through, *cube).depth.value_or(0.0), 0.25, kClose);
}

TEST(FclShapes, RandomPointsAreInsideOfABallExactlyWhenTheyAreNearItsCentre) {
  constexpr std::uint32_t kSeed = 7;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> anywhere(-1.5, 1.5);
  const auto solid = ball({0, 0, 0}, 1.0, 30);
  std::vector<std::unique_ptr<PointModel>> points;  // kept: a step knows models by their addresses
  FclNarrowPhase phase;
  phase.beginNarrowPhase();
  for (int i = 0; i < 400; ++i) {
    const Vec3 place{anywhere(random), anywhere(random), anywhere(random)};
    const double radius = std::hypot(place[0], place[1], place[2]);
    if (std::abs(radius - 1.0) < 0.01) continue;
    points.push_back(std::make_unique<PointModel>("point", std::vector<Vec3>{place}));
    phase.addCollisionPair({points.back().get(), solid.get()});
    const ExactPair& pair = phase.pairs().back();
    EXPECT_EQ(pair.state, radius < 1.0 ? ExactState::Contained : ExactState::Apart) << "seed " << kSeed << ", " << i;
    EXPECT_NEAR(radius < 1.0 ? pair.depth.value_or(0.0) : pair.distance, std::abs(radius - 1.0), 0.01);
  }
}

TEST(FclShapes, PointsInLineWithEdgesAndCornersAreInsideOrOutside) {
  const auto cube = cuboid({0, 0, 0}, {2, 2, 2});
  for (const double y : {0.0, 0.5, 1.0, 2.0, 3.0}) {
    for (const double z : {0.0, 1.0, 1.5, 2.0}) {
      PointModel left("left", {{-1.0, y, z}});
      PointModel right("right", {{3.0, y, z}});
      EXPECT_EQ(examine(left, *cube).state, ExactState::Apart);
      EXPECT_EQ(examine(right, *cube).state, ExactState::Apart);
    }
  }
  PointModel middle("middle", {{1.0, 1.0, 1.0}});
  EXPECT_EQ(examine(middle, *cube).state, ExactState::Contained);
}

}  // namespace
}  // namespace allpairs::test
