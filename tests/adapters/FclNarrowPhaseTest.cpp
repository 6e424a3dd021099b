// SPDX-License-Identifier: MIT
#include "allpairs/fcl/FclNarrowPhase.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "FclExamine.h"
#include "Shapes.h"
#include "allpairs/Error.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/collision/CollisionPipeline.h"
#include "allpairs/collision/DiscreteIntersection.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

using collision::CollisionModel;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Optional;

auto near(double x, double y, double z) {
  return ElementsAre(DoubleNear(x, kClose), DoubleNear(y, kClose), DoubleNear(z, kClose));
}

auto depthOf(double depth) { return Optional(DoubleNear(depth, kClose)); }

TEST(FclNarrowPhase, AlignedCubesThatShareATenthAreATenthDeep) {
  const auto pair = examine(*unitCube({0.0, 0.0, 0.0}), *unitCube({0.9, 0.0, 0.0}));
  EXPECT_EQ(pair.state, ExactState::Clash);
  EXPECT_THAT(pair.depth, depthOf(0.1));
  EXPECT_EQ(pair.distance, 0.0);
  EXPECT_THAT(pair.normal, near(-1.0, 0.0, 0.0));
}

TEST(FclNarrowPhase, ShiftedCubesMeetWhereTheirFacesCross) {
  const auto pair = examine(*unitCube({0.0, 0.0, 0.0}), *unitCube({0.9, 0.3, 0.2}));
  EXPECT_EQ(pair.state, ExactState::Clash);
  EXPECT_THAT(pair.depth, depthOf(0.1));
  EXPECT_THAT(pair.normal, near(-1.0, 0.0, 0.0));
  EXPECT_GT(pair.contactCount, 4U);
  for (const Vec3& point : pair.contactPoints) {
    EXPECT_TRUE(overlap({point, point}, {{0.9, 0.3, 0.2}, {1.0, 1.0, 1.0}}, kClose));
  }
  EXPECT_TRUE(overlap(pair.contactBox, {{0.9, 0.3, 0.2}, {1.0, 1.0, 1.0}}));
}

TEST(FclNarrowPhase, CubesThatShareAFaceTouchWithoutDepth) {
  for (const Vec3& place : {Vec3{1.0, 0.0, 0.0}, Vec3{1.0, 0.3, 0.2}, Vec3{-1.0, 0.5, 0.0}}) {
    const auto pair = examine(*unitCube({0.0, 0.0, 0.0}), *unitCube(place));
    EXPECT_EQ(pair.state, ExactState::Touching);
    EXPECT_THAT(pair.depth, depthOf(0.0));
    EXPECT_EQ(pair.distance, 0.0);
    EXPECT_THAT(pair.normal, near(place[0] > 0.0 ? -1.0 : 1.0, 0.0, 0.0));
    for (const Vec3& point : pair.contactPoints) EXPECT_EQ(point[0], place[0] > 0.0 ? 1.0 : 0.0);
  }
}

TEST(FclNarrowPhase, CubesThatShareACornerTouchThere) {
  const auto pair = examine(*unitCube({0.0, 0.0, 0.0}), *unitCube({1.0, 1.0, 1.0}));
  EXPECT_EQ(pair.state, ExactState::Touching);
  EXPECT_THAT(pair.depth, depthOf(0.0));
  for (const Vec3& point : pair.contactPoints) EXPECT_THAT(point, near(1.0, 1.0, 1.0));
}

TEST(FclNarrowPhase, CubesAQuarterApartAreAQuarterApart) {
  const auto pair = examine(*unitCube({0.0, 0.0, 0.0}), *unitCube({1.25, 0.0, 0.0}));
  EXPECT_EQ(pair.state, ExactState::Apart);
  EXPECT_EQ(pair.distance, 0.25);
  EXPECT_EQ(pair.depth, std::nullopt);
  EXPECT_EQ(pair.pointOnFirst[0], 1.0);
  EXPECT_EQ(pair.pointOnSecond[0], 1.25);
  EXPECT_THAT(pair.normal, near(-1.0, 0.0, 0.0));
  EXPECT_EQ(pair.contactCount, 0U);
  EXPECT_TRUE(isEmpty(pair.contactBox));
}

