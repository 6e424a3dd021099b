// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "Expect.h"
#include "support/Boxes.h"
#include "support/Npy.h"
#include "support/Oracle.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using Row = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;

constexpr std::size_t kWorlds = 12;
constexpr std::size_t kEach = 25;

std::vector<Box> someWorlds() { return toDouble(randomBoxes(kWorlds * kEach, 17, 3.0F)); }

/// The double loop in each world.
std::vector<Row> expectedRows(double distance = 0.0) {
  std::vector<Row> rows;
  const std::vector<Box> boxes = someWorlds();
  for (std::uint32_t k = 0; k < kWorlds; ++k) {
    const auto begin = boxes.begin() + static_cast<std::ptrdiff_t>(k * kEach);
    for (const Pair pair : oracle({begin, begin + kEach}, distance)) rows.emplace_back(k, pair.first, pair.second);
  }
  return rows;
}

class DetectWorlds : public ::testing::Test {
 protected:
  TempFolder folder;
  std::string path;

  void write(const std::string& type = "<f4", const std::string& shape = "(12, 25, 6)") {
    path = folder.write("worlds.npy", npyBytes(someWorlds(), {.descr = type, .shape = shape})).string();
  }
};

TEST_F(DetectWorlds, GiveThePairsOfTheDoubleLoopInEveryFormat) {
  for (const char* type : {"<f4", "<f8", ">f4"}) {
    write(type);
    const std::vector<Row> expected = expectedRows();
    const ProgramRun csv = runProgram({"detect", path, "--worlds", "--format", "csv", "--verify"});
    expectSuccess(csv);
    std::istringstream lines(csv.out);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "world,first,second");
    std::vector<Row> found;
    char comma = 0;
    for (std::uint32_t k = 0, i = 0, j = 0; lines >> k >> comma >> i >> comma >> j;) found.emplace_back(k, i, j);
    EXPECT_EQ(found, expected);

    const ProgramRun json = runProgram({"detect", path, "--worlds", "--format", "json"});
    expectSuccess(json);
    const auto result = nlohmann::json::parse(json.out);
    EXPECT_EQ(result["worlds"], kWorlds);
    EXPECT_EQ(result["boxes"], kEach);
    found.clear();
    for (const auto& row : result["pairs"]) found.emplace_back(row[0], row[1], row[2]);
    EXPECT_EQ(found, expected);

    const ProgramRun npy = runProgram({"detect", path, "--worlds", "--format", "npy"});
    expectSuccess(npy);
    ASSERT_EQ(npy.out.size(), 128 + 12 * expected.size());
    found.clear();
    for (std::size_t i = 0; i < expected.size(); ++i) {
      std::uint32_t row[3];
      std::memcpy(row, npy.out.data() + 128 + 12 * i, sizeof row);
      found.emplace_back(row[0], row[1], row[2]);
    }
    EXPECT_EQ(found, expected);
  }
}

TEST_F(DetectWorlds, AreFoundAtADistance) {
  write();
  const ProgramRun run = runProgram({"detect", path, "--worlds", "--format", "json", "--distance", "0.25"});
  expectSuccess(run);
  EXPECT_EQ(nlohmann::json::parse(run.out)["pairs"].size(), expectedRows(0.25).size());
}

TEST_F(DetectWorlds, AreCountedInATable) {
  write();
  const ProgramRun run = runProgram({"detect", path, "--worlds"});
  expectSuccess(run);
  EXPECT_NE(run.out.find("worlds   12 of 25 boxes\npairs    " + std::to_string(expectedRows().size())),
            std::string::npos)
      << run.out;
}

