// SPDX-License-Identifier: MIT
// What --between-inputs leaves out: compared with what is found without it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "Expect.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using Arguments = std::vector<std::string>;
using Json = nlohmann::json;

constexpr std::array<std::size_t, 4> kSizes{12, 0, 9, 15};  // one of the files has no box

std::size_t inputOf(std::size_t model) {
  std::size_t input = 0;
  for (std::size_t end = kSizes[0]; model >= end; end += kSizes[input]) ++input;
  return input;
}

/// Boxes, or triangles, at random places, many of which overlap, in as many files as there are sizes.
Arguments writeInputs(const TempFolder& folder, bool areMeshes) {
  std::mt19937 random(11);
  Arguments paths;
  for (std::size_t file = 0; file < kSizes.size(); ++file) {
    std::string text = areMeshes ? "" : "minx,miny,minz,maxx,maxy,maxz\n";
    for (std::size_t i = 0; i < kSizes[file]; ++i) {
      const auto x = random() % 4;
      const auto y = random() % 4;
      const auto z = random() % 4;
      text += areMeshes
                  ? fmt::format("o {0}\nv {1} {2} {3}\nv {1}.9 {2} {3}\nv {1} {2}.9 {3}.9\nf -3 -2 -1\n", i, x, y, z)
                  : fmt::format("{}.5,{}.5,{}.5,{}.9,{}.9,{}.9\n", x, y, z, x + 1, y + 1, z + 1);
    }
    if (text.empty()) continue;
    paths.push_back(folder.write(fmt::format("input{}.{}", file, areMeshes ? "obj" : "csv"), text));
  }
  return paths;
}

Json detect(Arguments words, const Arguments& more) {
  words.insert(words.begin(), "detect");
  words.insert(words.end(), {"--format", "json", "--verify"});
  words.insert(words.end(), more.begin(), more.end());
  const ProgramRun run = runProgram(words);
  EXPECT_EQ(run.status, 0) << run.err;
  return Json::parse(run.out);
}

Json pairsOfDifferentInputs(const Json& pairs) {
  Json kept = Json::array();
  for (const Json& pair : pairs) {
    if (inputOf(pair[0]) != inputOf(pair[1])) kept.push_back(pair);
  }
  return kept;
}

void expectPairsBetween(const Arguments& paths, const Arguments& more) {
  const Json all = detect(paths, more);
  Arguments between = more;
  between.emplace_back("--between-inputs");
  const Json found = detect(paths, between);
  const Json expected = pairsOfDifferentInputs(all["pairs"]);
  EXPECT_EQ(found["pairs"], expected);
  EXPECT_FALSE(expected.empty());
  for (std::size_t i = 0; i < found["models"].size(); ++i)
    EXPECT_EQ(found["models"][i]["groups"].size(), 1U) << "the group of its input";
  EXPECT_LT(expected.size(), all["pairs"].size());
}

TEST(BetweenInputs, BoxesOfOneFileAreNoPair) {
  const TempFolder folder;
  const Arguments paths = writeInputs(folder, false);
  expectPairsBetween(paths, {});
  expectPairsBetween(paths, {"--strategy", "exhaustive"});
  expectPairsBetween(paths, {"--strategy", "bvh", "--distance", "0.5"});
}

TEST(BetweenInputs, ObjectsOfOneFileAreNoPair) {
  const TempFolder folder;
  const Arguments paths = writeInputs(folder, true);
  expectPairsBetween(paths, {});
  expectPairsBetween(paths, {"--distance", "0.25"});
}

TEST(BetweenInputs, WhyNamesTheGroupOfTheInput) {
  const TempFolder folder;
  const std::string first = folder.write("a.csv", "0,0,0,1,1,1,wall\n0,0,0,1,1,1,door\n");
  const std::string second = folder.write("b.csv", "0,0,0,1,1,1,pipe\n");
  const Arguments words{"detect", first, second, "--between-inputs", "--why"};
  const auto whyOf = [&words](const std::string& a, const std::string& b) {
    Arguments all = words;
    all.insert(all.end(), {a, b});
    return runProgram(all).out;
  };
  EXPECT_NE(whyOf("wall", "door").find("both are in the group 1"), std::string::npos) << whyOf("wall", "door");
  EXPECT_EQ(whyOf("wall", "pipe").find("group"), std::string::npos) << whyOf("wall", "pipe");
}

