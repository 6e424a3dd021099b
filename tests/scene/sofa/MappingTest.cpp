// SPDX-License-Identifier: MIT
#include "scene/sofa/SceneText.h"

namespace allpairs::scene::sofa {
namespace {

using testing::HasSubstr;

class SofaMapping : public SceneTest {
 protected:
  /// The box of a child's points below a parent.
  [[nodiscard]] Corners box(const std::string& parent, const std::string& child) const {
    return onlyBox(readIn(parent + "<Node name='Child'>" + child + "<PointModel/></Node>"));
  }
};

constexpr auto kTurned = "<MechanicalObject template='Rigid3d' dx='5' rx='90' rz='90'/>";
constexpr auto kTwoFrames = "<MechanicalObject template='Rigid' position='10 0 0 0 0 0 1  20 0 0 0 0 0 1'/>";

TEST_F(SofaMapping, RigidFramesCarryPoints) {
  EXPECT_THAT(box(kTurned, "<MechanicalObject position='0 1 0  0 2 0  1 1 0'/><RigidMapping/>"),
              IsBox(Corners{5, 0, 1, 5, 1, 2}));
}

TEST_F(SofaMapping, TheChildsOwnTransformComesFirst) {
  EXPECT_THAT(box("<MechanicalObject template='Rigid' rz='90'/>",
                  "<MechanicalObject position='1 0 0' scale='2' dx='1'/><RigidMapping/>"),
              IsBox(Corners{0, 3, 0, 0, 3, 0}));
}

TEST_F(SofaMapping, RigidFramesAreChosenByIndex) {
  const std::string points = "<MechanicalObject position='1 0 0 2 0 0'/>";
  EXPECT_THAT(box(kTwoFrames, points + "<RigidMapping/>"), IsBox(Corners{11, 0, 0, 12, 0, 0}));
  EXPECT_THAT(box(kTwoFrames, points + "<RigidMapping index='1'/>"), IsBox(Corners{21, 0, 0, 22, 0, 0}));
  EXPECT_THAT(box(kTwoFrames, points + "<RigidMapping index='0' indexFromEnd='1'/>"),
              IsBox(Corners{21, 0, 0, 22, 0, 0}));
  EXPECT_THAT(box(kTwoFrames, points + "<RigidMapping index='1' indexFromEnd='1'/>"),
              IsBox(Corners{11, 0, 0, 12, 0, 0}));
  EXPECT_THAT(box(kTwoFrames, points + "<RigidMapping rigidIndexPerPoint='1 0'/>"), IsBox(Corners{12, 0, 0, 21, 0, 0}));
  EXPECT_THAT(box(kTwoFrames, points + "<RigidMapping repartition='1'/>"), IsBox(Corners{11, 0, 0, 22, 0, 0}));
  EXPECT_THAT(box(kTwoFrames, points + "<RigidMapping repartition='0 2'/>"), IsBox(Corners{21, 0, 0, 22, 0, 0}));
  EXPECT_THAT(box(kTwoFrames, "<MechanicalObject position='1 0 0 2 0 0 3 0 0'/><RigidMapping repartition='1-2'/>"),
              IsBox(Corners{11, 0, 0, 23, 0, 0}))
      << "one point for the first frame and two for the second";
}

TEST_F(SofaMapping, AFrameThatIsNotThereIsNamed) {
  EXPECT_THAT(complaintIn(std::string{kTwoFrames} +
                          "<Node><MechanicalObject/><RigidMapping name='r' index='2'/><PointModel/></Node>"),
              HasSubstr("no rigid frame number 2 among the 2"));
}

TEST_F(SofaMapping, PointsGivenToARigidMappingReplaceTheChilds) {
  EXPECT_THAT(box(kTwoFrames, "<MechanicalObject/><RigidMapping initialPoints='1 1 1 2 2 2'/>"),
              IsBox(Corners{11, 1, 1, 12, 2, 2}));
}

TEST_F(SofaMapping, GlobalPointsStayWhereTheyAre) {
  EXPECT_THAT(box(kTurned, "<MechanicalObject position='1 2 3'/><RigidMapping globalToLocalCoords='true'/>"),
              IsBox(Corners{1, 2, 3, 1, 2, 3}));
}

TEST_F(SofaMapping, RigidFramesCarryFrames) {
  const auto scene = readIn(std::string{"<MechanicalObject template='Rigid' rz='90'/>"} +
                            R"(<Node><MechanicalObject template="Rigid" position="1 0 0 0 0 0 1"/><RigidRigidMapping/>
                            <OBBModel extents="3 2 1"/></Node>)");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{-2, -2, -1, 2, 4, 1}));
}

TEST_F(SofaMapping, FramesOfAFileThatTheirStateDoesNotHaveAreNotTurned) {
  std::string points;
  for (int i = 0; i < 5000; ++i) points += "v " + std::to_string(i) + " 0 0\n";
  write("many.obj", points + "f 1 2 3\n");
  const auto scene = readIn(std::string{"<MechanicalObject template='Rigid' rz='90'/>"} +
                            R"(<Node><MechanicalObject template="Rigid" position="1 0 0 0 0 0 1"/>
                            <RigidRigidMapping filename="many.obj"/><OBBModel extents="3 2 1"/></Node>)");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{-2, -3, -1, 2, 5000, 1}));
}

TEST_F(SofaMapping, FramesAreNotCarriedByADeformedState) {
  std::string points;
  for (int i = 0; i < 5000; ++i) points += std::to_string(i) + " 0 0 ";
  const auto scene = readIn("<MechanicalObject name='points' position='" + points +
                            R"('/><Node><MechanicalObject template="Rigid" position="1 0 0 0 0 0 1"/>
                            <DeformableOnRigidFrameMapping input1="@../points"/><OBBModel extents="3 2 1"/></Node>)");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{-2, -2, -1, 4, 2, 1}));
}

TEST_F(SofaMapping, IdentityCopiesThePointsOrTheCentres) {
  EXPECT_THAT(box("<MechanicalObject position='1 2 3 4 5 6'/>", "<MechanicalObject/><IdentityMapping/>"),
              IsBox(Corners{1, 2, 3, 4, 5, 6}));
  EXPECT_THAT(box(kTwoFrames, "<MechanicalObject/><IdentityMapping/>"), IsBox(Corners{10, 0, 0, 20, 0, 0}));
}

TEST_F(SofaMapping, SubsetsTakeIndicesARangeOrTheNearest) {
  const std::string parent = "<MechanicalObject position='0 0 0 1 0 0 2 0 0 3 0 0 4 0 0'/>";
  EXPECT_THAT(box(parent, "<MechanicalObject/><SubsetMapping indices='1 3'/>"), IsBox(Corners{1, 0, 0, 3, 0, 0}));
  EXPECT_THAT(box(parent, "<MechanicalObject/><SubsetMapping indices='2-4'/>"), IsBox(Corners{2, 0, 0, 4, 0, 0}));
  EXPECT_THAT(box(parent, "<MechanicalObject/><SubsetMapping first='1' last='2'/>"), IsBox(Corners{1, 0, 0, 2, 0, 0}));
  EXPECT_THAT(box(parent, "<MechanicalObject position='2.2 0 0 9 0 0'/><SubsetMapping radius='0.5'/>"),
              IsBox(Corners{2, 0, 0, 9, 0, 0}));
  EXPECT_THAT(box(parent, "<MechanicalObject position='2.5 0 0 4 0 0'/><SubsetMapping radius='0.5'/>"),
              IsBox(Corners{2.5, 0, 0, 4, 0, 0}))
      << "not those as far away as the radius";
  EXPECT_THAT(box(parent, "<MechanicalObject/><SubsetMapping first='3' last='5'/>"), IsBox(Corners{3, 0, 0, 4, 0, 0}))
      << "there is no fifth, and the last one counts";
  EXPECT_THAT(box(parent, "<MechanicalObject/><SubsetMapping first='5' last='1'/>"), IsBox(Corners{0, 0, 0, 1, 0, 0}))
      << "there is no fifth, and the first one counts";
}

TEST_F(SofaMapping, SubsetsOfFramesAreTurnedAsTheyAre) {
  const auto scene = readIn(
      R"(<MechanicalObject template="Rigid" position="5 0 0 0 0 0 1  9 0 0 0 0 0.70710678118654752 0.70710678118654752"/>
      <Node><MechanicalObject template="Rigid"/><SubsetMapping indices="1"/><OBBModel extents="3 2 1"/></Node>)");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{7, -3, -1, 11, 3, 1}));
}

TEST_F(SofaMapping, PointsInTetrahedraStayWhereTheyAre) {
  const std::string parent = R"(<MechanicalObject position="0 0 0 1 0 0 0 1 0 0 0 1"/>
    <MeshTopology tetrahedra="0 1 2 3"/>)";
  EXPECT_THAT(box(parent, "<MechanicalObject position='0.1 0.1 0.1 5 5 5'/><BarycentricMapping/>"),
              IsBox(Corners{0.1, 0.1, 0.1, 5, 5, 5}));
}

TEST_F(SofaMapping, PointsInATetrahedronFollowItFromRest) {
  const std::string parent = R"(<MechanicalObject position="0 0 0 1 0 0 0 1 0 0 0 1" translation2="5 0 0"/>
    <MeshTopology tetrahedra="0 1 2 3"/>)";
  EXPECT_THAT(box(parent, "<MechanicalObject position='0.1 0.2 0.3'/><BarycentricMapping useRestPosition='1'/>"),
              IsBox(Corners{5.1, 0.2, 0.3, 5.1, 0.2, 0.3}));
}

