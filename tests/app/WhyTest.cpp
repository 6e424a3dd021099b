// SPDX-License-Identifier: MIT
// What detect --why says of two models.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "Expect.h"
#include "support/Sanitizers.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using Arguments = std::vector<std::string>;

/// One of each rule, all boxes near one another but those of F and G.
const std::string kRules = R"(<Node name="root"><CollisionPipeline/><BVHNarrowPhase/><CollisionResponse/>
<BruteForceBroadPhase box="-9 -9 -9 30 9 9"/><MinProximityIntersection alarmDistance="0.5"/>
<Node name="A"><MechanicalObject position="0 0 0"/><SphereCollisionModel name="s"/>
<SphereCollisionModel name="t" selfCollision="1"/><SphereCollisionModel name="u" selfCollision="1"/></Node>
<Node name="B"><MechanicalObject position="1 0 0"/><SphereCollisionModel name="s" group="3 4"/></Node>
<Node name="C"><MechanicalObject position="1 1 0"/><SphereCollisionModel name="s" group="4"/></Node>
<Node name="D"><MechanicalObject position="0 1 0"/><SphereCollisionModel name="s" simulated="0"/></Node>
<Node name="E"><MechanicalObject position="0 1 0"/><SphereCollisionModel name="s" simulated="0"/></Node>
<Node name="F"><MechanicalObject position="20 0 0"/><SphereCollisionModel name="s" contactDistance="0.25"/></Node>
<Node name="G"><MechanicalObject position="50 0 0"/><SphereCollisionModel name="s"/></Node>
<Node name="H"><MechanicalObject position="0 1 0"/><SphereCollisionModel name="s" active="0"/></Node>
<Node name="I"><MechanicalObject position="22.75 0 0"/><SphereCollisionModel name="s"/></Node></Node>)";

std::string whyOf(const std::string& input, const std::string& a, const std::string& b, const Arguments& more = {}) {
  Arguments words{"detect", input, "--why", a, b};
  words.insert(words.end(), more.begin(), more.end());
  const ProgramRun run = runProgram(words);
  EXPECT_EQ(run.status, 0) << run.err;
  return run.out;
}

/// Whether the program is asked of a pair: of each, but with a sanitizer, if there are many models, of a third of them.
bool isAsked(std::size_t first, std::size_t second, std::size_t models) {
  return !kIsSanitized || models < 8 || (first + second) % 3 == 1;
}

/// The pairs that --why calls pairs, of all there could be, must be those that detect lists.
void expectSamePairs(const std::string& input, const Arguments& more = {}) {
  Arguments words{"detect", input, "--format", "json"};
  words.insert(words.end(), more.begin(), more.end());
  const auto result = nlohmann::json::parse(runProgram(words).out);
  const std::size_t count = result["models"].size();
  std::set<std::pair<std::size_t, std::size_t>> expected;
  for (const auto& pair : result["pairs"]) {
    const auto first = pair[0].get<std::size_t>();
    const auto second = pair[1].get<std::size_t>();
    if (isAsked(first, second, count)) expected.emplace(std::min(first, second), std::max(first, second));
  }
  std::set<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i; k < count; ++k) {
      if (!isAsked(i, k, count)) continue;
      const std::string why = whyOf(input, std::to_string(i), std::to_string(k), more);
      if (why.find(" a pair") != std::string::npos && why.find(" no pair") == std::string::npos) found.emplace(i, k);
    }
  }
  EXPECT_EQ(found, expected) << input;
}

TEST(Why, SaysOfAllPairsOfASceneWhatDetectFinds) {
  const TempFolder folder;
  const std::string scene = folder.write("rules.scn", kRules);
  expectSamePairs(scene);
  expectSamePairs(scene, {"--distance", "30"});
  expectSamePairs(scene, {"--box", "-9,-9,-9,0.25,9,9"});
}

TEST(Why, SaysOfAllPairsOfASceneOfFlatModelsWhatDetectFinds) {
  expectSamePairs(ALLPAIRS_SOURCE_DIR "/tests/view/flat.scn");
}

TEST(Why, SaysOfAllPairsOfBoxesWhatDetectFinds) {
  const TempFolder folder;
  const std::string boxes =
      folder.write("boxes.csv", "a,0,0,0,1,1,1\nb,1,1,1,2,2,2\nc,2.5,0,0,3,1,1\nempty,1,0,0,0,1,1\nd,0,0,0,inf,9,9\n");
  expectSamePairs(boxes);
  expectSamePairs(boxes, {"--distance", "0.5"});
  expectSamePairs(boxes, {"--distance", "-0.5"});
  expectSamePairs(boxes, {"--box", "0,0,0,0.5,1,1"});
}

