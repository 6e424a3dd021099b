// SPDX-License-Identifier: MIT
// What each type of model makes of its elements, and what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "allpairs/Error.h"
#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/CapsuleModel.h"
#include "allpairs/collision/LineModel.h"
#include "allpairs/collision/OrientedBoxModel.h"
#include "allpairs/collision/PointModel.h"
#include "allpairs/collision/SphereModel.h"
#include "allpairs/collision/TetrahedronModel.h"
#include "allpairs/collision/TriangleModel.h"
#include "support/Boxes.h"
#include "support/Numbers.h"

namespace allpairs::test {
namespace {

using namespace collision;

const std::vector<Vec3> kPoints{{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, 3.0, 0.0}, {0.0, 0.0, 4.0}};

Box rootBox(CollisionModel& model) {
  model.computeBoundingTree();
  return model.getFirst()->elementBox(0);
}

template <class Exception = InvalidArgument, class Action>
std::string messageOf(const Action& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  return {};
}

TEST(Models, PointsLinesAndTrianglesAreWidenedByTheContactDistance) {
  PointModel points("p", kPoints);
  LineModel lines("l", kPoints, {{0, 1}, {2, 3}});
  TriangleModel triangles("t", kPoints, {{0, 1, 2}, {1, 2, 3}});
  for (CollisionModel* model : {static_cast<CollisionModel*>(&points), static_cast<CollisionModel*>(&lines),
                                static_cast<CollisionModel*>(&triangles)}) {
    EXPECT_EQ(rootBox(*model), (Box{{0.0, 0.0, 0.0}, {2.0, 3.0, 4.0}}));
    model->setContactDistance(0.5);
    EXPECT_EQ(rootBox(*model), (Box{{-0.5, -0.5, -0.5}, {2.5, 3.5, 4.5}}));
  }
  EXPECT_EQ(points.getSize(), 4U);
  EXPECT_EQ(lines.elementBox(0), (Box{{-0.5, -0.5, -0.5}, {2.5, 0.5, 0.5}}));
  EXPECT_EQ(triangles.elementBox(0), (Box{{-0.5, -0.5, -0.5}, {2.5, 3.5, 0.5}}));
}

TEST(Models, TetrahedraAndCapsulesAreNotWidenedByTheContactDistance) {
  TetrahedronModel tetrahedra("t", kPoints, {{0, 1, 2, 3}});
  tetrahedra.setContactDistance(0.5);
  EXPECT_EQ(rootBox(tetrahedra), (Box{{0.0, 0.0, 0.0}, {2.0, 3.0, 4.0}}));
  CapsuleModel capsules("c", {Capsule{{1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}}});
  capsules.setContactDistance(0.25);
  EXPECT_EQ(rootBox(capsules), (Box{{-0.5, -0.5, -0.5}, {1.5, 2.5, 0.5}}));
}

TEST(Models, BoxesAreNotWidenedByTheContactDistance) {
  BoxModel boxes("b", std::vector<Box>{cube(0.0, 0.0, 0.0), cube(3.0, 0.0, 0.0)});
  boxes.setContactDistance(0.5);
  EXPECT_EQ(rootBox(boxes), (Box{{0.0, 0.0, 0.0}, {4.0, 1.0, 1.0}}));
}

TEST(Models, SpheresHaveRadiiByListAndThenTheSingleOne) {
  SphereModel spheres("s", {{0.0, 0.0, 0.0}, {10.0, 0.0, 0.0}, {20.0, 0.0, 0.0}}, {2.0}, 0.5);
  EXPECT_EQ(spheres.radii(), (std::vector<double>{2.0, 0.5, 0.5}));
  EXPECT_EQ(spheres.elementBox(1), (Box{{9.5, -0.5, -0.5}, {10.5, 0.5, 0.5}}));
  EXPECT_EQ(SphereModel("d", {{0.0, 0.0, 0.0}}).radii(), std::vector<double>{1.0});
}

TEST(Models, TheBoxOfASphereReachesRadiusAndContactDistance) {
  SphereModel sphere("s", {{3.0, 0.0, 0.0}});
  sphere.setContactDistance(0.1);
  EXPECT_EQ(rootBox(sphere), (Box{{3.0 - 1.1, -1.1, -1.1}, {3.0 + 1.1, 1.1, 1.1}}));
}

TEST(Models, OrientedBoxesAreBoundedByTheirCorners) {
  const double half = std::sqrt(0.5);
  OrientedBoxModel turned("o", {OrientedBox::turned({1.0, 0.0, 0.0}, {0.0, 0.0, std::sin(std::numbers::pi / 8.0),
                                                                      std::cos(std::numbers::pi / 8.0)})});
  turned.setContactDistance(0.5);
  const Box box = rootBox(turned);
  EXPECT_NEAR(box.min[0], 1.0 - 2.0 * half - 0.5, 1e-12);
  EXPECT_NEAR(box.max[1], 2.0 * half + 0.5, 1e-12);
  EXPECT_EQ(box.max[2], 1.5);
  EXPECT_EQ(OrientedBoxModel("d", {OrientedBox{}}).elementBox(0), (Box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}}));
}