TEST_F(SofaMapping, PointsInAGridFollowIt) {
  const std::string grid =
      "<RegularGridTopology n='3 3 3' min='0 0 0' max='2 2 2'/><MechanicalObject dx='10' scale='2'/>";
  EXPECT_THAT(box(grid, "<MechanicalObject position='0.5 1.5 1 2 2 2'/><BarycentricMapping/>"),
              IsBox(Corners{11, 3, 2, 14, 4, 4}));
}

TEST_F(SofaMapping, AGridThatIsNoVolumeMovesNothing) {
  for (const char* n : {"1 3 3", "3 1 3", "3 3 1"}) {
    const auto scene = readIn("<RegularGridTopology n='" + std::string{n} + R"(' min='0 0 0' max='2 2 2'/>
        <MechanicalObject dx='10'/><Node><MechanicalObject position='0.5 1.5 1'/><BarycentricMapping/><PointModel/>
        </Node>)");
    EXPECT_THAT(onlyBox(scene), IsBox(Corners{0.5, 1.5, 1, 0.5, 1.5, 1})) << n;
    EXPECT_THAT(scene.warnings.back().reason, HasSubstr("is no volume")) << n;
  }
}

TEST_F(SofaMapping, PointsOutsideAGridGoOnAsTheNearestCell) {
  const std::string grid = "<RegularGridTopology n='2 2 2'/><MechanicalObject scale='3'/>";
  EXPECT_THAT(box(grid, "<MechanicalObject position='-1 0 0 0 5 0'/><BarycentricMapping/>"),
              IsBox(Corners{-3, 0, 0, 0, 15, 0}));
}

