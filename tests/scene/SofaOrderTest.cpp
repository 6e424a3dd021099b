// SPDX-License-Identifier: MIT
#include "SofaAnswer.h"

namespace allpairs::test {
namespace {

using scene::SofaVersion;

/// SOFA makes and starts components in an order, and what comes later is not there for what comes first.
class SofaOrder : public SofaAnswers {};

constexpr const char* kBall = "<Node name='B'><MechanicalObject name='m'/><SphereCollisionModel name='s'/></Node>";
constexpr const char* kBallAtZero = "/B/s 1 [-1 -1 -1] [1 1 1]\n";

TEST_F(SofaOrder, ModelsOfPointsLinesAndTrianglesBeforeTheirStateAreNotMade) {
  const std::string late = "comes later in the file: as in SOFA, it is left out\n";
  for (const SofaVersion sofa : kBoth)
    EXPECT_EQ(answer("<Node name='A'><MeshTopology position='0 0 0 1 0 0 0 1 0' triangles='0 1 2'/>"
                     "<TriangleCollisionModel name='t'/><LineCollisionModel name='l'/><PointCollisionModel name='p'/>"
                     "<SphereCollisionModel name='s' radius='0.5'/><MechanicalObject name='m'/></Node>" +
                         std::string{kBall},
                     sofa),
              "/A/s 3 [-0.5 -0.5 -0.5] [1.5 1.5 0.5]\n" + std::string{kBallAtZero} + "/B/s - /A/s\n" +
                  "/A/t: it needs MechanicalObject 'm' (/A/m), which " + late +
                  "/A/l: it needs MechanicalObject 'm' (/A/m), which " + late +
                  "/A/p: it needs MechanicalObject 'm' (/A/m), which " + late);
}

TEST_F(SofaOrder, OfAStateThatIsCopiedAgainAndWhoseTopologyComesLaterNothingIsBoundAtRest) {
  // Written past the rest positions of a state that had none.
  for (const SofaVersion sofa : kBoth)
    EXPECT_NE(answer("<Node name='R'><MechanicalObject template='Rigid3d' position='1 2 3 0 0 0 1'/>"
                     "<Node name='M'><MechanicalObject name='m' position='0 0 0'/><RigidMapping/></Node></Node>"
                     "<Node name='A'><MechanicalObject name='p' position='@../R/M/m.position'/>"
                     "<MeshTopology position='0 0 0' triangles='0 0 0'/>"
                     "<Node name='C'><MechanicalObject position='0 0 0 1 1 1'/>"
                     "<BarycentricMapping useRestPosition='1'/><PointCollisionModel name='q'/></Node></Node>",
                     sofa)
                  .find("/A/C/q "),
              std::string::npos);
}

TEST_F(SofaOrder, AModelIsMadeIfAStateOfPointsAboveComesFirst) {
  const auto scene = [](const std::string& above) {
    return "<Node name='A'>" + above +
           "<Node name='C'><PointCollisionModel name='p'/><MechanicalObject name='m' position='5 0 0'/></Node></Node>";
  };
  EXPECT_EQ(answer(scene("<MechanicalObject/>")), "/A/C/p 1 [5 0 0] [5 0 0]\n");
  EXPECT_EQ(answer(scene("<MechanicalObject template='Rigid3'/>")),
            "/A/C/p: it needs MechanicalObject 'm' (/A/C/m), which comes later in the file: as in SOFA, it is left "
            "out\n");
}

TEST_F(SofaOrder, MappingsBeforeAStateThatTheyNeedAreNotMade) {
  const std::string state = "<MechanicalObject name='m' position='0 0 0'/>", model = "<SphereCollisionModel name='s'/>";
  const std::string frame = "<MechanicalObject name='f' template='Rigid3' position='10 0 0 0 0 0 1'/>";
  const std::string pair = "/A/C/s 1 [-1 -1 -1] [1 1 1]\n" + std::string{kBallAtZero} + "/B/s - /A/C/s\n";
  for (const SofaVersion sofa : kBoth) {
    EXPECT_EQ(answer("<Node name='A'>" + frame + "<Node name='C'><RigidMapping name='r'/>" + state + model +
                         "</Node></Node>" + kBall,
                     sofa),
              pair +
                  "/A/C/r: it needs MechanicalObject 'm' (/A/C/m), which comes later in the file: as in SOFA, it is "
                  "left out\n");
    EXPECT_EQ(answer("<Node name='A'><Node name='C'>" + state + model + "<RigidMapping name='r'/></Node>" + frame +
                         "</Node>" + kBall,
                     sofa),
              pair +
                  "/A/C/r: it needs MechanicalObject 'f' (/A/f), which comes later in the file: as in SOFA, it is "
                  "left out\n");
    EXPECT_EQ(
        answer("<Node name='A'>" + frame + "<Node name='C'>" + state + model + "<RigidMapping/></Node></Node>", sofa),
        "/A/C/s 1 [9 -1 -1] [11 1 1]\n");
  }
}

TEST_F(SofaOrder, MappingsOfSeveralStatesNameTheirOutputAndComeAfterAllOfThem) {
  const auto scene = [](const std::string& mapping, const std::string& last) {
    return "<Node name='A'><MechanicalObject name='m' position='5 0 0'/></Node>"
           "<Node name='C'><MechanicalObject name='m' position='0 0 0'/><IdentityMultiMapping name='i' " +
           mapping + "/><SphereCollisionModel name='s'/></Node>" + last;
  };
  const std::string last = "<Node name='D'><MechanicalObject name='m' position='7 0 0'/></Node>";
  for (const SofaVersion sofa : kBoth) {
    EXPECT_EQ(answer(scene("input='@../A/m @../A/m'", ""), sofa),
              "/C/s 1 [-1 -1 -1] [1 1 1]\n/C/i: it names no output: as in SOFA, it is left out\n");
    EXPECT_EQ(answer(scene("input='@../A/m @../D/m' output='@m'", last), sofa),
              "/C/s 1 [-1 -1 -1] [1 1 1]\n"
              "/C/i: it needs MechanicalObject 'm' (/D/m), which comes later in the file: as in SOFA, it is left "
              "out\n");
    EXPECT_EQ(answer(scene("input='@../A/m @../A/m' output='@m'", ""), sofa), "/C/s 2 [4 -1 -1] [6 1 1]\n");
  }
}

TEST_F(SofaOrder, TopologicalMappingsBeforeATopologyThatTheyNeedAreNotMade) {
  EXPECT_EQ(
      answer("<Node name='A'><TetrahedronSetTopologyContainer position='0 0 0 1 0 0 0 1 0 0 0 1' tetrahedra='0 1 2 3'/>"
             "<MechanicalObject/><Node name='Q'><MechanicalObject/><Tetra2TriangleTopologicalMapping name='map'/>"
             "<TriangleSetTopologyContainer name='c'/><IdentityMapping/><TriangleCollisionModel name='t'/>"
             "</Node></Node>"),
      "/A/Q/t 0\n/A/Q/map: it needs TriangleSetTopologyContainer 'c' (/A/Q/c), which comes later in the file: as in "
      "SOFA, it is left out\n/A/Q/t: it has no elements, and is in no pair\n");
}

TEST_F(SofaOrder, DataThatLinkToWhatComesLaterHaveTheirDefaults) {
  m_folder.write("t.obj", "v 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\n");
  const auto scene = [](const std::string& topology, const std::string& state) {
    return "<Node name='A'><TriangleSetTopologyContainer name='c' " + topology + "/><MechanicalObject name='m' " +
           state +
           "/><TriangleCollisionModel name='t'/><PointCollisionModel name='p'/>"
           "<MeshOBJLoader name='l' filename='t.obj'/></Node>";
  };
  const std::string loader = " MeshOBJLoader 'l' (/A/l), which comes later in the file: as in SOFA, ";
  const std::string empty = "/A/t: it has no elements, and is in no pair\n";
  for (const SofaVersion sofa : kBoth) {
    EXPECT_EQ(answer(scene("position='@l.position' triangles='@l.triangles'", "position='@l.position'"), sofa),
              "/A/t 0\n/A/p 1 [0 0 0] [0 0 0]\n/A/m: it needs" + loader +
                  "its position has the default\n/A/c: it needs" + loader +
                  "its position has the default\n/A/c: it needs" + loader + "its triangles has the default\n" + empty);
    EXPECT_EQ(answer(scene("src='@l'", "src='@l'"), sofa), "/A/t 0\n/A/p 1 [0 0 0] [0 0 0]\n/A/m: it needs" + loader +
                                                               "its src gives nothing\n/A/c: it needs" + loader +
                                                               "its src gives nothing\n" + empty);
  }
  EXPECT_EQ(answer("<Node name='B'><MechanicalObject name='n' position='@../A/m.position' translation='5 0 0'/>"
                   "<SphereCollisionModel name='s'/></Node>"
                   "<Node name='A'><MechanicalObject name='m' position='1 0 0'/></Node>"),
            "/B/s 1 [4 -1 -1] [6 1 1]\n/B/n: it needs MechanicalObject 'm' (/A/m), which comes later in the file: as "
            "in SOFA, its position has the default\n");
}

TEST_F(SofaOrder, LinesAreThoseThatTheTopologyHasWhenTheModelStarts) {
  const std::string tetrahedron = "position='0 0 0 1 0 0 0 1 0 0 0 1' tetrahedra='0 1 2 3'";
  const std::string none =
      "comes later, or what fills it does: as in SOFA, it has only the elements that are written there\n"
      "/A/l: it has no elements, and is in no pair\n";
  const auto scene = [&](const std::string& model, const std::string& topology) {
    return "<Node name='A'><MechanicalObject name='m' position='0 0 0 1 0 0 0 1 0 0 0 1'/>" + model + topology +
           "<TriangleCollisionModel name='t'/></Node>";
  };
  for (const SofaVersion sofa : kBoth) {
    for (const std::string kind : {"TetrahedronSetTopologyContainer", "MeshTopology"}) {
      const auto topology = [&](const std::string& edges) {
        return "<" + kind + " name='c' " + tetrahedron + edges + "/>";
      };
      EXPECT_EQ(answer(scene("<LineCollisionModel name='l'/>", topology("")), sofa),
                "/A/l 0\n/A/t 4 [0 0 0] [1 1 1]\n/A/l: its topology " + kind + " 'c' (/A/c) " + none);
      EXPECT_EQ(answer(scene("<CapsuleCollisionModel name='l'/>", topology("")), sofa),
                "/A/l 0\n/A/t 4 [0 0 0] [1 1 1]\n/A/l: its topology " + kind + " 'c' (/A/c) " + none);
      EXPECT_EQ(answer(scene("<LineCollisionModel name='l'/>", topology(" edges='0 1'")), sofa).substr(0, 23),
                "/A/l 1 [0 0 0] [1 0 0]\n");
    }
    EXPECT_EQ(answer("<Node name='A'><MechanicalObject position='0 0 0 1 0 0 0 1 0'/><LineCollisionModel name='l'/>"
                     "<MeshTopology edges='0 1 1 2'/></Node>",
                     sofa),
              "/A/l 2 [0 0 0] [1 1 0]\n");
    EXPECT_EQ(answer(scene("<TetrahedronCollisionModel name='l'/>", "<MeshTopology " + tetrahedron + "/>"), sofa),
              "/A/l 1 [0 0 0] [1 1 1]\n/A/t 4 [0 0 0] [1 1 1]\n");
  }
}

TEST_F(SofaOrder, LinesBeforeTheMappingThatFillsTheirTopologyAreNone) {
  const auto scene = [](const std::string& first, const std::string& last) {
    return "<Node name='A'><TetrahedronSetTopologyContainer name='g' position='0 0 0 1 0 0 0 1 0 0 0 1' "
           "tetrahedra='0 1 2 3'/><MechanicalObject/><Node name='Q'><TriangleSetTopologyContainer name='q'/>"
           "<TriangleSetTopologyModifier/><MechanicalObject/>" +
           first + "<Tetra2TriangleTopologicalMapping input='@../g' output='@q'/><IdentityMapping/>" + last +
           "</Node></Node>";
  };
  const std::string models = "<LineCollisionModel name='l'/><TriangleCollisionModel name='t'/>";
  for (const SofaVersion sofa : kBoth) {
    EXPECT_EQ(answer(scene(models, ""), sofa),
              "/A/Q/l 0\n/A/Q/t 4 [0 0 0] [1 1 1]\n"
              "/A/Q/l: its topology TriangleSetTopologyContainer 'q' (/A/Q/q) comes later, or what fills it does: as "
              "in SOFA, it has only the elements that are written there\n"
              "/A/Q/l: it has no elements, and is in no pair\n");
    EXPECT_EQ(answer(scene("", models), sofa), "/A/Q/l 6 [0 0 0] [1 1 1]\n/A/Q/t 4 [0 0 0] [1 1 1]\n");
  }
}

TEST_F(SofaOrder, APositionThatLinksToAMappedStateFollowsItWithoutTransformsOfItsOwn) {
  const auto scene = [](const std::string& mapping, const std::string& second) {
    return "<Node name='A'><MechanicalObject template='Rigid3' position='10 0 0 0 0 0 1'/><Node name='C'>"
           "<MechanicalObject name='m' position='0 0 0'/>" +
           mapping + "</Node></Node><Node name='B'><MechanicalObject name='n' position='@../A/C/m.position' " + second +
           "/><SphereCollisionModel name='s'/></Node><Node name='D'><MechanicalObject name='o' "
           "position='@../B/n.position' translation2='0 3 0'/><SphereCollisionModel name='s'/></Node>";
  };
  const std::string again =
      ": its position links to a state that a mapping moves: as in SOFA, it is that state's in the end, without the "
      "transforms of its own\n";
  for (const SofaVersion sofa : kBoth) {
    EXPECT_EQ(answer(scene("<RigidMapping/>", "translation='5 0 0'"), sofa),
              "/B/s 1 [9 -1 -1] [11 1 1]\n/D/s 1 [9 -1 -1] [11 1 1]\n/D/s - /B/s\n/B/n" + again + "/D/o" + again);
    EXPECT_EQ(answer(scene("<RigidMapping/>", ""), sofa),
              "/B/s 1 [9 -1 -1] [11 1 1]\n/D/s 1 [9 -1 -1] [11 1 1]\n/D/s - /B/s\n/D/o" + again);
    EXPECT_EQ(answer(scene("", "translation='5 0 0'"), sofa), "/B/s 1 [4 -1 -1] [6 1 1]\n/D/s 1 [4 2 -1] [6 4 1]\n");
  }
}

}  // namespace
}  // namespace allpairs::test
