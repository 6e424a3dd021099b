// SPDX-License-Identifier: MIT
#include "scene/sofa/SceneText.h"
#include "support/Sanitizers.h"

namespace allpairs::scene::sofa {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

using SofaGraph = SceneTest;

constexpr auto kPoint = "<MechanicalObject position='1 2 3'/>";

TEST_F(SofaGraph, ModelsComeInDocumentOrderAndThenChildrenDepthFirst) {
  const auto scene = readIn(R"(
    <MechanicalObject/>
    <Node name="A"><PointModel name="a"/><Node name="B"><PointModel name="b"/></Node></Node>
    <PointModel name="first"/>
    <Node name="C"><PointModel name="c"/></Node>)");
  EXPECT_THAT(pathsOf(scene), ElementsAre("/first", "/A/a", "/A/B/b", "/C/c"));
}

TEST_F(SofaGraph, OnlyTheNodeOfThePipelineAndWhatIsBelowItCounts) {
  const auto scene = readIn(R"(
    <Node name="Out"><MechanicalObject/><PointModel name="p"/></Node>
    <Node name="In"><CollisionPipeline/><MechanicalObject/><PointModel name="p"/></Node>)");
  EXPECT_THAT(pathsOf(scene), ElementsAre("/In/p"));
}

TEST_F(SofaGraph, InactiveNodesAreLeftOut) {
  const auto scene = readIn(R"(<MechanicalObject/>
    <Node name="A" activated="0"><PointModel/><Node><PointModel/></Node></Node>
    <Node name="B" activated="false"><PointModel/></Node>
    <Node name="C" activated="true"><PointModel name="p"/></Node>)");
  EXPECT_THAT(pathsOf(scene), ElementsAre("/C/p"));
  EXPECT_THAT(scene.warnings, SizeIs(1)) << "that there is no pipeline";
}

TEST_F(SofaGraph, ANodeThatIsNeitherActivatedNorNotIsActiveAndSaysSo) {
  const auto scene = readIn(R"(<MechanicalObject/>
    <Node name="A" activated="no"><PointModel name="p"/></Node>
    <Node name="B" activated="@/A.activated"><PointModel name="p"/></Node>
    <Node name="C" activated=""><PointModel name="p"/></Node>
    <Node name="D" activated="false"><Node name="E" activated="no"><PointModel name="p"/></Node></Node>)");
  EXPECT_THAT(pathsOf(scene), ElementsAre("/A/p", "/B/p", "/C/p"));
  ASSERT_THAT(scene.warnings, SizeIs(3)) << "one is that there is no pipeline";
  EXPECT_EQ(scene.warnings[1].subject, "/A");
  EXPECT_EQ(scene.warnings[1].line, 3U);
  EXPECT_EQ(scene.warnings[1].reason, "activated: 'no' is neither true nor false; the node is active, as in SOFA");
  EXPECT_EQ(scene.warnings[2].subject, "/B");
  EXPECT_EQ(scene.warnings[2].reason,
            "activated: '@/A.activated' is a link, which this reader does not follow; the node is taken as active");
}

TEST_F(SofaGraph, ModelsWithoutANameAreNumberedByClassThroughoutTheFile) {
  const auto scene = readIn(R"(<MechanicalObject/>
    <Node name="A"><PointModel/><SphereCollisionModel/></Node><Node name="B"><Point/><PointModel name="own"/><TPointModel/></Node>)");
  EXPECT_THAT(pathsOf(scene),
              ElementsAre("/A/tPointModel1", "/A/tSphereModel1", "/B/tPointModel2", "/B/own", "/B/tPointModel3"));
}

TEST_F(SofaGraph, ModelsOfOneNodeShareAnOwner) {
  const auto scene = readIn(R"(<MechanicalObject/>
    <Node name="A"><PointModel/><SphereModel/></Node><Node name="B"><PointModel/></Node>)");
  ASSERT_EQ(scene.models.size(), 3U);
  EXPECT_EQ(scene.models[0].owner, scene.models[1].owner);
  EXPECT_NE(scene.models[0].owner, scene.models[2].owner);
  EXPECT_THAT(scene.owners, ElementsAre("/A", "/B"));
}

TEST_F(SofaGraph, ComponentsMayBeWrittenAsObjectsWithAType) {
  const auto scene = readIn(std::string{"<Object type='MechanicalObject' position='1 2 3'/>"} +
                            "<Object type='PointModel' name='p'/>");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{1, 2, 3, 1, 2, 3}));
}

