// SPDX-License-Identifier: MIT
// What a narrow phase says of bodies of several parts, of thick ones, and of meshes that are drawn unusually.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "FclExamine.h"
#include "Shapes.h"
#include "allpairs/Error.h"
#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/CapsuleModel.h"
#include "allpairs/collision/LineModel.h"
#include "allpairs/collision/PointModel.h"
#include "allpairs/collision/SphereModel.h"
#include "allpairs/collision/TetrahedronModel.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

using collision::BoxModel;
using collision::CapsuleModel;
using collision::LineModel;
using collision::PointModel;
using collision::SphereModel;
using collision::TetrahedronModel;

TEST(FclBodies, OfSeveralPartsTheNearestCountsWhicheverBoxIsNearest) {
  SphereModel ball("ball", {{0, 0, 0}}, {0.5});
  CapsuleModel capsules("capsules", {{{0, 4, 0}, {4, 0, 0}, 0.1}, {{-1.5, -1, 0}, {-1.5, 1, 0}, 0.1}});
  EXPECT_NEAR(examine(ball, capsules).distance, 0.9, kClose);
  EXPECT_NEAR(examine(capsules, ball).distance, 0.9, kClose);
}

TEST(FclBodies, OfPartsThatAreAsDeepOrAsFarAsEachOtherTheFirstIsReported) {
  for (const double start : {0.0, 16.0}) {
    const double end = 16.0 - start;
    SphereModel balls("balls", {{start, 0, 0}, {end, 0, 0}}, {}, 1.0);
    SphereModel deep("deep", {{0, 0, 1.5}, {16, 0, 1.5}}, {}, 1.0);
    const auto clash = examine(balls, deep);
    EXPECT_THAT(clash.depth, ::testing::Optional(0.5));
    EXPECT_EQ(clash.pointOnFirst[0], start);
    EXPECT_EQ(clash.pointOnSecond[0], start);
    SphereModel far("far", {{0, 0, 3}, {16, 0, 3}}, {}, 1.0);
    const auto apart = examine(balls, far);
    EXPECT_EQ(apart.distance, 1.0);
    EXPECT_EQ(apart.pointOnFirst[0], start);
    EXPECT_EQ(apart.pointOnSecond[0], start);
  }
}

/// Slanted capsules, of which the boxes of many overlap, in one of two layers.
std::vector<collision::Capsule> slanted(std::size_t count, double z) {
  std::vector<collision::Capsule> capsules;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = double(i * 37 % 101);
    const double y = double(i * 53 % 97);
    const double turn = double(i);
    capsules.push_back({{x, y, z}, {x + 8 * std::cos(turn), y + 8 * std::sin(turn), z + 2 * std::cos(2 * turn)}, 0.25});
  }
  return capsules;
}

TEST(FclBodies, OfManyPartsTheNearestIsThatOfEachTwoAlone) {
  for (const double z : {2.0, 5.0, 12.0}) {
    const auto low = slanted(90, 0.0);
    const auto high = slanted(70, z);
    ExactPair nearest;
    nearest.distance = std::numeric_limits<double>::infinity();
    for (const auto& a : low) {
      for (const auto& b : high) {
        CapsuleModel first("first", {a});
        CapsuleModel second("second", {b});
        const auto pair = examine(first, second);
        if (pair.distance < nearest.distance) nearest = pair;
      }
    }
    CapsuleModel first("first", low);
    CapsuleModel second("second", high);
    const auto pair = examine(first, second);
    EXPECT_EQ(pair.state, nearest.state) << z;
    EXPECT_EQ(pair.distance, nearest.distance) << z;
    EXPECT_EQ(pair.pointOnFirst, nearest.pointOnFirst) << z;
    EXPECT_EQ(pair.pointOnSecond, nearest.pointOnSecond) << z;
  }
}

/// Points in the places of a row, as capsules.
std::vector<collision::Capsule> row(std::size_t count, const Vec3& from) {
  std::vector<collision::Capsule> capsules;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 at{from[0], from[1] + 3.0 * double(i), from[2]};
    capsules.push_back({at, at, 0.0});
  }
  return capsules;
}