TEST_F(SofaMapping, PointsInASparseGridFollowItsTransform) {
  const std::string grid =
      "<SparseGridTopology n='3 3 3' fileTopology='x.obj'/><MechanicalObject scale='2' rz='90' dx='1'/>";
  EXPECT_THAT(box(grid, "<MechanicalObject position='1 0 0 0 1 0'/><BarycentricMapping/>"),
              IsBox(Corners{-1, 0, 0, 1, 2, 0}));
}

TEST_F(SofaMapping, PointsFallOntoTheNearestTriangleOrQuad) {
  const std::string triangle = "<MechanicalObject position='0 0 0 1 0 0 0 1 0'/><MeshTopology triangles='0 1 2'/>";
  EXPECT_THAT(box(triangle, "<MechanicalObject position='0.25 0.25 7'/><BarycentricMapping/>"),
              IsBox(Corners{0.25, 0.25, 0, 0.25, 0.25, 0}));
  const std::string quads =
      "<MechanicalObject position='0 0 0 1 0 0 1 1 0 0 1 0 5 0 0 6 0 0 6 1 0 5 1 0'/>"
      "<QuadSetTopologyContainer quads='0 1 2 3 4 5 6 7'/>";
  EXPECT_THAT(box(quads, "<MechanicalObject position='5.5 0.5 3'/><BarycentricMapping/>"),
              IsBox(Corners{5.5, 0.5, 0, 5.5, 0.5, 0}));
}

