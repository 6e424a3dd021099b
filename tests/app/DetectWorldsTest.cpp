// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <tuple>
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
  expectFailure(runProgram({"detect", path, "--worlds"}), kBadInput, "frames of boxes are (t, n, 6)");
  const std::string none = folder.write(
      "none.npy", npyHeaderBytes("{'descr': '<f4', 'fortran_order': False, 'shape': (100000000, 0, 6), }"));
  for (const std::vector<std::string>& words : {std::vector<std::string>{"detect", none, "--worlds"}, {"track", none}})
    expectFailure(runProgram(words), kBadInput, "claims 100000000 frames without boxes; at most 1000000 are taken");
  write();
  expectFailure(runProgram({"detect", path, path, "--worlds"}), kWrongUsage, "one input");
  expectFailure(runProgram({"detect", path, "--worlds", "--exact"}), kWrongUsage, "--exact");
  expectFailure(runProgram({"detect", "boxes.csv", "--worlds"}), kWrongUsage, ".npy");
  expectFailure(runProgram({"detect", path, "--worlds", "--max-memory", "100"}), kBadInput, "--max-memory");
}

TEST_F(DetectWorlds, ThatAreNoneHaveNoPairs) {
  path = folder.write("none.npy", npyBytes({}, {.descr = "<f4", .shape = "(0, 25, 6)"})).string();
  const ProgramRun run = runProgram({"detect", path, "--worlds", "--format", "csv"});
  expectSuccess(run);
  EXPECT_EQ(run.out, "world,first,second\n");
}

}  // namespace
}  // namespace allpairs::test