TEST(Why, NamesTheRule) {
  const TempFolder folder;
  const std::string scene = folder.write("rules.scn", kRules);
  const auto expectReason = [&scene](const std::string& a, const std::string& b, const std::string& reason) {
    EXPECT_NE(whyOf(scene, a, b).find(reason), std::string::npos) << whyOf(scene, a, b);
  };
  expectReason("/A/s", "/B/s", "'/B/s' (3) and '/A/s' (0) are a pair: their boxes are near enough");
  expectReason("/A/s", "/A/t", "no pair: both are of one node or body, '/A', and selfCollision of '/A/s' (0) is off");
  expectReason("/A/u", "/A/t", "are a pair: ");
  expectReason("/B/s", "/C/s", "are no pair: both are in the group 4\n");
  expectReason("/D/s", "/E/s", "are no pair: neither of them is simulated\n");
  expectReason("/A/s", "/G/s", "are no pair: '/G/s' (8) is outside of the region [-9, -9, -9] to [30, 9, 9]\n");
  EXPECT_NE(whyOf(scene, "/A/t", "/F/s", {"--box", "-9,-9,-9,0.25,9,9"})
                .find("'/F/s' (7) is outside of the region [-9, -9, -9] to [0.25, 9, 9]"),
            std::string::npos)
      << "--box in place of the scene's";
  expectReason("/A/s", "/H/s", "are no pair: '/H/s' (9) is not active\n");
  expectReason("/A/s", "/A/s", "'/A/s' (0) is no pair with itself: it may not collide with itself");
  expectReason("1", "1", "'/A/t' (1) is a pair with itself: selfCollision is on\n");
  expectReason("/F/s", "10",
               "'/I/s' (10) and '/F/s' (7) are a pair: their boxes are near enough, and no rule excludes them\n"
               "  gaps of the boxes: 0.5 on x, -2.25 on y, -2.25 on z, below 0 where they overlap; a pair has at most "
               "0.75\n");
  EXPECT_EQ(whyOf(scene, "/F/s", "/A/s"),
            "'/F/s' (7) and '/A/s' (0) are no pair: their boxes are too far apart\n"
            "  gaps of the boxes: 17.75 on x, -2.25 on y, -2.25 on z, below 0 where they overlap; a pair has at most "
            "0.75\n");
}

TEST(Why, NamesAnEmptyBox) {
  const TempFolder folder;
  const std::string boxes = folder.write("boxes.csv", "a,0,0,0,1,1,1\nempty,1,0,0,0,1,1\n");
  EXPECT_EQ(whyOf(boxes, "a", "empty"),
            "'empty' (1) and 'a' (0) are no pair: the box of 'empty' (1) is empty: its min is above its max\n");
}

TEST(Why, BoxesAtTheSameInfinityAreNear) {
  const TempFolder folder;
  const std::string boxes = folder.write("boxes.csv", "a,inf,0,0,inf,1,1\nb,0,0,0,inf,1,1\n");
  EXPECT_EQ(whyOf(boxes, "a", "b"),
            "'b' (1) and 'a' (0) are a pair: their boxes are near enough, and no rule excludes them\n"
            "  gaps of the boxes: -inf on x, -1 on y, -1 on z, below 0 where they overlap; a pair has at most 0\n");
}

TEST(Why, TakesANumberWhereNamesAreNumbersToo) {
  const TempFolder folder;
  const std::string names =
      folder.write("names.csv", "name,minx,miny,minz,maxx,maxy,maxz\n1,0,0,0,1,1,1\n0,5,5,5,6,6,6\n");
  EXPECT_NE(whyOf(names, "1", "0").find("'1' (0) "), std::string::npos) << "by name";
  EXPECT_NE(whyOf(names, "#1", "0").find("'0' (1) is no pair with itself"), std::string::npos)
      << whyOf(names, "#1", "0");
}

TEST(Why, SaysThatADistanceKeepsAModelFromItself) {
  const TempFolder folder;
  const std::string scene = folder.write("rules.scn", kRules);
  EXPECT_NE(whyOf(scene, "/A/t", "/A/t", {"--distance", "-5"}).find("at a distance below 0"), std::string::npos);
}

TEST(Why, SaysWhichDistanceOrFlatnessItIs) {
  const TempFolder folder;
  const std::string boxes = folder.write("boxes.csv", "a,0,0,0,1,1,1\nb,0.75,0,0,2,1,1\n");
  EXPECT_EQ(whyOf(boxes, "a", "b", {"--distance", "-0.5"}),
            "'b' (1) and 'a' (0) are no pair: their boxes are too far apart\n"
            "  gaps of the boxes: -0.25 on x, -1 on y, -1 on z, below 0 where they overlap; a pair has at most -0.5\n");
  EXPECT_EQ(whyOf(ALLPAIRS_SOURCE_DIR "/tests/view/flat.scn", "/Flat/t", "/Flat/t"),
            "'/Flat/t' (0) is no pair with itself: it is too flat to touch itself\n");
}