TEST(Models, AQuarterTurnAboutZTakesXToY) {
  const OrientedBox box = OrientedBox::turned({}, {0.0, 0.0, std::sqrt(0.5), std::sqrt(0.5)});
  EXPECT_NEAR(box.axes[0][1], 1.0, 1e-12);
  EXPECT_NEAR(box.axes[1][0], -1.0, 1e-12);
}

/// What a unit quaternion (x, y, z, w) makes of a vector: v + 2 q x (q x v + w v).
Vec3 turned(const std::array<double, 4>& quaternion, const Vec3& v) {
  const auto [x, y, z, w] = quaternion;
  const Vec3 inner{y * v[2] - z * v[1] + w * v[0], z * v[0] - x * v[2] + w * v[1], x * v[1] - y * v[0] + w * v[2]};
  return {v[0] + 2.0 * (y * inner[2] - z * inner[1]), v[1] + 2.0 * (z * inner[0] - x * inner[2]),
          v[2] + 2.0 * (x * inner[1] - y * inner[0])};
}

TEST(Models, AQuaternionTurnsEachAxisOfAnOrientedBox) {
  const std::array<double, 4> quaternion{0.1, 0.3, -0.5, std::sqrt(0.65)};
  const OrientedBox box = OrientedBox::turned({}, quaternion, {1.0, 1.0, 1.0});
  for (std::size_t a = 0; a < 3; ++a) {
    Vec3 axis{};
    axis[a] = 1.0;
    const Vec3 expected = turned(quaternion, axis);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(box.axes[a][i], expected[i], 1e-12) << "axis " << a << ", " << i;
  }
}

TEST(Models, QuadsAreTwoTrianglesEachAfterTheTriangles) {
  const TriangleModel model("q", kPoints, {{1, 2, 3}}, {{0, 1, 2, 3}});
  EXPECT_EQ(model.triangles(), (std::vector<TriangleModel::Triangle>{{1, 2, 3}, {0, 1, 2}, {0, 2, 3}}));
}

TEST(Models, TypesAreNamedAsInSofa) {
  EXPECT_EQ(BoxModel("", cube(0, 0, 0)).typeName(), "BoxModel");
  EXPECT_EQ(SphereModel("", {}).typeName(), "TSphereModel");
  EXPECT_EQ(CapsuleModel("", {}).typeName(), "TCapsuleModel");
  EXPECT_EQ(OrientedBoxModel("", {}).typeName(), "TOBBModel");
  EXPECT_EQ(PointModel("", {}).typeName(), "TPointModel");
  EXPECT_EQ(LineModel("", {}, {}).typeName(), "TLineModel");
  EXPECT_EQ(TriangleModel("", {}, {}).typeName(), "TTriangleModel");
  EXPECT_EQ(TetrahedronModel("", {}, {}).typeName(), "TetrahedronModel");
}

