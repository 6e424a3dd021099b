// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "Base64.h"
#include "Xml.h"
#include "app/Expect.h"
#include "support/Npy.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using Json = nlohmann::json;

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

TEST(EscapeXml, LeavesNoMarkupAndNoBytesThatXmlLacks) {
  EXPECT_EQ(view::escapeXml("a<b>&\"'c\n"), "a&lt;b&gt;&amp;&quot;&#39;c ");
  EXPECT_EQ(view::escapeXml("\x01\xff"), "\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(view::escapeXml("Größe"), "Größe");
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
  for (std::size_t i = 0; i < result["models"].size(); ++i) EXPECT_EQ(scene["names"][i], result["models"][i]["name"]);
  for (const Json& array : scene["arrays"]) {
    if (array["name"] == "pairs") {
      EXPECT_EQ(array["length"], 2 * result["pairs"].size());
    }
  }
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
  expectFailure(runProgram({"view", input, input}), 2, "boxes over time cannot be put together");
  expectFailure(runProgram({"report", input, "-o", folder.path() / "r"}), 2, "a report is of one moment");
}

TEST(View, IsServedToThisMachineAlone) {
  const ProgramRun run = runScript(
      "\"$0\" view " ALLPAIRS_SOURCE_DIR
      "/examples/boxes.csv --serve > /dev/null 2>&1 & child=$!\n"
      "wait_for() { for i in 1 2 3 4 5 6 7 8 9 10; do sleep 0.2; grep -q . /proc/$child/net/tcp && return; done; }\n"
      "wait_for; inodes=$(ls -l /proc/$child/fd 2>/dev/null | sed -n 's/.*socket:\\[\\([0-9]*\\)\\]/\\1/p')\n"
      "for n in $inodes; do awk -v n=$n '$10 == n && $4 == \"0A\" { print $2 }' /proc/net/tcp; done\n"
      "kill $child");
  if (run.out.empty()) GTEST_SKIP() << "the system does not show its sockets";
  EXPECT_EQ(run.out.substr(0, 9), "0100007F:") << run.out;
}

}  // namespace
}  // namespace allpairs::test
