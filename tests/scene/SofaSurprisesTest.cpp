// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include "SofaAnswer.h"

namespace allpairs::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Scenes that SOFA reads otherwise than one would think.
class SofaSurprises : public SofaAnswers {
 protected:
  SofaSurprises() { m_method = "<MinProximityIntersection alarmDistance='0' contactDistance='0'/>"; }

  /// The models of a scene in which nothing overlaps and of which nothing is to be said.
  [[nodiscard]] std::vector<std::string> models(const std::string& body,
                                                scene::SofaVersion sofa = scene::SofaVersion::Sofa2612) const {
    const SofaAnswer result = partsOfAnswer(body, sofa);
    EXPECT_THAT(result.pairs, IsEmpty());
    EXPECT_THAT(result.warnings, IsEmpty());
    return result.models;
  }

  [[nodiscard]] std::string complaint(const std::string& body) const {
    try {
      (void)partsOfAnswer(body);
    } catch (const FileError& problem) {
      return problem.what();
    }
    return "read";
  }
};

constexpr auto kOld = scene::SofaVersion::Sofa2006;
constexpr auto kNew = scene::SofaVersion::Sofa2612;

/// A node with a ball of radius 0.5, and more in front of it.
std::string ball(const std::string& name, const std::string& points, const std::string& more = "") {
  return "<Node name='" + name + "'><MechanicalObject position='" + points + "'/>" + more +
         "<SphereCollisionModel name='S' radius='0.5'/></Node>";
}

std::string boundBall(const std::string& points) { return ball("C", points, "<BarycentricMapping/>"); }

TEST_F(SofaSurprises, PointsInABentCellOfAContainerMoveAsInOneOfAMesh) {
  for (const char* kind : {"MeshTopology", "HexahedronSetTopologyContainer"})
    for (const auto sofa : {kOld, kNew})
      EXPECT_THAT(models(std::string("<Node name='A'><") + kind +
                             " position='0 0 0 1 0 0 2 2 0 0 1 0 0 0 1 1 0 1 2 2 1 0 1 1' "
                             "hexahedra='0 1 2 3 4 5 6 7'/><MechanicalObject/>" +
                             boundBall("1 1 0.5") + "</Node>",
                         sofa),
                  ElementsAre("/A/C/S 1 [1.5 1.5 0] [2.5 2.5 1]"))
          << kind;
}

TEST_F(SofaSurprises, AFlatGridBindsNothing) {
  for (const auto sofa : {kOld, kNew}) {
    const SofaAnswer flat =
        partsOfAnswer("<Node name='A'><RegularGridTopology n='5 5 1' max='4 4 0'/><MechanicalObject/>" +
                          boundBall("1 1 5") + "</Node>" + ball("B", "1 1 5"),
                      sofa);
    EXPECT_THAT(flat.models, ElementsAre("/A/C/S 1 [0.5 0.5 4.5] [1.5 1.5 5.5]", "/B/S 1 [0.5 0.5 4.5] [1.5 1.5 5.5]"));
    EXPECT_THAT(flat.pairs, ElementsAre("/B/S - /A/C/S"));
    EXPECT_THAT(flat.warnings, ElementsAre(HasSubstr("the grid of its input is no volume, and it moves nothing")));
  }
}

TEST_F(SofaSurprises, TheFirstOfTwoTopologiesCountsWhereComponentsSearchThemselves) {
  const std::string points = "position='0 0 0 4 0 0 0 4 0 4 4 4'";
  const std::string triangle = "<MeshTopology " + points + " triangles='0 1 2'/>";
  const std::string edge = "<MeshTopology " + points + " edges='0 3'/>";
  const auto bound = [&](const std::string& topologies) {
    return models("<Node name='A'>" + topologies + "<MechanicalObject " + points + "/>" + boundBall("1 1 0.25") +
                  "</Node>");
  };
  EXPECT_THAT(bound(triangle + edge), ElementsAre("/A/C/S 1 [0.5 0.5 -0.5] [1.5 1.5 0.5]"));
  EXPECT_THAT(bound(edge + triangle), ElementsAre("/A/C/S 1 [0.25 0.25 0.25] [1.25 1.25 1.25]"));
  EXPECT_THAT(
      models("<Node name='A'>" + triangle + edge + "<Node name='B'><MeshTopology name='t' " + points +
             "/></Node><SubsetTopology name='e' rest_position='@B/t.position' box='0 0 0 9 9 9'/>"
             "<Node name='C'><MechanicalObject " +
             points +
             "/><MeshTopology triangles='@../e.trianglesInROI'/><TriangleCollisionModel name='T'/></Node></Node>"),
      ElementsAre("/A/C/T 1 [0 0 0] [4 4 0]"));
}

