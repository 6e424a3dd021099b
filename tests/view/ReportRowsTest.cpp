// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <vector>

#include "ReportFiles.h"
#include "app/Expect.h"
#include "support/IfcText.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// All BCF files of a report of the wall and the column, by version.
std::map<std::string, std::string> bcfOfIfc(const TempFolder& folder, const std::string& version) {
  const std::string input = folder.write("two.ifc", kIfc);
  expectSuccess(runProgram({"report", input, "--bcf", version, "-o", folder.path() / version}));
  return filesOf(folder.path() / version / "clashes.bcf");
}

Names guidsOf(const pugi::xml_node& components) {
  Names guids;
  for (const pugi::xml_node& component : components.children("Component"))
    guids.emplace_back(component.attribute("IfcGuid").value());
  return guids;
}

TEST(ReportOfIfc, TopicsSelectAndColourComponentsByTheirGlobalIds) {
  const TempFolder folder;
  const Names expected{"2AvctVUKr0kugbFTf53O9L", "1AvctVUKr0kugbFTf53O9L"};
  for (const std::string version : {"2.1", "3.0"}) {
    std::size_t count = 0;
    for (const auto& [name, bytes] : bcfOfIfc(folder, version)) {
      if (!name.ends_with("viewpoint.bcfv")) continue;
      const pugi::xml_document document = parse(bytes);
      const pugi::xml_node components = document.child("VisualizationInfo").child("Components");
      EXPECT_EQ(guidsOf(components.child("Selection")), expected);
      Names coloured;
      for (const pugi::xml_node& colour : components.child("Coloring").children("Color")) {
        const Names guids = guidsOf(version == "3.0" ? colour.child("Components") : colour);
        coloured.insert(coloured.end(), guids.begin(), guids.end());
      }
      EXPECT_EQ(coloured, expected);
      ++count;
    }
    EXPECT_EQ(count, 1U) << version;
  }
}

TEST(ReportOfIfc, BcfOfVersion30HasItsForm) {
  const TempFolder folder;
  const auto files = bcfOfIfc(folder, "3.0");
  EXPECT_STREQ(parse(files.at("bcf.version")).child("Version").attribute("VersionId").value(), "3.0");
  EXPECT_EQ(childrenOf(parse(files.at("extensions.xml")).child("Extensions")),
            (Names{"TopicTypes", "TopicStatuses", "TopicLabels"}));
  std::size_t topics = 0;
  std::size_t cameras = 0;
  for (const auto& [name, bytes] : files) {
    const pugi::xml_document document =
        name.ends_with("markup.bcf") || name.ends_with(".bcfv") ? parse(bytes) : pugi::xml_document();
    const pugi::xml_node topic = document.child("Markup").child("Topic");
    if (topic) {
      ++topics;
      EXPECT_EQ(childrenOf(document.child("Markup")), (Names{"Header", "Topic"}));
      EXPECT_EQ(childrenOf(topic),
                (Names{"Title", "Index", "CreationDate", "CreationAuthor", "Description", "Viewpoints"}));
      EXPECT_STREQ(topic.child_value("Title"), "column and wall");
      EXPECT_EQ(childrenOf(topic.child("Viewpoints")), (Names{"ViewPoint"}));
    }
    const pugi::xml_node camera = document.child("VisualizationInfo").child("OrthogonalCamera");
    if (camera) {
      ++cameras;
      EXPECT_NEAR(camera.child("AspectRatio").text().as_double(), 4.0 / 3.0, 1e-9);
    }
  }
  EXPECT_EQ(topics, 1U);
  EXPECT_EQ(cameras, 1U);
}