TEST_F(DetectWorlds, OfWrongShapesOrOptionsAreRefused) {
  write("<f4", "(300, 6)");
  expectFailure(runProgram({"detect", path, "--worlds"}), kBadInput, "worlds of boxes are (w, n, 6)");
  const std::string none = folder.write(
      "none.npy", npyHeaderBytes("{'descr': '<f4', 'fortran_order': False, 'shape': (100000000, 0, 6), }"));
  const std::string claims = "without boxes; at most 1000000 are taken";
  expectFailure(runProgram({"detect", none, "--worlds"}), kBadInput, "claims 100000000 worlds " + claims);
  expectFailure(runProgram({"track", none}), kBadInput, "claims 100000000 frames " + claims);
  write();
  expectFailure(
      runProgram({"detect", path}), kBadInput,
      "has shape (12, 25, 6); boxes are (n, 6); of several worlds or frames it is for 'allpairs detect --worlds'");
  expectFailure(runProgram({"detect", path, path, "--worlds"}), kWrongUsage, "one input");
  expectFailure(runProgram({"detect", path, "--worlds", "--exact"}), kWrongUsage, "--exact");
  expectFailure(runProgram({"detect", "boxes.csv", "--worlds"}), kWrongUsage, ".npy");
  expectFailure(runProgram({"detect", path, "--worlds", "--max-memory", "100"}), kBadInput, "--max-memory");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--recursive"}, {"--partial"}, {"--data", folder.path()}, {"--sofa", "20.06"}}) {
    std::vector<std::string> all{"detect", path, "--worlds"};
    all.insert(all.end(), words.begin(), words.end());
    expectFailure(runProgram(all), kWrongUsage, words.front() + " does not apply to --worlds");
  }
  expectFailure(runProgram({"detect", path, "--worlds", "--clearance", "1"}), kWrongUsage, "--clearance is measured");
  std::vector<Box> boxes = someWorlds();
  boxes[2 * kEach + 5].min[1] = std::numeric_limits<double>::quiet_NaN();
  const std::string nan = folder.write("nan.npy", npyBytes(boxes, {.descr = "<f4", .shape = "(12, 25, 6)"}));
  expectFailure(runProgram({"detect", nan, "--worlds"}), kBadInput, "nan.npy: world 2: box 5");
}

TEST_F(DetectWorlds, TheTableNamesTheFirstWorldWithTheMostPairsAndCountsThoseWithoutAny) {
  std::vector<Box> boxes;
  const auto addWorld = [&boxes](const std::vector<double>& places) {
    for (const double x : places) boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  };
  addWorld({0, 5, 10});
  addWorld({0, 0.25, 0.5});  // each with each other
  addWorld({0, 0.25, 0.5});
  addWorld({0, 0.5, 10});
  const std::string file = folder.write("four.npy", npyBytes(boxes, {.descr = "<f8", .shape = "(4, 3, 6)"}));
  const ProgramRun run = runProgram({"detect", file, "--worlds"});
  expectSuccess(run);
  EXPECT_TRUE(run.out.starts_with("worlds   4 of 3 boxes\npairs    7; most in world 1, 3; none in 1 world\n"))
      << run.out;
  const std::string none = folder.write("none.npy", npyBytes({}, {.descr = "<f8", .shape = "(0, 3, 6)"}));
  const ProgramRun ofNone = runProgram({"detect", none, "--worlds"});
  expectSuccess(ofNone);
  EXPECT_TRUE(ofNone.out.starts_with("worlds   0 of 3 boxes\npairs    0\n")) << ofNone.out;
}

TEST_F(DetectWorlds, TakeTheMemoryThatTheirNumbersTake) {
  for (const auto& [type, size] : {std::pair{"<f4", 7200}, {"<f8", 14400}}) {
    write(type);
    const std::string less = std::to_string(size - 1);
    expectFailure(runProgram({"detect", path, "--worlds", "--max-memory", less}), kBadInput,
                  "worlds.npy: needs more memory than --max-memory allows");
    expectSuccess(runProgram({"detect", path, "--worlds", "--max-memory", std::to_string(size)}));
  }
}

TEST_F(DetectWorlds, ThatAreVerifiedSaySo) {
  write();
  EXPECT_NE(runProgram({"detect", path, "--worlds", "--verify"}).out.find("\nverify   the exhaustive strategy gives"),
            std::string::npos);
  for (const bool isVerified : {false, true}) {
    std::vector<std::string> words{"detect", path, "--worlds", "--format", "json"};
    if (isVerified) words.emplace_back("--verify");
    EXPECT_EQ(nlohmann::json::parse(runProgram(words).out)["statistics"]["verified"], isVerified);
  }
}

TEST_F(DetectWorlds, ThatAreNoneHaveNoPairs) {
  path = folder.write("none.npy", npyBytes({}, {.descr = "<f4", .shape = "(0, 25, 6)"})).string();
  const ProgramRun run = runProgram({"detect", path, "--worlds", "--format", "csv"});
  expectSuccess(run);
  EXPECT_EQ(run.out, "world,first,second\n");
}

}  // namespace
}  // namespace allpairs::test