/// A large triangle, a small one above it that starts at a height, and twenty small ones far away.
std::string nearAndFar(const std::string& height) {
  std::string points = "0 0 0 10 0 0 0 10 10 8 8 " + height + " 8.3 8 " + height + " 8 8.3 " + height;
  std::string triangles = "0 1 2 3 4 5";
  for (int i = 0; i < 20; ++i) {
    const std::string x = std::to_string(20 + i);
    points += ' ' + x + " 0 500 " + x + ".3 0 500 " + x + " 0.3 500";
    for (int corner = 0; corner < 3; ++corner) triangles += ' ' + std::to_string(6 + 3 * i + corner);
  }
  return "<TriangleSetTopologyContainer position='" + points + "' triangles='" + triangles + "'/><MechanicalObject/>";
}

TEST_F(SofaSurprises, OfAContainerOnlyTrianglesNearAPointBindIt) {
  // Places are 0.954 wide. From z = 5 the small triangle, whose centre is nearest, is not among the places around.
  const auto bound = [this](const std::string& height, const std::string& points) {
    for (const auto sofa : {kOld, kNew})
      EXPECT_EQ(models("<Node name='A'>" + nearAndFar(height) + boundBall(points) + "</Node>", sofa).size(), 1U);
    return models("<Node name='A'>" + nearAndFar(height) + boundBall(points) + "</Node>");
  };
  EXPECT_THAT(bound("5", "8 8 1"), ElementsAre("/A/C/S 1 [7.5 4 4] [8.5 5 5]"));
  EXPECT_THAT(bound("2.4", "8 8 1"), ElementsAre("/A/C/S 1 [7.5 7.5 1.9] [8.5 8.5 2.9]"));
  EXPECT_THAT(bound("5", "8 8 30"), ElementsAre("/A/C/S 1 [7.5 7.5 4.5] [8.5 8.5 5.5]")) << "none near: all count";
}

TEST_F(SofaSurprises, FlatTrianglesBindByTheirSidesInContainersAndToTheirFirstCornerInMeshes) {
  const auto bound = [&](const std::string& kind, scene::SofaVersion sofa, const std::string& size,
                         const std::string& point) {
    return models("<Node name='A'><" + kind + " position='0 0 0 " + size + " triangles='0 1 2'/><MechanicalObject/>" +
                      "<Node name='C'><MechanicalObject position='" + point +
                      "'/><BarycentricMapping/><PointCollisionModel name='P'/></Node></Node>",
                  sofa);
  };
  const std::string container = "TriangleSetTopologyContainer", mesh = "MeshTopology";
  for (const auto sofa : {kOld, kNew}) {
    EXPECT_THAT(bound(container, sofa, "1 0 0 2 0 0'", "0.25 5 7"), ElementsAre("/A/C/P 1 [1.25 0 0] [1.25 0 0]"));
    EXPECT_THAT(bound(mesh, sofa, "1 0 0 2 0 0'", "0.25 5 7"), ElementsAre("/A/C/P 1 [0 0 0] [0 0 0]"));
  }
  // Newer SOFA takes triangles for flat that are smaller than about a ten-thousandth.
  const std::string tiny = "0.0001 0 0 0 0.0001 0'", point = "0.00005 0.00002 0";
  const std::string kept = "/A/C/P 1 [5e-05 2e-05 0] [5e-05 2e-05 0]";
  EXPECT_THAT(bound(container, kOld, tiny, point), ElementsAre(kept));
  EXPECT_THAT(bound(mesh, kOld, tiny, point), ElementsAre(kept));
  EXPECT_THAT(bound(container, kNew, tiny, point), ElementsAre("/A/C/P 1 [5e-13 2e-13 0] [5e-13 2e-13 0]"));
  EXPECT_THAT(bound(mesh, kNew, tiny, point), ElementsAre("/A/C/P 1 [0 0 0] [0 0 0]"));
}