TEST(ReportOfIfc, ClassNameAndGlobalIdAreApart) {
  const TempFolder folder;
  const std::string input = folder.write("two.ifc", kIfc);
  const auto models = nlohmann::json::parse(runProgram({"detect", input, "--format", "json"}).out)["models"];
  EXPECT_EQ(models[0]["name"], "wall");
  EXPECT_EQ(models[0]["ifcType"], "IfcWallStandardCase");
  EXPECT_EQ(models[0]["globalId"], "1AvctVUKr0kugbFTf53O9L");
  EXPECT_EQ(models[1]["name"], "column");
  expectSuccess(runProgram({"report", input, "--boxes", "-o", folder.path() / "out"}));
  EXPECT_NE(readBytes(folder.path() / "out/index.html").find("IfcColumn 2AvctVUKr0kugbFTf53O9L"), std::string::npos);
  EXPECT_NE(readBytes(folder.path() / "out/clashes.csv")
                .find(",IfcColumn,2AvctVUKr0kugbFTf53O9L,IfcWallStandardCase,1AvctVUKr0kugbFTf53O9L,"),
            std::string::npos);
}

/// Two bodies of two models each, which all overlap, and a third one that overlaps one of them.
const std::string kBodies = R"(<Node name="root"><CollisionPipeline/><BruteForceDetection/>
<Node name="A"><MechanicalObject position="0 0 0  1 0 0"/><SphereCollisionModel name="s" radius="1"/>
<PointCollisionModel name="p"/></Node>
<Node name="B"><MechanicalObject position="0.5 0 0  1.5 0 0"/><SphereCollisionModel name="s" radius="1"/>
<PointCollisionModel name="p"/></Node>
<Node name="C"><MechanicalObject position="3 0 0"/><SphereCollisionModel name="s" radius="1"/></Node></Node>)";

TEST(ReportOfBodies, HasARowForAllPairsOfTheSameTwo) {
  const TempFolder folder;
  const std::string scene = folder.write("bodies.scn", kBodies);
  const auto report = [&](const std::string& group) {
    const fs::path out = folder.path() / group;
    expectSuccess(runProgram({"report", scene, "--boxes", "--group", group, "-o", out}));
    return out;
  };
  const std::size_t pairs =
      nlohmann::json::parse(runProgram({"detect", scene, "--format", "json"}).out)["pairs"].size();
  ASSERT_EQ(pairs, 6U);  // four between A and B, C's with two of their models
  EXPECT_EQ(filesOf(report("none") / "clashes.bcf").size(), 3 * pairs + 1);
  const fs::path out = report("body");
  const auto files = filesOf(out / "clashes.bcf");
  const auto rows = rowsOf(out);
  ASSERT_EQ(rows.size(), pairs) << "the table has every pair";
  std::map<std::string, std::set<std::string>> guids;
  for (const auto& row : rows) guids[row.at("number")].insert(row.at("guid"));
  EXPECT_EQ(files.size(), 3 * guids.size() + 1);
  std::size_t most = 0;
  for (const auto& [number, all] : guids) {
    EXPECT_EQ(all.size(), 1U) << "a row has one topic";
    const pugi::xml_document document = parse(files.at(*all.begin() + "/viewpoint.bcfv"));
    const auto selection = document.child("VisualizationInfo").child("Components").child("Selection").children();
    most = std::max<std::size_t>(most, static_cast<std::size_t>(std::distance(selection.begin(), selection.end())));
  }
  EXPECT_EQ(most, 4U) << "all models of a row are selected";
  const std::string page = readBytes(out / "index.html");
  EXPECT_NE(page.find("<span class=\"first\">/B</span><br><span class=\"second\">/A</span>"), std::string::npos);
  EXPECT_NE(page.find("<summary>4 pairs of their parts</summary>"), std::string::npos);
  EXPECT_NE(page.find("pairs of bodies, 6 pairs of boxes</p>"), std::string::npos);
}

