// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "Base64.h"
#include "PageSize.h"
#include "Text.h"
#include "allpairs/Error.h"
#include "app/Expect.h"
#include "support/Npy.h"
#include "support/Numbers.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

std::string base64(const std::string& bytes) {
  std::string text;
  view::writeBase64(bytes, [&text](std::string_view part) { text += part; });
  return text;
}

/// What stands in the page between a script element's tags.
std::string scriptOf(const std::string& page, const std::string& id) {
  const std::string begin = "id=\"" + id + "\">";
  const std::size_t place = page.find(begin) + begin.size();
  return page.substr(place, page.find("</script>", place) - place);
}

TEST(Base64, GivesTheTextsOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
  EXPECT_EQ(base64(std::string(600'001, 'a')).size(), 800'004U);
}

TEST(EscapeHtml, LeavesNoMarkupAndNoBytesThatHtmlLacks) {
  EXPECT_EQ(view::escapeHtml("a<b>&\"'c\n"), "a&lt;b&gt;&amp;&quot;&#39;c ");
  EXPECT_EQ(view::escapeHtml("\x01\xff"), "\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(view::escapeHtml("Größe"), "Größe");
}

TEST(View, WritesNamesAsDataThatCannotEndTheScript) {
  const TempFolder folder;
  const std::string input =
      folder.write("a.obj", "o </script><img src=x onerror=alert(1)><!--\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const ProgramRun run = runProgram({"view", input});
  expectSuccess(run);
  EXPECT_EQ(run.out.find("<img"), std::string::npos);
  const Json scene = Json::parse(scriptOf(run.out, "allpairs-scene"));
  EXPECT_EQ(scene["names"][0], "</script><img src=x onerror=alert(1)><!--");
}

TEST(View, HasTheModelsAndPairsOfDetect) {
  const std::string input = ALLPAIRS_SOURCE_DIR "/examples/scenes/demo.scn";
  const Json scene = Json::parse(scriptOf(runProgram({"view", input}).out, "allpairs-scene"));
  const Json result = Json::parse(runProgram({"detect", input, "--format", "json"}).out);
  EXPECT_EQ(scene["models"], result["models"].size());
  EXPECT_EQ(scene["isExact"], false) << "of a SOFA scene, unless shapes are asked for";
#ifdef ALLPAIRS_HAS_FCL
  for (const Words& words : {Words{"view", input, "--exact"}, Words{"view", input, "--clearance", "0"}})
    EXPECT_EQ(Json::parse(scriptOf(runProgram(words).out, "allpairs-scene"))["isExact"], true);
#endif
  for (std::size_t i = 0; i < result["models"].size(); ++i) EXPECT_EQ(scene["names"][i], result["models"][i]["name"]);
  std::vector<Json> lengths;
  for (const Json& array : scene["arrays"]) {
    if (array["name"] == "pairs") lengths.push_back(array["length"]);
  }
  EXPECT_EQ(lengths, std::vector<Json>{2 * result["pairs"].size()});
}

TEST(View, NeedsNoNetworkAndForbidsIt) {
  const ProgramRun run = runProgram({"view", ALLPAIRS_SOURCE_DIR "/examples/boxes.csv"});
  expectSuccess(run);
  EXPECT_NE(run.out.find("default-src 'none'; script-src 'sha256-"), std::string::npos);
  for (const char* attribute : {"src=\"http", "href=\"http", "url(http", "@import"}) {
    EXPECT_EQ(run.out.find(attribute), std::string::npos) << attribute;
  }
}

TEST(View, BoxesOverTimeGiveFramesAndStandAlone) {
  const TempFolder folder;
  const std::vector<Box> boxes{
      {{0, 0, 0}, {1, 1, 1}}, {{2, 0, 0}, {3, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}};
  const std::string input = folder.write("f.npy", npyBytes(boxes, {.shape = "(2, 2, 6)"}));
  const ProgramRun run = runProgram({"view", input});
  expectSuccess(run);
  EXPECT_EQ(Json::parse(scriptOf(run.out, "allpairs-scene"))["frames"], 2);
  expectFailure(runProgram({"view", input, input}), 2, "an array of frames must be the only input");
  const std::string late =
      folder.write("late.npy", npyBytes({boxes[0], {{kNan, 0, 0}, {1, 1, 1}}}, {.shape = "(2, 1, 6)"}));
  expectFailure(runProgram({"report", late, "-o", folder.path() / "r"}), 2, "a report shows one frame");
  for (const Words& words : {Words{"--partial"}, {"--recursive"}, {"--data", folder.path()}, {"--group", "file"}}) {
    Words all{"view", input};
    all.insert(all.end(), words.begin(), words.end());
    expectFailure(runProgram(all), 2, words.front() + " does not apply to an array of frames");
  }
  expectFailure(runProgram({"view", input, "--port", "80"}), 2, "--port requires --serve");
  expectFailure(runProgram({"view", input, "--max-memory", "100"}), 3, "f.npy: needs more memory than --max-memory");
  expectFailure(runProgram({"view", late, "-o", folder.path() / "none/a.html"}), 3, "a.html: cannot be created");
}

constexpr const char* kTwoTriangles = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 {}\nv 1 0 {}\nv 0 1 {}\nf 1 2 3\nf 4 5 6\n";

std::string twoTriangles(const std::string& height) {
  return std::regex_replace(std::string(kTwoTriangles), std::regex("\\{\\}"), height);
}

TEST(View, MeshesOverTimeHaveThePairsThatTrackCounts) {
  const TempFolder folder;
  std::vector<std::string> words{"view", "--sequence", "--distance", "0.1"};
  for (const char* height : {"1", "0.05", "0", "0.3"}) {
    words.push_back(folder.write(std::to_string(words.size()) + ".obj", twoTriangles(height)));
  }
  const ProgramRun run = runProgram(words);
  expectSuccess(run);
  const Json scene = Json::parse(scriptOf(run.out, "allpairs-scene"));
  EXPECT_EQ(scene["models"], 2);
  EXPECT_EQ(scene["frames"], 4);
  EXPECT_EQ(scene["names"], (std::vector<std::string>{"triangle 0", "triangle 1"}));
  words[0] = "track";
  words[1] = "--format=json";
  const Json track = Json::parse(runProgram(words).out);
  EXPECT_EQ(track["pairs"], (std::vector<int>{0, 1, 1, 0}));
  const auto arrayOf = [&scene](const std::string& name) {
    for (const Json& array : scene["arrays"]) {
      if (array["name"] == name) return array;
    }
    return Json();
  };
  EXPECT_EQ(arrayOf("pairs")["length"], 4);
  EXPECT_EQ(arrayOf("boxes")["length"], 0) << "the page makes them from the positions";
  EXPECT_EQ(arrayOf("positions")["length"], 4 * 6 * 3);
  EXPECT_EQ(arrayOf("positions")["type"], "Float64") << "0.05 is no float32";
}

TEST(View, SaysWhatIsWrongWithMeshesOverTime) {
  const TempFolder folder;
  const std::string two = folder.write("two.obj", twoTriangles("1"));
  const std::string one = folder.write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  expectFailure(runProgram({"view", "--sequence", two, one}), 3, "one.obj");
  expectFailure(runProgram({"view", "--sequence", two, "--partial"}), 2, "--partial does not apply to --sequence");
  expectFailure(runProgram({"view", "--sequence", two, "--recursive"}), 2, "--recursive does not apply to --sequence");
  expectFailure(runProgram({"view", "--sequence", two, "--sofa", "20.06"}), 2, "--sofa does not apply to --sequence");
  expectFailure(runProgram({"view", "--sequence", two, "--group", "file"}), 2, "--group does not apply to --sequence");
}

TEST(PageSize, MoreThanAPageHoldsIsRefusedWithAdvice) {
  view::ViewScene scene;
  scene.modelCount = 7;
  scene.title = "a.obj";
  view::checkPageSize(scene, 1, 1U << 20U);
  const auto complaint = [&scene](std::size_t frames) {
    try {
      view::checkPageSize(scene, frames, std::size_t{1} << 30U);
      return std::string();
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  EXPECT_TRUE(complaint(1).starts_with("a.obj: 7 models ")) << complaint(1);
  EXPECT_NE(complaint(1).find("a smaller distance, or fewer inputs"), std::string::npos) << complaint(1);
  EXPECT_NE(complaint(2).find("fewer frames, or a smaller distance"), std::string::npos) << complaint(2);
  scene.corners = {0, 1, 2};
  EXPECT_NE(complaint(1).find("fewer frames, or a smaller distance"), std::string::npos) << "the first of a sequence";
}

TEST(PageSize, CountsPositionsAsFloatsWhereTheyAreAndBoxesWhereThereAreNone) {
  view::ViewFrame frame;
  frame.boxes.resize(3);
  frame.flags.resize(3);
  EXPECT_EQ(view::bytesOf(frame, 2), 3 * 48U + 3U + 2 * 8U);
  frame.positions = {1.0, 2.5, -0.125};
  EXPECT_EQ(view::bytesOf(frame, 0), 3 * 4U + 3U);
  frame.positions[1] = 0.1;
  EXPECT_EQ(view::bytesOf(frame, 0), 3 * 8U + 3U);
}

}  // namespace
}  // namespace allpairs::test