TEST(FclNarrowPhase, TheDistanceIsEuclidean) {
  const auto pair = examine(*unitCube({0.0, 0.0, 0.0}), *unitCube({1.3, 1.4, 0.0}));
  EXPECT_NEAR(pair.distance, 0.5, kClose);
}

TEST(FclNarrowPhase, APartWithinASolidIsContainedAsDeepAsItsDeepestPoint) {
  const auto inner = cuboid({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5});
  const auto outer = unitCube({0.0, 0.0, 0.0});
  for (const auto& pair : {examine(*inner, *outer), examine(*outer, *inner)}) {
    EXPECT_EQ(pair.state, ExactState::Contained);
    EXPECT_THAT(pair.depth, depthOf(0.5));
    EXPECT_EQ(pair.distance, 0.0);
    EXPECT_EQ(pair.contactCount, 0U);
  }
}

TEST(FclNarrowPhase, APartInTheHollowOfAnotherIsApart) {
  const auto outer = cuboid({0.0, 0.0, 0.0}, {10.0, 10.0, 10.0});
  const auto hollow = cuboid({1.0, 1.0, 1.0}, {9.0, 9.0, 9.0}, true);
  const auto shell = together({outer.get(), hollow.get()});
  const auto pair = examine(*shell, *unitCube({1.5, 4.0, 4.0}));
  EXPECT_EQ(pair.state, ExactState::Apart);
  EXPECT_EQ(pair.distance, 0.5);
}

TEST(FclNarrowPhase, SolidsThatOverlapThemselvesStaySolid) {
  const auto left = cuboid({0.0, 0.0, 0.0}, {6.0, 4.0, 4.0});
  const auto right = cuboid({4.0, 0.0, 0.0}, {10.0, 4.0, 4.0});
  const auto welded = together({left.get(), right.get()});
  const auto pair = examine(*welded, *cuboid({4.9, 1.9, 1.9}, {5.1, 2.1, 2.1}));
  EXPECT_EQ(pair.state, ExactState::Contained);
}

TEST(FclNarrowPhase, TrianglesThatFaceEitherWayStillCloseASolid) {
  const auto cube = unitCube({0.0, 0.0, 0.0});
  auto triangles = cube->triangles();
  std::swap(triangles[3][0], triangles[3][1]);
  TriangleModel mixed("mixed", cube->positions(), triangles);
  const auto pair = examine(mixed, *cuboid({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6}));
  EXPECT_EQ(pair.state, ExactState::Contained);
}

TEST(FclNarrowPhase, AVertexPerTriangleClosesASolidToo) {
  const auto cube = unitCube({0.0, 0.0, 0.0});
  std::vector<Vec3> points;
  std::vector<TriangleModel::Triangle> triangles;
  for (const auto& triangle : cube->triangles()) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (const std::uint32_t vertex : triangle) points.push_back(cube->positions()[vertex]);
    triangles.push_back({first, first + 1, first + 2});
  }
  TriangleModel soup("soup", points, triangles);
  EXPECT_EQ(examine(soup, *cuboid({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6})).state, ExactState::Contained);
}