TEST_F(SofaSurprises, TetrahedraThatLackAnEdgeOfTheirsGetAllOfThem) {
  const auto lines = [&](const std::string& edges, const std::string& tetrahedra) {
    return models("<Node name='A'><TetrahedronSetTopologyContainer position='0 0 0 1 0 0 0 1 0 0 0 1' edges='" + edges +
                  "' " + tetrahedra + "/><MechanicalObject/><LineCollisionModel name='L'/></Node>");
  };
  const std::string tetrahedra = "tetrahedra='0 1 2 3'";
  EXPECT_THAT(lines("0 1", tetrahedra), ElementsAre("/A/L 7 [0 0 0] [1 1 1]"));
  EXPECT_THAT(lines("0 1 0 2 0 3 1 2 1 3 3 2", tetrahedra), ElementsAre("/A/L 6 [0 0 0] [1 1 1]"));
  EXPECT_THAT(lines("0 1", ""), ElementsAre("/A/L 1 [0 0 0] [1 0 0]"));
}

TEST_F(SofaSurprises, StatesThatAreReadFromAFileAreNamed) {
  const SofaAnswer read = partsOfAnswer(ball("A", "0 0 0", "<ReadState filename='a.state'/>"));
  EXPECT_THAT(read.models, ElementsAre("/A/S 1 [-0.5 -0.5 -0.5] [0.5 0.5 0.5]"));
  EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("SOFA may move points by it before it detects anything")));
}

TEST_F(SofaSurprises, TheScaleOfALoaderOfSpheresIsAlsoThatOfTheStateThatTakesItsData) {
  m_folder.write("one.sph", "sph 1.0\nnums 1\nsphe 0 1 0 0 0.5\n");
  const auto spheres = [&](const std::string& scale, const std::string& from, scene::SofaVersion sofa) {
    return models("<Node name='A'><SphereLoader name='l' filename='one.sph' " + scale + "='3 3 3'/><MechanicalObject " +
                      from + "/><SphereCollisionModel name='S' radius='0.5'/></Node>",
                  sofa);
  };
  const auto at = [](const std::string& low, const std::string& high) {
    return ElementsAre("/A/S 1 [" + low + " -0.5 -0.5] [" + high + " 0.5 0.5]");
  };
  EXPECT_THAT(spheres("scale3d", "position='@l.position'", kNew), at("2.5", "3.5"));
  EXPECT_THAT(spheres("scale3d", "position='@l.position'", kOld), at("0.5", "1.5"));
  EXPECT_THAT(spheres("scale", "src='@l'", kNew), at("8.5", "9.5"));
  EXPECT_THAT(spheres("scale", "src='@l'", kOld), at("2.5", "3.5"));
  EXPECT_THAT(spheres("scale3d", "src='@l'", kOld), at("0.5", "1.5"));
}

TEST_F(SofaSurprises, TheDiscreteMethodHasNoAlarmDistance) {
  m_method = "<DiscreteIntersection name='d' alarmDistance='5'/>";
  const SofaAnswer apart = partsOfAnswer(ball("A", "0 0 0") + ball("B", "4 0 0"));
  EXPECT_THAT(apart.models,
              ElementsAre("/A/S 1 [-0.5 -0.5 -0.5] [0.5 0.5 0.5]", "/B/S 1 [3.5 -0.5 -0.5] [4.5 0.5 0.5]"));
  EXPECT_THAT(apart.pairs, IsEmpty());
  EXPECT_THAT(apart.warnings, ElementsAre(HasSubstr("d: its alarmDistance is not read, as in SOFA")));
}