TEST_F(SofaGraph, AnElementWithATypeThatIsNoObjectIsNothing) {
  EXPECT_THAT(readIn(std::string{kPoint} + "<Foo type='PointModel'/>").models, IsEmpty());
}

TEST_F(SofaGraph, LinesOfModelsCountFromOne) {
  const auto scene = readIn(std::string{kPoint} + "\n\n<PointModel/>");
  ASSERT_EQ(scene.models.size(), 1U);
  EXPECT_EQ(scene.models[0].line, 4U);
  EXPECT_EQ(scene.models[0].file.filename(), "scene.scn");
}

// Links.

TEST_F(SofaGraph, LinksFollowPathsUpDownAndFromTheRoot) {
  for (const auto link : {"@../data.position", "@/Here/data.position", "@data.position",
                          "@/Here/There/../data.position", "@.././data.position"}) {
    const auto scene = readIn(
        "<Node name='Here'><MechanicalObject name='data' position='4 5 6'/><Node name='There'>"
        "<MechanicalObject name='state' position='" +
        std::string{link} + "'/><PointModel/></Node></Node>");
    EXPECT_THAT(onlyBox(scene), IsBox(Corners{4, 5, 6, 4, 5, 6})) << link;
  }
}

TEST_F(SofaGraph, NegativeNumbersLinkToComponentsBefore) {
  const auto scene =
      readIn(R"(<MechanicalObject name="a" position="1 1 1"/><MechanicalObject name="b" position="2 2 2"/>
    <UnknownThing/><MechanicalObject position="@[-3].position"/><PointModel/>)");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{1, 1, 1, 1, 1, 1}));
}

TEST_F(SofaGraph, LinksMayNameAnyAttributeThatIsWrittenOut) {
  const auto scene =
      readIn(R"(<Whatever name="w" points="1 0 0 5 0 0"/><MechanicalObject position="@w.points"/><PointModel/>)");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{1, 0, 0, 5, 0, 0}));
}

TEST_F(SofaGraph, ALinkToNothingIsNamedWithItsLine) {
  EXPECT_THAT(complaintIn("<MechanicalObject name='m' position='@nobody.position'/>\n<PointModel name='p'/>"),
              testing::AllOf(HasSubstr("scene.scn:2: MechanicalObject 'm' (/m)"), HasSubstr("@nobody.position"),
                             HasSubstr("PointModel 'p' (/p) depends on it")));
}

TEST_F(SofaGraph, LinksInACircleAreNamed) {
  const auto scene = readIn(
      "<MechanicalObject name='a' position='@b.position'/>"
      "<MechanicalObject name='b' position='@a.position'/><PointModel/>");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{}));
  EXPECT_THAT(scene.warnings.back().reason, HasSubstr("'b' (/b), which comes later in the file"));
  EXPECT_THAT(complaintIn("<MechanicalObject name='a' position='@a.position'/><PointModel/>"),
              HasSubstr("depends on itself"));
  EXPECT_THAT(
      complaintIn("<X name='x' p='@y.p'/><X name='y' p='@x.p'/><MechanicalObject position='@x.p'/><PointModel/>"),
      HasSubstr("needs the p of X 'x'"));
}

TEST_F(SofaGraph, AVeryLongChainOfLinksIsAnErrorAndNoCrash) {
  std::string text = "<X name='x0' p='1 2 3'/>";
  for (int i = 1; i < 20000; ++i)
    text += "<X name='x" + std::to_string(i) + "' p='@x" + std::to_string(i - 1) + ".p'/>";
  EXPECT_THAT(complaintIn(text + "<MechanicalObject position='@x19999.p'/><PointModel/>"), HasSubstr("too long"));
}