TEST_F(SofaMapping, PointsFallOntoTheFirstEdgeBesideWhichTheyLieElseTheLast) {
  const std::string edges = "<MechanicalObject position='0 0 0 2 0 0 2 2 0'/><MeshTopology edges='0 1 1 2'/>";
  EXPECT_THAT(box(edges, "<MechanicalObject position='1 9 0'/><BarycentricMapping/>"),
              IsBox(Corners{1, 0, 0, 1, 0, 0}));
  EXPECT_THAT(box(edges, "<MechanicalObject position='3 1 0'/><BarycentricMapping/>"),
              IsBox(Corners{2, 1, 0, 2, 1, 0}));
  EXPECT_THAT(box(edges, "<MechanicalObject position='3 -1 0'/><BarycentricMapping/>"),
              IsBox(Corners{2, -1, 0, 2, -1, 0}));
  EXPECT_THAT(box("<MechanicalObject position='1 0 0 3 0 0'/><MeshTopology edges='0 1'/>",
                  "<MechanicalObject position='1.5 9 0'/><BarycentricMapping/>"),
              IsBox(Corners{1.5, 0, 0, 1.5, 0, 0}));
}

TEST_F(SofaMapping, PointsInAHexahedronOfAMeshFollowItsCorners) {
  // The far corner sticks out: what lies half way in the first corner's frame is pulled along.
  const std::string hexahedron = R"(<MechanicalObject position="0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 3 3 3 0 1 1"/>
    <MeshTopology hexahedra="0 1 2 3 4 5 6 7"/>)";
  EXPECT_THAT(box(hexahedron, "<MechanicalObject position='0.5 0.5 0.5'/><BarycentricMapping/>"),
              IsBox(Corners{0.75, 0.75, 0.75, 0.75, 0.75, 0.75}));
}

std::string textOf(const std::vector<Vec3>& points) {
  std::string text;
  for (const auto& p : points)
    for (const double coordinate : p) text += std::to_string(coordinate) + ' ';
  return text;
}

/// The points, made larger and moved.
std::vector<Vec3> placed(std::vector<Vec3> points, double scale, const Vec3& at) {
  for (auto& p : points)
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = scale * p[axis] + at[axis];
  return points;
}

/// A large cell and a small one beside it, which leaves. The middle of the small one is nearer.
TEST_F(SofaMapping, PointsAreBoundToTheCellInWhichTheyLie) {
  const std::vector<Vec3> cube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const std::vector<Vec3> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto expectBound = [&](const std::string& cells, const std::vector<Vec3>& cell, const Vec3& at,
                               const Vec3& point) {
    const auto large = textOf(placed(cell, 10, {}));
    const auto parent = "<MechanicalObject rest_position='" + large + textOf(placed(cell, 1, at)) + "' position='" +
                        large + textOf(placed(cell, 1, at + Vec3{100, 0, 0})) + "'/><MeshTopology " + cells + "/>";
    EXPECT_THAT(
        box(parent, "<MechanicalObject position='" + textOf({point}) + "'/><BarycentricMapping useRestPosition='1'/>"),
        IsBox(Corners{point[0], point[1], point[2], point[0], point[1], point[2]}))
        << cells << ' ' << textOf({at});
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 10.0}) {
      Vec3 at{4.5, 4.5, 4.5}, point{5, 5, 5};
      at[axis] = side;
      point[axis] = side < 0 ? 0.5 : 9.5;
      expectBound("hexahedra='0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15'", cube, at, point);
      at[2] = point[2] = 0;
      if (axis < 2) expectBound("quads='0 1 2 3 4 5 6 7'", {cube.begin(), cube.begin() + 4}, at, point);
    }
  }
  expectBound("triangles='0 1 2 3 4 5'", triangle, {5.1, 5.1, 0}, {4.5, 4.5, 0});
  expectBound("triangles='0 1 2 3 4 5'", triangle, {-1, 2, 0}, {0.5, 2.5, 0});
  expectBound("triangles='0 1 2 3 4 5'", triangle, {2, -1, 0}, {2.5, 0.5, 0});
}

constexpr auto kTwoStates =
    "<MechanicalObject name='a' position='1 1 1 2 2 2'/><MechanicalObject name='b' position='3 3 3'/>";

TEST_F(SofaMapping, SeveralStatesAreJoinedWholeOrInPart) {
  const std::string child = "<MechanicalObject name='c'/>";
  EXPECT_THAT(box(kTwoStates, child + "<IdentityMultiMapping input='@../a @../b' output='@c'/>"),
              IsBox(Corners{1, 1, 1, 3, 3, 3}));
  EXPECT_THAT(box(kTwoStates, child + "<SubsetMultiMapping input='@../a @../b' output='@c' indexPairs='0 1 1 0'/>"),
              IsBox(Corners{2, 2, 2, 3, 3, 3}));
  for (const std::string pairs : {"1 1", "2 0"})
    EXPECT_THAT(complaintIn(kTwoStates + ("<Node>" + child) + "<SubsetMultiMapping input='@../a @../b' output='@c' " +
                            "indexPairs='" + pairs + "'/><PointModel/></Node>"),
                HasSubstr("a point that isn't there"));
}