TEST_F(SofaSurprises, RangesMayGoDownAndHaveSteps) {
  const auto chosen = [&](const std::string& indices) {
    return models("<Node name='A'><MechanicalObject position='0 0 0 1 0 0 2 0 0 3 0 0'/>" +
                  ball("C", "9 9 9", "<SubsetMapping indices='" + indices + "'/>") + "</Node>");
  };
  EXPECT_THAT(chosen("3-1"), ElementsAre("/A/C/S 3 [0.5 -0.5 -0.5] [3.5 0.5 0.5]"));
  EXPECT_THAT(chosen("0-3-2"), ElementsAre("/A/C/S 2 [-0.5 -0.5 -0.5] [2.5 0.5 0.5]"));
  EXPECT_THAT(chosen("3-0-2"), ElementsAre("/A/C/S 2 [-0.5 -0.5 -0.5] [2.5 0.5 0.5]")) << "from its end";
  EXPECT_THAT(chosen("3-1--2"), ElementsAre("/A/C/S 2 [0.5 -0.5 -0.5] [3.5 0.5 0.5]"));
  EXPECT_THAT(chosen("1-1"), ElementsAre("/A/C/S 1 [0.5 -0.5 -0.5] [1.5 0.5 0.5]"));
  EXPECT_THAT(
      complaint("<MechanicalObject position='0 0 0'/>" + ball("C", "0 0 0", "<SubsetMapping indices='3-0--2'/>")),
      HasSubstr("'3-0--2' is neither an index nor a range"));
}

TEST_F(SofaSurprises, GroupsAreRangesOrTheIntegersThatWordsStartWith) {
  const auto pairs = [&](const std::string& group, const std::string& other) {
    const auto inGroup = [](const std::string& node, const std::string& numbers) {
      return "<Node name='" + node + "'><MechanicalObject position='0 0 0'/><SphereCollisionModel name='S' group='" +
             numbers + "'/></Node>";
    };
    return partsOfAnswer(inGroup("A", group) + inGroup("B", other));
  };
  for (const char* other : {"1", "2", "3"}) EXPECT_THAT(pairs("3-1", other).pairs, IsEmpty()) << other;
  EXPECT_THAT(pairs("3-1", "4").pairs, ElementsAre("/B/S - /A/S"));
  EXPECT_THAT(pairs("0-4-2", "3").pairs, ElementsAre("/B/S - /A/S"));
  EXPECT_THAT(pairs("0-4-2", "4").pairs, IsEmpty());
  for (const char* word : {"1,2", "1.9", "1e1"}) {
    EXPECT_THAT(pairs(word, "1").pairs, IsEmpty()) << word;
    const SofaAnswer outside = pairs(word, "2");
    EXPECT_THAT(outside.pairs, ElementsAre("/B/S - /A/S")) << word;
    EXPECT_THAT(outside.warnings, ElementsAre(HasSubstr("only the integer that it starts with is read, as in SOFA")));
  }
  for (const char* group : {"0-3-0.5", "0-3.7"}) {
    EXPECT_THAT(pairs(group, "2").pairs, IsEmpty());
    const SofaAnswer outside = pairs(group, "4");
    EXPECT_THAT(outside.pairs, ElementsAre("/B/S - /A/S"));
    EXPECT_THAT(outside.warnings, ElementsAre("/A/S: group: of '" + std::string(group) +
                                              "' only the integers that its numbers start with are read, as in SOFA"));
  }
}

