// SPDX-License-Identifier: MIT
#include "allpairs/scene/FileError.h"
#include "scene/sofa/SceneText.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/graph/Links.h"
#include "sofa/graph/SceneXml.h"
#include "support/Sanitizers.h"

namespace allpairs::scene::sofa {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using SofaHostile = SceneTest;

constexpr auto kSmall = R"(<?xml version="1.0"?>
<!-- a scene -->
<Node name="root">
  <CollisionPipeline/><MinProximityIntersection alarmDistance="0.5"/>
  <RegularGridTopology n="2 2 2"/>
  <MechanicalObject template="Vec3d" dx="1"/>
  <Node name="A"><MechanicalObject position="0 0 0 1 1 1"/>
    <BarycentricMapping/><PointModel group="1 2" proximity="0.1"/></Node>
</Node>
)";

TEST_F(SofaHostile, ASceneCutAtEveryByteIsAnErrorThatNamesIt) {
  const std::string text = kSmall;
  EXPECT_EQ(complaint(text), "");
  const auto end = text.rfind("</Node>") + 7;
  for (std::size_t size = 0; size < end; ++size)
    EXPECT_THAT(complaint(text.substr(0, size)), HasSubstr("scene.scn")) << "cut at " << size;
}

TEST_F(SofaHostile, ASceneWithAnyByteChangedIsReadOrNamedButNeverCrashes) {
  const std::string text = kSmall;
  int change = 0;
  for (std::size_t i = 0; i < text.size(); ++i)
    for (const char byte : {'<', '"', '@', '9', '-', '\0', '\xff'}) {
      if (test::kIsSanitized && ++change % 4 != 0) continue;  // one or two of them in each place
      auto changed = text;
      changed[i] = byte;
      (void)complaint(changed);
    }
}

TEST_F(SofaHostile, WhatIsNotWellFormedIsNamedWithLineAndColumn) {
  EXPECT_THAT(complaint("<Node>\n <Node name=x/></Node>"), AllOf(HasSubstr("scene.scn:2:"), HasSubstr("well-formed")));
  EXPECT_THAT(complaint("<Node><Node></Node>"), HasSubstr("well-formed"));
  EXPECT_THAT(complaint("<Node></Other>"), HasSubstr("well-formed"));
  EXPECT_THAT(complaint(""), HasSubstr("scene.scn"));
  EXPECT_THAT(complaint("<!-- nothing -->"), HasSubstr("scene.scn"));
  EXPECT_THAT(complaint("<PointModel/>"), HasSubstr("must be a Node"));
}