TEST_F(SofaMapping, ARigidFrameCarriesADeformableBody) {
  const std::string parents =
      "<MechanicalObject name='frame' template='Rigid' dx='10' rz='90'/>"
      "<MechanicalObject name='body' position='1 0 0 2 0 0'/>";
  EXPECT_THAT(box(parents,
                  "<MechanicalObject name='c'/>"
                  "<DeformableOnRigidFrameMapping input1='@../body' input2='@../frame' output='@c'/>"),
              IsBox(Corners{10, 1, 0, 10, 2, 0}));
}

TEST_F(SofaMapping, AFrameBeforeTheFirstCarriesNothing) {
  EXPECT_THAT(complaintIn(R"(<MechanicalObject name="frame" template="Rigid"/><MechanicalObject name="body"/>
      <Node><MechanicalObject name="c"/><DeformableOnRigidFrameMapping input1="@../body" input2="@../frame" output="@c"
      index="-1"/><PointModel/></Node>)"),
              HasSubstr("how its rigid frames carry its points"));
}

TEST_F(SofaMapping, ASkinStaysWhereItIsWhileItsBonesRest) {
  const std::string skin = "<MechanicalObject position='1 2 3'/><SkinningMapping/>";
  EXPECT_THAT(box(kTwoFrames, skin), IsBox(Corners{1, 2, 3, 1, 2, 3}));
  EXPECT_THAT(complaintIn("<MechanicalObject template='Rigid' dx2='1'/><Node>" + skin + "<PointModel/></Node>"),
              HasSubstr("not where they rest"));
}

TEST_F(SofaMapping, APointIsInTheMiddleOfMasses) {
  const std::string bodies =
      "<MechanicalObject template='Rigid3' position='0 0 0 0 0 0 1  1 2 3 0 0 0 1  5 4 3 0 0 0 1'/>";
  const std::string child = "<MechanicalObject position='9 9 9'/><CenterOfMassMapping/>";
  const auto middle = IsBox(Corners{2, 2, 2, 2, 2, 2});
  EXPECT_THAT(box(bodies + "<UniformMass vertexMass='2 1 [1 0 0,0 1 0,0 0 1]'/>", child), middle);
  EXPECT_THAT(box(bodies + "<UniformMass totalMass='7'/>", child), middle);
  const auto scene = readIn(bodies + "<Node>" + child + "<PointModel/></Node>");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{9, 9, 9, 9, 9, 9}));
  EXPECT_THAT(scene.warnings.back().reason, HasSubstr("no mass"));
  EXPECT_THAT(complaintIn(bodies + "<DiagonalMass/><Node>" + child + "<PointModel/></Node>"),
              HasSubstr("masses of this kind"));
}

TEST_F(SofaMapping, MappingsFollowOneAnother) {
  const auto scene = readIn(R"(<MechanicalObject template="Rigid" dx="10"/>
    <Node><MechanicalObject position="0 0 0 1 0 0 0 1 0 0 0 1"/><RigidMapping/><MeshTopology tetrahedra="0 1 2 3"/>
      <Node><MechanicalObject/><IdentityMapping/><PointModel/></Node></Node>)");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{10, 0, 0, 11, 1, 1}));
}

TEST_F(SofaMapping, MappingsMayNameWhatTheyJoin) {
  const auto scene = readIn(R"(<Node name="A"><MechanicalObject name="in" position="3 3 3"/></Node>
    <Node name="B"><MechanicalObject name="out"/><PointModel/></Node>
    <Node name="M"><IdentityMapping input="@../A/in" output="@/B/out"/></Node>)");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{3, 3, 3, 3, 3, 3}));
}

TEST_F(SofaMapping, WhatAMappingLacksIsNamed) {
  EXPECT_THAT(complaintIn("<MechanicalObject/><Node><MechanicalObject/><RigidMapping/><PointModel/></Node>"),
              HasSubstr("the state that it reads is not rigid"));
  EXPECT_THAT(complaintIn("<Node><MechanicalObject/><IdentityMapping input='@nobody'/><PointModel/></Node>"),
              HasSubstr("the state that it reads is nowhere to be found"));
  EXPECT_THAT(complaintIn("<MechanicalObject/><Node><MechanicalObject/><BarycentricMapping/><PointModel/></Node>"),
              HasSubstr("its input has no topology"));
}