TEST_F(SofaSurprises, MappingsThatSofaDoesNotHaveMoveNothing) {
  const std::string points = "<MechanicalObject name='p' position='5 0 0'/>";
  const std::string frames = "<MechanicalObject name='p' template='Rigid3' position='5 0 0 0 0 0 1'/>";
  const std::string point = "<MechanicalObject name='o' position='0 0 0'/>";
  const std::string frame = "<MechanicalObject name='o' template='Rigid3' position='0 0 0 0 0 0 1'/>";
  const auto mapped = [&](const std::string& from, const std::string& to, const std::string& mapping) {
    return partsOfAnswer("<Node name='A'>" + from + "<Node name='C'>" + to + "<" + mapping +
                         "/><SphereCollisionModel name='S' radius='0.5'/></Node></Node>");
  };
  const auto stays = ElementsAre("/A/C/S 1 [-0.5 -0.5 -0.5] [0.5 0.5 0.5]");
  const auto moves = ElementsAre("/A/C/S 1 [4.5 -0.5 -0.5] [5.5 0.5 0.5]");
  const std::string multi = " input='@../p' output='@o'";
  for (const std::string& mapping : {std::string("IdentityMapping"), std::string("SubsetMapping indices='0'"),
                                     "IdentityMultiMapping" + multi, "SubsetMultiMapping indexPairs='0 0'" + multi}) {
    const bool dropsTurns = mapping == "IdentityMapping" || mapping.starts_with("SubsetMulti");
    const SofaAnswer toFrames = mapped(points, frame, mapping), toPoints = mapped(frames, point, mapping);
    EXPECT_THAT(toFrames.models, stays) << mapping;
    EXPECT_THAT(toFrames.warnings, ElementsAre(HasSubstr("SOFA has no such mapping from points to frames")));
    EXPECT_THAT(mapped(points, point, mapping).models, moves) << mapping;
    EXPECT_THAT(mapped(frames, frame, mapping).models, moves) << mapping;
    if (dropsTurns) {
      EXPECT_THAT(toPoints.models, moves) << mapping;
      EXPECT_THAT(toPoints.warnings, IsEmpty());
    } else {
      EXPECT_THAT(toPoints.models, stays) << mapping;
      EXPECT_THAT(toPoints.warnings, ElementsAre(HasSubstr("SOFA has no such mapping from frames to points")));
    }
  }
}

TEST_F(SofaSurprises, NamesAreReadAsSofaSpellsThem) {
  const auto model = [&](const std::string& name, const std::string& attributes) {
    return models("<Node name='A'><MechanicalObject template='Rigid3' position='0 0 0 0 0 0 1'/><" + name +
                  " name='M' " + attributes + "/></Node>");
  };
  const auto along = [](const std::string& y) {
    return ElementsAre("/A/M 1 [-0.5 -" + y + " -0.5] [0.5 " + y + " 0.5]");
  };
  EXPECT_THAT(model("CapsuleCollisionModel", "dafaultHeight='10'"), along("5.5"));
  EXPECT_THAT(model("CapsuleCollisionModel", "defaultHeight='10'"), along("1.5"));
  EXPECT_THAT(model("CylinderCollisionModel", "defaultHeight='10'"), along("5.5"));
  EXPECT_THAT(model("CylinderCollisionModel", "dafaultHeight='10' localAxes='1 0 0'"), along("1.5"));
  EXPECT_THAT(model("SphereCollisionModel", "defaultRadius='10'"), ElementsAre("/A/M 1 [-1 -1 -1] [1 1 1]"));
}

TEST_F(SofaSurprises, NewerRigidMappingsDoNotReadRepartition) {
  const auto carried = [&](const std::string& name, scene::SofaVersion sofa) {
    return partsOfAnswer(
        "<Node name='A'><MechanicalObject template='Rigid3' position='5 0 0 0 0 0 1 50 0 0 0 0 0 1'/>" +
            ball("C", "0 0 0 1 0 0", "<RigidMapping " + name + "='1 1'/>") + "</Node>",
        sofa);
  };
  const auto byOne = ElementsAre("/A/C/S 2 [4.5 -0.5 -0.5] [6.5 0.5 0.5]");
  const auto byBoth = ElementsAre("/A/C/S 2 [4.5 -0.5 -0.5] [51.5 0.5 0.5]");
  EXPECT_THAT(carried("repartition", kOld).models, byBoth);
  EXPECT_THAT(carried("d_repartition", kOld).models, byOne);
  EXPECT_THAT(carried("d_repartition", kNew).models, byBoth);
  const SofaAnswer unread = carried("repartition", kNew);
  EXPECT_THAT(unread.models, byOne);
  EXPECT_THAT(unread.warnings, ElementsAre(HasSubstr("its repartition is not read, as in SOFA since 25.06")));
}