TEST(Report, OfNoMomentIsRefused) {
  const TempFolder folder;
  for (const char* moment :
       {"99999999999999", "99999999999999999999", "253402300800", "-62167219201", "abc", "", "1e9"})
    expectFailure(runScript("SOURCE_DATE_EPOCH=" + std::string(moment) + " \"$0\" report '" + kDemoScene + "' -o '" +
                            folder.path().string() + "/o'"),
                  2, "SOURCE_DATE_EPOCH: '" + std::string(moment) + "' is no moment of the years 0 to 9999");
  expectSuccess(runScript("SOURCE_DATE_EPOCH=253402300799 \"$0\" report '" + kDemoScene + "' -o '" +
                          folder.path().string() + "/o'"));
  EXPECT_NE(readBytes(folder.path() / "o/index.html").find("9999-12-31"), std::string::npos);
}

TEST(Report, TakesThePlaceOfNoInput) {
  const TempFolder folder;
  const std::string boxes = folder.write("r/clashes.csv", "0,0,0,2,2,2\n1,1,1,3,3,3\n");
  folder.write("r/index.html", "my own page");
  const std::string named = "is an input; the output needs another name";
  expectFailure(runProgram({"report", boxes, "-o", folder.path() / "r"}), 3, named);
  expectFailure(runProgram({"report", boxes, "-o", folder.path() / "r", "--force"}), 3, named);
  expectFailure(runProgram({"report", kDemoScene, "-o", folder.path() / "r"}), 3, "holds no report");
  folder.write("parts/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n");
  fs::create_directories(folder.path() / "out/pictures");
  fs::create_hard_link(folder.path() / "parts/a.obj", folder.path() / "out/pictures/0001.png");
  expectFailure(runProgram({"report", folder.path() / "parts", "-o", folder.path() / "out", "--force"}), 3, named);
  EXPECT_FALSE(fs::exists(folder.path() / "r/clashes.bcf"));
  EXPECT_EQ(readBytes(boxes), "0,0,0,2,2,2\n1,1,1,3,3,3\n");
}

TEST(ReportOfBodies, OfTheSameNameAreToldApart) {
  const TempFolder folder;
  const std::string body =
      R"(<Node name="A"><MechanicalObject position="0 0 0"/><SphereCollisionModel name="s" radius="1"/>
<PointCollisionModel name="p"/></Node>)";
  const std::string scene = folder.write(
      "same.scn", "<Node name=\"root\"><CollisionPipeline/><BruteForceDetection/>" + body + body + body + "</Node>");
  expectSuccess(runProgram({"report", scene, "--boxes", "-o", folder.path() / "out"}));
  EXPECT_EQ(filesOf(folder.path() / "out/clashes.bcf").size(), 3 * 3 + 1U) << "three rows, each with its GUID";
  for (const char* name : {"left/wheel.obj", "right/wheel.obj"})
    folder.write(name, "o wheel\n" + kTriangle + "o rim\n" + kTriangle);
  expectSuccess(runProgram({"report", folder.path() / "left/wheel.obj", folder.path() / "right/wheel.obj", "--boxes",
                            "--group", "file", "-o", folder.path() / "files"}));
  EXPECT_EQ(filesOf(folder.path() / "files/clashes.bcf").size(), 3 * 3 + 1U);
}

TEST(ReportOfBodies, MayBeOfFiles) {
  const TempFolder folder;
  folder.write("parts/left.obj", "o axle\n" + kTriangle + "o wheel\n" + kTriangle);
  folder.write("parts/right.obj", "o rim\n" + kTriangle + "o wheel\n" + kTriangle);
  const auto report = [&](const std::string& group) {
    const fs::path out = folder.path() / group;
    expectSuccess(runProgram({"report", folder.path() / "parts", "--boxes", "--group", group, "-o", out}));
    return out;
  };
  const fs::path out = report("file");
  EXPECT_EQ(tableOf(out).size(), 6U);
  const std::string page = readBytes(out / "index.html");
  EXPECT_NE(page.find("3 pairs of bodies, 6 pairs of boxes</p>"), std::string::npos);
  EXPECT_NE(page.find("<span class=\"first\">right.obj</span><br><span class=\"second\">left.obj</span>"),
            std::string::npos);
  EXPECT_NE(page.find("left.obj › wheel"), std::string::npos);
  EXPECT_NE(readBytes(report("body") / "index.html").find("6 pairs of boxes</p>"), std::string::npos);
  expectFailure(runProgram({"report", kDemoScene, "-o", folder.path() / "o", "--group", "all"}), 2,
                "is not one of body");
}