TEST(Models, ContinuousBoxesHoldStartAndEndOfTheStep) {
  BoxModel box("b", cube(0.0, 0.0, 0.0));
  box.setVelocities({{4.0, -2.0, 0.0}});
  box.computeContinuousBoundingTree(0.5);
  EXPECT_EQ(box.getFirst()->elementBox(0), (Box{{0.0, -1.0, 0.0}, {3.0, 1.0, 1.0}}));
  LineModel line("l", kPoints, {{0, 1}});
  line.setVelocities({{0.0, 0.0, 1.0}, {0.0, 0.0, -2.0}, {}, {}});
  line.computeContinuousBoundingTree(2.0);
  EXPECT_EQ(line.getFirst()->elementBox(0), (Box{{0.0, 0.0, -4.0}, {2.0, 0.0, 2.0}}));
  line.computeBoundingTree();
  EXPECT_EQ(line.getFirst()->elementBox(0), (Box{{0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}}));
}

TEST(Models, ContinuousBoxesOfSolidsHoldStartAndEndOfTheStep) {
  SphereModel sphere("s", {{0.0, 0.0, 0.0}});
  CapsuleModel capsule("c", {Capsule{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 1.0}});
  OrientedBoxModel box("o", {OrientedBox{}});
  for (SolidModel* model :
       {static_cast<SolidModel*>(&sphere), static_cast<SolidModel*>(&capsule), static_cast<SolidModel*>(&box)}) {
    model->setVelocities({{4.0, -2.0, 0.0}});
    model->computeContinuousBoundingTree(0.5);
    EXPECT_EQ(model->getFirst()->elementBox(0), (Box{{-1.0, -2.0, -1.0}, {3.0, 1.0, 1.0}})) << model->typeName();
  }
}

TEST(Models, SolidsOfAnotherNumberHaveNoVelocitiesAndOfTheSameNumberKeepTheirs) {
  const std::vector<Vec3> velocity{{4.0, 0.0, 0.0}};
  BoxModel boxes("b", cube(0.0, 0.0, 0.0));
  CapsuleModel capsules("c", {Capsule{}});
  OrientedBoxModel oriented("o", {OrientedBox{}});
  for (SolidModel* model :
       {static_cast<SolidModel*>(&boxes), static_cast<SolidModel*>(&capsules), static_cast<SolidModel*>(&oriented)}) {
    model->setVelocities(velocity);
  }
  boxes.setBoxes({cube(1.0, 0.0, 0.0)});
  capsules.setCapsules({Capsule{}});
  oriented.setBoxes({OrientedBox{}});
  EXPECT_EQ(boxes.velocities(), velocity);
  EXPECT_EQ(capsules.velocities(), velocity);
  EXPECT_EQ(oriented.velocities(), velocity);
  boxes.setBoxes({cube(1.0, 0.0, 0.0), cube(2.0, 0.0, 0.0)});
  capsules.setCapsules({});
  oriented.setBoxes({OrientedBox{}, OrientedBox{}});
  EXPECT_TRUE(boxes.velocities().empty());
  EXPECT_TRUE(capsules.velocities().empty());
  EXPECT_TRUE(oriented.velocities().empty());
  EXPECT_EQ(boxes.elementSweptBox(0, 1.0), cube(1.0, 0.0, 0.0));
}

TEST(Models, AnEmptyElementThatMovesStaysEmptyHoweverItsEndIsRounded) {
  BoxModel box("b", Box{{1.0, 1.0, 1.0}, {0.0, 0.0, 0.0}});
  box.setVelocities({{1e17, 1e17, 1e17}});
  EXPECT_TRUE(isEmpty(box.elementSweptBox(0, 1.0)));
}

TEST(Models, WithoutCurvatureNothingIsKnownOfNormals) {
  TriangleModel model("t", kPoints, {{0, 1, 2}});
  EXPECT_EQ(model.elementCone(0).halfAngle, 2.0 * std::numbers::pi);
  model.setUseCurvature(true);
  EXPECT_EQ(model.elementCone(0).halfAngle, 0.0);
  EXPECT_EQ(model.elementCone(0).axis, (Vec3{0.0, 0.0, 1.0}));
}