TEST(FclNarrowPhase, SheetsThatCrossClashAndHaveNoDepth) {
  TriangleModel floor("floor", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  TriangleModel wall("wall", {{1, 1, -1}, {1, 1, 1}, {1, 2, 1}}, {{0, 1, 2}});
  const auto pair = examine(floor, wall);
  EXPECT_EQ(pair.state, ExactState::Clash);
  EXPECT_EQ(pair.depth, std::nullopt);
  ASSERT_EQ(pair.contactPoints.size(), 1U);
  EXPECT_THAT(pair.contactPoints.front(), near(1.0, 1.25, 0.0));
}

TEST(FclNarrowPhase, ASheetThatReachesIntoASolidIsAsDeepAsItsVertex) {
  TriangleModel sheet("sheet", {{0.5, 0.5, 0.8}, {0.5, 0.4, 3.0}, {0.5, 0.6, 3.0}}, {{0, 1, 2}});
  const auto pair = examine(sheet, *unitCube({0.0, 0.0, 0.0}));
  EXPECT_EQ(pair.state, ExactState::Clash);
  EXPECT_THAT(pair.depth, depthOf(0.2));
  EXPECT_THAT(pair.pointOnFirst, near(0.5, 0.5, 0.8));
  EXPECT_THAT(pair.pointOnSecond, near(0.5, 0.5, 1.0));
  EXPECT_THAT(pair.normal, near(0.0, 0.0, 1.0));
}

TEST(FclNarrowPhase, CrossedBeamsAreAsDeepAsTheirFacesAreBelowEachOther) {
  const auto along = cuboid({-5.0, -0.5, 0.0}, {5.0, 0.5, 1.0});
  const auto across = cuboid({-0.5, -5.0, 0.9}, {0.5, 5.0, 1.9});
  const auto pair = examine(*along, *across);
  EXPECT_EQ(pair.state, ExactState::Clash);
  EXPECT_THAT(pair.depth, depthOf(0.1));
  EXPECT_THAT(pair.normal, near(0.0, 0.0, -1.0));
}

TEST(FclNarrowPhase, ABarThroughAPlateClashesHoweverThinAndTurnedTheyAre) {
  for (const double thickness : {0.1, 0.01, 1e-3, 1e-4}) {
    for (const double width : {0.1, 0.01, 1e-3}) {
      const auto plate = cuboid({-1, -1, 0}, {1, 1, thickness});
      const auto bar = cuboid({0.31, 0.17, -1.1}, {0.31 + width, 0.17 + width, 0.9});
      for (int i = 0; i < repeats(24); ++i) {
        const auto pair = examine(*turned(*plate, 0.13 * i), *turned(*bar, 0.13 * i));
        EXPECT_EQ(pair.state, ExactState::Clash) << thickness << ' ' << width << ' ' << i;
        const double most = std::max(thickness, width) / 2.0;  // in the middle of the plate, or of the bar
        EXPECT_GT(pair.depth.value_or(0.0), 0.2 * most) << thickness << ' ' << width << ' ' << i;
        EXPECT_LT(pair.depth.value_or(0.0), most * (1.0 + 1e-9) + kClose);
      }
    }
  }
}

/// A slab from z = 0 to 0.25 with an opening from (1, 2) to (3, 4).
std::unique_ptr<TriangleModel> frame() {
  std::vector<Vec3> points;
  for (const double z : {0.0, 0.25}) {
    for (const auto& [x, y] : {std::pair(0, 0), {4, 0}, {4, 6}, {0, 6}, {1, 2}, {3, 2}, {3, 4}, {1, 4}}) {
      points.push_back({double(x), double(y), z});
    }
  }
  std::vector<TriangleModel::Quad> quads;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    quads.push_back({i + 4, next + 4, next, i});            // below
    quads.push_back({i + 8, next + 8, next + 12, i + 12});  // above
    quads.push_back({i, next, next + 8, i + 8});            // around
    quads.push_back({next + 4, i + 4, i + 12, next + 12});  // the opening
  }
  return std::make_unique<TriangleModel>("frame", points, std::vector<TriangleModel::Triangle>{}, quads);
}

TEST(FclNarrowPhase, WhatStandsInAnOpeningIsApartHoweverBothAreTurned) {
  for (int i = 0; i < 60; ++i) {
    const double gap = 0.125;
    const auto window = cuboid({1.0 + gap, 2.0 + gap, 0}, {3.0 - gap, 4.0 - gap, 0.25});
    const auto move = [i](const TriangleModel& model) {
      std::vector<Vec3> points = model.positions();
      const double c = std::cos(0.1 * i);
      const double s = std::sin(0.1 * i);
      for (Vec3& p : points) p = {p[0] + 10.3, c * p[1] - s * p[2] + 7.7, s * p[1] + c * p[2] + 2.6};  // about x
      return std::make_unique<TriangleModel>("moved", points, model.triangles());
    };
    const auto pair = examine(*move(*frame()), *move(*window));
    EXPECT_EQ(pair.state, ExactState::Apart) << i;
    EXPECT_NEAR(pair.distance, gap, kClose) << i;
  }
}