/// The wall and the column, and a curtain wall of two members, which mapped items place: each member is a beam from x =
/// -500 to 500.
std::string ifcOfParts() {
  const std::string parts = R"(#50=IFCRECTANGLEPROFILEDEF(.AREA.,$,#53,1000.,200.);
#51=IFCEXTRUDEDAREASOLID(#50,#9,#7,300.);
#52=IFCCARTESIANPOINT((0.,0.));
#53=IFCAXIS2PLACEMENT2D(#52,#21);
#54=IFCSHAPEREPRESENTATION(#10,'Body','SweptSolid',(#51));
#55=IFCREPRESENTATIONMAP(#9,#54);
#56=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#8,1.,$);
#57=IFCMAPPEDITEM(#55,#56);
#58=IFCCARTESIANPOINT((300.,0.,0.));
#59=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#58,1.,$);
#60=IFCMAPPEDITEM(#55,#59);
#61=IFCSHAPEREPRESENTATION(#10,'Body','MappedRepresentation',(#57,#60));
#62=IFCPRODUCTDEFINITIONSHAPE($,$,(#61));
#63=IFCMEMBER('3AvctVUKr0kugbFTf53O9L',#5,'mullion',$,$,#15,#62,$);
#64=IFCSHAPEREPRESENTATION(#10,'Body','MappedRepresentation',(#60));
#65=IFCPRODUCTDEFINITIONSHAPE($,$,(#64));
#66=IFCMEMBER('4AvctVUKr0kugbFTf53O9L',#5,'mullion',$,$,#15,#65,$);
#67=IFCCURTAINWALL('5AvctVUKr0kugbFTf53O9L',#5,'front',$,$,#15,$,$);
#68=IFCRELAGGREGATES('6AvctVUKr0kugbFTf53O9L',#5,$,$,#67,(#63,#66));
)";
  std::string text = kIfc;
  text.replace(text.find("(#27,#39)"), 9, "(#27,#39,#67)");
  return text.insert(text.find("ENDSEC;", text.find("DATA;")), parts);
}

TEST(ReportOfIfc, MappedItemsArePartsOfTheirProductAndProductsOfTheirAssembly) {
  const TempFolder folder;
  const std::string input = folder.write("parts.ifc", ifcOfParts());
  const auto result = nlohmann::json::parse(runProgram({"detect", input, "--format", "json"}).out);
  std::map<std::string, std::string> ids;
  for (const auto& model : result["models"]) {
    ids.emplace(model["name"].get<std::string>(), model.value("globalId", ""));
    EXPECT_EQ(model.value("ifcType", "").substr(0, 3), "Ifc") << model["name"];
  }
  EXPECT_EQ(ids, (std::map<std::string, std::string>{{"wall", "1AvctVUKr0kugbFTf53O9L"},
                                                     {"column", "2AvctVUKr0kugbFTf53O9L"},
                                                     {"mullion/IfcMappedItem", "3AvctVUKr0kugbFTf53O9L"},
                                                     {"mullion/IfcMappedItem#2", "3AvctVUKr0kugbFTf53O9L"},
                                                     {"mullion#2", "4AvctVUKr0kugbFTf53O9L"}}));
  const auto titlesOf = [&](const std::string& group) {
    const fs::path out = folder.path() / group;
    expectSuccess(runProgram({"report", input, "--boxes", "--group", group, "-o", out}));
    std::set<std::string> titles;
    for (const auto& [name, bytes] : filesOf(out / "clashes.bcf")) {
      if (name.ends_with("markup.bcf")) titles.insert(parse(bytes).child("Markup").child("Topic").child_value("Title"));
    }
    return titles;
  };
  EXPECT_EQ(result["pairs"].size(), 7U);
  EXPECT_EQ(titlesOf("body"),
            (std::set<std::string>{"column and wall", "mullion and wall", "mullion#2 and mullion", "mullion#2 and wall",
                                   "mullion/IfcMappedItem#2 and mullion/IfcMappedItem"}));
  EXPECT_EQ(titlesOf("assembly"), (std::set<std::string>{"column and wall", "front and wall", "front with itself"}));
}

