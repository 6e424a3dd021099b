// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "Expect.h"
#include "support/Data.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using ::testing::HasSubstr;

#ifdef ALLPAIRS_HAS_FCL

/// A file with one cuboid, named as the file, from `min` to `max` along x and from 0 to 1 along y and z.
void writePart(const std::filesystem::path& folder, const std::string& name, double min, double max,
               double margin = 0.0) {
  std::ofstream file(folder / (name + ".obj"));
  file << "o " << name << '\n';
  for (const double z : {margin, 1.0 - margin}) {
    for (const double y : {margin, 1.0 - margin})
      file << "v " << min << ' ' << y << ' ' << z << "\nv " << max << ' ' << y << ' ' << z << '\n';
  }
  file << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

/// Parts with known answers: two clash by 0.125, one touches, one is a quarter off, and one is within another.
class Exact : public ::testing::Test {
 protected:
  Exact() {
    writePart(parts(), "a-plate", 0.0, 1.0);
    writePart(parts(), "b-bracket", 0.875, 2.0);
    writePart(parts(), "c-shim", 2.0, 3.0);
    writePart(parts(), "d-far", 3.25, 4.0);
    writePart(parts(), "e-pin", 0.25, 0.5, 0.25);
  }

  [[nodiscard]] std::filesystem::path parts() const { return m_folder.path(); }

  [[nodiscard]] ProgramRun detect(std::vector<std::string> options) const {
    options.insert(options.begin(), {"detect", parts().string(), "--exact", "--distance", "0.25"});
    return runProgram(options);
  }

 private:
  TempFolder m_folder;
};

TEST_F(Exact, TheTableSaysWhichPartsClashWhereAndHowDeepAndHowFarTheOthersAre) {
  const ProgramRun run = detect({});
  expectSuccess(run);
  EXPECT_THAT(run.out,
              HasSubstr("pairs    4 by their boxes; by their shapes 2 clashes (1 contained), 1 touching, 1 apart\n\n"
                        "  contained    e-pin       a-plate     0.5 deep at "));
  EXPECT_THAT(run.out,
              ::testing::ContainsRegex("e-pin       a-plate     0.5 deep at [^\n]*; the first is in the second\n"));
  EXPECT_THAT(run.out, HasSubstr("\n  clash        b-bracket   a-plate     0.125 deep at (0.9375, "));
  EXPECT_THAT(run.out, HasSubstr("\n  touching     c-shim      b-bracket   at (2, 0.5, 0.5)\n"
                                 "  apart        d-far       c-shim      0.25 between (3.25, "));
}

TEST_F(Exact, CsvHasALineForEachCandidate) {
  const ProgramRun run = detect({"--format", "csv"});
  expectSuccess(run);
  EXPECT_TRUE(
      run.out.starts_with("first,second,state,distance,depth,x1,y1,z1,x2,y2,z2,nx,ny,nz,contacts\n"
                          "b-bracket,a-plate,clash,0,0.125,0.875,"))
      << run.out;
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 5);
  EXPECT_THAT(run.out, HasSubstr("\nd-far,c-shim,apart,0.25,,3.25,"));
}

TEST_F(Exact, JsonHasWhatTheShapesSayForEachPairBesidesAllElse) {
  const ProgramRun run = detect({"--format", "json"});
  expectSuccess(run);
  const auto result = nlohmann::json::parse(run.out);
  ASSERT_EQ(result["pairs"].size(), 4U);
  ASSERT_EQ(result["exact"].size(), 4U);
  EXPECT_EQ(result["models"].size(), 5U);
  EXPECT_EQ(result["exact"][0]["state"], "clash");
  EXPECT_EQ(result["exact"][0]["depth"], 0.125);
  EXPECT_EQ(result["exact"][0]["contactBox"], nlohmann::json::parse("[[0.875,0,0],[1,1,1]]"));
  EXPECT_EQ(result["exact"][3]["state"], "contained");
  EXPECT_EQ(result["exact"][3]["inner"], 0);
  EXPECT_FALSE(result["exact"][0].contains("inner"));
  EXPECT_EQ(result["exact"][1]["state"], "touching");
  EXPECT_EQ(result["exact"][2]["distance"], 0.25);
  EXPECT_EQ(result["exact"][2]["depth"], nullptr);
  EXPECT_EQ(result["exactStatistics"]["falseShare"], 0.25);
  EXPECT_EQ(result["exactStatistics"]["clashes"], 2);
  EXPECT_EQ(result["exact"][0]["open"], nlohmann::json::parse("[false, false]"));
}