TEST_F(SofaMapping, MappingsInACircleAreNamed) {
  EXPECT_THAT(complaintIn(R"(<MechanicalObject name="a"/><MechanicalObject name="b"/>
    <IdentityMapping input="@a" output="@b"/><IdentityMapping input="@b" output="@a"/><PointModel/>)"),
              HasSubstr("depends on itself"));
}

TEST_F(SofaMapping, EnginesTransformPoints) {
  const auto scene = readIn(R"(<MechanicalObject name="m" position="1 0 0"/>
    <TransformEngine name="t" input_position="@m.position" scale="2 1 1" rotation="0 0 90" translation="0 0 5"/>
    <Node><MechanicalObject position="@../t.output_position"/><PointModel/></Node>
    <TransformEngine name="u" input_position="@t.output_position" inverse="1" scale="2 1 1" rotation="0 0 90" translation="0 0 5"/>
    <Node><MechanicalObject position="@../u.output_position"/><PointModel/></Node>)");
  ASSERT_EQ(scene.models.size(), 2U);
  EXPECT_THAT(boxOf(scene.models[0]), IsBox(Corners{0, 2, 5, 0, 2, 5}));
  EXPECT_THAT(boxOf(scene.models[1]), IsBox(Corners{1, 0, 0, 1, 0, 0}));
}

TEST_F(SofaMapping, DataOfAnUnknownEngineIsNamed) {
  EXPECT_THAT(complaintIn("<MagicEngine name='e'/><MechanicalObject position='@e.output'/><PointModel/>"),
              HasSubstr("needs the output of MagicEngine 'e' (/e), which this reader cannot compute"));
  EXPECT_THAT(complaintIn("<MagicLoader name='e'/><MechanicalObject src='@e'/><PointModel/>"),
              HasSubstr("MagicLoader 'e'"));
}

constexpr auto kOnSparseGrid =
    "<Node><MechanicalObject position='0 0 0 1 1 1'/><PointModel/><BarycentricMapping/></Node>";

TEST_F(SofaMapping, PointsInASparseGridFollowAllThatMovesTheGridsPoints) {
  const std::string grid = "<SparseGridTopology name='grid' fileTopology='a.obj'/>";
  const std::string engine = "<TransformEngine name='e' translation='10 0 0' rotation='0 0 90' scale='0.5 1 2' ";
  EXPECT_THAT(onlyBox(readIn(grid + engine +
                             "input_position='@grid.position'/><MechanicalObject "
                             "position='@e.output_position'/>" +
                             kOnSparseGrid)),
              IsBox(Corners{9, 0, 0, 10, 0.5, 2}));
  EXPECT_THAT(onlyBox(readIn(grid + engine +
                             "input_position='@grid.position' inverse='1'/><MechanicalObject "
                             "position='@[-1].output_position' dz='1'/>" +
                             kOnSparseGrid)),
              IsBox(Corners{0, 9, 1, 2, 10, 1.5}));
  EXPECT_THAT(
      onlyBox(readIn(grid + "<TransformEngine name='f' translation='0 0 3' input_position='@grid.position'/>" + engine +
                     "input_position='@f.output_position'/><MechanicalObject "
                     "position='@e.output_position'/>" +
                     kOnSparseGrid)),
      IsBox(Corners{9, 0, 6, 10, 0.5, 8}));
  EXPECT_THAT(onlyBox(readIn(grid + "<MechanicalObject src='@grid' dx='2'/>" + kOnSparseGrid)),
              IsBox(Corners{2, 0, 0, 3, 1, 1}));
}

TEST_F(SofaMapping, PointsOfASparseGridAreNotTakenForNone) {
  const std::string grid = "<SparseGridTopology name='grid' fileTopology='a.obj'/>";
  EXPECT_THAT(complaintIn(grid + "<MergePoints name='m' position1='@grid.position'/><MechanicalObject "
                                 "position='@m.points'/><PointModel/>"),
              HasSubstr("sparse grid, which this reader does not compute"));
  EXPECT_THAT(complaintIn(grid + "<TransformEngine name='a' input_position='@b.output_position'/><TransformEngine "
                                 "name='b' input_position='@a.output_position'/><MechanicalObject "
                                 "position='@a.output_position'/><PointModel/>"),
              HasSubstr("sparse grid, which this reader does not compute"));
  EXPECT_THAT(complaintIn(grid +
                          "<MechanicalObject name='s' dx2='5'/><Node><MechanicalObject "
                          "position='@../s.rest_position'/>" +
                          kOnSparseGrid + "</Node>"),
              HasSubstr("sparse grid, which this reader does not compute"))
      << "at rest they are elsewhere";
}

