// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "Expect.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using Json = nlohmann::json;

/// Two models near the origin and one far off; the region has the first two.
std::string sceneWith(const std::string& pipeline) {
  return "<Node name='root'>" + pipeline +
         "<Node name='A'><MechanicalObject position='0 0 0'/><SphereCollisionModel name='s'/></Node>"
         "<Node name='B'><MechanicalObject position='1 0 0'/><SphereCollisionModel name='s'/></Node>"
         "<Node name='C'><MechanicalObject position='9 0 0'/><SphereCollisionModel name='s'/></Node></Node>";
}

const std::string kOnePipeline =
    "<CollisionPipeline/><BruteForceBroadPhase box='-2 -2 -2 3 2 2'/><BVHNarrowPhase/><CollisionResponse/>"
    "<MinProximityIntersection alarmDistance='0.5'/>";

/// The region is that of the first pipeline, which takes A and C; the second takes B and C.
const std::string kTwoRegions =
    "<CompositeCollisionPipeline subCollisionPipelines='@p1 @p2'/><CollisionResponse name='r'/>"
    "<BVHNarrowPhase name='n'/><BruteForceBroadPhase name='b1' box='-2 -2 -2 3 2 2'/>"
    "<BruteForceBroadPhase name='b2' box='-2 -2 -2 0.5 2 2'/><DiscreteIntersection name='m'/>"
    "<SubCollisionPipeline name='p1' collisionModels='@A/s @C/s' broadPhaseDetection='@b1' "
    "narrowPhaseDetection='@n' intersectionMethod='@m' contactManager='@r'/>"
    "<SubCollisionPipeline name='p2' collisionModels='@B/s' broadPhaseDetection='@b2' "
    "narrowPhaseDetection='@n' intersectionMethod='@m' contactManager='@r'/>";

TEST(InfoAsJson, HasTheModelsOfDetectAndWhichLieOutside) {
  const TempFolder folder;
  const std::string scene = folder.write("a.scn", sceneWith(kOnePipeline));
  const ProgramRun run = runProgram({"info", scene, "--format", "json"});
  expectSuccess(run);
  Json info = Json::parse(run.out);
  const Json detected = Json::parse(runProgram({"detect", scene, "--format", "json"}).out);
  std::vector<bool> outside;
  for (Json& model : info["models"]) {
    outside.push_back(model["outside"]);
    model.erase("outside");
  }
  EXPECT_EQ(outside, (std::vector<bool>{false, false, true}));
  EXPECT_EQ(info["models"], detected["models"]);
  EXPECT_EQ(info["ignored"], detected["ignored"]);
  EXPECT_EQ(info["warnings"], detected["warnings"]);
  EXPECT_EQ(info["statistics"], Json::parse(R"({"models": 3, "elements": 3, "box": [[-1, -1, -1], [10, 1, 1]],
    "region": [[-2, -2, -2], [3, 2, 2]], "method": "MinProximityIntersection", "distance": 0.5})"));
}

TEST(InfoAsJson, HasEveryBoxOfAnArray) {
  const TempFolder folder;
  std::string rows;
  for (int i = 0; i < 30; ++i) rows += "b" + std::to_string(i) + ",0,0,0,1,1," + std::to_string(i) + "\n";
  const ProgramRun run = runProgram({"info", folder.write("boxes.csv", rows), "--format", "json"});
  expectSuccess(run);
  const Json info = Json::parse(run.out);
  ASSERT_EQ(info["models"].size(), 30U);
  EXPECT_EQ(info["models"][29]["name"], "b29");
  EXPECT_EQ(info["statistics"], Json::parse(R"({"models": 30, "elements": 30, "box": [[0, 0, 0], [1, 1, 29]],
    "method": "DiscreteIntersection", "distance": 0.0})"));
}

