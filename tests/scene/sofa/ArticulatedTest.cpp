// SPDX-License-Identifier: MIT
#include "scene/sofa/SceneText.h"

namespace allpairs::scene::sofa {
namespace {

using testing::HasSubstr;

using SofaArticulated = SceneTest;

/// Two bodies, the second on a joint at x = 1 of the first and at x = -1 of itself, and a point in the second one's
/// middle.
std::string articulated(const std::string& values, const std::string& axes, const std::string& center = "",
                        const std::string& mapping = "", const std::string& second = "0 0 0 0 0 0 1") {
  return "<MechanicalObject name='base' template='Rigid3' position='0 0 9 0 0 0 1  0 0 5 0 0 0 1'/>"
         "<Node name='system'><MechanicalObject name='values' template='Vec1d' position='" +
         values + "'/><Node><MechanicalObject name='bodies' template='Rigid3' position='0 0 0 0 0 0 1  " + second +
         "'/><ArticulatedSystemMapping input1='@../values' output='@bodies' " + mapping +
         "/><Node><MechanicalObject position='0 0 0'/><PointModel/><RigidMapping index='1'/></Node></Node>"
         "<ArticulatedHierarchyContainer/><Node><Node><ArticulationCenter parentIndex='0' childIndex='1' "
         "posOnParent='1 0 0' posOnChild='-1 0 0' " +
         center + "/><Node>" + axes + "</Node></Node></Node></Node>";
}

/// The same with points on the beam between the bodies instead of one on the second body: at its start, and between.
std::string onBeam(std::string scene) {
  const std::string rigid = "<RigidMapping index='1'/>", point = "<MechanicalObject position='0 0 0'/>";
  scene.replace(scene.find(rigid), rigid.size(), "<BeamLinearMapping/>");
  scene.replace(scene.find(point), point.size(), "<MechanicalObject position='0 0 0  1 0.5 0'/>");
  return scene;
}

constexpr auto kAboutZ = "<Articulation rotation='1' axis='0 0 2' articulationIndex='0'/>";
constexpr auto kThenAboutX = "<Articulation rotation='1' rotationAxis='1 0 0' articulationIndex='1'/>";
constexpr auto kThenAlongX = "<Articulation translation='1' axis='1 0 0' articulationIndex='1'/>";
constexpr auto kRight = "1.5707963267948966 ";  // a right angle

TEST_F(SofaArticulated, ArticulatedBodiesHangOnEachOther) {
  const std::string right = kRight;
  const std::string both = std::string(kAboutZ) + kThenAboutX;
  const auto at = [&](const std::string& scene) { return onlyBox(readIn(scene)); };
  const auto is = [](double x, double y, double z) { return IsBox(Corners{x, y, z, x, y, z}); };
  EXPECT_THAT(at(articulated("0", kAboutZ)), is(2, 0, 0));
  EXPECT_THAT(at(articulated(right, kAboutZ)), is(1, 1, 0));
  // The second axis is turned by the first, or is the parent's, or is that of the child as it was.
  EXPECT_THAT(at(articulated(right + right, both)), is(1, 1, 0));
  EXPECT_THAT(at(articulated(right + right, both, "articulationProcess='1'")), is(1, 0, 1));
  EXPECT_THAT(at(articulated(right + right, both, "articulationProcess='2'")), is(1, 0, 1));
  EXPECT_THAT(at(articulated(right + right, both, "articulationProcess='2'", "",
                             "0 0 0  0 0 0.70710678118654752 0.70710678118654752")),
              is(1, 1, 0));
  EXPECT_THAT(at(articulated(right + "2", std::string(kAboutZ) + kThenAlongX)), is(1, 3, 0));
  EXPECT_THAT(at(articulated(right + "2", std::string(kAboutZ) + kThenAlongX, "articulationProcess='1'")), is(3, 1, 0));
  // The whole is where the last frame of another state is, or one that is named.
  EXPECT_THAT(at(articulated(right, kAboutZ, "", "input2='@../../base'")), is(1, 1, 5));
  EXPECT_THAT(at(articulated(right, kAboutZ, "", "input2='@../../base' indexInput2='0'")), is(1, 1, 9));
}

TEST_F(SofaArticulated, BeamsOfArticulatedBodiesAreAsLongAsTheirFramesAreWritten) {
  // The frames are written 3 apart, and the joint puts the second one 2 from the first.
  const std::string text = onBeam(articulated("0", kAboutZ, "", "", "3 0 0 0 0 0 1"));
  EXPECT_THAT(onlyBox(readIn(text)), IsBox(Corners{0, 0, 0, 2, 1.5, 0}));
}

TEST_F(SofaArticulated, ArticulatedBodiesWithoutJointsStayWhereTheyAreAndThatIsSaid) {
  auto text = articulated("0", kAboutZ, "", "", "7 0 0 0 0 0 1");
  text.replace(text.find("input1"), 6, "input");
  const auto scene = readIn(text);
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{7, 0, 0, 7, 0, 0}));
  EXPECT_THAT(scene.warnings.back().reason, HasSubstr("it names no input1"));
}