TEST(FclBodies, OfManyPartsThatAreAsFarAsEachOtherTheFirstAreReported) {
  CapsuleModel few("few", row(70, {0, 0, 0}));
  CapsuleModel many("many", row(90, {0, -30, 5}));
  const ExactPair pair = examine(few, many);
  EXPECT_EQ(pair.pointOnFirst, (Vec3{0, 0, 0}));
  EXPECT_EQ(pair.pointOnSecond, (Vec3{0, 0, 5}));
  const ExactPair swapped = examine(many, few);
  EXPECT_EQ(swapped.pointOnFirst, (Vec3{0, 0, 5}));
  EXPECT_EQ(swapped.pointOnSecond, (Vec3{0, 0, 0}));
}

TEST(FclBodies, OfManyPartsOneWithVolumeGivesADepthWhereItsBoxIsNearerThanWhatTouches) {
  ExactOptions options;
  options.tolerance = 0.01;
  for (const bool isThick : {true, false}) {
    auto low = row(70, {20, 0, 0});
    auto high = row(70, {20, 0, 40});
    low.front() = {{0, 0, 0}, {10, 10, 0}, isThick ? 0.1 : 0.0};
    high.front() = {{10.15, 0, 0}, {10.15, 0, 0}, 0.0};
    high.back() = low.back();
    high.back().begin[2] = high.back().end[2] = 0.2;
    CapsuleModel first("first", low);
    CapsuleModel second("second", high);
    const ExactPair pair = examine(first, second, options);
    EXPECT_EQ(pair.state, ExactState::Touching);
    EXPECT_EQ(pair.depth.has_value(), isThick);
  }
}

TEST(FclBodies, OneThatHasVolumeGivesTheDepthAPlace) {
  SphereModel first("first", {{0, 0, 0}, {10, 0, 0}}, {1.0, 0.0});
  SphereModel second("second", {{0, 0, 1.5}, {10, 0, 0}}, {1.0, 0.0});
  EXPECT_THAT(examine(first, second).depth, ::testing::Optional(::testing::DoubleNear(0.5, kClose)));
}

TEST(FclBodies, DuplicatesHaveThePartsOfEachOther) {
  SphereModel twice("twice", {{0, 0, 0}, {0, 0, 0}}, {}, 1.0);
  SphereModel two("two", {{0, 0, 0}, {5, 0, 0}}, {}, 1.0);
  SphereModel again("again", {{5, 0, 0}, {0, 0, 0}}, {}, 1.0);
  EXPECT_NE(examine(twice, two).state, ExactState::Duplicate);
  EXPECT_NE(examine(two, twice).state, ExactState::Duplicate);
  const auto pair = examine(two, again);
  EXPECT_EQ(pair.state, ExactState::Duplicate);
  EXPECT_EQ(pair.contactBox, (Box{{-1, -1, -1}, {6, 1, 1}})) << "radii included";
}

TEST(FclBodies, BallsAroundOnePointAreDuplicatesOnlyOfTheSameRadius) {
  SphereModel small("small", {{1, 2, 3}}, {1.0});
  SphereModel large("large", {{1, 2, 3}}, {2.0});
  EXPECT_EQ(examine(small, large).state, ExactState::Contained);
  EXPECT_EQ(examine(large, small).state, ExactState::Contained);
}

TEST(FclBodies, ManySmallFlushFacesHideNoFewOthers) {
  const auto same = unitCube({20, 20, 0.5});
  const auto hole = cuboid({20.25, 20.25, 0.75}, {20.75, 20.75, 1.25}, true);
  const auto inHole = cuboid({20.25, 20.25, 0.75}, {20.75, 20.75, 1.25});
  constexpr std::uint32_t kMany = kIsSanitized ? 28 : 40;  // so many that fewer than 64 places are looked beside
  for (const std::uint32_t n : {1U, 8U, 20U, kMany}) {
    const auto left = fineCube({0, 0, 0}, n);
    const auto right = fineCube({1, 0, 0}, n);
    EXPECT_EQ(examine(*together({left.get(), same.get()}), *together({right.get(), same.get()})).state,
              ExactState::Clash)
        << n;
    const auto filling = together({left.get(), inHole.get()});  // only its second cube is outside of the other part
    EXPECT_EQ(examine(*filling, *together({left.get(), same.get(), hole.get()})).state, ExactState::Clash) << n;
  }
}

