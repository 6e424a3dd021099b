// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "SceneText.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadSofaScene.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// Where SOFA places models by attributes and defaults that few scenes use.
class SofaRareAttributes : public testing::Test {
 protected:
  /// The number of elements of the last model of a scene, and its box.
  struct Last {
    std::size_t elements;
    Box box;
    std::vector<std::string> warnings;
  };

  [[nodiscard]] Last last(const std::string& body, const std::string& broadPhase = "BruteForceBroadPhase") const {
    const std::string narrowPhase = broadPhase == "BruteForceBroadPhase" ? "<BVHNarrowPhase/>" : "";
    const auto path =
        m_folder.write("scene.scn", "<Node name='root'><CollisionPipeline/><" + broadPhase + "/>" + narrowPhase +
                                        "<CollisionResponse/><DiscreteIntersection/>" + body + "</Node>");
    const scene::Scene scene = scene::readSofaScene(path, {});
    auto& model = *scene.models.back();
    const auto elements = static_cast<std::size_t>(model.getSize());
    std::vector<std::string> warnings;
    for (const scene::Remark& remark : scene.warnings) warnings.push_back(remark.subject + ": " + remark.reason);
    return {elements, elements != 0 ? boxOf(model) : Box{}, std::move(warnings)};
  }

  TempFolder m_folder;
};

constexpr const char* kTriangles = "position='0 0 0 1 0 0 0 1 0 5 5 5 6 5 5 5 6 5' triangles='0 1 2 3 4 5'";
constexpr const char* kPoints = "position='0 0 0 1 0 0 0 1 0 5 5 5 6 5 5 5 6 5'";