TEST_F(SofaMapping, PointsOnBeamsFollowTheirFrames) {
  // Two beams along x, of lengths 2 and 4; the third frame is turned about x, so that its y is z.
  const std::string beams =
      "<MechanicalObject template='Rigid3' position='0 0 5 0 0 0 1  2 0 5 0 0 0 1  6 0 5 "
      "0.70710678118654752 0 0 0.70710678118654752'/>";
  const auto on = [&](const std::string& points, const std::string& data = "") {
    return readIn(beams + "<Node><MechanicalObject position='" + points + "'/><PointModel/><BeamLinearMapping " + data +
                  "/></Node>");
  };
  // By default coordinates are in beams: the length of a beam scales them.
  EXPECT_THAT(onlyBox(on("0 0 0  2 0 0")), IsBox(Corners{0, 0, 5, 6, 0, 5}));
  EXPECT_THAT(onlyBox(on("0.5 0.1 0")), IsBox(Corners{1, 0.2, 5, 1, 0.2, 5}));
  EXPECT_THAT(onlyBox(on("2 0.5 0")), IsBox(Corners{6, 0, 7, 6, 0, 7}));
  EXPECT_THAT(onlyBox(on("1.5 0.5 0")), IsBox(Corners{4, 1, 6, 4, 1, 6}));
  EXPECT_THAT(onlyBox(on("-1 0 0")), IsBox(Corners{-2, 0, 5, -2, 0, 5}));
  EXPECT_THAT(onlyBox(on("3 0 0")), IsBox(Corners{10, 0, 5, 10, 0, 5})) << "the last beam goes on";
  EXPECT_THAT(onlyBox(on("1 0.3 5.5  4 0 5", "localCoord='0'")), IsBox(Corners{1, 0, 5, 4, 0.3, 5.5}));
  EXPECT_THAT(complaintIn(beams + "<Node><MechanicalObject position='99 0 0'/><PointModel/><BeamLinearMapping "
                                  "localCoord='0'/></Node>"),
              HasSubstr("far behind the last beam"));
  EXPECT_THAT(complaintIn("<MechanicalObject template='Rigid3'/><Node><MechanicalObject position='0 0 0'/><PointModel/>"
                          "<BeamLinearMapping/></Node>"),
              HasSubstr("two frames or more"));
}

/// A cube of length 1 as a Wavefront file.
constexpr auto kCubeObj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\n"
    "f 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

