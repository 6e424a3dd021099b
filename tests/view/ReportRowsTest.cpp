// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "ReportFiles.h"
#include "app/Expect.h"
#include "support/IfcText.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

const std::string kDemoScene = ALLPAIRS_SOURCE_DIR "/examples/scenes/demo.scn";

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
  for (const auto& [name, bytes] : files) {
    const pugi::xml_document document =
        name.ends_with("markup.bcf") || name.ends_with(".bcfv") ? parse(bytes) : pugi::xml_document();
    const pugi::xml_node topic = document.child("Markup").child("Topic");
    if (topic) {
      EXPECT_EQ(childrenOf(document.child("Markup")), (Names{"Header", "Topic"}));
      EXPECT_EQ(childrenOf(topic),
                (Names{"Title", "Index", "CreationDate", "CreationAuthor", "Description", "Viewpoints"}));
      EXPECT_STREQ(topic.child_value("Title"), "column and wall");
      EXPECT_EQ(childrenOf(topic.child("Viewpoints")), (Names{"ViewPoint"}));
    }
    const pugi::xml_node camera = document.child("VisualizationInfo").child("OrthogonalCamera");
    if (camera) {
      EXPECT_NEAR(camera.child("AspectRatio").text().as_double(), 4.0 / 3.0, 1e-9);
    }
  }
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
const std::string kBodies = R"(<Node name="root"><CollisionPipeline/>
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
  const std::vector<std::string> lines = tableOf(out);
  ASSERT_EQ(lines.size(), pairs) << "the table has every pair";
  std::map<std::string, std::set<std::string>> guids;
  for (const std::string& line : lines) guids[line.substr(0, line.find(','))].insert(lastCell(line));
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

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 1\nf -3 -2 -1\n";

/// GUIDs of a report by the names of their two models, in order.
std::map<std::string, std::string> guidsByNames(const fs::path& report) {
  std::map<std::string, std::string> guids;
  for (const std::string& line : tableOf(report)) {
    std::istringstream text(line);
    std::string number;
    Names names(2);
    std::getline(text, number, ',');
    for (std::string& name : names) std::getline(text, name, ',');
    std::sort(names.begin(), names.end());
    guids[names[0] + ' ' + names[1]] = lastCell(line);
  }
  return guids;
}

TEST(ReportSince, GuidsStayWhenTheFolderMovesAndOtherPartsCome) {
  const TempFolder folder;
  for (const char* name : {"b", "c"})
    folder.write("here/" + std::string(name) + ".obj", "o " + std::string(name) + '\n' + kTriangle);
  expectSuccess(runProgram({"report", folder.path() / "here", "--boxes", "-o", folder.path() / "one"}));
  fs::create_directory(folder.path() / "there");
  fs::rename(folder.path() / "here", folder.path() / "there/new");
  folder.write("there/new/a.obj", "o b\n" + kTriangle);  // now b is no name of one part alone
  expectSuccess(runProgram({"report", folder.path() / "there/new", "--boxes", "-o", folder.path() / "two"}));
  const auto one = guidsByNames(folder.path() / "one");
  const auto two = guidsByNames(folder.path() / "two");
  ASSERT_EQ(one.size(), 1U);
  ASSERT_EQ(two.size(), 3U);
  EXPECT_EQ(one.at("b c"), two.at("b.obj › b c"));
}

