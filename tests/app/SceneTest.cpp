// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "Expect.h"
#include "support/Data.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using Json = nlohmann::json;

const std::string kDemoScene = ALLPAIRS_SOURCE_DIR "/examples/scenes/demo.scn";
const std::string kDemoZones = ALLPAIRS_SOURCE_DIR "/examples/scenes/zones.csv";

/// SOFA computes in float32; this is the tolerance at which its boxes are known.
void expectSameBox(const Json& box, const Json& expected, const std::string& name) {
  for (std::size_t k = 0; k < 6; ++k) {
    const double value = box[k / 3][k % 3];
    const double wanted = expected[k / 3][k % 3];
    EXPECT_NEAR(value, wanted, 1e-5 * std::max(1.0, std::abs(wanted))) << name;
  }
}

void expectSameModels(const Json& models, const Json& expected, const std::string& scene) {
  ASSERT_EQ(models.size(), expected.size()) << scene;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const std::string name = expected[i]["path"];
    EXPECT_EQ(models[i]["name"], name) << scene;
    EXPECT_EQ(models[i]["type"], expected[i]["type"]) << scene << ' ' << name;
    EXPECT_EQ(models[i]["elements"], expected[i]["elements"]) << scene << ' ' << name;
    EXPECT_EQ(models[i]["simulated"], expected[i]["simulated"]) << scene << ' ' << name;
    EXPECT_EQ(models[i]["moving"], expected[i]["moving"]) << scene << ' ' << name;
    expectSameBox(models[i]["box"], expected[i]["box"], scene + ' ' + name);
  }
}

TEST(DetectScene, PartsAreDescribedWithoutTheWordsOfScenes) {
  const TempFolder folder;
  std::filesystem::create_directory(folder.path() / "within");
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  folder.write("roof.obj", triangle);
  folder.write("within/wall.obj", triangle);
  const ProgramRun top = runProgram({"detect", folder.path()});
  expectSuccess(top);
  EXPECT_TRUE(top.out.starts_with("models   1\nmethod   boxes\nignored  1 part of the input")) << top.out;
  const ProgramRun all = runProgram({"detect", folder.path(), "--recursive", "--distance", "0.5"});
  expectSuccess(all);
  EXPECT_TRUE(
      all.out.starts_with("models   2\nmethod   boxes at most 0.5 apart on every axis\npairs    1\n\n"
                          "  wall.obj   roof.obj\n"))
      << all.out;
  const ProgramRun scene = runProgram({"info", kDemoScene});
  expectSuccess(scene);
  EXPECT_NE(scene.out.find(", alarm distance "), std::string::npos) << scene.out;
}