TEST(FclNarrowPhase, SmallAndLargePartsAreAsFarApartAndAsDeepInTheirUnit) {
  const auto left = ball({0.0, 0.0, 0.0}, 1.0, 32);
  for (const double place : {2.01, 1.9}) {
    const auto right = ball({place, 0.1, 0.2}, 1.0, 32);
    const auto plain = examine(*turned(*left, 0.5), *turned(*right, 0.5));
    for (const double scale : {1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9}) {
      if (kIsSanitized && scale > 1e-9 && scale < 1e9) continue;
      const auto pair = examine(*turned(*left, 0.5, scale), *turned(*right, 0.5, scale));
      EXPECT_EQ(pair.state, plain.state) << scale;
      EXPECT_NEAR(pair.distance / scale, plain.distance, kClose) << scale;
      EXPECT_NEAR(pair.depth.value_or(0.0) / scale, plain.depth.value_or(0.0), kClose) << scale;
    }
  }
}

TEST(FclNarrowPhase, SizesOfWhichProductsHaveNoRoomAmongTheNumbersAreNotExamined) {
  for (const double size : {1e-320, 1e-150, 1e-80, 1e71, 1e150, 4e307}) {
    const auto cube = cuboid({0, 0, 0}, {2 * size, 2 * size, 2 * size});
    const auto other = cuboid({size, size, size}, {3 * size, 3 * size, 3 * size});
    EXPECT_EQ(examine(*cube, *other).state, ExactState::NotExamined) << size;
  }
  for (const double size : {1e-60, 1e69}) {
    const auto cube = cuboid({0, 0, 0}, {2 * size, 2 * size, 2 * size});
    const auto other = cuboid({size, size, size}, {3 * size, 3 * size, 3 * size});
    const auto pair = examine(*cube, *other);
    EXPECT_EQ(pair.state, ExactState::Clash) << size;
    EXPECT_THAT(pair.depth, ::testing::Optional(::testing::DoubleNear(size, 1e-9 * size)));
  }
}

TEST(FclNarrowPhase, BallsOfTrianglesAreNearlyAsDeepAndAsFarAsSpheres) {
  const auto deep = examine(*ball({0.0, 0.0, 0.0}, 1.0), *ball({0.0, 0.0, 1.9}, 1.0));
  EXPECT_EQ(deep.state, ExactState::Clash);
  EXPECT_NEAR(deep.depth.value_or(0.0), 0.1, 1e-3);
  EXPECT_NEAR(deep.normal[2], -1.0, 0.01);
  const auto far = examine(*ball({0.0, 0.0, 0.0}, 1.0), *ball({0.0, 0.0, 2.5}, 1.0));
  EXPECT_EQ(far.state, ExactState::Apart);
  EXPECT_NEAR(far.distance, 0.5, kClose);
}

TEST(FclNarrowPhase, BoxesThatOverlapAroundBallsThatDoNotAreFalseCandidates) {
  const auto pair = examine(*ball({0.0, 0.0, 0.0}, 1.0, 40), *ball({1.5, 1.5, 1.5}, 1.0, 40));
  EXPECT_EQ(pair.state, ExactState::Apart);
  EXPECT_NEAR(pair.distance, 1.5 * std::sqrt(3.0) - 2.0, 0.01);
}

TEST(FclNarrowPhase, ContactPointsAreAtMostAsManyAsAskedFor) {
  const ExactOptions three{.contactLimit = 3};
  const auto pair = examine(*ball({0.0, 0.0, 0.0}, 1.0), *ball({0.0, 0.5, 0.5}, 1.0), three);
  EXPECT_EQ(pair.contactPoints.size(), 3U);
  EXPECT_GT(pair.contactCount, 100U);
}

TEST(FclNarrowPhase, AModelWithItselfIsNotExamined) {
  const auto cube = unitCube({0.0, 0.0, 0.0});
  EXPECT_EQ(examine(*cube, *cube).state, ExactState::NotExamined);
}

TEST(FclNarrowPhase, RefusesWhatMakesNoSense) {
  EXPECT_THROW(FclNarrowPhase({.tolerance = -1.0}), InvalidArgument);
  FclNarrowPhase phase;
  EXPECT_THROW(phase.addCollisionPair({nullptr, nullptr}), InvalidArgument);
}