TEST_F(SofaRareAttributes, AModelMayNameItsTopology) {
  const std::string points = kPoints, triangles = kTriangles;
  const std::string topologies = "<Node name='A'><MeshTopology name='one' " + points +
                                 " triangles='0 1 2' edges='0 1'/><MeshTopology " + triangles + "/><MechanicalObject " +
                                 points + "/>";
  EXPECT_EQ(last(topologies + "<TriangleCollisionModel topology='@one'/></Node>").box, (Box{{0, 0, 0}, {1, 1, 0}}));
  EXPECT_EQ(last(topologies + "<LineCollisionModel topology='@one'/></Node>").box, (Box{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(last(topologies + "<Node name='B'><MechanicalObject " + points +
                 "/><TriangleCollisionModel topology='@../one'/></Node></Node>")
                .elements,
            1U);
}

TEST_F(SofaRareAttributes, ContainersWithoutPointsDeriveEdgesAndFaces) {
  const std::string state = "<MechanicalObject position='0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1'/>";
  for (const char* broadPhase : {"BruteForceBroadPhase", "BruteForceDetection"}) {
    const auto count = [&](const std::string& text) {
      return last("<Node>" + state + text + "</Node>", broadPhase).elements;
    };
    EXPECT_EQ(count("<TriangleSetTopologyContainer triangles='0 1 2'/><LineCollisionModel/>"), 3U);
    EXPECT_EQ(count("<QuadSetTopologyContainer quads='0 1 2 3'/><LineCollisionModel/>"), 4U);
    EXPECT_EQ(count("<HexahedronSetTopologyContainer hexahedra='0 1 2 3 4 5 6 7'/><TriangleCollisionModel/>"), 12U);
  }
}

TEST_F(SofaRareAttributes, GmshLoadersMakeFacesAndEdgesUnlessTold) {
  m_folder.write(
      "a.msh",
      "$NOD\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 3\n$ENDNOD\n$ELM\n2\n1 1 1 1 2 1 2\n2 4 1 1 4 1 2 3 4\n$ENDELM\n");
  const auto scene = [](const std::string& flag, const std::string& topology, const std::string& model) {
    return "<Node><MeshGmshLoader name='l' filename='a.msh' " + flag + "/><" + topology +
           " src='@l'/><MechanicalObject src='@l'/><" + model + "/></Node>";
  };
  EXPECT_EQ(last(scene("", "TriangleSetTopologyContainer", "TriangleCollisionModel")).elements, 4U);
  EXPECT_EQ(last(scene("", "MeshTopology", "LineCollisionModel")).box, (Box{{0, 0, 0}, {1, 1, 3}}));
  EXPECT_EQ(last(scene("createSubelements='0'", "MeshTopology", "LineCollisionModel")).elements, 1U);
}

TEST_F(SofaRareAttributes, AnIdentityMatrixOfALoaderIsNone) {
  m_folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(last("<Node><MeshOBJLoader name='l' filename='t.obj' translation='10 0 0'"
                 " transformation='1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1'/><MeshTopology src='@l'/>"
                 "<MechanicalObject src='@l'/><TriangleCollisionModel/></Node>")
                .box,
            (Box{{10, 0, 0}, {11, 1, 0}}));
}

TEST_F(SofaRareAttributes, NewerLoadersOfSpheresTurnThemAndKeepTheirRadii) {
  m_folder.write("a.sph", "sph 1.0\nnums 1\nsphe 1 1 0 0 0.5\n");
  const std::string model =
      "<MechanicalObject position='@l.position'/><SphereModel listRadius='@l.listRadius'/></Node>";
  const std::string scaled = "<Node><SphereLoader name='l' filename='a.sph' scale='2 2 2'/>" + model;
  EXPECT_EQ(last(scaled).box, (Box{{1.5, -0.5, -0.5}, {2.5, 0.5, 0.5}}));
  EXPECT_EQ(last(scaled, "BruteForceDetection").box, (Box{{1, -1, -1}, {3, 1, 1}}));
  const Box turned = last("<Node><SphereLoader name='l' filename='a.sph' rotation='0 0 90'/>" + model).box;
  EXPECT_NEAR(turned.min[1], 0.5, 1e-12);
}

TEST_F(SofaRareAttributes, RigidMappingsMayCarryPointsAtRestOrGivenOnes) {
  const std::string frame = "<Node><MechanicalObject template='Rigid3' position='10 0 0 0 0 0 1'/><Node>";
  const std::string end = "<SphereModel radius='0.5'/></Node></Node>";
  EXPECT_EQ(
      last(frame + "<MechanicalObject position='1 0 0' rest_position='2 0 0'/><RigidMapping useX0='1'/>" + end).box,
      (Box{{11.5, -0.5, -0.5}, {12.5, 0.5, 0.5}}));
  EXPECT_EQ(
      last(frame + "<MechanicalObject position='1 0 0'/><RigidMapping globalToLocalCoords='1' initialPoints='1 0 0'/>" +
           end)
          .box,
      (Box{{10.5, -0.5, -0.5}, {11.5, 0.5, 0.5}}));
}

TEST_F(SofaRareAttributes, EnginesKeepFramesAndPutPointsInTheirPlaces) {
  EXPECT_EQ(last("<Node><TransformEngine name='e' template='Rigid3' translation='0 5 0'"
                 " input_position='0 0 0 0 0 0 1 1 0 0 0 0 0 1 2 0 0 0 0 0 1'/>"
                 "<MechanicalObject template='Rigid3' position='@e.output_position'/>"
                 "<SphereModel template='Rigid3' radius='0.5'/></Node>")
                .box,
            (Box{{-0.5, 4.5, -0.5}, {2.5, 5.5, 0.5}}));
  EXPECT_EQ(last("<Node><MergePoints name='e' position1='0 0 0 1 0 0' position2='0 7 0' mappingX2='1'/>"
                 "<MechanicalObject position='@e.points'/><SphereModel radius='0.5'/></Node>")
                .box,
            (Box{{-0.5, -0.5, -0.5}, {0.5, 7.5, 0.5}}));
}

TEST_F(SofaRareAttributes, ABarycentricMappingMayNameItsTopology) {
  EXPECT_EQ(
      last("<Node><MeshTopology name='t' position='0 0 0 1 0 0 0 1 0 9 9 9' triangles='0 1 2'/>"
           "<MeshTopology position='0 0 0 1 0 0 0 1 0 9 9 9' edges='0 3'/>"
           "<MechanicalObject position='0 0 0 1 0 0 0 1 0 9 9 9'/><Node><MechanicalObject position='0.25 0.25 0.5'/>"
           "<BarycentricMapping input_topology='@../t'/><SphereModel radius='0.5'/></Node></Node>")
          .box,
      (Box{{-0.25, -0.25, -0.5}, {0.75, 0.75, 0.5}}));
}

TEST_F(SofaRareAttributes, OfTwoNamesOfAValueTheLastOfTheAlphabetCounts) {
  EXPECT_EQ(last("<Node><MechanicalObject position='0 0 0'/><SphereModel radius='0.5' proximity='0.25'"
                 " contactDistance='0.125'/></Node>")
                .box,
            (Box{{-0.75, -0.75, -0.75}, {0.75, 0.75, 0.75}}));
  EXPECT_EQ(last("<Node><MeshTopology position='0 0 0 1 0 0 2 0 0' lines='0 1 1 2' edges='0 1'/><MechanicalObject/>"
                 "<LineModel/></Node>")
                .elements,
            2U);
}

TEST_F(SofaRareAttributes, FramesMayBeOfCuda) {
  EXPECT_EQ(last("<Node><MechanicalObject template='CudaRigid3f' position='0 0 0 0 0 0 1 5 0 0 0 0 0 1'/>"
                 "<SphereModel radius='0.5'/></Node>")
                .elements,
            2U);
}

TEST_F(SofaRareAttributes, ConstraintsThatMovePointsAtTheStartAreNamed) {
  const std::string body =
      "<Node name='A'><MechanicalObject position='0 0 0'/><OscillatorProjectiveConstraint "
      "name='o' oscillators='0 7 0 0 0 0 0 1 0'/><FixedProjectiveConstraint/>"
      "<SphereCollisionModel radius='0.5'/></Node>";
  EXPECT_THAT(last(body).warnings, testing::ElementsAre(testing::HasSubstr("A/o: SOFA may move points by it")));
}

TEST_F(SofaRareAttributes, ModelsWithoutElementsAreNamed) {
  const Last empty = last(
      "<Node name='A'><MeshTopology position='0 0 0 1 0 0' edges='0 1'/><MechanicalObject/>"
      "<TriangleCollisionModel name='t'/></Node>");
  EXPECT_EQ(empty.elements, 0U);
  EXPECT_THAT(empty.warnings, testing::ElementsAre("/A/t: it has no elements, and is in no pair"));
}

TEST_F(SofaRareAttributes, AFrameThatIsNotThereIsCountedFromTheEndWhereTheSceneDoes) {
  const std::string body =
      "<Node><MechanicalObject template='Rigid3' position='0 0 0 0 0 0 1'/><Node>"
      "<MechanicalObject position='0 0 0'/><RigidMapping index='5' indexFromEnd='1'/>"
      "<SphereModel/></Node></Node>";
  try {
    (void)last(body);
    FAIL() << "read";
  } catch (const FileError& problem) {
    EXPECT_THAT(problem.what(), testing::HasSubstr("no rigid frame number 5 from the end among the 1 of its input"));
  }
}

TEST_F(SofaRareAttributes, TopologiesAndFilesThatAreNotThereAreNamed) {
  const auto complaint = [this](const std::string& body) -> std::string {
    try {
      (void)last(body);
    } catch (const FileError& problem) {
      return problem.what();
    }
    return "read";
  };
  const std::string state = "<MeshTopology position='0 0 0 1 0 0 0 1 0' triangles='0 1 2'/><MechanicalObject/>";
  EXPECT_THAT(complaint("<Node>" + state + "<TriangleModel topology='@nowhere'/></Node>"),
              testing::HasSubstr("topology=\"@nowhere\" leads to no topology"));
  EXPECT_THAT(complaint("<Node>" + state +
                        "<Node><MechanicalObject position='0 0 0'/><BarycentricMapping "
                        "input_topology='@nowhere'/><SphereModel/></Node></Node>"),
              testing::HasSubstr("input_topology=\"@nowhere\" leads to no topology"));
  m_folder.write("a.trian", "0\n0\n");
  EXPECT_THAT(complaint("<Node><MeshTrianLoader name='l' filename='a.trian' trian2='1'/><MeshTopology src='@l'/>"
                        "<MechanicalObject src='@l'/><TriangleModel/></Node>"),
              testing::HasSubstr("trian2"));
}

TEST_F(SofaRareAttributes, PrismsAndPyramidsHavePoints) {
  const std::string state = "<MechanicalObject position='0 0 0 1 0 0 0 1 0 0 0 1 1 0 1 0 1 1'/><PointModel/></Node>";
  EXPECT_EQ(last("<Node><MeshTopology prisms='0 1 2 3 4 5'/>" + state).elements, 6U);
  EXPECT_EQ(last("<Node><MeshTopology pyramids='0 1 2 3 4'/>" + state).elements, 6U);
}

}  // namespace
}  // namespace allpairs::test
