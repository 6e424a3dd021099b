// SPDX-License-Identifier: MIT
#include "scene/sofa/SceneText.h"

namespace allpairs::scene::sofa {
namespace {

using testing::HasSubstr;

/// States: sizes, points from topologies, transforms. What they hold is seen through a model of points.
class SofaState : public SceneTest {
 protected:
  [[nodiscard]] ModelDescription points(const std::string& text) const {
    auto scene = readIn(text + "<PointModel/>");
    EXPECT_EQ(scene.models.size(), 1U);
    return scene.models.at(0);
  }
  [[nodiscard]] Corners box(const std::string& text) const { return boxOf(points(text)); }
  [[nodiscard]] std::size_t count(const std::string& text) const { return points(text).elementCount(); }
};

TEST_F(SofaState, HasOnePointAtTheOriginUnlessToldOtherwise) {
  EXPECT_EQ(count("<MechanicalObject/>"), 1U);
  EXPECT_THAT(box("<MechanicalObject/>"), IsBox(Corners{}));
  EXPECT_EQ(count("<MechanicalObject size='4'/>"), 4U);
  EXPECT_EQ(count("<MechanicalObject position='1 1 1' size='3'/>"), 3U);
  EXPECT_EQ(count("<MechanicalObject velocity='0 0 0 0 0 0'/>"), 2U);
  EXPECT_EQ(count("<MechanicalObject position=''/>"), 0U);
}

TEST_F(SofaState, AnIncompleteLastPointIsDropped) { EXPECT_EQ(count("<MechanicalObject position='1 1 1 2 2'/>"), 1U); }

TEST_F(SofaState, ScalesThenTurnsThenMoves) {
  EXPECT_THAT(box("<MechanicalObject position='1 2 3 2 2 3' scale3d='2 1 1' rotation='0 0 90' translation='10 0 0'/>"),
              IsBox(Corners{8, 2, 3, 8, 4, 3}));
}

TEST_F(SofaState, TurnsAboutXThenYThenZ) {
  EXPECT_THAT(box("<MechanicalObject position='0 0 1' rotation='90 90 0'/>"), IsBox(Corners{0, -1, 0, 0, -1, 0}));
  EXPECT_THAT(box("<MechanicalObject position='1 0 0' rotation='0 90 90'/>"), IsBox(Corners{0, 0, -1, 0, 0, -1}));
}

TEST_F(SofaState, TheSecondTransformComesAfterTheFirst) {
  EXPECT_THAT(box("<MechanicalObject position='1 0 0' translation='1 0 0' rotation2='0 0 90' translation2='0 0 5'/>"),
              IsBox(Corners{0, 2, 5, 0, 2, 5}));
  EXPECT_THAT(box("<MechanicalObject position='1 0 0' rz2='90' dz2='5'/>"), IsBox(Corners{0, 1, 5, 0, 1, 5}));
}

TEST_F(SofaState, SingleAttributesOverrideVectors) {
  EXPECT_THAT(box("<MechanicalObject position='1 1 1' scale3d='9 9 9' scale='2'/>"), IsBox(Corners{2, 2, 2, 2, 2, 2}));
  EXPECT_THAT(box("<MechanicalObject position='1 1 1' scale='3' sy='2'/>"), IsBox(Corners{1, 2, 1, 1, 2, 1}));
  EXPECT_THAT(box("<MechanicalObject position='1 1 1' translation='9 9 9' dx='2'/>"), IsBox(Corners{3, 1, 1, 3, 1, 1}));
  EXPECT_THAT(box("<MechanicalObject position='1 0 0' rotation='9 9 9' rz='90'/>"), IsBox(Corners{0, 1, 0, 0, 1, 0}));
}

TEST_F(SofaState, AFloatAttributeThatDoesNotParseAsAWholeKeepsItsDefault) {
  EXPECT_THAT(box("<MechanicalObject position='1 1 1' scale='0.25 0.25 0.25'/>"), IsBox(Corners{1, 1, 1, 1, 1, 1}));
  EXPECT_THAT(box("<MechanicalObject position='1 1 1' dx='2 '/>"), IsBox(Corners{1, 1, 1, 1, 1, 1}));
  EXPECT_THAT(box("<MechanicalObject position='1 1 1' dy=' 3'/>"), IsBox(Corners{1, 4, 1, 1, 4, 1}));
}

TEST_F(SofaState, AFloatAttributeThatKeepsItsDefaultIsNamed) {
  const auto scene = readIn("<MechanicalObject position='1 1 1' dx='2 '/><PointModel/>");
  EXPECT_THAT(scene.warnings.back().reason, HasSubstr("dx: '2 ' is not one number alone"));
}

TEST_F(SofaState, AFloatAttributeThatIsALinkKeepsItsDefaultAndIsNamed) {
  const auto scene = readIn("<MechanicalObject name='m' position='1 1 1' dx='@m.dy'/><PointModel/>");
  EXPECT_EQ(scene.models.at(0).positions.at(0), (Vec3{1, 1, 1}));
  EXPECT_THAT(scene.warnings.back().reason, HasSubstr("dx: a link is not followed here; it has the default"));
}

TEST_F(SofaState, AFloatAttributeWithAWordThatIsNoNumberIsAnError) {
  const auto failure = [&](const std::string& components) { return complaintIn(components + "<PointModel/>"); };
  for (const std::string name : {"dx", "rz", "sy", "scale", "dx2", "ry2", "size"})
    EXPECT_THAT(failure("<MechanicalObject position='1 1 1' " + name + "='1,5'/>"),
                HasSubstr(name + ": '1,5' is not a finite number"));
  EXPECT_THAT(failure("<MechanicalObject rz='90deg'/>"), HasSubstr("rz: '90deg' is not a finite number"));
  EXPECT_THAT(failure("<MechanicalObject dx='1e50'/>"), HasSubstr("dx: '1e50' is out of the range of float32"));
  EXPECT_THAT(failure("<RegularGridTopology n='2 2 2' xmin='0,5' ymin='0' zmin='0' xmax='1' ymax='1' zmax='1'/>"
                      "<MechanicalObject/>"),
              HasSubstr("xmin: '0,5' is not a finite number"));
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THAT(
      failure("<MeshOBJLoader name='l' filename='a.obj' scale='2,5'/><MechanicalObject position='@l.position'/>"),
      HasSubstr("scale: '2,5' is not a finite number"));
}

TEST_F(SofaState, AVectorWithTooFewNumbersKeepsTheDefaultsOfTheRest) {
  EXPECT_THAT(box("<MechanicalObject position='1 1 1' scale3d='4'/>"), IsBox(Corners{4, 1, 1, 4, 1, 1}));
}

TEST_F(SofaState, FloatAttributesAreSinglePrecision) {
  EXPECT_EQ(box("<MechanicalObject dx='0.1'/>")[0], static_cast<double>(0.1F));
  EXPECT_EQ(box("<MechanicalObject translation='0.1 0 0'/>")[0], 0.1);
}

TEST_F(SofaState, WithOnePointTakesThoseOfItsTopology) {
  const std::string mesh = "<MeshTopology position='1 0 0 2 0 0 3 0 0' edges='0 1'/>";
  EXPECT_EQ(count(mesh + "<MechanicalObject/>"), 2U);  // One more than the largest index.
  EXPECT_THAT(box(mesh + "<MechanicalObject position='9 9 9' dx='1'/>"), IsBox(Corners{2, 0, 0, 3, 0, 0}));
  EXPECT_THAT(box(mesh + "<MechanicalObject position='9 9 9 8 8 8'/>"), IsBox(Corners{8, 8, 8, 9, 9, 9}));
  EXPECT_EQ(count(mesh + "<MechanicalObject useTopology='0'/>"), 1U);
  EXPECT_EQ(count("<MeshTopology edges='0 4'/><MechanicalObject/>"), 1U);  // That one has no points to give.
}

TEST_F(SofaState, DoesNotTakePointsFromATopologyAbove) {
  EXPECT_EQ(count("<MeshTopology position='1 0 0 2 0 0' edges='0 1'/><Node><MechanicalObject/></Node><MechanicalObject "
                  "size='3'/>"),
            3U);
}

TEST_F(SofaState, BeforeItsTopologyTakesNothingFromAMeshAndAllFromAGrid) {
  EXPECT_EQ(count("<MechanicalObject/><MeshTopology position='1 0 0 2 0 0' edges='0 1'/>"), 0U);
  EXPECT_EQ(count("<MechanicalObject/><RegularGridTopology n='2 3 4'/>"), 24U);
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n");
  EXPECT_EQ(count("<MechanicalObject/><SparseGridTopology n='2 2 2' filename='a.obj'/>"), 8U);
}

TEST_F(SofaState, ANodeMayOrderTheTopologyFirst) {
  const auto scene = readIn(R"(<Node depend="topo dofs"><MechanicalObject name="dofs"/>
    <TetrahedronSetTopologyContainer name="topo" position="1 0 0 2 0 0"/><PointModel/></Node>)");
  ASSERT_EQ(scene.models.size(), 1U);
  EXPECT_EQ(scene.models[0].elementCount(), 2U);
}

TEST_F(SofaState, ContainersGiveAllTheirPoints) {
  EXPECT_EQ(count("<PointSetTopologyContainer position='1 0 0 2 0 0 3 0 0'/><MechanicalObject/>"), 3U);
  EXPECT_EQ(
      count("<TriangleSetTopologyContainer position='1 0 0 2 0 0 3 0 0 4 0 0' triangles='0 1 2'/><MechanicalObject/>"),
      4U);
}

TEST_F(SofaState, RigidFramesTurnAboutTheOriginAndAboutThemselves) {
  const auto scene = readIn(R"(<MechanicalObject template="Rigid3d" position="1 0 0 0 0 0 1" rz="90" dx="5"/>
    <OBBModel extents="3 2 1"/>)");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{3, -2, -1, 7, 4, 1}));
}

TEST_F(SofaState, RigidFramesLinkedFromPointsAreNotTurned) {
  const auto scene = readIn(R"(<MechanicalObject name="p" position="1 2 3 4 5 6"/>
    <Node><MechanicalObject template="Rigid" position="@../p.position"/><OBBModel/></Node>)");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{0, 1, 2, 5, 6, 7}));
}

TEST_F(SofaState, AScaleMayBeLinkedFromAnotherState) {
  EXPECT_THAT(box("<MechanicalObject name='a' scale='2'/><MechanicalObject position='1 1 1' scale3d='@a.scale3d'/>"),
              IsBox(Corners{2, 2, 2, 2, 2, 2}));
  write("a.obj", "v 0 0 0\n");
  EXPECT_THAT(box("<MeshObjLoader name='l' filename='a.obj' scale3d='2 1 1' scale='3'/>"
                  "<MechanicalObject position='1 1 1' scale3d='@l.scale3d'/>"),
              IsBox(Corners{6, 3, 3, 6, 3, 3}))
      << "a loader multiplies its two scales";
}

TEST_F(SofaState, WhatIsNoFiniteNumberIsNamed) {
  for (const auto word : {"nan", "inf", "1e999", "abc", "1,2,3", "0x10"})
    EXPECT_THAT(complaintIn("<MechanicalObject name='m' position='0 0 " + std::string{word} + "'/><PointModel/>"),
                testing::AllOf(HasSubstr("scene.scn:2: MechanicalObject 'm'"), HasSubstr(word)));
}

TEST_F(SofaState, NumbersThatRunTogetherAreTakenApart) {
  const auto scene = readIn("<MechanicalObject name='m' position='0-1+2 1.5.25-3e-1-4e1'/><PointModel/>");
  ASSERT_EQ(scene.models.size(), 1U);
  EXPECT_EQ(scene.models[0].positions, (std::vector<Vec3>{{0, -1, 2}, {1.5, 0.25, -0.3}}));
  ASSERT_EQ(scene.warnings.size(), 3U);
  EXPECT_EQ(scene.warnings[1].subject, "/m");
  EXPECT_THAT(scene.warnings[1].reason, HasSubstr("'0-1+2' is read as several numbers"));
  EXPECT_THAT(scene.warnings[2].reason, HasSubstr("the last 1 of 7 numbers are dropped"));
  EXPECT_THAT(complaintIn("<MechanicalObject position='0-1e 2'/><PointModel/>"), HasSubstr("'0-1e' is not a finite"));
  EXPECT_THAT(complaintIn("<MechanicalObject position='0--1 2'/><PointModel/>"), HasSubstr("'0--1' is not a finite"));
}

TEST_F(SofaState, RestPositionsOfRigidFramesAreFrames) {
  const auto scene = readIn(
      "<MechanicalObject template='Rigid3' position='0 0 0 0 0 0 1' rest_position='1 2 3 0 0 0 1'/>"
      "<CollisionPipeline/><BruteForceDetection/>"
      "<Node><MechanicalObject name='m' position='@../mObject1.rest_position'/><PointModel/></Node>");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{1, 2, 3, 1, 2, 3}));
  EXPECT_THAT(scene.warnings, testing::IsEmpty());
}

TEST_F(SofaState, ResultsThatOverflowAreNamed) {
  EXPECT_THAT(complaintIn("<MechanicalObject position='1e300 0 0' scale3d='1e300 1 1'/><PointModel/>"),
              HasSubstr("not finite"));
}

TEST_F(SofaState, SizesOutOfAllReasonAreNamed) {
  EXPECT_THAT(complaintIn("<MechanicalObject size='2000000000'/><PointModel/>"),
              testing::AnyOf(HasSubstr("out of all reason"), HasSubstr("points it takes more than")));
}

TEST_F(SofaState, StatesOfAnotherKindAreNamed) {
  EXPECT_THAT(complaintIn("<MechanicalObject template='Vec1d'/><PointModel/>"), HasSubstr("states of this kind"));
}

}  // namespace
}  // namespace allpairs::scene::sofa