TEST_F(SofaGraph, SrcLinksWhatIsNotGiven) {
  const auto scene = readIn(R"(<MechanicalObject name="a" position="1 0 0 2 0 0"/><MechanicalObject name="b" src="@a"/>
    <PointModel/>)");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{1, 0, 0, 2, 0, 0}));
  const auto given = readIn(R"(<MechanicalObject name="a" position="1 0 0 2 0 0"/>
    <MechanicalObject name="b" src="@a" position="7 0 0 8 0 0"/><PointModel/>)");
  EXPECT_THAT(onlyBox(given), IsBox(Corners{7, 0, 0, 8, 0, 0}));
}

// Includes.

TEST_F(SofaGraph, IncludesPutTheirRootNodeWhereTheyStand) {
  write("part.xml", "<Node name='Part'><MechanicalObject position='1 2 3'/><PointModel name='p'/></Node>");
  EXPECT_THAT(pathsOf(readIn("<include href='part.xml'/><include href='part.xml' name='Other'/>")),
              ElementsAre("/Part/p", "/Other/p"));
}

TEST_F(SofaGraph, ARootNamedGroupIsReplacedByItsChildren) {
  write("part.xml", "<Node name='Group'><MechanicalObject/><PointModel name='p'/></Node>");
  EXPECT_THAT(pathsOf(readIn("<include href='part.xml'/>")), ElementsAre("/p"));
  write("part.xml", "<Node name='Part'><MechanicalObject/><PointModel name='p'/></Node>");
  EXPECT_THAT(pathsOf(readIn("<include href='part.xml' name='Group'/>")), ElementsAre("/p"));
}

TEST_F(SofaGraph, AnIncludedFileMayBeOneComponent) {
  write("part.xml", "<MechanicalObject position='1 2 3'/>");
  EXPECT_THAT(onlyBox(readIn("<include href='part.xml'/><PointModel/>")), IsBox(Corners{1, 2, 3, 1, 2, 3}));
  EXPECT_THAT(onlyBox(readIn("<include href='part.xml' position='4 5 6'/><PointModel/>")),
              IsBox(Corners{4, 5, 6, 4, 5, 6}));
  write("none.xml", "<Data value='1'/>");
  EXPECT_THAT(complaintIn("<include href='none.xml'/>"), HasSubstr("must be a Node or a component"));
}

TEST_F(SofaGraph, AttributesOfAnIncludeReplaceThoseThatArePresent) {
  write("part.xml", R"(<Node name="Part"><MechanicalObject name="m" dx="1" position="0 0 0"/><PointModel/></Node>)");
  EXPECT_THAT(onlyBox(readIn("<include href='part.xml' dx='5' dy='7'/>")), IsBox(Corners{5, 0, 0, 5, 0, 0}));
}

TEST_F(SofaGraph, AnAttributeOfAnIncludeMayAddressOneComponent) {
  write("part.xml", R"(<Node name="Part"><MechanicalObject name="a" dx="1"/><PointModel/>
    <Node name="N"><MechanicalObject name="b" dx="1"/><PointModel/></Node></Node>)");
  const auto scene = readIn("<include href='part.xml' b__dx='5'/>");
  ASSERT_EQ(scene.models.size(), 2U);
  EXPECT_THAT(boxOf(scene.models[0]), IsBox(Corners{1, 0, 0, 1, 0, 0}));
  EXPECT_THAT(boxOf(scene.models[1]), IsBox(Corners{5, 0, 0, 5, 0, 0}));
}

TEST_F(SofaGraph, TheOutermostIncludeHasTheLastWord) {
  write("inner.xml", "<Node name='I'><MechanicalObject dx='1'/><PointModel/></Node>");
  write("outer.xml", "<Node name='O'><include href='inner.xml' dx='2'/></Node>");
  EXPECT_THAT(onlyBox(readIn("<include href='outer.xml'/>")), IsBox(Corners{2, 0, 0, 2, 0, 0}));
  EXPECT_THAT(onlyBox(readIn("<include href='outer.xml' dx='3'/>")), IsBox(Corners{3, 0, 0, 3, 0, 0}));
}

