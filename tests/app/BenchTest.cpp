// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "Expect.h"
#include "PairHash.h"
#include "allpairs/generate/BoxScenes.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// The oracle: the hash of the double loop's pairs.
std::string hashOfDoubleLoop(const std::vector<float>& rows) {
  std::vector<Pair> pairs;
  const auto apart = [&](std::size_t i, std::size_t j, std::size_t axis) {
    return rows[6 * i + axis] > rows[6 * j + 3 + axis] || rows[6 * j + axis] > rows[6 * i + 3 + axis];
  };
  for (std::uint32_t i = 0; i < rows.size() / 6; ++i) {
    for (std::uint32_t j = i + 1; j < rows.size() / 6; ++j) {
      if (!apart(i, j, 0) && !apart(i, j, 1) && !apart(i, j, 2)) pairs.push_back({i, j});
    }
  }
  return measure::hexadecimal(measure::hashOfPairs(pairs));
}

nlohmann::json benchJson(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "bench");
  arguments.insert(arguments.end(), {"--repetitions", "2", "--json"});
  const ProgramRun run = runProgram(arguments);
  expectSuccess(run);
  return nlohmann::json::parse(run.out);
}

TEST(Bench, GivesTheDoubleLoopsHashWhateverTheStrategyOrderAndThreads) {
  const std::string expected = hashOfDoubleLoop(generate::makeBoxes({.scene = "clusters", .count = 3000}));
  const std::vector<std::string> scene{"clusters", "-n", "3000"};  // as many as threads share
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {}, {"--unordered"}, {"--threads", "3"}, {"--strategy", "exhaustive"}, {"--strategy", "bvh"}}) {
    std::vector<std::string> arguments = scene;
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(benchJson(arguments)["hash"], expected) << testing::PrintToString(options);
  }
}

TEST(Bench, SaysWhatWasMeasuredOnWhat) {
  const nlohmann::json record = benchJson({"all-overlap", "-n", "50"});
  EXPECT_EQ(record["n"], 50);
  EXPECT_EQ(record["pairs"], 50 * 49 / 2);
  EXPECT_EQ(record["repetitions"], 2);
  for (const char* key : {"median_ms", "median_cpu_ms", "min_ms", "max_ms", "warm_median_ms", "warm_median_cpu_ms"}) {
    EXPECT_GE(record[key].get<double>(), 0.0) << key;
  }
  for (const char* key : {"commit", "compiler", "processor", "instruction_set", "date", "strategy", "order"}) {
    EXPECT_FALSE(record[key].get<std::string>().empty()) << key;
  }
}

TEST(Bench, ReadsBoxesFromAFile) {
  const TempFolder folder;
  const std::string file = (folder.path() / "boxes.npy").string();
  expectSuccess(runProgram({"generate", "mesh", "-n", "500", "--seed", "3", "-o", file}));
  EXPECT_EQ(benchJson({file})["hash"], benchJson({"mesh", "-n", "500", "--seed", "3"})["hash"]);
}

TEST(Bench, OfAFileWithANameThatIsNotUtf8IsJsonAllTheSame) {
  const TempFolder folder;
  const std::string file = (folder.path() / "\"a\\\xFF.npy").string();
  expectSuccess(runProgram({"generate", "mesh", "-n", "10", "-o", file}));
  const std::string input = benchJson({file})["input"];
  EXPECT_TRUE(input.ends_with("\"a\\\xEF\xBF\xBD.npy")) << input;
}

TEST(Bench, CountsWithoutAHash) {
  const nlohmann::json record = benchJson({"all-overlap", "-n", "50", "--count"});
  EXPECT_EQ(record["pairs"], 50 * 49 / 2);
  EXPECT_FALSE(record.contains("hash"));
}

TEST(Bench, PrintsATableForPeople) {
  const ProgramRun run = runProgram({"bench", "uniform", "-n", "10", "--repetitions", "1"});
  expectSuccess(run);
  for (const char* word : {"pairs", "hash", "one-shot", "warm", "median", "in 1 repetition\n", "machine"}) {
    EXPECT_NE(run.out.find(word), std::string::npos) << word;
  }
}

TEST(Bench, OfNoSuchFileOrSceneIsBadInput) {
  expectFailure(runProgram({"bench", "missing.npy"}), 3, "missing.npy");
  expectFailure(runProgram({"bench", "brownian", "-n", "10"}), 2,
                "'brownian' is neither a file nor the name of a scene");
}

TEST(Bench, OfAFileTakesNoNumberOfBoxes) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"-n", "5"}, {"--boxes", "5"}, {"--seed", "2"}, {"--sorted"}}) {
    std::vector<std::string> arguments{"bench", "boxes.npy"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expectFailure(runProgram(arguments), 2, "is for a scene that is made up, not for 'boxes.npy'");
  }
}

TEST(Bench, OnNoThreadsIsWrongUsage) {
  expectFailure(runProgram({"bench", "uniform", "--threads", "0"}), 2, "--threads");
  expectFailure(runProgram({"bench", "uniform", "--threads", "100000"}), 2,
                "--threads: 100000 is not a number of threads from 1 to 9999");
}

TEST(Bench, WithAnUnknownInstructionSetSaysSo) {
  const ProgramRun run = runProgram({"bench", "uniform", "--instruction-set", "ABACUS"});
  EXPECT_NE(run.status, 0);
  EXPECT_NE(run.err.find("ABACUS"), std::string::npos) << run.err;
}

TEST(Bench, OnAnUnknownInstructionSetIsWrongUsage) {
  expectFailure(runProgram({"bench", "uniform", "--instruction-set", "FOO"}), 2,
                "'FOO' is not available on this processor, which has ");
}

}  // namespace
}  // namespace allpairs::test