TEST(FclBodies, ACapsuleIsTheSameFromEitherEnd) {
  CapsuleModel one("one", {{{0, 0, 0}, {1, 2, 3}, 0.5}});
  CapsuleModel turned("turned", {{{1, 2, 3}, {0, 0, 0}, 0.5}});
  CapsuleModel shorter("shorter", {{{0.5, 1, 1.5}, {0, 0, 0}, 0.5}});
  EXPECT_EQ(examine(one, turned).state, ExactState::Duplicate);
  EXPECT_EQ(examine(turned, one).state, ExactState::Duplicate);
  EXPECT_EQ(examine(one, shorter).state, ExactState::Contained);
}

TEST(FclBodies, ABallThatReachesOutOfAnotherIsNotWithin) {
  SphereModel outer("outer", {{0, 0, 0}}, {1.0});
  SphereModel inner("inner", {{0.4, 0.4, 0.4}}, {0.5});
  EXPECT_EQ(examine(outer, inner).state, ExactState::Clash);
  EXPECT_EQ(examine(inner, outer).state, ExactState::Clash);
}

TEST(FclBodies, ABallHoldsASolidAroundItsCentre) {
  SphereModel round("round", {{0, 0, 0}}, {1.0});
  const auto cube = cuboid({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
  EXPECT_EQ(examine(round, *cube).state, ExactState::Contained);
  EXPECT_EQ(examine(*cube, round).state, ExactState::Contained);
}

TEST(FclBodies, ABallThatTouchesASurfaceFromWithinIsContained) {
  const auto cube = cuboid({-4, -4, -4}, {4, 4, 4});
  SphereModel resting("resting", {{0, 0, 3.25}}, {0.75});
  SphereModel sunk("sunk", {{0, 0, 3.375}}, {0.75});
  EXPECT_EQ(examine(resting, *cube).state, ExactState::Contained);
  EXPECT_EQ(examine(*cube, resting).state, ExactState::Contained);
  EXPECT_EQ(examine(sunk, *cube).state, ExactState::Clash);
  EXPECT_EQ(examine(*cube, sunk).state, ExactState::Clash);
}

TEST(FclBodies, OnlyWhatFitsIntoTheBoxOfAnOpenSurfaceMayLieInIt) {
  const auto open = openCube();
  SphereModel within("within", {{0, 0, 0}}, {0.25});
  SphereModel stickingOut("stickingOut", {{1.9, -0.7, 0.7}}, {0.3});  // where its last triangle is missing
  EXPECT_EQ(examine(*open, within).state, ExactState::Undecided);
  EXPECT_EQ(examine(*open, stickingOut).state, ExactState::Apart);
}

TEST(FclBodies, EmptyBoxesAreNoPartsAndRadiiHaveABound) {
  BoxModel box("box", Box{{0, 0, 0}, {1, 1, 1}});
  BoxModel beside("beside", std::vector<Box>{kEmptyBox, {{3, 0, 0}, {4, 1, 1}}, {{1, 1, 1}, {0.25, 0.25, 0.25}}});
  const auto pair = examine(box, beside);
  EXPECT_EQ(pair.state, ExactState::Apart);
  EXPECT_NEAR(pair.distance, 2.0, kClose);
  SphereModel huge("huge", {{0, 0, 0}}, {1e80});
  EXPECT_EQ(examine(box, huge).state, ExactState::NotExamined);
}

TEST(FclBodies, FacesBetweenTetrahedraAreNoSurface) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}, {4, 4, 4}};
  TetrahedronModel two("two", points, {{0, 1, 2, 3}, {1, 2, 4, 3}});
  PointModel onFace("onFace", {{4.0 / 3, 4.0 / 3, 4.0 / 3}});  // that both have
  const auto pair = examine(two, onFace);
  EXPECT_EQ(pair.state, ExactState::Contained);
  EXPECT_GT(pair.depth.value_or(0.0), 1.0);
}

TEST(FclBodies, ToleranceIsOfTheLargerOfTwoRadiiIncluded) {
  const auto large = cuboid({0, 0, 0}, {1000, 1000, 1000});
  const auto small = cuboid({1000 + 5e-7, 0, 0}, {1001, 1, 1});
  EXPECT_EQ(examine(*large, *small).state, ExactState::Touching);
  EXPECT_EQ(examine(*small, *large).state, ExactState::Touching);
  SphereModel first("first", {{0, 0, 0}}, {1000.0});
  SphereModel second("second", {{2000 + 1e-6, 0, 0}}, {1000.0});
  EXPECT_EQ(examine(first, second).state, ExactState::Touching);
}