TEST_F(SofaGraph, AnUnknownElementMayBeAFileOfObjects) {
  write("Objects/MyPart.xml", "<Node name='Part'><MechanicalObject dx='1'/><PointModel name='p'/></Node>");
  const auto scene = readIn("<MyPart dx='4' name='Mine'/>");
  EXPECT_THAT(pathsOf(scene), ElementsAre("/Mine/p"));
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{4, 0, 0, 4, 0, 0}));
}

TEST_F(SofaGraph, FilesAreFoundBesideTheSceneAndThenBelowTheRoots) {
  const Folder root;
  m_roots = {m_folder.path() / "nowhere", root.path()};
  root.write("lib/part.xml", "<Node name='FromRoot'><MechanicalObject/><PointModel name='p'/></Node>");
  EXPECT_THAT(pathsOf(readIn("<include href='lib/part.xml'/>")), ElementsAre("/FromRoot/p"));
  write("lib/part.xml", "<Node name='Beside'><MechanicalObject/><PointModel name='p'/></Node>");
  EXPECT_THAT(pathsOf(readIn("<include href='lib/part.xml'/>")), ElementsAre("/Beside/p"));
}

TEST_F(SofaGraph, FilesThatAnIncludedFileNamesAreFoundBesideIt) {
  write("sub/part.xml", "<Node name='P'><include href='deeper.xml'/></Node>");
  write("sub/deeper.xml", "<Node name='D'><MechanicalObject/><PointModel name='p'/></Node>");
  EXPECT_THAT(pathsOf(readIn("<include href='sub/part.xml'/>")), ElementsAre("/P/D/p"));
}

TEST_F(SofaGraph, AnIncludeRenamesAComponent) {
  write("part.xml", "<Node name='P'><MechanicalObject name='dof' position='1 2 3'/><PointModel name='p'/></Node>");
  const auto scene = readIn(
      "<include href='part.xml' dof__name='state' p__name='q' P__name='Q'/>"
      "<Node><MechanicalObject position='@../P/state.position'/><PointModel name='p'/></Node>");
  EXPECT_THAT(pathsOf(scene), ElementsAre("/P/q", "/1/p"));
  EXPECT_THAT(boxOf(scene.models.at(1)), IsBox(Corners{1, 2, 3, 1, 2, 3}));
}

TEST_F(SofaGraph, AnIncludeNamesWhatHasNoNameInItsFile) {
  write("part.xml", "<Node><MechanicalObject position='1 2 3'/><PointModel name='p'/></Node>");
  write("state.xml", "<MechanicalObject position='4 5 6'/>");
  for (const auto sofa : {SofaVersion::Sofa2006, SofaVersion::Sofa2612}) {
    m_sofa = sofa;
    const auto scene = readIn(
        "<include href='part.xml' name='P'/><Node name='N'><include href='state.xml' name='s'/></Node>"
        "<Node name='Q'><MechanicalObject position='@../N/s.position'/><PointModel name='q'/></Node>");
    EXPECT_THAT(pathsOf(scene), ElementsAre("/P/p", "/Q/q"));
    EXPECT_THAT(boxOf(scene.models.at(1)), IsBox(Corners{4, 5, 6, 4, 5, 6}));
  }
  EXPECT_THAT(pathsOf(readIn("<include href='part.xml' name=''/>")), ElementsAre("/p")) << "nor has it one then";
}