TEST(BetweenInputs, AReportAndAPageLeaveThemOut) {
  const TempFolder folder;
  const std::string first = folder.write("a.csv", "0,0,0,1,1,1,wall\n0,0,0,1,1,1,door\n");
  const std::string second = folder.write("b.csv", "0,0,0,1,1,1,pipe\n");
  for (const std::string shapes : {"--exact", "--boxes"}) {
    const std::string report = folder.path() / ("report" + shapes);
    const ProgramRun run = runProgram({"report", first, second, "--between-inputs", shapes, "-o", report});
    ASSERT_EQ(run.status, 0) << run.err;
    std::ifstream stream(report + "/clashes.csv");
    const std::string table{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_NE(table.find("pipe,wall"), std::string::npos) << table;
    EXPECT_NE(table.find("pipe,door"), std::string::npos) << table;
    EXPECT_EQ(table.find("door,wall"), std::string::npos) << table;
    const std::string page = folder.path() / ("page" + shapes + ".html");
    EXPECT_EQ(runProgram({"view", first, second, "--between-inputs", shapes, "-o", page}).status, 0);
  }
}

Json sceneIn(const std::string& page) {
  const std::string begin = "id=\"allpairs-scene\">";
  const std::size_t place = page.find(begin) + begin.size();
  return Json::parse(page.substr(place, page.find("</script>", place) - place));
}

/// How many pairs a page says that a rule excludes.
std::size_t excludedIn(const std::string& page) {
  const Json scene = sceneIn(page);
  for (const Json& array : scene["arrays"]) {
    if (array["name"] == "excluded") return array["length"].get<std::size_t>() / 2;
  }
  return 0;
}

TEST(BetweenInputs, APageSaysWhichPairsTheyAre) {
  const TempFolder folder;
  const std::string first = folder.write("a.csv", "0,0,0,1,1,1,wall\n0,0,0,1,1,1,door\n5,0,0,6,1,1,far\n");
  const std::string second = folder.write("b.csv", "0,0,0,1,1,1,pipe\n");
  for (const std::string shapes : {"--boxes", "--exact"}) {
    Arguments words{"view", first, second, shapes};
    EXPECT_EQ(excludedIn(runProgram(words).out), 0U) << shapes;
    words.emplace_back("--between-inputs");
    EXPECT_EQ(excludedIn(runProgram(words).out), 1U) << shapes;
    words.insert(words.end(), {"--box", "0.5,0,0,9,9,9"});
    EXPECT_EQ(excludedIn(runProgram(words).out), 1U) << shapes;
    words.back() = "4,0,0,9,9,9";
    EXPECT_EQ(excludedIn(runProgram(words).out), 0U) << shapes;
  }
}

TEST(BetweenInputs, APageLeavesOutMoreThanAMillionAndSaysSo) {
  const TempFolder folder;
  std::string boxes;
  std::string parts = "v 0 0 0\nv 1 0 0\nv 0 1 1\n";
  for (int i = 0; i < 1500; ++i) {  // in one place: 1,124,250 pairs
    boxes += "0,0,0,1,1,1\n";
    parts += fmt::format("o {}\nf 1 2 3\n", i);
  }
  const std::string one = folder.write("one.csv", "5,0,0,6,1,1\n");
  for (const std::string many : {folder.write("many.csv", boxes), folder.write("many.obj", parts)}) {
    const ProgramRun run = runProgram({"view", many, one, "--between-inputs"});
    expectSuccess(run);
    EXPECT_EQ(excludedIn(run.out), 0U) << many;
    const Json scene = sceneIn(run.out);
    EXPECT_TRUE(scene.contains("leavesOutExcluded") && scene["leavesOutExcluded"]) << many;
    EXPECT_EQ(scene["ignored"], Json::array()) << "nothing of the input";
    const std::string report = many + "-report";
    expectSuccess(runProgram({"report", many, one, "--between-inputs", "-o", report}));
    std::ifstream page(report + "/index.html");
    const std::string text{std::istreambuf_iterator<char>(page), {}};
    EXPECT_EQ(text.find("left out, and not tested"), std::string::npos);
    EXPECT_NE(text.find("No pair was found"), std::string::npos);
  }
}

TEST(BetweenInputs, NeedsTwoInputsThatHaveNoGroups) {
  const TempFolder folder;
  const std::string boxes = folder.write("a.csv", "0,0,0,1,1,1\n");
  const std::string scene = folder.write("a.scn", "<Node name=\"root\"/>");
  expectFailure(runProgram({"detect", boxes, "--between-inputs"}), kWrongUsage,
                "allpairs: --between-inputs leaves out pairs within one input: give two or more");
  expectFailure(runProgram({"report", boxes, scene, "--between-inputs", "-o", folder.path() / "r"}), kWrongUsage,
                "allpairs: --between-inputs is not for SOFA scenes, whose groups say what is no pair: " + scene);
  expectFailure(runProgram({"detect", boxes, "--between-inputs", "--worlds"}), kWrongUsage,
                "allpairs: --between-inputs is of several inputs; --worlds takes one array");
}

}  // namespace
}  // namespace allpairs::test