TEST_F(Exact, TheSameShapeInTheSamePlaceIsTheMostSeriousAndComesFirst) {
  writePart(parts(), "f-bracket", 0.875, 2.0);
  const ProgramRun run = detect({});
  expectSuccess(run);
  EXPECT_THAT(run.out, HasSubstr("pairs    7 by their boxes; by their shapes 4 clashes (1 duplicate, 1 contained), 2 "
                                 "touching, 1 apart\n\n"
                                 "  duplicate    f-bracket   b-bracket   the same shape at (1.4375, 0.5, 0.5)\n"
                                 "  contained "));
}

TEST_F(Exact, WhatIsApartByNoMoreThanTheClearanceIsWithinIt) {
  const ProgramRun run = runProgram({"detect", parts().string(), "--exact", "--clearance", "0.25"});
  expectSuccess(run);
  EXPECT_THAT(run.out, HasSubstr("1 touching, 1 within the clearance\n\n"));
  EXPECT_THAT(run.out, HasSubstr("\n  clearance    d-far       c-shim      0.25 between (3.25, "));
  // A distance that is larger than the clearance keeps its candidates.
  EXPECT_THAT(detect({"--clearance", "0.125"}).out, HasSubstr("1 touching, 1 apart\n\n"));
  expectFailure(runProgram({"detect", parts().string(), "--clearance", "1"}), 2, "add --exact, or use --distance");
  expectFailure(runProgram({"detect", parts().string(), "--exact", "--clearance", "-1"}), 2,
                "--clearance: '-1' is not a distance from 0 on");
}

TEST_F(Exact, WhatIsToBeRepairedIsRedAndWhatIsToBeNotedIsYellow) {
  const std::string text = detect({"--color", "always"}).out;
  EXPECT_THAT(text, HasSubstr("\n  \033[1;31mcontained "));
  EXPECT_THAT(text, HasSubstr("\n  \033[1;31mclash "));
  EXPECT_THAT(text, HasSubstr("\n  \033[33mtouching "));
  EXPECT_THAT(text, HasSubstr("\n  apart "));
  EXPECT_THAT(detect({"--color", "always", "--clearance", "0.25"}).out, HasSubstr("\n  \033[33mclearance "));
  expectFailure(runProgram({"detect", parts().string(), "--exact", "--color", "always", "--format", "csv"}), 2,
                "--color is of the table of pairs, and there is none");
}

TEST_F(Exact, TheTableHasFiftyPairsAndTheNumberOfTheOthers) {
  std::ofstream file(parts() / "row.csv");  // each box touches the next
  for (int i = 0; i < 53; ++i) file << i << ",0,0," << i + 1 << ",1,1\n";
  file.close();
  const ProgramRun run = runProgram({"detect", (parts() / "row.csv").string(), "--exact"});
  expectSuccess(run);
  std::size_t lines = 0;
  for (auto at = run.out.find("\n  touching "); at != std::string::npos; at = run.out.find("\n  touching ", at + 1))
    ++lines;
  EXPECT_EQ(lines, 50U);
  EXPECT_THAT(run.out, HasSubstr("\n  ... and 2 more; "));
}