TEST_F(SofaGraph, FilesAreBesideTheSceneOfTheNodeThatNamesThem) {
  write("mesh.obj", "v 1 1 1\n");
  write("sub/mesh.obj", "v 7 7 7\n");
  const std::string loader = "<MeshOBJLoader name='l' filename='mesh.obj'/>";
  const std::string points = "<MechanicalObject src='@l'/><PointModel/>";
  const auto boxWith = [&](const std::string& part, const std::string& scene) {
    write("sub/part.xml", part);
    return onlyBox(readIn(scene));
  };
  const std::string include = "<include href='sub/part.xml'/>";
  EXPECT_THAT(boxWith("<Node name='P'>" + loader + points + "</Node>", include), IsBox(Corners{7, 7, 7, 7, 7, 7}));
  // The nodes around these are outside.
  for (const char* name : {"Group", "_Merge_"})
    EXPECT_THAT(boxWith("<Node name='" + std::string(name) + "'>" + loader + points + "</Node>", include),
                IsBox(Corners{1, 1, 1, 1, 1, 1}))
        << name;
  EXPECT_THAT(boxWith("<Node name='Group'><Node>" + loader + points + "</Node></Node>", include),
              IsBox(Corners{1, 1, 1, 1, 1, 1}));
  EXPECT_THAT(boxWith(loader, include + points), IsBox(Corners{1, 1, 1, 1, 1, 1}));
}

TEST_F(SofaGraph, AMissingIncludeIsNamed) {
  EXPECT_THAT(complaintIn("<include href='missing.xml'/>"),
              testing::AllOf(HasSubstr("scene.scn:2:"), HasSubstr("missing.xml")));
  EXPECT_THAT(complaintIn("<include/>"), HasSubstr("without href"));
}

TEST_F(SofaGraph, FilesThatIncludeThemselvesAreNamed) {
  write("a.xml", "<Node><include href='b.xml'/></Node>");
  write("b.xml", "<Node><include href='a.xml'/></Node>");
  EXPECT_THAT(complaintIn("<include href='a.xml'/>"), HasSubstr("includes itself"));
  EXPECT_THAT(complaintIn("<include href='scene.scn'/>"), HasSubstr("includes itself"));
}

TEST_F(SofaGraph, IncludesThatDoubleWithEachLevelDoNotEatTheMemory) {
  write("f0.xml", "<Node><X/><X/></Node>");
  for (int i = 1; i < 31; ++i) {
    const auto inner = "<include href='f" + std::to_string(i - 1) + ".xml'/>";
    write("f" + std::to_string(i) + ".xml", "<Node>" + inner + inner + "</Node>");
  }
  if (test::kIsSanitized) m_maxMemory = std::uint64_t{64} << 20;
  EXPECT_THAT(complaintIn("<include href='f30.xml'/>"),
              HasSubstr(test::kIsSanitized ? "takes more than 64 MiB" : "takes more than 2"));
}

TEST_F(SofaGraph, AttributesNeedNoBlankBetweenThem) {
  const auto scene = read(
      "<?xml version='1.0'encoding='utf-8'?><!-- a='1'b='2' <Node> --><Node name=\"r\"dt='0.1'>\n<MechanicalObject "
      "name='>'position=\"1 2 3\"dx='1'/><PointModel name='a\"b'group='1'/></Node>");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{2, 2, 3, 2, 2, 3}));
  EXPECT_EQ(scene.models[0].path, "/a\"b");
  EXPECT_THAT(scene.models[0].groups, testing::ElementsAre(1));
  EXPECT_EQ(scene.models[0].line, 2U);
  for (const auto bad : {"<Node name='a", "<Node name='a'b", "<Node name='a'<b", "<", "<!--", "<Node a='1'"})
    EXPECT_THAT(complaint(bad), HasSubstr("XML")) << bad;
}

/// As Windows PowerShell writes what `php -f SCENE.pscn` prints.
TEST_F(SofaGraph, AScenePrintedIntoAFileOfUtf16IsNamed) {
  std::string little = "\xff\xfe";
  std::string big = "\xfe\xff";
  for (const char c : std::string("<Node name='a'/>")) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  for (const std::string& text : {little, big})
    EXPECT_THAT(complaint(text), testing::EndsWith("scene.scn: is a text in UTF-16; UTF-8 can be read"));
}

TEST_F(SofaGraph, AnAttributeThatIsGivenTwiceIsAnErrorAsInSofa) {
  EXPECT_THAT(complaint("<Node>\n<MechanicalObject position='1 2 3' position='4 5 6'/><PointModel/></Node>"),
              HasSubstr("scene.scn:2: not well-formed XML: two attributes of an element have the same name"));
  EXPECT_THAT(complaint("<Node name='a' name='b'/>"), HasSubstr("scene.scn:1: not well-formed XML"));
}