TEST_F(SofaArticulated, ArticulatedBodiesThatCannotBePlacedAreAnError) {
  EXPECT_THAT(complaintIn(articulated("0", kThenAboutX)), HasSubstr("a value that its input does not have"));
  EXPECT_THAT(complaintIn(articulated("0 0", "<ArticulationCenter childIndex='2'/>")),
              HasSubstr("a frame that its output"));
  EXPECT_THAT(complaintIn(articulated("", kAboutZ)), HasSubstr("more articulations than values"));
  EXPECT_THAT(complaintIn(articulated("0 2", kThenAlongX, "articulationProcess='2'")), HasSubstr("does not follow"));
  EXPECT_THAT(complaintIn(articulated("0", kAboutZ, "", "input2='@nowhere'")), HasSubstr("nowhere to be found"));
  EXPECT_THAT(complaintIn(articulated("0", kAboutZ, "", "container='@nowhere'")), HasSubstr("no Articulated"));
}

TEST_F(SofaArticulated, AxesAreOfLengthOneOnlyWhereOneTurnsTheNext) {
  const auto along = [](const std::string& axis, const std::string& center = "") {
    return articulated(
        "0 2", std::string(kAboutZ) + "<Articulation translation='1' articulationIndex='1' axis='" + axis + "'/>",
        center);
  };
  EXPECT_THAT(onlyBox(readIn(along("3 0 0"))), IsBox(Corners{4, 0, 0, 4, 0, 0}));
  EXPECT_THAT(onlyBox(readIn(along("3 0 0", "articulationProcess='1'"))), IsBox(Corners{8, 0, 0, 8, 0, 0}));
  EXPECT_THAT(onlyBox(readIn(along("0 0 0"))), IsBox(Corners{2, 0, 0, 2, 0, 0})) << "an axis without a direction";
}

TEST_F(SofaArticulated, BeamsOfThemAreAsLongAsTheirFramesAreWrittenButForTheFirst) {
  // The first frame is where another state's is as the beams are measured: 5 above, and the second is written 12 along.
  const std::string text = onBeam(articulated("0", kAboutZ, "", "input2='@../../base'", "12 0 0 0 0 0 1"));
  EXPECT_THAT(onlyBox(readIn(text)), IsBox(Corners{0, 0, 5, 2, 6.5, 5}));
}

TEST_F(SofaArticulated, BodiesThatAreNoneCannotBeCarried) {
  auto text = articulated("0", kAboutZ, "", "input2='@../../base'");
  const std::string bodies = "position='0 0 0 0 0 0 1  0 0 0 0 0 0 1'";
  text.replace(text.find(bodies), bodies.size(), "position=''");
  EXPECT_THAT(complaintIn(text), HasSubstr("no rigid frame"));
}

}  // namespace
}  // namespace allpairs::scene::sofa