TEST(Models, TheConeOfATurningTriangleIsAsWideAsItTurns) {
  TriangleModel model("t", kPoints, {{0, 1, 2}});
  model.setUseCurvature(true);
  model.setVelocities({{}, {}, {0.0, -3.0, 3.0}, {}});  // point 2 goes from y to z
  EXPECT_NEAR(model.elementSweptCone(0, 1.0).halfAngle, std::numbers::pi / 2.0, 1e-12);
  EXPECT_EQ(model.elementSweptCone(0, 1.0).axis, (Vec3{0.0, 0.0, 1.0}));
}

TEST(Models, ConesMergeAroundTheMiddleOfTheirAxes) {
  NormalCone cone = NormalCone::of({1.0, 0.0, 0.0});
  cone.merge(NormalCone::of({0.0, 5.0, 0.0}));
  EXPECT_NEAR(cone.halfAngle, std::numbers::pi / 4.0, 1e-12);
  const auto expectAxis = [&cone](const Vec3& expected) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(cone.axis[i], expected[i], 1e-12) << i;
  };
  expectAxis({std::sqrt(0.5), std::sqrt(0.5), 0.0});
  cone.merge(NormalCone::of({0.0, 0.0, 1.0}));
  expectAxis({0.5, 0.5, std::sqrt(0.5)});
  EXPECT_NEAR(cone.halfAngle, std::numbers::pi / 4.0 + std::numbers::pi / 4.0, 1e-12);
  cone.merge(NormalCone{});
  EXPECT_EQ(cone.halfAngle, 2.0 * std::numbers::pi);
}

TEST(Models, EachAxisOfTwoConesCountsWhenTheyMerge) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 lower{3.0, 3.0, 3.0};
    Vec3 higher = lower;
    lower[axis] = 1.0;
    higher[axis] = 5.0;
    NormalCone cone = NormalCone::of(lower);
    cone.merge(NormalCone::of(higher));
    for (std::size_t i = 0; i < 3; ++i) {
      const double sum = lower[i] / std::sqrt(19.0) + higher[i] / std::sqrt(43.0);
      const double along = 1.0 / std::sqrt(19.0) + 5.0 / std::sqrt(43.0);
      const double across = 3.0 / std::sqrt(19.0) + 3.0 / std::sqrt(43.0);
      EXPECT_NEAR(cone.axis[i], sum / std::sqrt(along * along + 2.0 * across * across), 1e-12) << axis << i;
    }
    EXPECT_NEAR(cone.halfAngle, std::acos(23.0 / std::sqrt(19.0 * 43.0)) / 2.0, 1e-12) << axis;
  }
}

TEST(Models, AConeOfAQuarterTurnStaysOneAndAnglesCountEveryAxis) {
  NormalCone wide{{0.0, 0.0, 1.0}, std::numbers::pi / 2.0};
  wide.merge(NormalCone::of({0.0, 0.0, 1.0}));
  EXPECT_EQ(wide.halfAngle, std::numbers::pi / 2.0);
  EXPECT_NEAR(NormalCone::ofTurning({0.0, 3.0, 4.0}, {0.0, 4.0, 3.0}).halfAngle, std::acos(0.96), 1e-12);
}

TEST(Models, WithoutANormalOrBetweenOppositeOnesNothingIsKnown) {
  EXPECT_EQ(NormalCone::of({0.0, 0.0, 0.0}).halfAngle, 2.0 * std::numbers::pi);
  EXPECT_EQ(NormalCone::ofTurning({0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}).halfAngle, 2.0 * std::numbers::pi);
  EXPECT_EQ(NormalCone::ofTurning({0.0, 0.0, 1.0}, {0.0, 0.0, 0.0}).halfAngle, 2.0 * std::numbers::pi);
  NormalCone cone = NormalCone::of({0.0, 2.0, 0.0});
  cone.merge(NormalCone::of({0.0, -3.0, 0.0}));
  EXPECT_EQ(cone.halfAngle, 2.0 * std::numbers::pi);
}

