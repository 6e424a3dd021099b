// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>
#include <string>
#include <vector>

#include "Expect.h"
#include "allpairs/BoxView.h"
#include "allpairs/Overlaps.h"
#include "support/Boxes.h"
#include "support/Npy.h"
#include "support/Oracle.h"
#include "support/Sanitizers.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

namespace fs = std::filesystem;

class JoinCommand : public ::testing::Test {
 protected:
  /// Enough boxes that the least memory holds them in three cells; with a sanitizer, which slows it down, in two.
  void writeMany() { writeMany("clusters", kIsSanitized ? 210'000 : 300'000); }
  void writeMany(const std::string& scene, std::size_t count) {
    many = folder.path() / "many.npy";
    const ProgramRun run = runProgram({"generate", scene, "-n", std::to_string(count), "-o", many});
    expectSuccess(run);
  }

  [[nodiscard]] std::string in(const char* name) const { return (folder.path() / name).string(); }
  [[nodiscard]] std::string bytes(const char* name) const {
    std::ifstream file(folder.path() / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// Runs a join to join.npy that is killed and resumed again and again; in the end it has these bytes, and no work
  /// folder.
  void expectSameBytesWhenKilled(const std::string& join, const char* expected) {
    const ProgramRun run =
        runScript("cd '" + folder.path().string() + "' && for delay in 0.02 0.05 0.09 0.13 0.2 0.3; do " + join +
                  " --resume >/dev/null 2>&1 & sleep $delay; kill -9 $! 2>/dev/null; "
                  "wait $! 2>/dev/null; done; " +
                  join + " --resume");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_GT(bytes(expected).size(), 1'000U);
    EXPECT_TRUE(bytes("join.npy") == bytes(expected));
    EXPECT_FALSE(fs::exists(in("join.npy.work")));
  }

  /// The same, with the bytes of the join that nobody kills.
  void expectSameBytesWhenKilled(const std::string& join) {
    ASSERT_EQ(runScript("cd '" + folder.path().string() + "' && " + join + " && mv join.npy whole.npy").status, 0);
    expectSameBytesWhenKilled(join, "whole.npy");
  }

  /// Boxes of a join that is killed: with a sanitizer so few that it comes as far.
  static constexpr std::size_t kKilled = kIsSanitized ? 40'000 : 300'000;

  TempFolder folder;
  std::vector<Box> boxes = toDouble(randomBoxes(400, 31));
  std::string few = folder.write("few.npy", npyBytes(boxes, {.descr = "<f4"})).string();
  std::string many;
};

TEST_F(JoinCommand, WritesTheBytesThatDetectWrites) {
  writeMany();
  expectSuccess(runProgram({"detect", many, "-o", in("detect.npy")}));
  for (const char* memory : {"64M", "1G"}) {
    const ProgramRun run = runProgram({"join", many, "-o", in("join.npy"), "--memory", memory, "--threads", "1"});
    expectSuccess(run);
    EXPECT_NE(run.out.find(kIsSanitized ? "among 210,000 boxes -> " : "among 300,000 boxes -> "), std::string::npos)
        << run.out;
    EXPECT_TRUE(bytes("join.npy") == bytes("detect.npy")) << memory;
  }
  expectSuccess(runProgram({"join", many, "-o", in("join.npy"), "--threads", "2"}));
  EXPECT_TRUE(bytes("join.npy") == bytes("detect.npy"));
  EXPECT_FALSE(fs::exists(in("join.npy.work")));
}

TEST_F(JoinCommand, TakesADistanceAndCounts) {
  const ProgramRun run = runProgram({"join", few, "--count", "--distance", "-0.1"});
  expectSuccess(run);
  EXPECT_TRUE(run.out.starts_with(std::to_string(oracle(boxes, -0.1).size()) + " pairs among 400 boxes\n")) << run.out;
  expectSuccess(runProgram({"join", few, few, "-o", in("both.npy"), "--distance=0.5"}));
  std::vector<Box> both = boxes;
  both.insert(both.end(), boxes.begin(), boxes.end());
  EXPECT_EQ(pairsOfNpy(bytes("both.npy")), oracle(both, 0.5));
}

TEST_F(JoinCommand, TakesASecondSet) {
  const std::vector<Box> others = toDouble(randomBoxes(300, 32));
  const std::string second = folder.write("others.npy", npyBytes(others, {.descr = "<f8"})).string();
  const ProgramRun run = runProgram({"join", few, "--with", second, "-o", in("pairs.npy"), "--distance", "0.25"});
  expectSuccess(run);
  const std::vector<Pair> expected = oracleBetween(boxes, others, 0.25);
  EXPECT_EQ(pairsOfNpy(bytes("pairs.npy")), expected);
  EXPECT_TRUE(run.out.find(" among 400 and 300 boxes -> ") != std::string::npos) << run.out;
  const ProgramRun twice = runProgram({"join", second, few, "--count", "--with", few, second});
  expectSuccess(twice);
  EXPECT_NE(twice.out.find(" among 700 and 700 boxes\n"), std::string::npos) << twice.out;
  constexpr const char* kOrder = "BOXES come before --with";
  expectFailure(runProgram({"join", "--count", "--with", second, few, few}), kWrongUsage, kOrder);
  expectFailure(runProgram({"join", "--count", "--with", second, "--", few, few}), kWrongUsage, kOrder);
  expectFailure(runProgram({"join", few, "--with", second, "--count", few}), kWrongUsage, kOrder);
  expectFailure(runProgram({"plan", "--threads", "1", "--with", second, few, few}), kWrongUsage, kOrder);
  const ProgramRun plan = runProgram({"plan", few, "--with", second, "--ranks", "2"});
  expectSuccess(plan);
  EXPECT_TRUE(plan.out.starts_with("boxes    400 and 300, 350 on each rank\n")) << plan.out;
  const ProgramRun here = runProgram({"plan", few, "--with", second, "--work", folder.path()});
  expectSuccess(here);
  EXPECT_TRUE(here.out.starts_with("boxes    400 and 300\n")) << here.out;
  expectFailure(runProgram({"join", few, "--with", in("gone.npy"), "--count"}), kBadInput, "gone.npy: no such file");
}

TEST_F(JoinCommand, TakesWhatBoxesHaveAndARegion) {
  std::vector<double> margins(400);
  std::vector<std::uint8_t> groups(400);
  for (std::size_t i = 0; i < 400; ++i) {
    margins[i] = 0.01 * static_cast<double>(i % 50);
    groups[i] = static_cast<std::uint8_t>(i % 7);
  }
  const std::string marginsFile = folder.write("margins.npy", npyNumbers(margins, "<f8")).string();
  const std::string groupsFile = folder.write("groups.npy", npyNumbers(groups, "|u1")).string();
  const Box region{{1, 1, 1}, {15, 15, 15}};
  BoxView view(boxes);
  view.setMargins(margins);
  std::vector<std::uint32_t> wide(groups.begin(), groups.end());
  const std::vector<Pair> expected = overlaps(view, {.region = region, .filter = {.first = {.groups = wide}}});
  const ProgramRun run = runProgram({"join", few, "-o", in("pairs.npy"), "--margins", marginsFile, "--groups",
                                     groupsFile, "--box", "1,1,1,15,15,15"});
  expectSuccess(run);
  EXPECT_EQ(pairsOfNpy(bytes("pairs.npy")), expected);
  const std::vector<Pair> between = overlaps(view, view, {.filter = {.second = {.masks = wide}}});
  const ProgramRun two = runProgram({"join", few, "--with", few, "--margins", marginsFile, "--with-margins",
                                     marginsFile, "--with-masks", groupsFile, "--count"});
  expectSuccess(two);
  std::string said = two.out;
  std::erase(said, ',');
  EXPECT_TRUE(said.starts_with(std::to_string(between.size()) + " pairs among ")) << said;
}

TEST_F(JoinCommand, APlanCountsWhatBoxesHaveAndARegion) {
  const std::string margins = folder.write("margins.npy", npyNumbers(std::vector<double>(400), "<f8")).string();
  const std::string plain = runProgram({"plan", few, "--ranks", "2"}).out;
  const std::string with = runProgram({"plan", few, "--ranks", "2", "--margins", margins, "--groups", margins}).err;
  EXPECT_NE(with.find("margins.npy: holds numbers of type '<f8'; groups are integers"), std::string::npos) << with;
  const ProgramRun far = runProgram({"plan", few, "--ranks", "2", "--margins", margins, "--box", "90,90,90,91,91,91"});
  expectSuccess(far);
  EXPECT_NE(far.out.find("pairs    about 0\n"), std::string::npos) << far.out;
  EXPECT_EQ(plain.find("pairs    about 0\n"), std::string::npos) << plain;
}

TEST_F(JoinCommand, WhatIsWrongWithValuesIsNamed) {
  const std::string margins = folder.write("margins.npy", npyNumbers(std::vector<double>(399), "<f8")).string();
  expectFailure(runProgram({"join", few, "--count", "--margins", margins}), kBadInput,
                "margins.npy: has 399 margins for 400 boxes");
  expectFailure(runProgram({"join", few, "--count", "--masks", margins}), kBadInput,
                "margins.npy: holds numbers of type '<f8'; masks are integers");
  expectFailure(runProgram({"join", few, "--count", "--groups", in("gone.npy")}), kBadInput, "gone.npy: no such file");
  expectFailure(runProgram({"join", few, "--count", "--with-groups", margins}), kWrongUsage,
                "--with-groups requires --with");
  expectFailure(runProgram({"join", "--count", "--margins", margins, margins, "--", few}), kWrongUsage, "BOXES");
  expectFailure(runProgram({"join", few, "--margins", "--count"}), kWrongUsage, "--margins: FILE is missing");
  expectFailure(runProgram({"join", few, "--with", "--margins", margins, "--count"}), kWrongUsage,
                "--with: FILE is missing");
  expectFailure(runProgram({"join", "--margins", margins, few, "--count"}), kWrongUsage,
                "no BOXES given; they come before --margins, which takes all files that follow it");
  expectFailure(runProgram({"plan", "--with", few, few}), kWrongUsage,
                "BOXES come before --with, which takes all files that follow it");
  expectFailure(runProgram({"join", "--margins", margins, "--count", few}), kWrongUsage,
                "BOXES come before --margins, which takes all files that follow it");
  expectFailure(runProgram({"join", few, "--count", "--box", "1,1,1,0,2,2"}), kWrongUsage, "--box: '1,1,1,0,2,2': ");
  expectFailure(runProgram({"plan", few, "--box", "1,2"}), kWrongUsage, "--box: '1,2' has 2 numbers");
  EXPECT_FALSE(fs::exists(few + ".work"));
}

TEST_F(JoinCommand, WithMarginsKilledAtAnyMomentItGoesOnToTheSameBytes) {
  writeMany("clusters", kKilled);
  std::vector<double> margins(kKilled);
  for (std::size_t i = 0; i < margins.size(); ++i) margins[i] = 1e-6 * static_cast<double>(i % 1'000);
  folder.write("margins.npy", npyNumbers(margins, "<f8"));
  const std::string join =
      "\"$0\" join many.npy -o join.npy --memory 64M --threads 1 --margins margins.npy --box 0,0,0,60,60,60";
  expectSameBytesWhenKilled(join);
}

TEST_F(JoinCommand, ASecondSetKilledAtAnyMomentGoesOnToTheSameBytes) {
  writeMany("clusters", kKilled);
  expectSuccess(runProgram({"generate", "uniform", "-n", std::to_string(kKilled / 3), "-o", in("others.npy")}));
  const std::string join = "\"$0\" join many.npy --with others.npy -o join.npy --memory 64M --threads 1";
  expectSameBytesWhenKilled(join);
}

TEST_F(JoinCommand, KilledAtAnyMomentItGoesOnToTheSameBytes) {
  writeMany("clusters", kKilled);
  expectSuccess(runProgram({"detect", many, "-o", in("detect.npy")}));
  expectSameBytesWhenKilled("\"$0\" join many.npy -o join.npy --memory 64M --threads 1", "detect.npy");
}

TEST_F(JoinCommand, WritesToStandardOutputWhereThatIsAskedFor) {
  const std::string join = "\"$0\" join '" + few + "' -o ";
  expectSuccess(runScript(join + "'" + in("file.npy") + "'"));
  const ProgramRun piped = runScript(join + "- | cat");
  EXPECT_EQ(piped.status, 0) << piped.err;
  EXPECT_TRUE(piped.err.starts_with("680 pairs among 400 boxes\n")) << piped.err;
  EXPECT_TRUE(piped.out == bytes("file.npy"));
  EXPECT_FALSE(fs::exists(few + ".work"));
}

TEST_F(JoinCommand, AFullDiskIsAnErrorAndWhatWasDoneStays) {
  writeMany("needles", kIsSanitized ? 75'000 : 300'000);
  // The shell counts blocks of 512 bytes: the boxes fit, and the pairs do not.
  const std::string limit = kIsSanitized ? "ulimit -f 5000" : "ulimit -f 20000";
  const std::string enter = "cd '" + folder.path().string() + "' && ";
  const ProgramRun full =
      runScript(enter + limit + " && exec \"$0\" join many.npy -o join.npy --memory 1G --threads 1 --work w");
  expectFailure(full, kBadInput, "cannot be written: File too large");
  EXPECT_NE(full.err.find("; what is complete is in w, and --resume goes on"), std::string::npos) << full.err;
  EXPECT_FALSE(fs::exists(in("join.npy")));
  const ProgramRun missing = runScript(enter + "exec \"$0\" join missing.npy -o join.npy --work w --resume");
  expectFailure(missing, kBadInput, "missing.npy: no such file");
  EXPECT_EQ(missing.err.find("--resume"), std::string::npos) << missing.err;
  expectSuccess(runProgram({"join", many, "-o", in("join.npy"), "--memory", "1G", "--work", in("w"), "--resume"}));
  expectSuccess(runProgram({"detect", many, "-o", in("detect.npy")}));
  EXPECT_TRUE(bytes("join.npy") == bytes("detect.npy"));
}

TEST_F(JoinCommand, WrongUsageIsSaid) {
  expectFailure(runProgram({"join", few}), kWrongUsage, "join takes -o FILE, or --count");
  expectFailure(runProgram({"join", few, "--count", "-o", in("x.npy")}), kWrongUsage, "--count writes no pairs");
  expectFailure(runProgram({"join", few, "-o", in("x.csv")}), kWrongUsage, ".npy");
  expectFailure(runProgram({"join", few, "-o", in("x.npy"), "--memory", "much"}), kWrongUsage,
                "--memory: 'much' is not a size");
  expectFailure(runProgram({"join", few, "-o", in("x.npy"), "--memory", "63M"}), kWrongUsage,
                "--memory: '63M' is less than the least, 64M");
  expectFailure(runProgram({"join", "-", "--count"}), kWrongUsage, "'-': files are read in pieces");
  expectFailure(runProgram({"plan", few, "--with", "-"}), kWrongUsage, "'-': files are read in pieces");
  expectFailure(runProgram({"join", in("missing.npy"), "--count"}), kBadInput, "missing.npy: no such file");
  EXPECT_FALSE(fs::exists(in("missing.npy.work")));
}

/// Thirty boxes overlap all, and their pairs are more than the memory holds.
TEST_F(JoinCommand, APlanSaysWhatPuttingPairsInOrderTakes) {
  std::vector<Box> all = toDouble(randomBoxes(120'000, 33));
  for (std::size_t i = 0; i < 30; ++i) all[i] = {{-1e6, -1e6, -1e6}, {1e6, 1e6, 1e6}};
  const std::string file = folder.write("all.npy", npyBytes(all, {.descr = "<f4"})).string();
  const auto planned = [this](const std::string& name) {
    return runProgram({"plan", name, "--memory", "64M", "--work", folder.path()}).out;
  };
  EXPECT_TRUE(std::regex_search(planned(file), std::regex("for pairs, 2[78] MiB to put them in order\n")));
  EXPECT_EQ(planned(few).find("order"), std::string::npos);
}

TEST_F(JoinCommand, APlanLeavesNothing) {
  writeMany("clusters", kIsSanitized ? 60'000 : 300'000);
  const std::string boxesText = kIsSanitized ? "boxes    60,000" : "boxes    300,000";
  const std::string shareText = kIsSanitized ? ", 3,750 on each rank" : ", 18,750 on each rank";
  const ProgramRun run = runProgram({"plan", many, "--memory", "64M", "--work", folder.path()});
  expectSuccess(run);
  EXPECT_TRUE(run.out.starts_with(boxesText + "\ncells    ")) << run.out;
  EXPECT_NE(run.out.find("\ntime     about "), std::string::npos) << run.out;
  const ProgramRun ranks = runProgram({"plan", many, "--ranks", "16"});
  expectSuccess(ranks);
  EXPECT_TRUE(ranks.out.starts_with(boxesText + shareText + "\ncells    ")) << ranks.out;
  EXPECT_NE(ranks.out.find("\nnetwork  "), std::string::npos) << ranks.out;
  expectFailure(runProgram({"plan", many, "--ranks", "0"}), kWrongUsage, "--ranks");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 2);
}

TEST_F(JoinCommand, APlanTakesTheWorkFolderThatAJoinWouldMake) {
  for (const char* name : {"new", "new/"}) {
    const ProgramRun run = runProgram({"plan", few, "--memory", "64M", "--work", in(name)});
    expectSuccess(run);
    EXPECT_NE(run.out.find("\ntime     about "), std::string::npos) << run.out;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST_F(JoinCommand, AWorkFolderThatCannotBeMadeIsNamedAsItWasGiven) {
  const auto expectNamed = [&](const std::string& work, const std::string& problem) {
    const ProgramRun plan = runProgram({"plan", few, "--work", work});
    EXPECT_EQ(plan.status, kBadInput);
    EXPECT_EQ(plan.err.find("allpairs: " + work + ": " + problem), 0U) << plan.err;
  };
  expectNamed(in("none/new"), "cannot be made: No such file or directory");
  expectNamed(in("few.npy/new"), "cannot be made: Not a directory");
  expectNamed("/proc/new", "cannot be made: ");  // nobody makes files there, not even root
  expectNamed(few, "no folder can be made in it: Not a directory");
  expectFailure(runProgram({"join", few, "--count", "--work", few}), kBadInput, few + ": is not a folder");
}

/// Which is removed when the result is complete.
TEST_F(JoinCommand, AResultInTheWorkFolderIsRefused) {
  fs::create_directory(in("w"));
  const std::string problem = ": is the folder of the join's own files, which is removed in the end, or lies in it\n";
  for (const std::string& output : {in("w/pairs"), in("new"), in("new/x.npy")}) {
    const std::string work = output == in("w/pairs") ? in("w") : in("new");
    for (const char* option : {"--threads=1", "--resume"}) {
      const ProgramRun run = runProgram({"join", few, "-o", output, "--work", work, option});
      EXPECT_EQ(run.status, kBadInput) << output;
      EXPECT_EQ(run.out, "");
    }
  }
  expectFailure(runProgram({"join", few, "-o", in("w/pairs"), "--work", in("w")}), kBadInput, in("w/pairs") + problem);
  expectFailure(runProgram({"join", few, "-o", in("new"), "--work", in("new")}), kBadInput, in("new") + problem);
  EXPECT_TRUE(fs::is_empty(in("w")));
  EXPECT_FALSE(fs::exists(in("new")));
}

TEST_F(JoinCommand, AWorkFolderThatNobodyNamedMayBeAnotherOne) {
  const std::string hint = "cannot be made: No such file or directory; --work DIR works in another folder\n";
  expectFailure(runScript("exec 9< '" + few + "'; exec \"$0\" join /proc/self/fd/9 --count"), kBadInput, hint);
  expectSuccess(runScript("exec 9< '" + few + "'; exec \"$0\" join /proc/self/fd/9 --count --work '" + in("w") + "'"));
}

TEST_F(JoinCommand, NamesTheBoundThatIsNoNumber) {
  boxes[7].min[2] = std::numeric_limits<double>::quiet_NaN();
  const std::string nan = folder.write("nan.npy", npyBytes(boxes)).string();
  const std::string problem = nan + ": box 7: min z is not a number (NaN)\n";
  expectFailure(runProgram({"join", few, nan, "-o", in("pairs.npy")}), kBadInput, problem);
  expectFailure(runProgram({"join", few, "--with", nan, "--count"}), kBadInput, problem);
  expectFailure(runProgram({"plan", few, nan}), kBadInput, problem);
  expectFailure(runProgram({"plan", few, nan, "--ranks", "4"}), kBadInput, problem);
  EXPECT_FALSE(fs::exists(in("pairs.npy")));
}

/// The two million boxes that were joined for any plan need files of 48 MB.
TEST_F(JoinCommand, APlanOfFewBoxesJoinsFewToMeasureTheTime) {
  const ProgramRun run = runScript("cd '" + folder.path().string() + "' && ulimit -f 4096 && exec \"$0\" plan few.npy");
  expectSuccess(run);
  EXPECT_NE(run.out.find("\ntime     about "), std::string::npos) << run.out;
}

TEST_F(JoinCommand, APlanWhereNothingCanBeWrittenNamesTheFolderThatWasGiven) {
  const ProgramRun run =
      runScript("cd '" + folder.path().string() + "' && ulimit -f 64 && exec \"$0\" plan few.npy --work there");
  EXPECT_NE(run.out.find("\nresult   about "), std::string::npos) << run.out;
  EXPECT_EQ(run.status, kBadInput);
  EXPECT_EQ(run.err,
            "allpairs: there: the time of a join cannot be measured there: cannot be written: File too large\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1) << "what was made to measure is gone";
}

/// A distance in the boxes' own units says nothing of the boxes that are made to measure.
TEST_F(JoinCommand, APlanMeasuresTheTimeWithoutTheDistance) {
  for (const char* distance : {"1e9", "-1e9"}) {
    const ProgramRun run = runScript("cd '" + folder.path().string() +
                                     "' && ulimit -f 4096 && exec \"$0\" plan few.npy --distance " + distance);
    expectSuccess(run);
    EXPECT_NE(run.out.find("\ntime     about "), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find("nan"), std::string::npos) << run.out;
  }
}

TEST_F(JoinCommand, APlanForRanksTakesNothingThatIsOfAJoinOnDisk) {
  expectFailure(runProgram({"plan", few, "--ranks", "2", "--threads", "2"}), kWrongUsage, "--threads");
  expectFailure(runProgram({"plan", few, "--ranks", "2", "--work", folder.path()}), kWrongUsage, "--work");
}

/// As a descriptor that a shell has opened, which is no name for files beside it.
TEST_F(JoinCommand, StandardOutputMayBeAFile) {
  expectSuccess(runProgram({"join", few, "-o", in("named.npy")}));
  for (const char* output : {"-", "/dev/stdout", "/proc/self/fd/1"}) {
    const ProgramRun run =
        runScript("cd '" + folder.path().string() + "' && \"$0\" join few.npy -o " + output + " > join.npy");
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(bytes("join.npy") == bytes("named.npy")) << output;
    EXPECT_NE(run.err.find(" among 400 boxes"), std::string::npos) << run.err;
  }
}

TEST(JoinOfManyBoxes, NamesItsWorkFolderWhereASignalEndsIt) {
  const TempFolder folder;
  const std::string count = kIsSanitized ? "1000000" : "4000000";  // enough that it lasts until the signal
  expectSuccess(runProgram({"generate", "uniform", "-n", count, "-o", folder.path() / "boxes.npy"}));
  for (const char* signal : {"TERM", "HUP"}) {
    const ProgramRun run = runScript("cd '" + folder.path().string() +
                                     "' && { rm -rf p.npy.work; \"$0\" join boxes.npy -o p.npy --memory 64M & i=0; "
                                     "until [ -e p.npy.work/manifest ] || "
                                     "[ $i = 4000 ]; do sleep 0.05; i=$((i + 1)); done; kill -" +
                                     signal + " $!; wait $!; }");
    EXPECT_GT(run.status, 128) << signal;
    EXPECT_EQ(run.err.substr(0, run.err.find('\n') + 1),  // the shell may add a word for the signal
              "allpairs: stopped; the work folder p.npy.work stays, for --resume\n");
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "p.npy.work/manifest")) << signal;
  }
}

TEST(PlanCommand, LeavesNothingWhereASignalEndsIt) {
  const TempFolder folder;
  const std::string boxes = folder.path() / "boxes.npy";
  const std::string count = kIsSanitized ? "250000" : "1000000";  // a second to measure the time
  expectSuccess(runProgram({"generate", "uniform", "-n", count, "-o", boxes}));
  const std::filesystem::path work = folder.path() / "work";
  std::filesystem::create_directory(work);
  for (const char* signal : {"TERM", "HUP"}) {
    const ProgramRun run = runScript(
        "\"$0\" plan '" + boxes + "' --work '" + work.string() + "' & i=0; until [ -n \"$(ls '" + work.string() +
        "')\" ] || [ $i = 600 ]; do sleep 0.05; i=$((i + 1)); done; kill -" + signal + " $!; wait $!");
    EXPECT_GT(run.status, 128) << signal << ": " << run.err;
    EXPECT_TRUE(std::filesystem::is_empty(work)) << signal;
  }
}

}  // namespace
}  // namespace allpairs::test