TEST_F(SofaGraph, MoreAttributesThanAnyComponentHasAreAnErrorAndNoLongWait) {
  std::string attributes;
  std::string elements;
  for (int i = 0; i < 300'000; ++i) {
    attributes += " a" + std::to_string(i) + "='1'";
    elements += "<Attribute type='a" + std::to_string(i) + "' value='1'/>";
  }
  for (const std::string& text : {"<PointModel" + attributes + "/>", "<PointModel>" + elements + "</PointModel>"})
    EXPECT_THAT(complaint("<Node>\n" + text + "</Node>"),
                HasSubstr("scene.scn:2: an element has more than 1000 attributes"));
}

TEST_F(SofaGraph, ComponentsWithoutANameAreNumberedByTheirClassInEachNodeOfNewerSofa) {
  const std::string models = "<MechanicalObject/><MeshTopology/><Triangle/><TriangleOctreeModel/><Triangle/>";
  const auto text = "<Node name='A'>" + models + "</Node><Node name='B'>" + models + "</Node>";
  const std::vector<std::string> names{"/A/TriangleCollisionModel1",       "/A/TriangleOctreeCollisionModel1",
                                       "/A/TriangleCollisionModel2",       "/B/TriangleCollisionModel1",
                                       "/B/TriangleOctreeCollisionModel1", "/B/TriangleCollisionModel2"};
  EXPECT_EQ(pathsOf(readIn("<RequiredPlugin name='Sofa.Component.Mass'/>" + text)), names);
  EXPECT_EQ(pathsOf(readIn("<BVHNarrowPhase/>" + text)), names);
  EXPECT_EQ(pathsOf(readIn("<CollisionPipeline/>" + text))[0], "/A/tTriangleModel1");
  m_sofa = SofaVersion::Sofa2612;
  EXPECT_EQ(pathsOf(readIn(text)), names);
  m_sofa = SofaVersion::Sofa2006;
  EXPECT_EQ(pathsOf(readIn("<BVHNarrowPhase/>" + text))[0], "/A/tTriangleModel1");
}

TEST_F(SofaGraph, TheBroadPhaseOfThisProjectInPlaceOfSofasMakesNoSceneOlder) {
  const auto pathWith = [&](const std::string& text) {
    return pathsOf(readIn(text + "<Node name='A'><MechanicalObject/><MeshTopology/><Triangle/></Node>"))[0];
  };
  const std::string newer = "/A/TriangleCollisionModel1";
  EXPECT_EQ(pathWith("<BruteForceBroadPhase/>"), newer);
  EXPECT_EQ(pathWith("<AllpairsBroadPhase/>"), newer);
  EXPECT_EQ(pathWith("<RequiredPlugin pluginName='Allpairs'/>"), newer);
  EXPECT_EQ(pathWith("<RequiredPlugin name='Allpairs'/>"), newer);
  EXPECT_EQ(pathWith("<RequiredPlugin pluginName='SofaPython Allpairs'/>"), newer) << "any of several";
  EXPECT_EQ(pathWith("<RequiredPlugin pluginName='AllpairsOfOthers'/>"), "/A/tTriangleModel1");
}

TEST_F(SofaGraph, NodesWithoutANameHaveNoneInNewerSofa) {
  m_sofa = SofaVersion::Sofa2612;
  const auto text = R"(<MechanicalObject/><Node><PointModel name="a"/><Node name="N"><PointModel name="b"/><Node>
    <PointModel name="c"/></Node></Node></Node>)";
  EXPECT_THAT(pathsOf(readIn(text)), ElementsAre("/a", "//N/b", "//N//c"));
  m_sofa = SofaVersion::Sofa2006;
  EXPECT_THAT(pathsOf(readIn(text)), ElementsAre("/1/a", "/1/N/b", "/1/N/2/c"));
}

}  // namespace
}  // namespace allpairs::scene::sofa