TEST_F(SofaHostile, MissingScenesAndFoldersAreNamed) {
  const auto said = [](const std::filesystem::path& path) -> std::string {
    try {
      (void)describeScene(path, {});
    } catch (const FileError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(said(m_folder.path() / "gone.scn"), HasSubstr("gone.scn: no such file or folder"));
  EXPECT_THAT(said(m_folder.path()), HasSubstr("is a folder, not a file"));
}

TEST_F(SofaHostile, NodesNestedWithoutEndAreAnErrorAndNoCrash) {
  std::string open, close;
  for (int i = 0; i < 100'000; ++i) open += "<Node>", close += "</Node>";
  EXPECT_THAT(complaint(open + close), HasSubstr("nested too deep"));
}

TEST_F(SofaHostile, PathsThatLeadOutOfTheSceneLeadNowhere) {
  for (const auto link : {"@../../../x.position", "@", "@.", "@..", "@/", "@//.", "@[", "@[-9].position",
                          "@[9].position", "@[-0].position", "@a/b/c/d.e", "@m/x.position", "@.position"})
    EXPECT_NE(complaintIn("<MechanicalObject name='m' position='" + std::string{link} + "'/><PointModel/>"), "")
        << link;
}

TEST_F(SofaHostile, HugeNumbersAreNamed) {
  for (const auto text :
       {"<MechanicalObject size='1e30'/><PointModel/>", "<MechanicalObject/><SphereModel group='10000000000'/>",
        "<RegularGrid n='1000000000 1 1'/><MechanicalObject/><PointModel/>",
        "<RegularGrid nx='1e18' ny='1e18' nz='1e18'/><MechanicalObject/><PointModel/>",
        "<MechanicalObject position='0 0 0'/><MeshTopology edges='0 4000000000'/><LineModel/>",
        "<MechanicalObject/><Node><MechanicalObject/><SubsetMapping indices='0-99999999999'/><PointModel/></Node>"})
    EXPECT_THAT(complaintIn(text), HasSubstr("scene.scn:2")) << text;
}

TEST_F(SofaHostile, SidesOfACubeWithoutPointsCountAsMuchAsOthers) {
  EXPECT_THAT(complaintIn("<CubeTopology nx='6000' ny='6000' nz='0'/><MechanicalObject/><PointModel/>"),
              HasSubstr("with 36000000 points it takes more than"));
}

std::string grid(const std::string& name, const std::string& n) {
  return "<RegularGridTopology name='" + name + "' n='" + n + "' min='10 10 10' max='11 11 11'/>";
}

std::string repeatedTriangle(int times) {
  std::string corners;
  for (int i = 0; i < times; ++i) corners += "0 1 2 ";
  return corners;
}

/// Components that compare all of one list with all of another: points with regions or beams, triangles with cells or
/// lines.
std::vector<std::string> comparisons(const std::string& n, const std::string& beams, int triangles) {
  const std::string points = "<MechanicalObject position='@g.position'/><PointModel/>";
  const std::string surface = "='0 0 0 1 1 0 0.5 0.5 1' ";
  const std::string corners = "='" + repeatedTriangle(triangles) + "'/>";
  return {grid("g", n) +
              "<BoxROI name='r' box='@g.position' position='@g.position'/>"
              "<MechanicalObject position='@r.pointsInROI'/><PointModel/>",
          grid("g", n) +
              "<SubsetTopology name='r' box='@g.position' rest_position='@g.position'/>"
              "<MechanicalObject position='@r.pointsInROI'/><PointModel/>",
          grid("h", beams) + "<MechanicalObject template='Rigid' position='@h.position'/><Node>" + grid("g", n) +
              "<MechanicalObject position='@g.position'/><BeamLinearMapping localCoord='0'/><PointModel/></Node>",
          "<SparseGridTopology n='30 30 30' position" + surface + "triangles" + corners +
              "<MechanicalObject/><PointModel/>"};
}

TEST_F(SofaHostile, MoreComparisonsThanTheFilesAreWorthAreRefused) {
  for (const auto& text : comparisons("50 50 50", "200000 1 1", 30'000))
    EXPECT_THAT(complaintIn(text), HasSubstr("comparing so many points, elements or components takes too long"))
        << text.substr(0, 200);
}

TEST_F(SofaHostile, AStopEndsLongComparisons) {
  auto texts = comparisons("14 14 14", "2 1 1", 200);
  texts.push_back(
      "<MeshTetraStuffing name='s' size='-25' inputPoints='0 0 0 1 1 0 0.5 0.5 1' inputTriangles='0 1 2'/>"
      "<MechanicalObject position='@s.outputPoints'/><PointModel/>");
  for (const auto& text : texts) {
    int asked = 0;
    const auto isTime = [&asked] { return ++asked > (test::kIsSanitized ? 1000 : 2000); };
    const StopFlag stop(isTime);
    ReadOptions options;
    options.stop = &stop;
    const auto file = m_folder.write("scene.scn", "<Node>" + text + "</Node>");
    EXPECT_THROW((void)describeScene(file, options), Stopped) << text.substr(0, 200);
  }
}

TEST_F(SofaHostile, StatesOfOneNodeAreNotComparedWithItsComponents) {
  constexpr int kStates = 8000;
  std::string text;
  for (int i = 0; i < kStates; ++i) text += "<MechanicalObject/>";
  const auto file = m_folder.write("scene.scn", "<Node>" + text + "<FixedRotationConstraint/></Node>");
  ReadScope reading(file, {});
  const auto root = readSceneGraph(file, reading);
  indexNames(*root);
  ReadOptions options;
  options.maxMemory = 200 * kStates;  // allows less than kStates squared comparisons
  ReadScope scope(file, options);
  Evaluation evaluation(*root, scope, Generation::Sofa26);
  for (const auto* state : root->states) (void)evaluation.state(*state);
  EXPECT_EQ(evaluation.warnings().size(), 1U);
}

TEST_F(SofaHostile, ModelsBeforeTheirStateAreNotComparedWithTheComponentsOfTheNode) {
  constexpr int kModels = 40'000;
  std::string models;
  for (int i = 0; i < kModels; ++i) models += "<PointModel/>";
  const auto file = m_folder.write("scene.scn", "<Node><Node><MechanicalObject/><PointModel/></Node><Node>" + models +
                                                    "<MechanicalObject/></Node></Node>");
  ReadOptions options;
  options.maxMemory = 1100 * kModels;  // allows less than kModels squared comparisons
  const auto scene = describeScene(file, options);
  EXPECT_EQ(scene.models.size(), 1U);
  EXPECT_EQ(scene.warnings.size(), 1U + kModels);
}

TEST_F(SofaHostile, EachElementOfAModelCounts) {
  const auto leastMemoryFor = [&](int triangles) {
    std::string points;
    for (int i = 0; i < 1000; ++i) points += "0 0 0 ";
    const auto file =
        m_folder.write("scene.scn", "<Node><MechanicalObject position='" + points + "'/><MeshTopology triangles='" +
                                        repeatedTriangle(triangles) + "'/><TriangleModel/></Node>");
    const auto isEnough = [&](std::uint64_t memory) {
      ReadOptions options;
      options.maxMemory = memory;
      try {
        (void)describeScene(file, options);
      } catch (const FileError&) {
        return false;
      }
      return true;
    };
    std::uint64_t little = 0, enough = std::uint64_t{16} << 20;
    while (enough - little > 100) (isEnough((little + enough) / 2) ? enough : little) = (little + enough) / 2;
    return enough;
  };
  EXPECT_LT(leastMemoryFor(2000), leastMemoryFor(1999) + 10'000);
}

/// Each would take twice as long as the one before it, and more, if what it gives were not remembered.
TEST_F(SofaHostile, ChainsOfLinksTakeNoLongerThanTheyAre) {
  std::string states = "<MechanicalObject name='m0' position='0 0 0 1 1 1' translation='1 0 0'/>";
  std::string merges = "<MergePoints name='m0' position1='' position2=''/>";
  for (int i = 1; i < 40; ++i) {
    const auto last = std::to_string(i - 1);
    states += "<MechanicalObject name='m" + std::to_string(i) + "' src='@m" + last + "'/>";
    merges += "<MergePoints name='m" + std::to_string(i) + "' position1='@m" + last + ".points' position2='@m" + last +
              ".points'/>";
  }
  EXPECT_EQ(complaintIn(states + "<PointModel/>"), "");
  EXPECT_EQ(complaintIn(merges + "<MechanicalObject position='@m39.points'/><PointModel/>"), "");
}

}  // namespace
}  // namespace allpairs::scene::sofa