TEST(ReportSince, MarksWhatIsNewPersistsAndIsResolved) {
  const TempFolder folder;
  const auto part = [&](const std::string& name, const std::string& text) {
    folder.write("parts/" + name + ".obj", "o " + name + '\n' + text);
  };
  const std::string away = "v 9 9 9\nv 10 9 9\nv 9 10 10\nf -3 -2 -1\n";
  part("a", kTriangle);
  part("=b", kTriangle);
  part("c", away);
  const fs::path out = folder.path() / "out";
  const std::string parts = folder.path() / "parts";
  expectSuccess(runProgram({"report", parts, "--boxes", "-o", out}));
  part("c", kTriangle);  // c comes in, and =b goes
  part("=b", away);
  part("d", away);
  expectSuccess(runProgram({"report", parts, "--boxes", "-o", out, "--since", out}));
  std::map<std::string, std::string> states;
  for (const std::string& line : tableOf(out)) {
    Names cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    ASSERT_EQ(cells.size(), 9U) << line;
    states[cells[1] + ' ' + cells[2]] = cells[7] + ' ' + (cells[0].empty() ? "-" : cells[0]);
  }
  // Before: a with =b. Now: a with c, and d with =b.
  EXPECT_EQ(states,
            (std::map<std::string, std::string>{{"c a", "new 1"}, {"d '=b", "new 2"}, {"a '=b", "resolved -"}}));
  EXPECT_NE(readBytes(out / "index.html").find(": 2 new, 0 persisting, 1 resolved.</p>"), std::string::npos);
  Names topics;
  for (const auto& [name, bytes] : filesOf(out / "clashes.bcf")) {
    if (!name.ends_with("markup.bcf")) continue;
    const pugi::xml_document document = parse(bytes);
    const pugi::xml_node topic = document.child("Markup").child("Topic");
    topics.push_back(std::string(topic.child_value("Title")) + ' ' + topic.child_value("Labels") + ' ' +
                     topic.attribute("TopicStatus").value());
  }
  std::sort(topics.begin(), topics.end());
  EXPECT_EQ(topics, (Names{"a and =b resolved Closed", "c and a new Open", "d and =b new Open"}));
  // The same again: nothing is new, and what was resolved before is not resolved again.
  expectSuccess(
      runProgram({"report", parts, "--boxes", "-o", folder.path() / "again", "--since", out / "clashes.csv"}));
  const std::string nothingNew = ": 0 new, 2 persisting, 0 resolved.</p>";
  EXPECT_NE(readBytes(folder.path() / "again/index.html").find(nothingNew), std::string::npos);
  // A spreadsheet ends lines in another way.
  const std::string table = std::regex_replace(readBytes(out / "clashes.csv"), std::regex("\n"), "\r\n");
  const std::string saved = folder.write("saved.csv", table);
  expectSuccess(runProgram({"report", parts, "--boxes", "-o", folder.path() / "again", "--since", saved}));
  EXPECT_NE(readBytes(folder.path() / "again/index.html").find(nothingNew), std::string::npos);
}

TEST(ReportSince, ComparesWhatWasAClashAndHowDeepItWas) {
  const TempFolder folder;
  const auto write = [&](double lid, double d, double f) {
    std::string text;
    const auto add = [&text](const std::string& name, double x) {
      text += name + ',' + std::to_string(x) + ",0,0," + std::to_string(x + 1.0) + ",1,1\n";
    };
    const std::vector<std::pair<std::string, double>> boxes{{"a", 0.0},  {"lid", lid}, {"c", 10.0}, {"d", d},
                                                            {"e", 20.0}, {"f", f},     {"g", 30.0}, {"h", 30.75}};
    for (const auto& [name, x] : boxes) add(name, x);
    return folder.write("boxes.csv", text);
  };
  const fs::path out = folder.path() / "out";
  expectSuccess(runProgram({"report", write(1.0, 10.75, 20.75), "--exact", "-o", out}));
  expectSuccess(runProgram({"report", write(0.5, 11.0, 20.5), "--exact", "-o", out, "--since", out}));
  std::map<std::string, std::string> changes;
  for (const std::string& line : tableOf(out)) {
    Names cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    changes[cells[1] + ' ' + cells[2]] = cells[3] + ' ' + cells[cells.size() - 2];
  }
  EXPECT_EQ(changes, (std::map<std::string, std::string>{{"lid a", "clash new"},
                                                         {"d c", "touching resolved"},
                                                         {"f e", "clash persisting"},
                                                         {"h g", "clash persisting"}}));
  const auto statusOf = [&](const std::string& what, const fs::path& earlier) {
    const ProgramRun run = runProgram({"report", folder.path() / "boxes.csv", "--exact", "-o", folder.path() / "again",
                                       "--since", earlier, "--fail-on", what});
    return std::to_string(run.status) + run.err.substr(0, run.err.find('\n'));
  };
  EXPECT_EQ(statusOf("new", out), "0");  // out is what is there now
  EXPECT_EQ(statusOf("clash", out), "4allpairs: --fail-on: found 3 rows of clashes");
  EXPECT_EQ(statusOf("pair", out), "4allpairs: --fail-on: found 4 rows");
  expectFailure(runProgram({"report", folder.path(), "-o", out, "--fail-on", "new"}), 2, "add --since");
  const std::string page = readBytes(out / "index.html");
  EXPECT_NE(page.find(": 1 new, 2 persisting, 1 resolved.</p>"), std::string::npos);
  std::map<std::string, std::string> topics;
  for (const auto& [name, bytes] : filesOf(out / "clashes.bcf")) {
    if (!name.ends_with("markup.bcf")) continue;
    const pugi::xml_document document = parse(bytes);
    const pugi::xml_node topic = document.child("Markup").child("Topic");
    const std::string words = topic.child_value("Description");
    const std::size_t before = words.find(" Before: ");
    topics[topic.child_value("Title")] = std::string(topic.attribute("TopicType").value()) + ' ' +
                                         topic.attribute("TopicStatus").value() +
                                         (before == std::string::npos ? "" : words.substr(before));
    if (before != std::string::npos) {
      EXPECT_NE(page.find(words.substr(before)), std::string::npos) << words;
    }
  }
  EXPECT_EQ(topics, (std::map<std::string, std::string>{{"lid and a", "Clash Open Before: touching."},
                                                        {"d and c", "Contact Closed Before: clash, 0.25 deep."},
                                                        {"f and e", "Clash Open Before: clash, 0.25 deep."},
                                                        {"h and g", "Clash Open"}}));
}