TEST_F(SofaMapping, ASparseGridHasTheCellsThatASurfaceRunsThroughOrEncloses) {
  write("cube.obj", kCubeObj);
  write("corner.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto points = [this](const std::string& file, const std::string& data) {
    return readIn("<SparseGridTopology fileTopology='" + file + "' " + data + "/><MechanicalObject/><PointModel/>");
  };
  const auto whole = points("cube.obj", "n='4 4 4'");
  EXPECT_EQ(whole.models[0].positions.size(), 64U) << "the cell in the middle is inside";
  EXPECT_THAT(boxOf(whole.models[0]), IsBox(Corners{-0.01, -0.01, -0.01, 1.01, 1.01, 1.01}));
  EXPECT_EQ(whole.models[0].positions[1], (Vec3{-0.01, -0.01, -0.01 + 1.02 / 3})) << "z runs first";
  const auto corner = points("corner.obj", "n='4 4 4'");
  EXPECT_EQ(corner.models[0].positions.size(), 51U) << "17 of 27 cells";
  EXPECT_EQ(points("corner.obj", "n='4 4 4' min='0 0 0' max='2 2 2'").models[0].positions.size(), 20U);
  EXPECT_EQ(points("cube.obj", "cellWidth='0.6'").models[0].positions.size(), 27U);
  EXPECT_THAT(complaintIn("<SparseGridTopology fileTopology='cube.obj' n='3 3 3' min='0.5 0 0' max='2 2 2'/>"
                          "<MechanicalObject/><PointModel/>"),
              HasSubstr("sparse grid, which this reader does not compute"));
  EXPECT_THAT(complaintIn("<SparseGridTopology fileTopology='cube.obj' nbVirtualFinerLevels='2'/><MechanicalObject/>"
                          "<PointModel/>"),
              HasSubstr("sparse grid, which this reader does not compute"));
  EXPECT_THAT(complaintIn("<SparseGridTopology fileTopology='cube.obj'/><MechanicalObject/><LineModel/>"),
              HasSubstr("the edges and faces of its sparse grid"));
  const std::string cube = "<SparseGridTopology name='grid' fileTopology='cube.obj' n='2 2 2'/>";
  EXPECT_THAT(
      onlyBox(readIn(cube + "<Node><MechanicalObject position='@../grid.position' dx='1'/><PointModel/></Node>")),
      IsBox(Corners{0.99, -0.01, -0.01, 2.01, 1.01, 1.01}));
  EXPECT_THAT(complaintIn(cube + "<Node><MechanicalObject position='@../grid.position'/><MeshTopology "
                                 "triangles='@../grid.triangles'/><TriangleModel/></Node>"),
              HasSubstr("its triangles are those of a sparse grid"));
  EXPECT_THAT(
      complaintIn("<Node name='a'><SparseGridTopology name='grid' fileTopology='none.obj'/></Node>"
                  "<MeshTopology position='1 2 3 4 5 6' edges='0 1'/><MechanicalObject/><Node><MechanicalObject/>"
                  "<BarycentricMapping input_topology='@../a/grid'/><PointModel/></Node>"),
      HasSubstr("its sparse grid moves in an unknown way"));
}

TEST_F(SofaMapping, PointsInASparseGridFollowAFrameThatCarriesIt) {
  write("cube.obj", kCubeObj);
  const std::string grid = "<SparseGridTopology filename='cube.obj' n='3 3 3'/>";
  const auto carried = [&](const std::string& second) {
    return "<MechanicalObject name='frame' template='Rigid3' position='1 2 0 0 0 0.70710678118654752 "
           "0.70710678118654752'/><Node name='a'>" +
           grid + "<MechanicalObject name='free' dx='1'/><Node name='b'>" + second +
           "<MechanicalObject name='m'/><DeformableOnRigidFrameMapping input1='@../free' input2='@../../frame' "
           "output='@m'/>" +
           kOnSparseGrid + "</Node></Node>";
  };
  EXPECT_THAT(onlyBox(readIn(carried(grid))), IsBox(Corners{0, 3, 0, 1, 4, 1}));
  EXPECT_THAT(complaintIn(carried("<SparseGridTopology filename='cube.obj' n='4 4 4'/>")),
              HasSubstr("its sparse grid moves in an unknown way"));
}

TEST_F(SofaMapping, WhatAMappingWritesIsNoPointOfASparseGrid) {
  const std::string grid = "<SparseGridTopology n='3 3 3' nbVirtualFinerLevels='2'/>";
  EXPECT_THAT(onlyBox(readIn("<MechanicalObject position='1 0 0 2 0 0'/><Node>" + grid +
                             "<MechanicalObject/><IdentityMapping/><PointModel/></Node>")),
              IsBox(Corners{1, 0, 0, 2, 0, 0}));
  EXPECT_THAT(onlyBox(readIn("<MechanicalObject position='1 0 0 2 0 0'/><Node>" + grid +
                             "<MechanicalObject/><SubsetMapping indices='1'/><PointModel/></Node>")),
              IsBox(Corners{2, 0, 0, 2, 0, 0}));
  EXPECT_THAT(complaintIn("<MechanicalObject template='Rigid3' position='1 0 0 0 0 0 1'/><Node>" + grid +
                          "<MechanicalObject name='m'/><RigidMapping/><Node>" + grid +
                          "<MechanicalObject position='@../m.position'/>" + kOnSparseGrid + "</Node></Node>"),
              HasSubstr("sparse grid, which this reader does not compute"));
}

TEST_F(SofaMapping, AVoidMappingMovesNothing) {
  EXPECT_THAT(onlyBox(readIn("<MechanicalObject position='9 9 9'/><Node><MechanicalObject position='1 2 3'/>"
                             "<VoidMapping/><PointModel/></Node>")),
              IsBox(Corners{1, 2, 3, 1, 2, 3}));
}

}  // namespace
}  // namespace allpairs::scene::sofa