TEST(DetectScene, TheScenesOfTheDataFolderGiveTheModelsAndPairsBesideThem) {
  const std::filesystem::path folder = dataFolder() / "scenes";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no folder of data: scenes/expected/*.json are not tried";
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "expected")) {
    const Json expected = Json::parse(readBytes(entry.path()));
    const std::string scene = folder / expected["scene"].get<std::string>();
    const ProgramRun run =
        runProgram({"detect", scene, "--data", folder, "--data", folder / "examples", "--format", "json", "--verify"});
    expectSuccess(run);
    const Json result = Json::parse(run.out);
    expectSameModels(result["models"], expected["models"], scene);
    EXPECT_EQ(result["pairs"], expected["pairs"]) << scene;
    ++count;
  }
  EXPECT_EQ(count, 12U);
}

TEST(DetectScene, ADistanceReplacesTheAlarmDistanceAndABoxTheRegion) {
  const TempFolder folder;
  const std::string scene = folder.write("two.scn", R"(<Node name="root"><CollisionPipeline/><BruteForceDetection/>
<MinProximityIntersection alarmDistance="5"/>
<Node name="A"><MechanicalObject position="0 0 0"/><SphereCollisionModel name="s" radius="1"/></Node>
<Node name="B"><MechanicalObject position="3 0 0"/><SphereCollisionModel name="s" radius="1"/></Node></Node>)");
  EXPECT_EQ(runProgram({"detect", scene, "--format", "csv"}).out, "first,second\n/B/s,/A/s\n");
  EXPECT_EQ(runProgram({"detect", scene, "--format", "csv", "--distance", "1"}).out, "first,second\n/B/s,/A/s\n");
  EXPECT_EQ(runProgram({"detect", scene, "--format", "csv", "--distance", "0.5"}).out, "first,second\n");
  EXPECT_EQ(runProgram({"detect", scene, "--format", "csv", "--distance", "1", "--box", "-9,-9,-9,0,9,9"}).out,
            "first,second\n");
}

TEST(DetectScene, AMalformedSceneIsNamedWithItsLine) {
  const TempFolder folder;
  const std::string scene = folder.write("bad.scn", "<Node>\n<Node>\n</Node>\n");
  expectFailure(runProgram({"detect", scene}), 3, scene + ":");
}

TEST(DetectScene, APartialResultIsNotSilent) {
  const TempFolder folder;
  const std::string scene = folder.write("two.scn", R"(<Node name="root"><CollisionPipeline/><BruteForceDetection/>
<Node name="A"><MechanicalObject position="0 0 0"/><SphereCollisionModel name="s" radius="1"/></Node>
<Node name="B"><MechanicalObject position="3 0 0"/><SphereCollisionModel name="s" radius="-1"/></Node></Node>)");
  const std::string warning =
      "allpairs: warning: " + scene + ": 1 model left out; 'allpairs info --partial " + scene + "' lists it\n";
  const ProgramRun run = runProgram({"detect", "--partial", scene, "--format", "json"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, warning);
  const Json ignored = Json::parse(run.out)["ignored"];
  ASSERT_EQ(ignored.size(), 1U);
  EXPECT_EQ(ignored[0]["file"], scene);
  EXPECT_EQ(ignored[0]["line"], 3);
  EXPECT_EQ(ignored[0]["subject"], "/B/s");
  const ProgramRun table = runProgram({"detect", "--partial", scene});
  EXPECT_EQ(table.err, warning);
  EXPECT_NE(table.out.find("'allpairs info --partial' lists them"), std::string::npos) << table.out;
  std::filesystem::rename(scene, folder.path() / "-two.scn");
  const ProgramRun dashed = runScript("cd '" + folder.path().string() + "' && \"$0\" detect --partial -- -two.scn");
  EXPECT_NE(dashed.err.find("; 'allpairs info --partial ./-two.scn' lists it"), std::string::npos) << dashed.err;
}

TEST(DetectScene, APartialResultOfNothingIsBadInput) {
  const TempFolder folder;
  const std::string scene = folder.write("none.scn", R"(<Node name="root"><CollisionPipeline/><BruteForceDetection/>
<Node name="B"><MechanicalObject position="3 0 0"/><SphereCollisionModel name="s" radius="-1"/></Node></Node>)");
  expectFailure(runProgram({"detect", "--partial", scene}), 3, scene + ": no model of it can be placed or read");
  EXPECT_EQ(runProgram({"info", "--partial", scene}).status, 0);
  const std::string empty = folder.write("empty.scn", R"(<Node name="root"><CollisionPipeline/></Node>)");
  EXPECT_EQ(runProgram({"detect", "--partial", empty}).status, 0);
}

TEST(PartialInput, IsNotSilentInAPageOrAReport) {
  const TempFolder folder;
  std::filesystem::create_directory(folder.path() / "parts");
  const std::string parts = folder.path() / "parts";
  const std::string broken = folder.write("parts/broken.stl", "solid\n facet\n");
  const auto runAs = [&](const std::string& command) {
    const std::string output = folder.path() / (command == "view" ? "page.html" : "report");
    std::vector<std::string> words{command, parts, "--partial", "-o", output};
    if (command == "report") words.insert(words.end(), {"--fail-on", "pair"});
    return runProgram(words);
  };
  for (const char* command : {"view", "report"})
    expectFailure(runAs(command), 3, parts + ": no model of it can be placed or read");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "page.html"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "report"));
  std::filesystem::rename(broken, folder.path() / "parts" / "other.stl");
  folder.write("parts/part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const char* command : {"view", "report"}) {
    const ProgramRun run = runAs(command);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err,
              "allpairs: warning: " + parts + ": 1 model left out; 'allpairs info --partial " + parts + "' lists it\n");
  }
}

TEST(PartialInput, OfAFolderOfCadFilesTellsWhatIsLeftOut) {
  const TempFolder folder;
  std::filesystem::create_directory(folder.path() / "cad");
  const std::string cad = folder.path() / "cad";
  const std::string gear = folder.write("cad/gear.step", "ISO-10303-21;");
  expectFailure(runProgram({"detect", cad, "--partial"}), 3, cad + ": no model of it can be placed or read");
  const ProgramRun info = runProgram({"info", cad, "--partial"});
  EXPECT_EQ(info.status, 0) << info.err;
  EXPECT_NE(info.out.find("\n  " + gear + ": has the exact surfaces of a CAD program"), std::string::npos) << info.out;
  const std::string part = folder.write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const ProgramRun both = runProgram({"detect", cad, part, "--partial", "--format", "json"});
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_EQ(Json::parse(both.out)["models"].size(), 1U);
}

TEST(PartialInput, TheCommandThatListsWhatIsLeftOutReadsTheSame) {
  const TempFolder folder;
  std::filesystem::create_directories(folder.path() / "parts" / "more");
  std::filesystem::create_directory(folder.path() / "other folder");
  const std::string parts = folder.path() / "parts";
  const std::string data = folder.path() / "other folder";
  const std::string broken = folder.write("parts/more/broken.obj", "v 0 0\n");
  const std::vector<std::string> options{"--recursive",     "--data",       data,  "--sofa", "22.06",
                                         "--allow-outside", "--max-memory", "64M", parts};
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.end(), options.begin(), options.end());
    return runProgram(words);
  };
  const std::string shown =
      "'allpairs info --partial --recursive --data '" + data + "' --sofa 22.06 --allow-outside --max-memory 64M";
  expectFailure(run({"detect", "--partial"}), 3, shown + "' lists why");
  folder.write("parts/part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(run({"detect", "--partial"}).err,
            "allpairs: warning: " + parts + ": 1 model left out; " + shown + " " + parts + "' lists it\n");
  const ProgramRun info = run({"info", "--partial"});
  EXPECT_NE(info.out.find("\n  " + broken + ":1: "), std::string::npos) << info.out;
}

TEST(DetectScene, AMeshThatIsNotThereTellsWhereElseToSay) {
  const TempFolder folder;
  const std::string scene = folder.write("mesh.scn", R"(<Node name="root"><CollisionPipeline/><BruteForceDetection/>
<MeshOBJLoader name="l" filename="gone.obj"/><MeshTopology src="@l"/><MechanicalObject/><TriangleCollisionModel/></Node>)");
  expectFailure(runProgram({"detect", scene}), 3, "the file 'gone.obj' is nowhere to be found; --data DIR");
}

/// Two spheres that touch, in two nodes with a pipeline each.
const std::string kTwoPipelines = R"(<Node name="root">
<Node name="A"><CollisionPipeline name="p"/><BruteForceDetection/><MinProximityIntersection alarmDistance="2"/>
<Node name="1"><MechanicalObject position="0 0 0"/><SphereCollisionModel name="s" radius="1"/></Node>
<Node name="2"><MechanicalObject position="3 0 0"/><SphereCollisionModel name="s" radius="1"/></Node></Node>
<Node name="B"><CollisionPipeline name="p"/><BruteForceDetection/><DiscreteIntersection/>
<Node name="1"><MechanicalObject position="0 0 0"/><SphereCollisionModel name="s" radius="1"/></Node>
<Node name="2"><MechanicalObject position="1 0 0"/><SphereCollisionModel name="s" radius="1"/></Node>
<Node name="3"><MechanicalObject position="4 0 0"/><SphereCollisionModel name="s" radius="1"/></Node></Node></Node>)";

TEST(DetectScene, EachPipelinePairsItsOwnModels) {
  const TempFolder folder;
  const std::string scene = folder.write("two.scn", kTwoPipelines);
  const ProgramRun run = runProgram({"detect", scene, "--format", "json", "--verify"});
  expectSuccess(run);
  const Json result = Json::parse(run.out);
  EXPECT_EQ(result["models"].size(), 5U);
  EXPECT_EQ(result["pairs"], Json::parse("[[1, 0], [3, 2]]"));
  EXPECT_EQ(result["pipelines"], Json::parse(R"([
    {"name": "/A/p", "method": "MinProximityIntersection", "distance": 2.0, "models": [0, 1], "pairs": 1},
    {"name": "/B/p", "method": "DiscreteIntersection", "distance": 0.0, "models": [2, 3, 4], "pairs": 1}])"));
  EXPECT_EQ(Json::parse(runProgram({"detect", scene, "--format", "json", "--distance", "1"}).out)["pairs"],
            Json::parse("[[1, 0], [3, 2], [4, 3]]"));
  // What is counted of each is counted together: two models and three.
  const Json statistics = result["statistics"];
  EXPECT_EQ(statistics["testsOfAllPairs"], 1 + 3);
  EXPECT_EQ(statistics["candidates"], 1 + 1);
  EXPECT_GT(statistics["detectSeconds"], 0.0);
  const ProgramRun exhaustive = runProgram({"detect", scene, "--format", "json", "--strategy", "exhaustive"});
  EXPECT_EQ(Json::parse(exhaustive.out)["statistics"]["testsMade"], 1 + 3);
}

TEST(DetectScene, SeveralPipelinesAreNotTakenTogetherWithOtherInputs) {
  const TempFolder folder;
  const std::string scene = folder.write("two.scn", kTwoPipelines);
  const std::string why = scene + ": a scene with several collision pipelines cannot be taken together";
  expectFailure(runProgram({"detect", scene, kDemoZones}), 3, why);
  expectFailure(runProgram({"detect", kDemoZones, kDemoScene, scene}), 3, why);
  expectFailure(runProgram({"info", kDemoZones, scene}), 3, why);
  expectFailure(runProgram({"view", scene, "-o", folder.path() / "page.html"}), 2, "several collision pipelines");
}

TEST(DetectScene, ASceneWithoutAPipelineIsTestedAndThatIsSaid) {
  const TempFolder folder;
  const std::string scene = folder.write("none.scn", R"(<Node name="root">
<Node name="A"><MechanicalObject position="0 0 0"/><SphereCollisionModel name="s" radius="1"/></Node>
<Node name="B"><MechanicalObject position="1 0 0"/><SphereCollisionModel name="s" radius="1"/></Node></Node>)");
  const ProgramRun run = runProgram({"detect", scene, "--format", "json"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "allpairs: warning: " + scene +
                         ":1: the scene has no collision pipeline: SOFA detects nothing in it; "
                         "all its models are tested against one another here\n");
  const Json result = Json::parse(run.out);
  EXPECT_EQ(result["pairs"], Json::parse("[[1, 0]]"));
  ASSERT_EQ(result["warnings"].size(), 1U);
  EXPECT_EQ(result["warnings"][0]["line"], 1);
}

TEST(InfoOfAScene, HasContactDistancesAndWhatLiesOutsideOfTheRegion) {
  const TempFolder folder;
  const std::string begin =
      "<Node name='root'><CollisionPipeline/><BruteForceBroadPhase box='-1 -1 -1 1 1 "
      "1'/><BVHNarrowPhase/><CollisionResponse/>"
      "<MinProximityIntersection alarmDistance='0.5'/>"
      "<Node name='A'><MechanicalObject position='0 0 0'/><SphereCollisionModel name='s'/></Node>"
      "<Node name='B'><MechanicalObject position='9 0 0'/><SphereCollisionModel name='s'";
  const ProgramRun plain = runProgram({"info", folder.write("plain.scn", begin + "/></Node></Node>")});
  expectSuccess(plain);
  EXPECT_NE(plain.out.find(R"(
#  name  type          elements  flags    groups  box
0  /A/s  TSphereModel         1  -        -       [-1, -1, -1] to [1, 1, 1]
1  /B/s  TSphereModel         1  outside  -       [8, -1, -1] to [10, 1, 1]
)"),
            std::string::npos)
      << plain.out;
  const ProgramRun near = runProgram({"info", folder.write("near.scn", begin + " proximity='0.25'/></Node></Node>")});
  EXPECT_NE(near.out.find("flags    groups  contact  box\n"), std::string::npos) << near.out;
  EXPECT_NE(near.out.find("outside  -       0.25     ["), std::string::npos) << near.out;
}

TEST(InfoOfAScene, IsReadAsByTheVersionThatReadsAsTheOneThatIsGiven) {
  const TempFolder folder;
  const std::string scene = folder.write("named.scn", R"(<Node name="root"><CollisionPipeline/><BruteForceDetection/>
<Node><MechanicalObject position="0 0 0"/><SphereCollisionModel name="s"/></Node></Node>)");
  const auto read = [&scene](const std::string& version) {
    const ProgramRun run = runProgram({"info", scene, "--sofa", version});
    EXPECT_EQ(run.status, 0) << version << run.err;
    return run.out;
  };
  const std::string before = read("20.06"), after = read("26.12");
  EXPECT_NE(before, after) << "a node without a name has a number, or none";
  for (const char* version : {"19.12", "17.06.02", "v20.06.00", "15.09"}) EXPECT_EQ(read(version), before) << version;
  for (const char* version : {"22.06", "24.06", "24.06.01", "v24.06"}) EXPECT_EQ(read(version), after) << version;
  for (const char* version : {"21.12", "27.06"})
    expectFailure(runProgram({"info", scene, "--sofa", version}), kWrongUsage,
                  "is neither a version up to 20.06 nor one from 22.06 to 26.12");
  for (const char* version : {"22.13", "23.07", "24.6", "24.06.1", "2406", "-1.06", "new", "16.00"})
    expectFailure(runProgram({"info", scene, "--sofa", version}), kWrongUsage,
                  "is no version of SOFA, which are called YY.06 and YY.12");
}

TEST(DetectScene, AMeshThatIsLeftOutIsNamedOnce) {
  const TempFolder folder;
  folder.write("a.obj", "o wheel\x1b[31m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string bad = folder.write("bad.obj", "v 0 0\n");
  const ProgramRun run = runProgram({"info", "--partial", folder.path()});
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.out.find("\n  " + bad + ":1: "), std::string::npos) << run.out;
  EXPECT_EQ(run.out.find("bad.obj"), run.out.rfind("bad.obj")) << run.out;
  EXPECT_NE(run.out.find("wheel\\x1b[31m"), std::string::npos) << run.out;
}

TEST(Demo, ShowsATableOfEveryPairWithoutAComplaint) {
  const ProgramRun run = runProgram({"detect", kDemoScene, kDemoZones, "--verify"});
  expectSuccess(run);
  EXPECT_EQ(run.out.find(" more;"), std::string::npos) << "the demo's table is whole";
  EXPECT_EQ(run.out.find("ignored"), std::string::npos);
  for (const char* pair : {"  /Hose/Rubber             /Hose/Rubber\n", "  /Hammer/Head             /Bench/Top/Beech\n",
                           "  zone/robot               /Robot/Arm/Links\n"}) {
    EXPECT_NE(run.out.find(pair), std::string::npos) << run.out;
  }
  EXPECT_EQ(run.out.find("Van"), std::string::npos) << "what is outside of the region pairs with nobody";
}

TEST(Demo, HasEveryTypeOfModel) {
  const ProgramRun run = runProgram({"detect", kDemoScene, kDemoZones, "--format", "json"});
  expectSuccess(run);
  std::set<std::string> types;
  const Json result = Json::parse(run.out);
  for (const Json& model : result["models"]) types.insert(model["type"]);
  EXPECT_EQ(types, (std::set<std::string>{"BoxModel", "TCapsuleModel", "TLineModel", "TOBBModel", "TPointModel",
                                          "TSphereModel", "TTriangleModel", "TetrahedronModel"}));
}

}  // namespace
}  // namespace allpairs::test