TEST(FclBodies, FarFromTheOriginWhatIsARoundingApartTouches) {
  for (const double at : {1e8, -1e8}) {
    const auto first = unitCube({at, 0, 0});
    const auto second = unitCube({at + 1.0 + 3e-8, 0, 0});
    EXPECT_EQ(examine(*first, *second).state, ExactState::Touching);
    EXPECT_EQ(examine(*first, *unitCube({at + 1.0 + 3e-6, 0, 0})).state, ExactState::Apart);
  }
}

TEST(FclBodies, WhatOnlyTouchesHasNoDepthHoweverItIsRounded) {
  const auto cube = unitCube({0, 0, 0});
  const auto pair = examine(*cube, *unitCube({1.0 - 1e-11, 0, 0}));
  EXPECT_EQ(pair.state, ExactState::Touching);
  EXPECT_EQ(pair.depth, 0.0);
  TriangleModel sheet("sheet", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  TriangleModel other("other", {{1, 0, 0}, {2, 0, 0}, {2, 1, 3}}, {{0, 1, 2}});
  const auto sheets = examine(sheet, other);
  EXPECT_EQ(sheets.state, ExactState::Touching);
  EXPECT_EQ(sheets.depth, std::nullopt) << "without volume";
}

TEST(FclBodies, NormalsOfWhatTouchesAreThoseOfTheTrianglesElseAlongTheMiddles) {
  const auto cube = unitCube({0, 0, 0});
  PointModel point("point", {{0.875, 0.5, 1.0}});
  EXPECT_EQ(examine(*cube, point).normal, (Vec3{0, 0, -1}));
  EXPECT_EQ(examine(point, *cube).normal, (Vec3{0, 0, 1}));
  LineModel first("first", {{0, 0, 0}, {1, 0, 0}}, {{0, 1}});
  LineModel second("second", {{1, 0, 0}, {2, 0, 0}}, {{0, 1}});
  EXPECT_EQ(examine(first, second).state, ExactState::Touching);
  EXPECT_EQ(examine(first, second).normal, (Vec3{-1, 0, 0}));
  LineModel across("across", {{0.5, -1, 0}, {0.5, 1, 0}}, {{0, 1}});
  EXPECT_EQ(examine(first, across).normal, (Vec3{0, 0, 1})) << "of the same middle";
}

TEST(FclBodies, NearlyParallelLinesAreNearestWhereTheyPassEachOther) {
  LineModel first("first", {{-5, -0.025, 0}, {5, 0.025, 0}}, {{0, 1}});
  LineModel second("second", {{-5, 0.025, 1}, {5, -0.025, 1}}, {{0, 1}});
  EXPECT_NEAR(examine(first, second).distance, 1.0, kClose);
}

TEST(FclBodies, ASolidIsNoDuplicateOfTheSameWithAHollow) {
  const auto block = cuboid({0, 0, 0}, {10, 10, 10});
  const auto hollow = cuboid({4, 4, 4}, {6, 6, 6}, true);
  const auto outer = together({block.get(), hollow.get()});
  EXPECT_NE(examine(*block, *outer).state, ExactState::Duplicate);
  EXPECT_NE(examine(*outer, *block).state, ExactState::Duplicate);
}

/// Points beside a cube, of which each ray along x passes two sides or none.
TEST(FclBodies, WhereTrianglesFaceEitherWayPointsBesideASolidAreOutside) {
  const auto cube = cuboid({0, 0, 0}, {2, 2, 2});
  const auto before = cuboid({-4, 0, 0}, {-3, 2, 2});  // so that the points lie in the box
  const auto plain = together({before.get(), cube.get()});
  auto triangles = plain->triangles();
  for (std::size_t i = 0; i < triangles.size(); i += 3) std::swap(triangles[i][0], triangles[i][1]);
  TriangleModel mixed("mixed", plain->positions(), triangles);
  for (const double y : {0.25, 0.75, 1.25, 1.75}) {
    for (const double z : {0.375, 0.875, 1.375, 1.875}) {
      PointModel beside("beside", {{-1, y, z}});
      PointModel within("within", {{1, y, z}});
      EXPECT_EQ(examine(mixed, beside).state, ExactState::Apart);
      EXPECT_EQ(examine(mixed, within).state, ExactState::Contained);
    }
  }
}

TEST(FclBodies, WhatIsDrawnForEitherSideBesideASolidIsSolidOnlyWhereItCloses) {
  const auto cube = unitCube({0, 0, 0});
  const auto there = unitCube({5, 0, 0});
  const auto back = cuboid({5, 0, 0}, {6, 1, 1}, true);
  const auto closed = together({cube.get(), there.get(), back.get()});
  TriangleModel fin("fin", {{9, -5, -5}, {9, 7, -5}, {9, 0, 9}}, {{0, 1, 2}, {0, 2, 1}});
  const auto finned = together({cube.get(), &fin});
  PointModel within("within", {{5.5, 0.375, 0.625}});
  PointModel between("between", {{3, 0.375, 0.625}});
  PointModel inCube("inCube", {{0.5, 0.375, 0.625}});
  EXPECT_EQ(examine(*closed, within).state, ExactState::Contained);
  EXPECT_EQ(examine(*closed, between).state, ExactState::Apart);
  EXPECT_EQ(examine(*finned, between).state, ExactState::Apart);
  EXPECT_EQ(examine(*finned, inCube).state, ExactState::Contained);
}

TEST(FclBodies, TrianglesThatGoBackToTheirFirstCornerChangeNothing) {
  const auto cube = unitCube({0, 0, 0});
  for (const TriangleModel::Triangle& flat : {TriangleModel::Triangle{0, 1, 0}, {0, 1, 1}, {1, 1, 0}}) {
    auto triangles = cube->triangles();
    triangles.push_back(flat);
    TriangleModel seamed("seamed", cube->positions(), triangles);
    PointModel within("within", {{0.5, 0.375, 0.625}});
    const auto pair = examine(seamed, within);
    EXPECT_EQ(pair.state, ExactState::Contained);
    EXPECT_FALSE(pair.isFirstOpen);
  }
}

TEST(FclBodies, ContactPointsAreEvenlySampled) {
  const auto first = fineCube({0, 0, 0}, 4);
  const auto second = fineCube({0.5, 0.5, 0.5}, 4);
  const auto all = examine(*first, *second, {.contactLimit = 100000}).contactPoints;
  const auto some = examine(*first, *second, {.contactLimit = 4}).contactPoints;
  ASSERT_GT(all.size(), 8U);
  ASSERT_EQ(some.size(), 4U);
  for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(some[i], all[i * all.size() / 4]);
}

TEST(FclBodies, ModelsAreReadAnewInEachStep) {
  SphereModel still("still", {{0, 0, 0}}, {1.0});
  SphereModel moving("moving", {{4, 0, 0}}, {1.0});
  FclNarrowPhase phase;
  for (const auto& [x, distance] : {std::pair(4.0, 2.0), {3.0, 1.0}, {6.0, 4.0}}) {
    moving.setCentres({{x, 0, 0}});
    phase.beginNarrowPhase();
    phase.addCollisionPair({&still, &moving});
    phase.endNarrowPhase();
    ASSERT_EQ(phase.pairs().size(), 1U);
    EXPECT_NEAR(phase.pairs().front().distance, distance, kClose);
  }
}

TEST(FclBodies, AToleranceOfZeroIsOneAndEachBelowIsRefused) {
  EXPECT_NO_THROW(FclNarrowPhase({.tolerance = 0.0, .duplicateTolerance = 0.0, .clearance = 0.0}));
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(FclNarrowPhase({.tolerance = bad}), InvalidArgument);
    EXPECT_THROW(FclNarrowPhase({.duplicateTolerance = bad}), InvalidArgument);
    EXPECT_THROW(FclNarrowPhase({.clearance = bad}), InvalidArgument);
    EXPECT_THROW(FclNarrowPhase({.leastDepth = bad}), InvalidArgument);
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(FclNarrowPhase({.tolerance = kInfinity}), InvalidArgument);
  EXPECT_THROW(FclNarrowPhase({.duplicateTolerance = kInfinity}), InvalidArgument);
  EXPECT_NO_THROW(FclNarrowPhase({.clearance = kInfinity, .leastDepth = kInfinity}));
}

}  // namespace
}  // namespace allpairs::test
