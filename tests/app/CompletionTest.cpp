// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "Expect.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

const std::string kFolder = ALLPAIRS_SOURCE_DIR "/completions/";

std::vector<std::string> sortedLines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line.substr(0, line.find('\t')));
  std::sort(lines.begin(), lines.end());
  return lines;
}

bool hasShell(const std::string& shell) { return runScript("command -v " + shell).status == 0; }

/// What bash offers behind words, of which the last one is being written.
std::vector<std::string> offeredByBash(const std::string& words) {
  const ProgramRun run = runScript("bash -c 'source " + kFolder + "allpairs.bash; COMP_WORDS=(" + words +
                                   "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _allpairs; "
                                   "printf \"%s\\n\" \"${COMPREPLY[@]}\"'");
  expectSuccess(run);
  return sortedLines(run.out);
}

std::vector<std::string> offeredByFish(const std::string& line) {
  const ProgramRun run = runScript("HOME=/nonexistent fish --no-config -c 'source " + kFolder +
                                   "allpairs.fish; complete -C\"" + line + "\"' 2>/dev/null");
  EXPECT_EQ(run.status, 0);
  return sortedLines(run.out);
}

using Lines = std::vector<std::string>;

TEST(Completion, InTheRepositoryIsWhatTheProgramPrints) {
  const std::vector<std::pair<std::string, std::string>> files{
      {"bash", "allpairs.bash"}, {"zsh", "_allpairs"}, {"fish", "allpairs.fish"}};
  for (const auto& [shell, file] : files) {
    const ProgramRun run = runProgram({"completion", shell});
    expectSuccess(run);
    EXPECT_EQ(run.out, readBytes(kFolder + file)) << "allpairs completion " << shell << " > completions/" << file;
  }
  expectFailure(runProgram({"completion", "csh"}), kWrongUsage, "'csh' is not one of bash, zsh, fish");
  expectFailure(runProgram({"completion"}), kWrongUsage, "see 'allpairs completion --help'");
}

TEST(Completion, OfBashOffersCommandsOptionsAndWords) {
  if (!hasShell("bash")) GTEST_SKIP() << "bash is not here";
  EXPECT_EQ(offeredByBash("allpairs re"), (Lines{"report"}));
  EXPECT_EQ(offeredByBash("allpairs detect --ex"), (Lines{"--exact"}));
  EXPECT_EQ(offeredByBash("allpairs detect --format \"\""), (Lines{"csv", "json", "npy", "table"}));
  EXPECT_EQ(offeredByBash("allpairs elements --format \"\""), (Lines{"json", "table"}));
  EXPECT_EQ(offeredByBash("allpairs generate b"), (Lines{"brownian"}));
  EXPECT_EQ(offeredByBash("allpairs help pl"), (Lines{"plan"}));
  EXPECT_EQ(offeredByBash("allpairs detect --distance 1"), (Lines{""}));
  EXPECT_EQ(offeredByBash("allpairs detect " + kFolder + "allp"),
            (Lines{kFolder + "allpairs.bash", kFolder + "allpairs.fish"}));
}

TEST(Completion, OfBashOffersTheWordsOfAnOptionBehindAnEqualsSign) {
  if (!hasShell("bash")) GTEST_SKIP() << "bash is not here";
  EXPECT_EQ(offeredByBash("allpairs detect --format ="), (Lines{"csv", "json", "npy", "table"}));
  EXPECT_EQ(offeredByBash("allpairs detect --format = c"), (Lines{"csv"}));
  EXPECT_EQ(offeredByBash("allpairs detect --format=c"), (Lines{"--format=csv"}));
  EXPECT_EQ(offeredByBash("allpairs detect --output = " + kFolder + "_a"), (Lines{kFolder + "_allpairs"}));
  EXPECT_EQ(offeredByBash("allpairs detect --output=" + kFolder + "_a"), (Lines{"--output=" + kFolder + "_allpairs"}));
  EXPECT_EQ(offeredByBash("allpairs detect --distance ="), (Lines{""}));
}

TEST(Completion, OfFishOffersCommandsOptionsAndWords) {
  if (!hasShell("fish")) GTEST_SKIP() << "fish is not here";
  EXPECT_EQ(offeredByFish("allpairs re"), (Lines{"report"}));
  EXPECT_EQ(offeredByFish("allpairs detect --ex"), (Lines{"--exact"}));
  EXPECT_EQ(offeredByFish("allpairs detect --format "), (Lines{"csv", "json", "npy", "table"}));
  EXPECT_EQ(offeredByFish("allpairs generate b"), (Lines{"brownian"}));
}

TEST(Completion, OfZshIsAScript) {
  if (!hasShell("zsh")) GTEST_SKIP() << "zsh is not here";
  expectSuccess(runScript("zsh -n " + kFolder + "_allpairs"));
}

}  // namespace
}  // namespace allpairs::test