/// An IFC with more in it, and behind others that building #16 holds.
std::string withMore(std::string ifc, const std::string& lines, const std::string& before = "") {
  if (!before.empty()) ifc.insert(ifc.find("(#27,#39") + 1, before);
  return ifc.insert(ifc.find("ENDSEC;", ifc.find("DATA;")), lines);
}

TEST(ReportOfIfc, ProductsOfOneNameAreToldApartByTheirPlaces) {
  const TempFolder folder;
  const std::string input = folder.write("two.ifc", withMore(kIfc, R"(
#70=IFCBUILDINGSTOREY('7AvctVUKr0kugbFTf53O9L',#5,'Upper',$,$,#15,$,$,.ELEMENT.,0.);
#71=IFCRELAGGREGATES('8AvctVUKr0kugbFTf53O9L',#5,$,$,#16,(#70));
#72=IFCCOLUMN('9AvctVUKr0kugbFTf53O9L',#5,'column',$,$,#15,#38,$);
#73=IFCRELCONTAINEDINSPATIALSTRUCTURE('0cvctVUKr0kugbFTf53O9L',#5,$,$,(#72),#70);
)"));
  const auto result = nlohmann::json::parse(runProgram({"detect", input, "--format", "json"}).out);
  std::map<std::string, Names> models;
  for (const auto& model : result["models"]) models[model["globalId"]] = {model["name"], model["path"]};
  EXPECT_EQ(models,
            (std::map<std::string, Names>{{"1AvctVUKr0kugbFTf53O9L", {"wall", "Building/wall"}},
                                          {"2AvctVUKr0kugbFTf53O9L", {"Building/column", "Building/column"}},
                                          {"9AvctVUKr0kugbFTf53O9L", {"Upper/column", "Building/Upper/column"}}}));
}

TEST(ReportOfIfc, AssembliesAreKnownByTheirGlobalIds) {
  const TempFolder folder;
  const auto guidsOfRows = [&](const std::string& ifc) {
    const std::string input = folder.write("parts.ifc", ifc);
    expectSuccess(runProgram({"report", input, "--boxes", "--group", "assembly", "-o", folder.path() / "out"}));
    std::map<std::string, std::set<std::string>> guids;  // by the GlobalIds of members
    for (const auto& row : rowsOf(folder.path() / "out")) {
      const auto& [first, second] = std::minmax(row.at("first_id"), row.at("second_id"));
      guids[first + ' ' + second].insert(row.at("guid"));
    }
    return guids;
  };
  const auto before = guidsOfRows(ifcOfParts());
  EXPECT_EQ(before.size(), 5U);
  // Another front of two members, which comes first.
  const auto after = guidsOfRows(withMore(ifcOfParts(), R"(
#83=IFCMEMBER('3BvctVUKr0kugbFTf53O9L',#5,'mullion',$,$,#15,#62,$);
#86=IFCMEMBER('4BvctVUKr0kugbFTf53O9L',#5,'mullion',$,$,#15,#65,$);
#87=IFCCURTAINWALL('5BvctVUKr0kugbFTf53O9L',#5,'front',$,$,#15,$,$);
#88=IFCRELAGGREGATES('6BvctVUKr0kugbFTf53O9L',#5,$,$,#87,(#83,#86));
)",
                                          "#87,"));
  EXPECT_GT(after.size(), before.size());
  for (const auto& [members, guids] : before) EXPECT_EQ(after.at(members), guids) << members;
}

/// A glTF of a camera and a machine, which holds a motor of two triangles and a gear of one; all overlap.
const std::string kAssembly = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
"nodes": [{"name": "camera"}, {"name": "machine", "children": [2, 5]}, {"name": "motor", "children": [3, 4]},
{"name": "rotor", "mesh": 0}, {"name": "stator", "mesh": 0}, {"name": "gear", "mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAIA/"}]})";