TEST(FclNarrowPhase, TakesTheCandidatesOfThePipelineInTheirOrder) {
  const auto a = ball({0.0, 0.0, 0.0}, 1.0);
  const auto b = ball({1.5, 1.5, 1.5}, 1.0);
  const auto c = ball({0.0, 0.0, 1.9}, 1.0);
  std::vector<CollisionModel*> models{a.get(), b.get(), c.get()};
  for (CollisionModel* model : models) model->setOwner(model);

  collision::DiscreteIntersection method;
  collision::BruteForceBroadPhase broadPhase;
  FclNarrowPhase narrowPhase;
  collision::CollisionPipeline pipeline;
  pipeline.setIntersectionMethod(&method);
  pipeline.setBroadPhase(&broadPhase);
  pipeline.setNarrowPhase(&narrowPhase);
  for (int step = 0; step < 2; ++step) {
    const auto& candidates = pipeline.step(models);
    ASSERT_EQ(narrowPhase.pairs().size(), candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      EXPECT_EQ(narrowPhase.pairs()[i].first, candidates[i].first->getLast());
      EXPECT_EQ(narrowPhase.pairs()[i].second, candidates[i].second->getLast());
    }
  }
  ASSERT_EQ(narrowPhase.pairs().size(), 3U);
  EXPECT_EQ(narrowPhase.pairs()[0].state, ExactState::Apart);
  EXPECT_EQ(narrowPhase.pairs()[1].state, ExactState::Clash);
}

TEST(FclNarrowPhase, FinelyCutCubesAreAsDeepAsPlainOnes) {
  const auto cube = fineCube({0.0, 0.0, 0.0}, 32);
  const auto face = examine(*cube, *fineCube({0.90625, 0.015625, 0.25}, 32));
  EXPECT_EQ(face.state, ExactState::Clash);
  EXPECT_THAT(face.depth, depthOf(0.09375));
  EXPECT_THAT(examine(*cube, *unitCube({0.5, 0.5, 0.5})).depth, depthOf(0.5));
  EXPECT_THAT(examine(*cube, *cuboid({0.25, 0.375, -1.0}, {0.75, 0.625, 2.0})).depth, depthOf(0.375));
}

double squaredDistance(const Vec3& a, const Vec3& b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]);
}

/// The middles of a ball's many small triangles.
std::vector<Vec3> middlesOf(const TriangleModel& ball) {
  std::vector<Vec3> middles;
  for (const auto& [a, b, c] : ball.triangles()) {
    Vec3 middle{};
    for (const auto vertex : {a, b, c}) {
      for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] += ball.positions()[vertex][axis] / 3.0;
    }
    middles.push_back(middle);
  }
  return middles;
}

/// How far a point is from the nearest of others.
double distanceFromNearest(const Vec3& point, const std::vector<Vec3>& others) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& other : others) least = std::min(least, squaredDistance(point, other));
  return std::sqrt(least);
}

/// The depth of the deepest vertex of one ball around `centre` with radius 1 below the surface of another.
double deepestVertex(const TriangleModel& outer, const Vec3& centre, const TriangleModel& inner) {
  const std::vector<Vec3> surface = middlesOf(outer);
  double deepest = 0.0;
  for (const Vec3& vertex : inner.positions()) {
    if (squaredDistance(vertex, centre) < 0.9) deepest = std::max(deepest, distanceFromNearest(vertex, surface));
  }
  return deepest;
}

TEST(FclNarrowPhase, BallsOfManyTrianglesAreAsDeepAsTheirDeepestVertex) {
  const auto first = ball({0.0, 0.0, 0.0}, 1.0, 32);
  for (const Vec3& centre : {Vec3{0.0, 0.0, 1.0}, Vec3{0.4, 0.0, 0.0}, Vec3{0.3, -0.7, 0.5}, Vec3{1.1, 1.1, 0.2}}) {
    const auto second = ball(centre, 1.0, 32);
    const auto pair = examine(*first, *second);
    const double deepest =
        std::max(deepestVertex(*first, {0.0, 0.0, 0.0}, *second), deepestVertex(*second, centre, *first));
    EXPECT_THAT(pair.depth, Optional(DoubleNear(deepest, 0.03)));
    const double shown = std::sqrt(squaredDistance(pair.pointOnFirst, pair.pointOnSecond));
    EXPECT_THAT(pair.depth, Optional(DoubleNear(shown, kClose)));
  }
}

}  // namespace
}  // namespace allpairs::test