TEST(ReportSince, FilesOfOneNameAreKnownByTheirFolders) {
  const TempFolder folder;
  for (const char* name : {"left/bolt.obj", "right/bolt.obj", "base/plate.obj"}) {
    folder.write(name, kTriangle);
  }
  // The GUID of each pair, which is known by the one that it is without.
  const auto guids = [&](const Names& folders, const char* out) {
    Names words{"report", "--boxes", "-o", folder.path() / out};
    for (const std::string& name : folders) words.push_back(folder.path() / name);
    expectSuccess(runProgram(words));
    std::map<std::string, std::string> found;
    for (const auto& [names, guid] : guidsByNames(folder.path() / out)) {
      for (const char* name : {"left", "right", "plate"}) {
        if (names.find(name) == std::string::npos) found[name] = guid;
      }
    }
    return found;
  };
  const std::map<std::string, std::string> before = guids({"left", "right", "base"}, "before");
  ASSERT_EQ(before.size(), 3U);
  EXPECT_EQ(guids({"right", "base", "left"}, "turned"), before) << "whatever their order";
  // Where there is one of the name it may be either: what is found is new.
  const std::map<std::string, std::string> after = guids({"right", "base"}, "after");
  ASSERT_EQ(after.size(), 2U) << "without one of the name, and so without its folder";
  for (const auto& [name, guid] : before) EXPECT_NE(after.at("left"), guid) << name;
}

TEST(ReportSince, SaysWhatIsNoReport) {
  const TempFolder folder;
  const std::string out = folder.path() / "out";
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", folder.path()}), 3,
                "holds no report to compare with");
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", ""}), 2, "--since: the name is empty");
  fs::create_directories(folder.path() / "odd/clashes.csv");
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", folder.path() / "odd"}), 3,
                "odd/clashes.csv: is a folder, not a file");
  if (::geteuid() != 0) {
    const std::string locked = folder.write("locked.csv", "");
    fs::permissions(locked, fs::perms::none);
    expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", locked}), 3,
                  "locked.csv: cannot be opened: Permission denied");
  }
  const std::string table = folder.write("other.csv", "a,b\n1,2\n");
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", table}), 3,
                "other.csv: is no table of a report");
  const std::string hostile =
      folder.write("hostile.csv", "number,first,second,guid\n1,a,b,../../../../../../../../../../../../\n");
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", hostile}), 3, "a line has other columns");
  const std::string cut = folder.write("cut.csv", "number,first,second,guid\n1,a\n");
  expectFailure(runProgram({"report", kDemoScene, "-o", out, "--since", cut}), 3, "a line has other columns");
  EXPECT_FALSE(fs::exists(out));
}

TEST(Report, OfNoMomentIsRefused) {
  const TempFolder folder;
  for (const char* moment : {"99999999999999", "99999999999999999999"})
    expectFailure(runScript("SOURCE_DATE_EPOCH=" + std::string(moment) + " \"$0\" report '" + kDemoScene + "' -o '" +
                            folder.path().string() + "/o'"),
                  2, "SOURCE_DATE_EPOCH: '" + std::string(moment) + "' is no moment of the years 0 to 9999");
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
  const std::string scene =
      folder.write("same.scn", "<Node name=\"root\"><CollisionPipeline/>" + body + body + body + "</Node>");
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

}  // namespace
}  // namespace allpairs::test