TEST(ReportOfBodies, MayBeOfAssemblies) {
  const TempFolder folder;
  const std::string input = folder.write("machine.gltf", kAssembly);
  const auto rowsOf = [&](const std::string& group) {
    const fs::path out = folder.path() / group;
    expectSuccess(runProgram({"report", input, "--boxes", "--group", group, "-o", out}));
    EXPECT_EQ(tableOf(out).size(), 3U) << "the table has every pair";
    return readBytes(out / "index.html");
  };
  EXPECT_NE(rowsOf("body").find("<p class=\"headline\">3 pairs of boxes</p>"), std::string::npos);
  const std::string page = rowsOf("assembly");
  EXPECT_NE(page.find("<p class=\"headline\">2 pairs of bodies, 3 pairs of boxes</p>"), std::string::npos);
  EXPECT_NE(page.find("<span class=\"first\">gear</span><br><span class=\"second\">motor</span>"), std::string::npos);
  EXPECT_NE(page.find("<dt>Rows</dt><dd>pairs of assemblies</dd>"), std::string::npos);
}

TEST(Report, IsNotMixedWithOtherFilesUnlessItIsForced) {
  const TempFolder folder;
  const std::filesystem::path out = folder.path() / "out";
  std::filesystem::create_directory(out);
  expectSuccess(runProgram({"report", kDemoScene, "-o", out, "--pictures", "0"}));  // an empty one is taken
  expectSuccess(runProgram({"report", kDemoScene, "-o", out, "--pictures", "1"}));  // and one of a report
  EXPECT_TRUE(std::filesystem::exists(out / "pictures/0001.png"));
  std::filesystem::remove(out / "index.html");  // as where a report was interrupted
  expectSuccess(runProgram({"report", kDemoScene, "-o", out, "--pictures", "0", "--force"}));
  EXPECT_FALSE(std::filesystem::exists(out / "pictures/0001.png"));
  const std::filesystem::path work = folder.path() / "work";
  std::filesystem::create_directory(work);
  folder.write("work/notes.txt", "mine");
  expectFailure(runProgram({"report", kDemoScene, "-o", work}), 3, "work: is not empty and holds no report; --force");
  EXPECT_EQ(readBytes(work / "notes.txt"), "mine");
  EXPECT_FALSE(std::filesystem::exists(work / "index.html"));
  expectSuccess(runProgram({"report", kDemoScene, "-o", work, "--pictures", "0", "--force"}));
  EXPECT_EQ(readBytes(work / "notes.txt"), "mine");
  EXPECT_TRUE(std::filesystem::exists(work / "index.html"));
}

TEST(Report, OfASofaSceneIsOfBoxesAndSaysWhichOfThemOnlyLieWithinTheDistance) {
  const TempFolder folder;
  const std::string scene = folder.write(
      "near.scn",
      "<Node name='root'><CollisionPipeline/><BruteForceBroadPhase/><BVHNarrowPhase/><CollisionResponse/>"
      "<MinProximityIntersection alarmDistance='1'/>"
      "<Node name='A'><MechanicalObject position='0 0 0'/><SphereCollisionModel name='s'/></Node>"
      "<Node name='B'><MechanicalObject position='2.25 0 0'/><SphereCollisionModel name='s'/></Node></Node>");
  expectSuccess(runProgram({"report", scene, "-o", folder.path() / "out"}));
  const std::string page = readBytes(folder.path() / "out/index.html");
  EXPECT_NE(page.find("do not overlap, but lie within the distance: they are 0.25 apart on x."), std::string::npos);
  expectFailure(runProgram({"report", scene, "-o", folder.path() / "out", "--fail-on", "clash"}), 2,
                "none were tested; --exact tests them");
  for (const char* missing : {"missing.csv", "missing.scn"})  // before anything is read
    expectFailure(runProgram({"report", missing, "-o", folder.path() / "out", "--fail-on", "clash"}), 2,
                  "none were tested; --exact tests them");
}

