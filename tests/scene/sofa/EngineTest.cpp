// SPDX-License-Identifier: MIT
#include <map>

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
  EXPECT_EQ(pointsOf(chosen("box='-0.5 -0.5 -1 0.5 0.5 1  2.5 0.5 -1 3.5 1.5 1'") +
                     "<Node><MechanicalObject position='@../roi.pointsInROI'/><PointModel/></Node>"),
            (std::vector<Vec3>{{0, 0, 0}, {3, 1, 0}}))
      << "there may be several boxes";
  EXPECT_EQ(pointsOf(std::string{kRow} + "<BoxROI name='roi' box='12.5 -1 -1 20 0.5 1'/><Node><MechanicalObject/>"
                                         "<SubsetMapping indices='@../roi.indices'/><PointModel/></Node>"),
            (std::vector<Vec3>{{13, 0, 0}}))
      << "the state beside it gives the points where none are given";
  EXPECT_THAT(complaintIn(chosen("orientedBox='0 0 0 1 0 0 1 1 0 1'") +
                          "<Node><MechanicalObject position='@../roi.pointsInROI'/><PointModel/></Node>"),
              HasSubstr("which this reader cannot compute"));
  EXPECT_THAT(complaintIn(std::string{kRow} + "<BoxROI name='roi' position='@m.position' triangles='0 1 8'/>" + child +
                          "@../roi.trianglesInROI'/><TriangleModel/></Node>"),
              HasSubstr("its elements name points that are not there"));
}

TEST_F(SofaEngine, ABoxBesideALoaderAndNoStateChoosesFromTheLoader) {
  write("a.obj", "v 0.5 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(pointsOf("<MechanicalObject position='0 0 1'/><Node><MeshObjLoader filename='a.obj'/><BoxROI name='roi'/>"
                     "<Node><MechanicalObject position='@../roi.pointsInROI'/><PointModel/></Node></Node>"),
            (std::vector<Vec3>{{0.5, 0, 0}, {0, 1, 0}}));
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
  // Across the line: along the spiral's normal, which points inward here.
  const double sine = std::sin(kAngle), cosine = std::cos(kAngle);
  const double x = -sine - kAngle * cosine, y = cosine - kAngle * sine, length = std::hypot(x, y);
  EXPECT_NEAR(rolled[3][0], rolled[1][0] + 0.5 * x / length, 1e-12);
  EXPECT_NEAR(rolled[3][1], rolled[1][1] + 0.5 * y / length, 1e-12);
}

/// A cube from -1 to 1, a little off the middle, of which a face is two triangles that face outward.
constexpr auto kBox =
    "<MeshTopology name='box' position='-1 -1 -1 1 -1 -1 1 1 -1 -1 1 -1 -1 -1 1.1 1 -1 1.1 1 1 1.1 -1 1 1.1' "
    "triangles='0 2 1 0 3 2 4 5 6 4 6 7 0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6 3 0 4 3 4 7'/>";

class SofaStuffing : public SofaEngine {
 protected:
  [[nodiscard]] ModelDescription filled(const std::string& data) const {
    return readIn(std::string{kBox} + "<MeshTetraStuffing name='s' inputPoints='@box.position' " + data +
                  "/><Node><TetrahedronSetTopologyContainer position='@../s.outputPoints' "
                  "tetrahedra='@../s.outputTetrahedra'/><MechanicalObject/><TetrahedronModel/></Node>")
        .models.at(0);
  }

  /// The volume of all tetrahedra, each of which must be of positive volume and share each face with one other at most.
  [[nodiscard]] static double volume(const ModelDescription& model) {
    double sum = 0;
    std::map<std::array<Index, 3>, int> faces;
    for (const auto& t : model.tetrahedra) {
      const auto side = [&](std::size_t i) { return model.positions[t[i]] - model.positions[t[0]]; };
      const double six = dot(side(1), cross(side(2), side(3)));
      EXPECT_GT(six, 0);
      sum += six / 6;
      for (std::size_t i = 0; i < 4; ++i) ++faces[sorted<3>({t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]})];
    }
    for (const auto& [face, count] : faces) EXPECT_LE(count, 2);
    return sum;
  }
};

TEST_F(SofaStuffing, WithoutCuttingTakesTheTetrahedraThatAreNotWhollyOutside) {
  const auto model = filled("inputTriangles='@box.triangles' size='0.47'");
  EXPECT_GT(volume(model), 2 * 2 * 2.1);
  for (const auto& p : model.positions)
    for (const double x : p) EXPECT_LE(std::abs(x), 1.1 + 0.47);
}

TEST_F(SofaStuffing, CuttingFillsTheSurface) {
  for (const auto* data : {"splitTetras='1'", "splitTetrahedra='1' snapPoints='1' alphaLong='0.3' alphaShort='0.4'"}) {
    const auto model = filled(std::string{"inputTriangles='@box.triangles' size='0.37' "} + data);
    EXPECT_NEAR(volume(model), 2 * 2 * 2.1, 0.45) << "but for edges and corners that the cells do not resolve";
    EXPECT_LT(volume(model), 2 * 2 * 2.1 + 1e-9);
    const auto box = boxOf(model);
    EXPECT_THAT(box, IsBox(Corners{-1, -1, -1, 1, 1, 1.1}));
  }
}

TEST_F(SofaStuffing, QuadsAreTwoTrianglesAndTheBoxMayBeGiven) {
  const std::string quads = "inputQuads='0 3 2 1 4 5 6 7 0 1 5 4 1 2 6 5 2 3 7 6 3 0 4 7' splitTetras='1' ";
  const auto triangles = filled("inputTriangles='@box.triangles' splitTetras='1' size='-5'");
  EXPECT_EQ(filled(quads + "size='-5'").positions, triangles.positions);
  const auto size = 2.1 * 1.02 / 5;
  EXPECT_EQ(filled(quads + "size='" + std::to_string(size) + "'").positions.size(), triangles.positions.size());
  EXPECT_EQ(filled(quads + "size='-5' vbbox='-1.02 -1.02 -1.021 1.02 1.02 1.121'").positions.size(),
            triangles.positions.size());
  EXPECT_NE(filled(quads + "size='-5' vbbox='-2 -2 -2 2 2 2'").positions.size(), triangles.positions.size());
}

TEST_F(SofaStuffing, WhatCannotBeFilledIsNamed) {
  const auto refusal = [&](const std::string& data) {
    return complaintIn(std::string{kBox} + "<MeshTetraStuffing name='s' inputPoints='@box.position' " + data +
                       "/><MechanicalObject position='@s.outputPoints'/><PointModel/>");
  };
  EXPECT_THAT(refusal(""), HasSubstr("MeshTetraStuffing 's' (/s): it is given no surface"));
  EXPECT_THAT(refusal("inputTriangles='0 1 8'"), HasSubstr("points that are not there"));
  EXPECT_THAT(refusal("inputTriangles='0 1 2' size='0'"), HasSubstr("out of all reason"));
  EXPECT_THAT(refusal("inputTriangles='0 1 2' size='1e-5'"), HasSubstr("out of all reason"));
  EXPECT_THAT(refusal("inputTriangles='0 1 2' size='0.01'"), HasSubstr("points it"));
}

}  // namespace
}  // namespace allpairs::scene::sofa