TEST_F(Exact, ClashesNoDeeperThanAskedForOnlyTouch) {
  const ProgramRun run = detect({"--min-depth", "0.125"});
  expectSuccess(run);
  EXPECT_THAT(run.out, HasSubstr("by their shapes 1 clash (1 contained), 2 touching, 1 apart\n\n"));
  EXPECT_THAT(run.out, HasSubstr("\n  touching     b-bracket   a-plate     at (0.9375, "));
  EXPECT_THAT(detect({"--min-depth", "0.1249"}).out, HasSubstr("by their shapes 2 clashes (1 contained)"));
  // A part that is in another stays a clash, however deep.
  EXPECT_THAT(detect({"--min-depth", "9"}).out, HasSubstr("by their shapes 1 clash (1 contained)"));
  expectFailure(runProgram({"detect", parts().string(), "--min-depth", "1"}), 2, "--min-depth is of shapes");
  expectFailure(detect({"--min-depth", "nan"}), 2, "--min-depth: 'nan' is not a distance from 0 on");
}

TEST_F(Exact, ScriptsLearnOfClashesByTheStatus) {
  const std::filesystem::path to = parts() / "out.json";
  const auto fails = [&](const std::vector<std::string>& options, const std::string& message) {
    const ProgramRun run = detect(options);
    EXPECT_EQ(run.status, 4) << run.err;
    EXPECT_THAT(run.err, HasSubstr("--fail-on: found " + message));
    return run.out;
  };
  EXPECT_THAT(fails({"--fail-on", "clash"}, "2 clashes (1 contained), 1 touching, 1 apart"), HasSubstr("0.125 deep"));
  fails({"--fail-on", "pair", "-o", to.string()}, "4 pairs\n");
  EXPECT_TRUE(std::filesystem::exists(to));
  for (const char* part : {"a-plate.obj", "e-pin.obj"}) std::filesystem::remove(parts() / part);
  expectSuccess(detect({"--fail-on", "clash"}));
  fails({"--fail-on", "pair"}, "2 pairs\n");
  expectFailure(runProgram({"detect", parts().string(), "--fail-on", "clash"}), 2, "add --exact");
  EXPECT_EQ(runProgram({"detect", parts().string(), "--fail-on", "pair"}).status, 4);
  std::filesystem::remove(parts() / "b-bracket.obj");
  expectSuccess(runProgram({"detect", parts().string(), "--fail-on", "pair"}));
}

TEST_F(Exact, WhatCannotBeDecidedIsSaid) {
  std::ofstream(parts() / "g-open.obj") << "v -9 -9 -9\nv 9 -9 -9\nv 0 9 -9\nv 0 0 20\nf 1 2 4\nf 2 3 4\nf 1 2 3\n";
  const ProgramRun run = detect({});
  expectSuccess(run);
  EXPECT_THAT(run.out, HasSubstr("; one may lie in the other: the first is not closed\n"));
  EXPECT_THAT(run.out, HasSubstr(" undecided, 1 apart\n"));
}

TEST_F(Exact, NpyKeepsThePairsThatAreNotApart) {
  const ProgramRun run = detect({"--format", "npy"});
  expectSuccess(run);
  EXPECT_THAT(run.out, HasSubstr("'shape': (3, 2)"));
}

TEST_F(Exact, NpyHasThePairsOfBoxesAsWithoutShapes) {
  const TempFolder folder;
  const std::string boxes = folder.path() / "boxes.csv";
  std::ofstream(boxes) << "0,0,0,1,1,1\n0,0,0,2,2,2\n0,0,0,3,3,3\n0.5,0.5,0.5,4,4,4\n";
  const ProgramRun run = runProgram({"detect", boxes, "--format", "npy"});
  expectSuccess(run);
  EXPECT_THAT(run.out, HasSubstr("'shape': (6, 2)"));
  EXPECT_EQ(runProgram({"detect", boxes, "--exact", "--format", "npy"}).out, run.out) << "all of them clash";
}

TEST_F(Exact, BoxesAreLookedAtAsSolids) {
  const TempFolder folder;
  std::ofstream(folder.path() / "boxes.csv") << "0,0,0,1,1,1,a\n0.75,0,0,2,1,1,b\n2,0,0,3,1,inf,c\n";
  const ProgramRun run = runProgram({"detect", folder.path() / "boxes.csv", "--exact", "--format", "csv"});
  expectSuccess(run);
  EXPECT_THAT(run.out, HasSubstr("\nb,a,clash,0,0.25,"));
  EXPECT_THAT(run.out, HasSubstr("\nc,b,not-examined,,,,,,,,,,,,\n"));
}

