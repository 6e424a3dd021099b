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
