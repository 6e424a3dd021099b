// SPDX-License-Identifier: MIT
#include "SofaAnswer.h"

namespace allpairs::test {
namespace {

using scene::SofaVersion;

/// Mappings between topologies that SOFA makes, but refuses to carry out.
class SofaRefusals : public SofaAnswers {
 protected:
  /// A cube of one cell, and below it a topology that a mapping fills.
  [[nodiscard]] static std::string scene(const std::string& cube, const std::string& below) {
    return "<Node name='A'><" + cube + " name='g' position='0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1' " +
           (cube == "QuadSetTopologyContainer" ? "quads='0 1 2 3'" : "hexahedra='0 1 2 3 4 5 6 7'") +
           "/><MechanicalObject/><Node name='Q'>" + below +
           "<MechanicalObject/><IdentityMapping/><TriangleCollisionModel name='t'/></Node></Node>";
  }
  [[nodiscard]] static std::string topology(const std::string& kind, const std::string& mapping) {
    return "<" + kind + " name='q'/><" + mapping + "TopologicalMapping name='map' input='@../g' output='@q'/>";
  }
};

constexpr const char* kHexa = "HexahedronSetTopologyContainer";
const std::string kEmpty = "/A/Q/t 0\n/A/Q/map: SOFA refuses it, and it is left out: ";
const std::string kNoElements = "/A/Q/t: it has no elements, and is in no pair\n";

TEST_F(SofaRefusals, MappingsOfTopologiesNeedAModifierOfTheirOutput) {
  const auto quads = topology("QuadSetTopologyContainer", "Hexa2Quad");
  for (const SofaVersion sofa : kBoth) {
    EXPECT_EQ(answer(scene(kHexa, quads), sofa),
              kEmpty + "there is no QuadSetTopologyModifier in the node of its output or above\n" + kNoElements);
    for (const std::string modifier : {"QuadSetTopologyModifier", "HexahedronSetTopologyModifier"})
      EXPECT_EQ(answer(scene(kHexa, "<" + modifier + "/>" + quads), sofa), "/A/Q/t 12 [0 0 0] [1 1 1]\n");
    EXPECT_EQ(answer("<QuadSetTopologyModifier/>" + scene(kHexa, quads), sofa), "/A/Q/t 12 [0 0 0] [1 1 1]\n");
    EXPECT_EQ(
        answer(scene("QuadSetTopologyContainer", topology("TriangleSetTopologyContainer", "Quad2Triangle")), sofa),
        kEmpty + "there is no TriangleSetTopologyModifier in the node of its output or above\n" + kNoElements);
  }
}

TEST_F(SofaRefusals, TetrahedraNeedAModifierInOlderSofaOnly) {
  const auto tetrahedra = topology("TetrahedronSetTopologyContainer", "Hexa2Tetra");
  EXPECT_EQ(answer(scene(kHexa, tetrahedra), SofaVersion::Sofa2612), "/A/Q/t 18 [0 0 0] [1 1 1]\n");
  EXPECT_EQ(answer(scene(kHexa, tetrahedra), SofaVersion::Sofa2006),
            kEmpty + "there is no TetrahedronSetTopologyModifier in the node of its output or above\n" + kNoElements);
  EXPECT_EQ(answer(scene(kHexa, "<TetrahedronSetTopologyModifier/>" + tetrahedra), SofaVersion::Sofa2006),
            "/A/Q/t 18 [0 0 0] [1 1 1]\n");
}

TEST_F(SofaRefusals, TheInputIsOfTheElementsThatAreMapped) {
  const auto triangles = "<TriangleSetTopologyModifier/>" + topology("TriangleSetTopologyContainer", "Quad2Triangle");
  for (const std::string cube : {kHexa, "MeshTopology"})
    EXPECT_EQ(answer(scene(cube, triangles), SofaVersion::Sofa2612),
              kEmpty + "its input is no topology of quads\n" + kNoElements);
  EXPECT_EQ(answer(scene(kHexa, triangles), SofaVersion::Sofa2006), "/A/Q/t 12 [0 0 0] [1 1 1]\n");
  for (const SofaVersion sofa : kBoth)
    EXPECT_EQ(answer(scene("QuadSetTopologyContainer", triangles), sofa), "/A/Q/t 2 [0 0 0] [1 1 0]\n");
}

TEST_F(SofaRefusals, TheOutputIsAContainerOfTheElementsThatAreMade) {
  const auto quads = [](const std::string& kind) {
    return "<HexahedronSetTopologyModifier/>" + topology(kind, "Hexa2Quad");
  };
  for (const SofaVersion sofa : kBoth)
    EXPECT_EQ(answer(scene(kHexa, quads("MeshTopology")), sofa),
              kEmpty + "its output is no topology of quads\n" + kNoElements);
  EXPECT_EQ(answer(scene(kHexa, quads(kHexa)), SofaVersion::Sofa2612),
            kEmpty + "its output is no topology of quads\n" + kNoElements);
  EXPECT_EQ(answer(scene(kHexa, quads(kHexa)), SofaVersion::Sofa2006), "/A/Q/t 12 [0 0 0] [1 1 1]\n");
}

TEST_F(SofaRefusals, TheQuadsOfAMappingHaveNoPoints) {
  for (const SofaVersion sofa : kBoth)
    EXPECT_EQ(
        answer("<Node name='A'><RegularGridTopology name='g' n='2 2 2' min='4 4 4' max='5 5 5'/><MechanicalObject/>"
               "<Node name='Q'><QuadSetTopologyContainer name='q'/><QuadSetTopologyModifier/>"
               "<Hexa2QuadTopologicalMapping input='@../g' output='@q'/><MechanicalObject/>"
               "<PointCollisionModel name='p'/></Node></Node>",
               sofa),
        "/A/Q/p 1 [0 0 0] [0 0 0]\n");
}

}  // namespace
}  // namespace allpairs::test