TEST(Report, HasTheNearestFirstOfBoxesThatOnlyLieWithinADistance) {
  const TempFolder folder;
  const std::string input = folder.write("boxes.csv", "0,0,0,1,1,1\n0,0,4,1,1,5\n0,2,0,1,3,1\n");
  const fs::path out = folder.path() / "out";
  expectSuccess(runProgram({"report", input, "--boxes", "--distance", "3", "-o", out}));
  const auto rows = rowsOf(out);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].at("overlap_y"), "-1");
  EXPECT_EQ(rows[1].at("overlap_z"), "-3");
}

#ifdef ALLPAIRS_HAS_FCL
TEST(ReportOfSeveralInputs, TestsShapesAlthoughOneOfThemIsAScene) {
  const TempFolder folder;
  const std::string a = folder.write("a.obj", "o a\n" + kTriangle);
  const std::string b = folder.write("b.obj", "o b\nv 0.9 0.9 0.1\nv 0.9 0.9 0.8\nv 0.9 0.8 0.1\nf 1 2 3\n");
  const std::string scene =
      folder.write("s.scn",
                   "<Node name='root'><CollisionPipeline/><BruteForceDetection/><DiscreteIntersection/>"
                   "<MechanicalObject position='9 9 9'/><SphereCollisionModel name='s'/></Node>");
  const auto tested = [&](const std::vector<std::string>& inputs, const std::string& standardInput = "/dev/null") {
    std::string words;
    for (const std::string& input : inputs) words += " '" + input + '\'';
    const std::string out = folder.path() / "out";
    EXPECT_EQ(runScript("\"$0\" report" + words + " -o '" + out + "' --threads 1 < '" + standardInput + '\'').status,
              0);
    const std::string page = readBytes(folder.path() / "out/index.html");
    return page.substr(page.find("<dt>Tested</dt><dd>") + 19, 6);
  };
  EXPECT_EQ(tested({a, b}), "shapes");
  EXPECT_EQ(tested({a, b, scene}), "shapes");
  ASSERT_EQ(rowsOf(folder.path() / "out").size(), 1U);
  EXPECT_EQ(rowsOf(folder.path() / "out")[0].at("state"), "undecided") << "triangles that are apart close nothing";
  EXPECT_EQ(tested({scene}), "boxes<");
  EXPECT_EQ(tested({"-", "--input-format", "scn"}, scene), "boxes<") << "by whatever name";
}
#endif

TEST(ReportTitle, OfTheFolderThatOneIsInIsItsName) {
  const TempFolder folder;
  folder.write("gears/a.obj", kTriangle);
  folder.write("gears/left/b.obj", kTriangle);
  const auto titleOf = [&](const std::string& from, const std::string& inputs) {
    const std::string out = folder.path() / "out";
    const std::string gears = folder.path() / "gears";
    const std::string arguments = " --boxes --threads 1 " + inputs + " -o '" + out;
    const std::string report = "\"$0\" report" + arguments + "' && \"$0\" view" + arguments + ".html'";
    expectSuccess(runScript("cd '" + gears + "/" + from + "' && " + report));
    const std::string page = readBytes(out + "/index.html");
    const std::string title = page.substr(page.find("<h1>") + 4, page.find("</h1>") - page.find("<h1>") - 4);
    EXPECT_NE(readBytes(out + ".html").find("\"title\":\"" + title + '"'), std::string::npos) << title;
    return title;
  };
  EXPECT_EQ(titleOf("", "."), "gears");
  EXPECT_EQ(titleOf("", "./ left/"), "gears, left");
  EXPECT_EQ(titleOf("left", ".. ."), "gears, left");
  EXPECT_EQ(titleOf("left", "../left/.. ../a.obj ./b.obj"), "gears, a.obj, b.obj");
}

}  // namespace
}  // namespace allpairs::test
