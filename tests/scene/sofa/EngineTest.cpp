// SPDX-License-Identifier: MIT
#include "scene/sofa/SceneText.h"

namespace allpairs::scene::sofa {
namespace {

using testing::HasSubstr;

class SofaEngine : public SceneTest {
 protected:
  [[nodiscard]] std::vector<Vec3> pointsOf(const std::string& text) const {
    const auto scene = readIn(text);
    return scene.models.empty() ? std::vector<Vec3>{} : scene.models[0].positions;
  }
};

/// Three squares in a row along x, each of two triangles: points 0 to 3 below, 4 to 7 above.
constexpr auto kRow =
    "<MeshTopology name='m' position='0 0 0 1 0 0 2 0 0 3 0 0 0 1 0 1 1 0 2 1 0 3 1 0' "
    "triangles='0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6'/><MechanicalObject name='state' dx='10'/>";

TEST_F(SofaEngine, ABoxChoosesPointsAndElements) {
  const auto chosen = [&](const std::string& data) {
    return std::string{kRow} + "<BoxROI name='roi' position='@m.position' triangles='@m.triangles' " + data + "/>";
  };
  const std::string box = "box='2.5 2 1 0.5 -1 -1'";
  const std::string child = "<Node><MechanicalObject position='@../m.position'/><MeshTopology triangles='";
  const auto trianglesOf = [&](const std::string& data, const std::string& list) {
    return readIn(chosen(data) + child + "@../roi." + list + "'/><TriangleModel/></Node>").models.at(0).triangles;
  };
  EXPECT_EQ(trianglesOf(box, "trianglesInROI"), (Elements<3>{{1, 2, 6}, {1, 6, 5}}));
  EXPECT_EQ(trianglesOf(box, "trianglesOutROI"), (Elements<3>{{0, 1, 5}, {0, 5, 4}, {2, 3, 7}, {2, 7, 6}}));
  EXPECT_EQ(trianglesOf("box='0.5 -1 -1 1.5 0.5 1' strict='0'", "trianglesInROI"), (Elements<3>{{0, 1, 5}}));
  EXPECT_EQ(trianglesOf(box + " computeTriangles='0'", "trianglesInROI"), Elements<3>{});
  EXPECT_EQ(pointsOf(chosen("") + "<Node><MechanicalObject position='@../roi.pointsInROI'/><PointModel/></Node>"),
            (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}))
      << "without a box it is that of one by one by one";
  EXPECT_EQ(pointsOf(std::string{kRow} + "<BoxROI name='roi' box='12.5 -1 -1 20 0.5 1'/><Node><MechanicalObject/>"
                                         "<SubsetMapping indices='@../roi.indices'/><PointModel/></Node>"),
            (std::vector<Vec3>{{13, 0, 0}}))
      << "the state beside it gives the points where none are given";
  EXPECT_THAT(complaintIn(chosen("orientedBox='0 0 0 1 0 0 1 1 0 1'") +
                          "<Node><MechanicalObject position='@../roi.pointsInROI'/><PointModel/></Node>"),
              HasSubstr("which this reader cannot compute"));
}

TEST_F(SofaEngine, PlacesAndTurnsMakeFrames) {
  const auto frames = [](const std::string& data) {
    return "<QuatToRigidEngine name='e' " + data +
           "/><MechanicalObject template='Rigid3' position='@e.rigids'/><Node><MechanicalObject position='0 1 0'/>"
           "<RigidMapping index='1'/><PointModel/></Node>";
  };
  const std::string places = "positions='1 0 0  2 3 4  5 5 5' ";
  EXPECT_EQ(pointsOf(frames(places + "orientations='0 0 0 1'")), (std::vector<Vec3>{{2, 4, 4}}));
  EXPECT_EQ(pointsOf(frames(places + "orientations='0 0 0 1 1 0 0 0'")), (std::vector<Vec3>{{2, 2, 4}}));
  EXPECT_EQ(pointsOf(frames(places + "orientations='0 0 0 1' colinearPositions='0 0 0 7 8 9'")),
            (std::vector<Vec3>{{7, 9, 4}}))
      << "on the line through the other place along the frame's z axis";
  EXPECT_THAT(complaintIn(frames(places)), HasSubstr("no rigid frame number 1 among the 0"));
}

TEST_F(SofaEngine, WhatADeviceMovesIsWhereItStartsAndThatIsSaid) {
  const auto scene = readIn(R"(<RazerHydraDriver name="d" scale="0.1"/>
    <QuatToRigidEngine name="e" positions="@d.positionFirstTool" orientations="@d.orientationFirstTool"/>
    <MergePoints name="both" template="Rigid3d" position1="@e.rigids" position2="0 0 -0.5 0 0 0 1"/>
    <MechanicalObject position="@both.points"/><PointModel/>)");
  ASSERT_EQ(scene.models.size(), 1U);
  EXPECT_EQ(scene.models[0].positions, (std::vector<Vec3>{{0, 0, 0}, {0, 0, -0.5}}));
  ASSERT_EQ(scene.warnings.size(), 3U);
  EXPECT_THAT(scene.warnings[1].reason, HasSubstr("a device moves its positionFirstTool"));
  const auto moved = readIn(R"(<GeomagicDriver name="d" positionBase="1 2 3"/>
    <MechanicalObject template="Rigid3" position="@d.positionBase"/>
    <Node><MechanicalObject position="1 0 0"/><RigidMapping/><PointModel/></Node>)");
  EXPECT_THAT(onlyBox(moved), IsBox(Corners{2, 2, 3, 2, 2, 3}));
  EXPECT_THAT(complaintIn("<RazerHydraDriver name='d'/><MechanicalObject position='@d.mood'/><PointModel/>"),
              HasSubstr("needs the mood of RazerHydraDriver 'd' (/d), which this reader cannot compute"));
}

TEST_F(SofaEngine, StatesHaveAMean) {
  EXPECT_EQ(pointsOf(R"(<MechanicalObject name="a" position="1 2 3 4 5 6"/><MechanicalObject name="b" position="3 2 1"/>
      <MeanComputation name="mean"/><MechanicalObject name="c" tags="other MeanOutput" position="@mean.result"/>
      <Node><MechanicalObject position="@../mean.result"/><PointModel/></Node>)"),
            (std::vector<Vec3>{{2, 2, 2}}))
      << "as many points as the shortest has";
}

TEST_F(SofaEngine, ALineIsRolledUpToASpiral) {
  const auto rolled = pointsOf(R"(<MechanicalObject name="m" position="0 0 7  1 0 0  -1 0 0  1 0.5 0"/>
      <Spiral name="s" rest_position="@m.position" curvature="0.5"/>
      <Node><MechanicalObject position="@../s.position"/><PointModel/></Node>)");
  ASSERT_EQ(rolled.size(), 4U);
  EXPECT_NEAR(rolled[0][0], 0, 1e-12);
  EXPECT_EQ(rolled[0][2], 7);
  // A spiral r = t / 2 is t / 4 sqrt(1 + t^2) + asinh(t) / 4 long up to the angle t: 1 at this one.
  constexpr double kAngle = 1.527853326634182;
  EXPECT_NEAR(rolled[1][0], kAngle / 2 * std::cos(kAngle), 1e-12);
  EXPECT_NEAR(rolled[1][1], kAngle / 2 * std::sin(kAngle), 1e-12);
  EXPECT_EQ(rolled[2][0], -rolled[1][0]);
  EXPECT_EQ(rolled[2][1], -rolled[1][1]);
  const auto across = rolled[3] - rolled[1];
  EXPECT_NEAR(std::sqrt(dot(across, across)), 0.5, 1e-12);
}

}  // namespace
}  // namespace allpairs::scene::sofa