TEST(InfoAsJson, GoesToAFileByItsName) {
  const TempFolder folder;
  const std::string boxes = folder.write("boxes.csv", "0,0,0,1,1,1\n");
  const std::string file = folder.path() / "info.json";
  expectSuccess(runProgram({"info", boxes, "-o", file}));
  EXPECT_EQ(readBytes(file), runProgram({"info", boxes, "--format", "json"}).out);
  expectFailure(runProgram({"info", boxes, "-o", boxes}), kWrongUsage, "ends in no format");
  expectFailure(runProgram({"info", boxes, "--format", "json", "-o", boxes}), 3, "is an input");
}

TEST(InfoAsATable, HasTwentyBoxesAndTheNumberOfTheOthers) {
  const TempFolder folder;
  std::string rows = "b0,0,0,0,1,1,0.5\nb1,0,0,0,1,1,1\n";
  const auto infoOf = [&] { return runProgram({"info", folder.write("boxes.csv", rows)}).out; };
  EXPECT_EQ(infoOf(),
            "models   2 boxes, float64\nbox      [0, 0, 0] to [1, 1, 1]\n\n"
            "#  name  type      elements  flags  groups  box\n"
            "0  b0    BoxModel         1  -      -       [0, 0, 0] to [1, 1, 0.5]\n"
            "1  b1    BoxModel         1  -      -       [0, 0, 0] to [1, 1, 1]\n");
  for (int i = 2; i < 20; ++i) rows += 'b' + std::to_string(i) + ",0,0,0,1,1,1\n";
  EXPECT_TRUE(infoOf().ends_with("\n19  b19   BoxModel         1  -      -       [0, 0, 0] to [1, 1, 1]\n"))
      << infoOf();
  rows += "last,0,0,0,1,1,1\n";
  EXPECT_TRUE(infoOf().ends_with("[0, 0, 0] to [1, 1, 1]\n... and 1 more; --format json gives all\n")) << infoOf();
}

TEST(InfoOfPipelines, SaysWhatLiesOutsideOfTheRegionsOfEach) {
  const TempFolder folder;
  const std::string scene = folder.write("two.scn", sceneWith(kTwoRegions));
  const ProgramRun run = runProgram({"info", scene, "--format", "json"});
  EXPECT_EQ(run.status, 0) << run.err;
  const Json info = Json::parse(run.out);
  std::vector<std::pair<std::string, bool>> outside;
  for (const Json& model : info["models"]) outside.emplace_back(model["name"], model["outside"]);
  EXPECT_EQ(outside, (std::vector<std::pair<std::string, bool>>{{"/A/s", false}, {"/C/s", true}, {"/B/s", false}}));
  EXPECT_EQ(info["pipelines"], Json::parse(R"([
    {"name": "/p1", "method": "DiscreteIntersection", "distance": 0.0, "region": [[-2, -2, -2], [3, 2, 2]],
     "models": [0, 1]},
    {"name": "/p2", "method": "DiscreteIntersection", "distance": 0.0, "region": [[-2, -2, -2], [0.5, 2, 2]],
     "models": [2]}])"));
  EXPECT_FALSE(info["statistics"].contains("region")) << "each pipeline has its own";
  EXPECT_NE(runProgram({"info", scene}).out.find("1  /C/s  TSphereModel         1  outside"), std::string::npos);
}

TEST(InfoOfPipelines, WhatLiesInTheRegionOfOneIsNotOutside) {
  std::string pipelines = kTwoRegions;  // the second takes C too, and its region has it
  pipelines.replace(pipelines.find("'@B/s'"), 6, "'@B/s @C/s'");
  pipelines.replace(pipelines.find("0.5 2 2"), 7, "20 2 2");
  const TempFolder folder;
  const std::string scene = folder.write("two.scn", sceneWith(pipelines));
  const ProgramRun run = runProgram({"info", scene, "--format", "json"});
  EXPECT_EQ(run.status, 0) << run.err;
  const Json info = Json::parse(run.out);
  EXPECT_EQ(info["pipelines"][1]["models"], Json::parse("[2, 1]"));
  ASSERT_EQ(info["models"].size(), 3U);
  for (const Json& model : info["models"]) EXPECT_EQ(model["outside"], false) << model;
}

}  // namespace
}  // namespace allpairs::test