TEST(ExactScenes, TheLinksOfAChainThreadEachOtherAndDoNotTouch) {
  const std::filesystem::path scenes = dataFolder() / "scenes";
  if (!std::filesystem::is_directory(scenes)) GTEST_SKIP() << "no folder of data: scenes are not tried";
  const ProgramRun run = runProgram({"detect", scenes / "examples/Demos/chainHybrid.scn", "--data", scenes, "--data",
                                     scenes / "examples", "--exact", "--format", "json"});
  expectSuccess(run);
  const auto result = nlohmann::json::parse(run.out);
  EXPECT_EQ(result["exactStatistics"]["apart"], 4);
  EXPECT_EQ(result["exactStatistics"]["falseShare"], 1.0);
  for (const auto& pair : result["exact"]) EXPECT_GT(pair["distance"], 0.01);
}

/// How far apart two boxes are, from the corners that JSON has.
double gapOf(const nlohmann::json& a, const nlohmann::json& b) {
  double sum = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::max({a[0][axis].get<double>() - b[1][axis].get<double>(),
                                 b[0][axis].get<double>() - a[1][axis].get<double>(), 0.0});
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

/// What is said of a pair goes together: the points are as far apart as it says, and no nearer than the boxes are.
void expectSound(const nlohmann::json& pair, double gap) {
  const auto a = pair["points"][0].get<std::array<double, 3>>();
  const auto b = pair["points"][1].get<std::array<double, 3>>();
  const double between = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  const double distance = pair["distance"];
  EXPECT_GE(distance, gap * (1.0 - 1e-9));
  if (pair["state"] == "apart" || pair["state"] == "undecided") {
    EXPECT_GT(distance, 0.0);
    EXPECT_NEAR(between, distance, 1e-9 * (1.0 + distance));
  } else {
    EXPECT_EQ(distance, 0.0);
    const double depth = pair["depth"].is_null() ? between : pair["depth"].get<double>();
    EXPECT_NEAR(between, depth, 1e-9 * (1.0 + between));
  }
}

TEST(ExactScenes, EveryCandidateOfEverySceneIsExaminedAndWhatIsSaidOfItGoesTogether) {
  const std::filesystem::path scenes = dataFolder() / "scenes";
  if (!std::filesystem::is_directory(scenes)) GTEST_SKIP() << "no folder of data: scenes are not tried";
  std::size_t examined = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes / "examples")) {
    const std::filesystem::path known = scenes / "expected" / (entry.path().stem().string() + ".json");
    if (entry.path().extension() != ".scn" || !std::filesystem::exists(known)) continue;
    SCOPED_TRACE(entry.path().filename());
    const ProgramRun run = runProgram(
        {"detect", entry.path(), "--data", scenes, "--data", scenes / "examples", "--exact", "--format", "json"});
    expectSuccess(run);
    const auto result = nlohmann::json::parse(run.out);
    std::ifstream file(known);
    ASSERT_EQ(result["pairs"], nlohmann::json::parse(file)["pairs"]);
    ASSERT_EQ(result["exact"].size(), result["pairs"].size());
    EXPECT_EQ(result["exactStatistics"]["notExamined"], 0);
    for (std::size_t i = 0; i < result["pairs"].size(); ++i) {
      const auto& pair = result["pairs"][i];
      expectSound(result["exact"][i], gapOf(result["models"][pair[0].get<std::size_t>()]["box"],
                                            result["models"][pair[1].get<std::size_t>()]["box"]));
      ++examined;
    }
  }
  EXPECT_EQ(examined, 530U);
}

#else

TEST(Exact, WithoutFclTheOptionSaysWhatIsMissing) {
  expectFailure(runProgram({"detect", "examples/scenes/demo.scn", "--exact"}), 2, "--exact needs FCL");
}

#endif

}  // namespace
}  // namespace allpairs::test