TEST(Models, NumbersThatAreNotFiniteAreRefusedByModelAndElement) {
  EXPECT_NE(messageOf([] {
              PointModel("bad", {{0.0, 0.0, 0.0}, {kNan, 0.0, 0.0}});
            }).find("model 'bad', point 1"),
            std::string::npos);
  EXPECT_NE(messageOf([] { SphereModel("bad", {{0.0, kInfinity, 0.0}}); }).find("sphere 0"), std::string::npos);
  EXPECT_NE(messageOf([] {
              CapsuleModel("bad", {Capsule{{kNan, 0.0, 0.0}, {}, 1.0}});
            }).find("capsule 0"),
            std::string::npos);
  EXPECT_NE(messageOf([] {
              OrientedBoxModel("bad", {OrientedBox{{kNan, 0.0, 0.0}}});
            }).find("oriented box 0"),
            std::string::npos);
  EXPECT_NE(messageOf<InvalidBox>([] {
              BoxModel("bad", Box{{kNan, 0.0, 0.0}, {}});
            }).find("model 'bad', box 0"),
            std::string::npos);
}

TEST(Models, NegativeSizesAreRefused) {
  EXPECT_NE(messageOf([] { SphereModel("bad", {{}, {}}, {1.0, -1.0}); }).find("sphere 1"), std::string::npos);
  EXPECT_NE(messageOf([] { CapsuleModel("bad", {Capsule{{}, {}, -1.0}}); }).find("capsule 0"), std::string::npos);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    OrientedBox thin;
    thin.halfExtents[axis] = -1.0;
    EXPECT_NE(messageOf([&] { OrientedBoxModel("bad", {thin}); }).find("negative"), std::string::npos) << axis;
  }
}

TEST(Models, SizesOfZeroArePointsAndRefuseNothing) {
  EXPECT_EQ(SphereModel("s", {{1.0, 2.0, 3.0}}, {0.0}).elementBox(0), (Box{{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}}));
  EXPECT_EQ(CapsuleModel("c", {Capsule{{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, 0.0}}).elementBox(0),
            (Box{{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}}));
  OrientedBox point{{1.0, 2.0, 3.0}};
  point.halfExtents = {0.0, 0.0, 0.0};
  EXPECT_EQ(OrientedBoxModel("o", {point}).elementBox(0), (Box{{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}}));
}

TEST(Models, MoreRadiiThanSpheresAreRefused) { EXPECT_THROW(SphereModel("bad", {{}}, {1.0, 1.0}), InvalidArgument); }

TEST(Models, IndicesPastThePointsAreRefusedByModelAndElement) {
  EXPECT_NE(messageOf([] {
              LineModel("bad", kPoints, {{0, 1}, {1, 4}});
            }).find("model 'bad', element 1: point 4"),
            std::string::npos);
  EXPECT_THROW(TriangleModel("bad", kPoints, {}, {{0, 1, 2, 9}}), InvalidArgument);
  EXPECT_THROW(TetrahedronModel("bad", {}, {{0, 0, 0, 0}}), InvalidArgument);
}

TEST(Models, SettersRefuseWhatTheConstructorsRefuseAndChangeNothing) {
  PointModel points("p", kPoints);
  EXPECT_THROW(points.setPositions({{}}), InvalidArgument);
  EXPECT_THROW(points.setVelocities({{}}), InvalidArgument);
  EXPECT_THROW(points.setContactDistance(kNan), InvalidArgument);
  EXPECT_THROW(points.computeBoundingTree(-1), InvalidArgument);
  EXPECT_THROW(points.computeContinuousBoundingTree(kInfinity), InvalidArgument);
  EXPECT_EQ(points.positions(), kPoints);
  BoxModel boxes("b", cube(0, 0, 0));
  EXPECT_THROW(boxes.setBox(1, cube(0, 0, 0)), InvalidArgument);
  SphereModel spheres("s", {{}});
  EXPECT_THROW(spheres.setCentres({{}, {}}), InvalidArgument);
  EXPECT_THROW(spheres.setVelocities({{kNan, 0.0, 0.0}}), InvalidArgument);
}

TEST(Models, GroupsAreASet) {
  PointModel model("p", kPoints);
  EXPECT_TRUE(model.getGroups().empty());
  model.setGroups({3, -1, 3});
  model.addGroup(0);
  model.addGroup(0);
  EXPECT_EQ(model.getGroups(), (std::vector<int>{-1, 0, 3}));
  model.setGroups({});
  EXPECT_TRUE(model.getGroups().empty());
}

}  // namespace
}  // namespace allpairs::test