TEST(Why, ListsUpToFiveModelsOfAName) {
  const TempFolder folder;
  std::string rows = "a,0,0,0,1,1,1\n";
  const auto complaint = [&] { return runProgram({"detect", folder.write("boxes.csv", rows), "--why", "a", "b"}).err; };
  for (int i = 0; i < 5; ++i) rows += "b,0,0,0,1,1,1\n";
  EXPECT_EQ(complaint(),
            "allpairs: --why: 5 models are called 'b': number 1, 2, 3, 4, 5; say which by its number, as in #1 "
            "(see 'allpairs detect --help')\n");
  rows += "b,0,0,0,1,1,1\n";
  EXPECT_EQ(complaint(),
            "allpairs: --why: 6 models are called 'b': number 1, 2, 3, 4, 5, ...; say which by its number, as in #1 "
            "(see 'allpairs detect --help')\n");
}

TEST(Why, WantsNamesThatSayWhichModel) {
  const TempFolder folder;
  const std::string boxes = folder.write("boxes.csv", "a,0,0,0,1,1,1\nb,0,0,0,1,1,1\nb,0,0,0,1,1,1\n");
  expectFailure(runProgram({"detect", boxes, "--why", "a", "c"}), kWrongUsage,
                "--why: of 3 models, none has the name or the number 'c'; 'allpairs info' lists them");
  expectFailure(runProgram({"detect", boxes, "--why", "a", "3"}), kWrongUsage, "none has the name or the number '3'");
  expectFailure(runProgram({"detect", boxes, "--why", "a"}), kWrongUsage, "--why takes two values, and got one (see");
  expectFailure(runProgram({"detect", boxes, "--why"}), kWrongUsage, "--why: MODEL is missing (see");
  expectFailure(runProgram({"detect", boxes, "--why", "a", "2", "--format", "csv"}), kWrongUsage,
                "it takes no format csv");
  expectFailure(runProgram({"detect", boxes, "--why", "a", "2", "--verify"}), kWrongUsage, "it takes no --verify");
  expectFailure(runProgram({"detect", boxes, "--why", "a", "2", "--threads", "2"}), kWrongUsage,
                "it takes no --threads");
  expectFailure(runProgram({"detect", boxes, "--why", "a", "2", "--strategy", "bvh"}), kWrongUsage,
                "it takes no --strategy");
}

TEST(Why, AnswersForEachPipelineThatTakesBoth) {
  const TempFolder folder;
  const std::string scene = folder.write("two.scn", R"(<Node name="root">
<CompositeCollisionPipeline subCollisionPipelines="@p1 @p2"/><CollisionResponse name="r"/><BVHNarrowPhase name="n"/>
<BruteForceBroadPhase name="b"/><DiscreteIntersection name="m"/><MinProximityIntersection name="m2" alarmDistance="9"/>
<SubCollisionPipeline name="p1" collisionModels="@A/s @B/s" broadPhaseDetection="@b" narrowPhaseDetection="@n"
 intersectionMethod="@m" contactManager="@r"/>
<SubCollisionPipeline name="p2" collisionModels="@A/s @B/s @C/s" broadPhaseDetection="@b" narrowPhaseDetection="@n"
 intersectionMethod="@m2" contactManager="@r"/>
<Node name="A"><MechanicalObject position="0 0 0"/><SphereCollisionModel name="s"/></Node>
<Node name="B"><MechanicalObject position="3 0 0"/><SphereCollisionModel name="s"/></Node>
<Node name="C"><MechanicalObject position="3 0 0"/><SphereCollisionModel name="s"/></Node>
<Node name="D"><MechanicalObject position="3 0 0"/><SphereCollisionModel name="s"/></Node></Node>)");
  const std::string both = whyOf(scene, "/A/s", "/B/s");
  EXPECT_NE(both.find("in /p1: '/B/s' (1) and '/A/s' (0) are no pair"), std::string::npos) << both;
  EXPECT_NE(both.find("in /p2: '/B/s' (1) and '/A/s' (0) are a pair"), std::string::npos) << both;
  EXPECT_TRUE(whyOf(scene, "/A/s", "/C/s").starts_with("in /p2: ")) << whyOf(scene, "/A/s", "/C/s");
}

}  // namespace
}  // namespace allpairs::test
