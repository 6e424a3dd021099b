// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "Expect.h"
#include "support/Boxes.h"
#include "support/Data.h"
#include "support/Npy.h"
#include "support/Oracle.h"
#include "support/Sanitizers.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

std::vector<Pair> sorted(std::vector<Pair> pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// (first, second) in the order of the double loop, as models come: for each box, those before it.
std::vector<Pair> newestFirst(std::vector<Pair> pairs) {
  for (Pair& pair : pairs) std::swap(pair.first, pair.second);
  return sorted(std::move(pairs));
}

std::vector<Pair> pairsOfJson(const std::string& text) {
  std::vector<Pair> pairs;
  const auto result = nlohmann::json::parse(text);
  for (const auto& pair : result["pairs"]) pairs.push_back({pair[0], pair[1]});
  return pairs;
}

/// The names are the indices.
std::vector<Pair> pairsOfCsv(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "first,second");
  std::vector<Pair> pairs;
  char comma = 0;
  for (Pair pair; lines >> pair.first >> comma >> pair.second;) pairs.push_back(pair);
  return pairs;
}

std::vector<Box> someBoxes(std::size_t count = 500) { return toDouble(randomBoxes(count, 7)); }

TEST(DetectBoxes, EveryArrayOfTheDataFolderGivesItsPairsByteForByte) {
  const std::filesystem::path folder = dataFolder() / "boxes";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no folder of data: boxes/*.npy are not tried";
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string path = entry.path().string();
    if (path.ends_with(".pairs.npy")) continue;
    const std::string expected = readBytes(path.substr(0, path.size() - 4) + ".pairs.npy");
    for (const char* strategy : {"auto", "exhaustive", "bvh"}) {
      const ProgramRun run = runProgram({"detect", path, "--format", "npy", "--strategy", strategy});
      EXPECT_EQ(run.status, 0);
      EXPECT_EQ(run.err.find(": min above max") != std::string::npos, path.find("empty") != std::string::npos)
          << run.err;
      EXPECT_TRUE(run.out == expected) << path << ' ' << strategy;
    }
    ++count;
  }
  EXPECT_EQ(count, 12U);
}

TEST(DetectBoxes, EveryStrategyThreadCountAndFormatGivesTheDoubleLoopsPairs) {
  const TempFolder folder;
  const std::vector<Box> boxes = someBoxes();
  const std::string path = folder.write("boxes.npy", npyBytes(boxes));
  const std::vector<Pair> expected = oracle(boxes);
  ASSERT_GT(expected.size(), 300U);
  unsigned round = 0;
  for (const char* strategy : {"auto", "exhaustive", "bvh"}) {
    for (const char* threads : {"0", "1", "3"}) {
      const std::vector<std::string> common{"detect", path, "--strategy", strategy, "--threads", threads, "--verify"};
      const auto run = [&common](const char* format) {
        std::vector<std::string> words = common;
        words.insert(words.end(), {"--format", format});
        const ProgramRun result = runProgram(words);
        expectSuccess(result);
        return result.out;
      };
      // With a sanitizer in one format, which is another for each strategy and for each number of threads.
      const unsigned only = (round + round / 3) % 3;
      ++round;
      const auto isTried = [only](unsigned format) { return !kIsSanitized || format == only; };
      if (isTried(0)) {
        EXPECT_EQ(pairsOfNpy(run("npy")), expected);
      }
      if (isTried(1)) {
        EXPECT_EQ(pairsOfJson(run("json")), newestFirst(expected));
      }
      if (isTried(2)) {
        EXPECT_EQ(pairsOfCsv(run("csv")), newestFirst(expected));
      }
    }
  }
}

TEST(DetectBoxes, ManyBoxesOnManyThreadsGiveTheSameBytesAsOnOne) {
  const TempFolder folder;
  const std::string path = folder.write("boxes.npy", npyBytes(someBoxes(30'000), {.descr = "<f4"}));
  const ProgramRun one = runProgram({"detect", path, "--format", "npy", "--threads", "1"});
  const ProgramRun many = runProgram({"detect", path, "--format", "npy", "--threads", "4"});
  expectSuccess(one);
  EXPECT_TRUE(one.out == many.out);
  EXPECT_GT(one.out.size(), 100'000U);
}

TEST(DetectBoxes, ADistanceAddsPairsAndANegativeOneTakesSomeAway) {
  const TempFolder folder;
  const std::vector<Box> boxes = someBoxes(200);
  const std::string path = folder.write("boxes.npy", npyBytes(boxes));
  for (const double distance : {0.25, -0.25, 0.0}) {
    const std::string text = std::to_string(distance);
    const ProgramRun apart = runProgram({"detect", path, "--format", "npy", "--distance", text});
    const ProgramRun joined = runProgram({"detect", path, "--format", "npy", "--distance=" + text});
    expectSuccess(apart);
    EXPECT_EQ(pairsOfNpy(apart.out), oracle(boxes, distance));
    EXPECT_TRUE(apart.out == joined.out);
  }
}

TEST(DetectBoxes, ARegionLeavesOutWhatDoesNotTouchIt) {
  const TempFolder folder;
  const std::vector<Box> boxes = someBoxes(200);
  const std::string path = folder.write("boxes.npy", npyBytes(boxes));
  const Box region{{-1, -1, -1}, {3, 3, 3}};
  std::vector<Pair> expected;
  for (const Pair& pair : oracle(boxes)) {
    if (!oracle({boxes[pair.first], region}).empty() && !oracle({boxes[pair.second], region}).empty()) {
      expected.push_back(pair);
    }
  }
  ASSERT_LT(expected.size(), oracle(boxes).size());
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(pairsOfNpy(runProgram({"detect", path, "--format", "npy", "--box", "-1,-1,-1,3,3,3"}).out), expected);
  EXPECT_EQ(pairsOfNpy(runProgram({"detect", path, "--format", "npy", "--box=-1,-1,-1,3,3,3"}).out), expected);
}

TEST(DetectBoxes, SeveralInputsAreOneListInTheOrderGiven) {
  const TempFolder folder;
  const std::vector<Box> boxes = someBoxes(60);
  const std::vector<Box> first(boxes.begin(), boxes.begin() + 25);
  const std::vector<Box> second(boxes.begin() + 25, boxes.end());
  const std::string a = folder.write("a.npy", npyBytes(first, {.descr = ">f4", .fortran = true}));
  const std::string b = folder.write("b.npy", npyBytes(second));
  EXPECT_EQ(pairsOfNpy(runProgram({"detect", a, b, "--format", "npy"}).out), oracle(boxes));
}

TEST(DetectBoxes, BoxesAmongMeshesAreModelsAndPairAsBoxesDo) {
  const TempFolder folder;
  const std::vector<Box> boxes = someBoxes(60);
  const std::string array = folder.write("boxes.npy", npyBytes(boxes));
  const std::string mesh = folder.write("far.obj", "v 900 900 900\nv 901 900 900\nv 900 901 900\nf 1 2 3\n");
  const ProgramRun run = runProgram({"detect", array, mesh, "--format", "json"});
  expectSuccess(run);
  EXPECT_EQ(pairsOfJson(run.out), newestFirst(oracle(boxes)));
}

TEST(DetectBoxes, NamesComeThroughToTheCsv) {
  const TempFolder folder;
  const std::string path =
      folder.write("b.csv", "name,minx,miny,minz,maxx,maxy,maxz\nleft,0,0,0,1,1,1\n\"r, t\",1,1,1,2,2,2\n");
  EXPECT_EQ(runProgram({"detect", path, "--format", "csv"}).out, "first,second\n\"r, t\",left\n");
}

TEST(DetectBoxes, TheTableShowsThePairsAndWhatTheyCost) {
  const TempFolder folder;
  const std::string path = folder.write("b.csv", "left,0,0,0,1,1,1\nright,1,1,1,2,2,2\nfar,9,9,9,10,10,10\n");
  const ProgramRun run = runProgram({"detect", path, "--verify"});
  expectSuccess(run);
  for (const char* part : {"models   3", "pairs    1\n", "  right   left\n", "the double loop makes 3", "verify"}) {
    EXPECT_NE(run.out.find(part), std::string::npos) << part << "\n" << run.out;
  }
}

TEST(DetectBoxes, TheTableSaysHowManyPairsItDoesNotShow) {
  const TempFolder folder;
  const std::vector<Box> boxes(60, cube(0, 0, 0));
  const ProgramRun run = runProgram({"detect", folder.write("same.npy", npyBytes(boxes))});
  EXPECT_NE(run.out.find("... and 1,720 more"), std::string::npos) << run.out;
}

TEST(Info, ShowsWhatAnArrayHolds) {
  const TempFolder folder;
  const ProgramRun run =
      runProgram({"info", folder.write("b.npy", npyBytes({cube(0, 0, 0), cube(2, 2, 2), {{1, 0, 0}, {0, 0, 0}}}))});
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.err.find("b.npy: box 2: min above max on x"), std::string::npos) << run.err;
  for (const char* part : {"3 boxes, float64", "empty    1", "[0, 0, 0] to [3, 3, 3]", "[2, 2, 2] to [3, 3, 3]"}) {
    EXPECT_NE(run.out.find(part), std::string::npos) << part << "\n" << run.out;
  }
}

TEST(Info, ShowsModelsAndWhatWasIgnored) {
  const TempFolder folder;
  folder.write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no wheel of wood\nf 1 2 3\n");
  folder.write("notes.txt", "hello");
  const ProgramRun run = runProgram({"info", folder.path().string()});
  expectSuccess(run);
  for (const char* part : {"wheel of wood", "TTriangleModel", "ignored\n", "notes.txt", "is no mesh file"}) {
    EXPECT_NE(run.out.find(part), std::string::npos) << part << "\n" << run.out;
  }
}

}  // namespace
}  // namespace allpairs::test