TEST_F(SofaSurprises, MappingsReadInputAndOutputAlone) {
  EXPECT_THAT(models("<Node name='A'><MechanicalObject name='r' template='Rigid3' position='5 0 0 0 0 0 1'/>"
                     "<Node name='N'><MechanicalObject template='Rigid3' position='50 0 0 0 0 0 1'/>" +
                     ball("C", "0 0 0", "<RigidMapping object1='@../../r' object2='@nobody'/>") + "</Node></Node>"),
              ElementsAre("/A/N/C/S 1 [49.5 -0.5 -0.5] [50.5 0.5 0.5]"));
}

TEST_F(SofaSurprises, TopologiesReadTwoKindsOfFiles) {
  m_folder.write("t.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  m_folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto triangles = [&](const std::string& file) {
    return partsOfAnswer("<Node name='A'><MeshTopology name='m' filename='" + file +
                         "'/><MechanicalObject/><PointCollisionModel name='P'/></Node>");
  };
  EXPECT_THAT(triangles("t.obj").models, ElementsAre("/A/P 3 [0 0 0] [1 1 0]"));
  const SofaAnswer unread = triangles("t.off");
  EXPECT_THAT(unread.models, ElementsAre("/A/P 1 [0 0 0] [0 0 0]"));
  EXPECT_THAT(unread.warnings, ElementsAre(HasSubstr("/A/m: a topology reads files .obj and .msh alone")));
}

TEST_F(SofaSurprises, LinksWithoutADataAreNotRead) {
  const SofaAnswer unread = partsOfAnswer(
      "<Node name='A'><MeshTopology name='t' position='3 0 0 4 0 0'/><Node name='C'>"
      "<MechanicalObject position='@../t'/><SphereCollisionModel name='S'/></Node></Node>");
  EXPECT_THAT(unread.models, ElementsAre("/A/C/S 1 [-1 -1 -1] [1 1 1]"));
  EXPECT_THAT(unread.warnings,
              ElementsAre(HasSubstr("position=\"@../t\" links to a component and names no data of it")));
}

TEST_F(SofaSurprises, ASizeBesideTheLinkToATopologysPointsIsNamed) {
  const SofaAnswer sized = partsOfAnswer(
      "<Node name='A'><MeshTopology name='t' position='0 0 0 1 0 0 2 0 0'/>"
      "<MechanicalObject position='@t.position' size='2'/><PointCollisionModel name='P'/></Node>");
  EXPECT_THAT(sized.models, ElementsAre("/A/P 3 [0 0 0] [2 0 0]"));
  EXPECT_THAT(sized.warnings, ElementsAre(HasSubstr("a link to 3 points; SOFA may make them 2")));
}

TEST_F(SofaSurprises, SkinsOnBonesThatRestElsewhereAreRefused) {
  const auto skin = [](const std::string& restScale) {
    return "<Node name='A'><MechanicalObject template='Rigid3' position='10 0 0 0 0 0 1' restScale='" + restScale +
           "'/>" + ball("C", "6 0 0", "<SkinningMapping nbRef='1'/>") + "</Node>";
  };
  EXPECT_THAT(complaint(skin("0.5")), HasSubstr("its bones are not where they rest"));
  EXPECT_THAT(models(skin("1")), ElementsAre("/A/C/S 1 [5.5 -0.5 -0.5] [6.5 0.5 0.5]"));
}

TEST_F(SofaSurprises, SubsetsWithoutABoxHaveTheUnitCube) {
  EXPECT_THAT(models("<Node name='A'><SubsetTopology name='e' rest_position='0.5 0.5 0.5 5 5 5'/>"
                     "<MechanicalObject position='@e.pointsInROI'/><PointCollisionModel name='P'/></Node>"),
              ElementsAre("/A/P 1 [0.5 0.5 0.5] [0.5 0.5 0.5]"));
}

}  // namespace
}  // namespace allpairs::test
