// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Expect.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// Makes boxes whose exhaustive search takes a second or so, and says how to search them.
std::string longWork(const TempFolder& folder) {
  const std::string boxes = folder.path() / "boxes.npy";
  expectSuccess(runProgram({"generate", "uniform", "-n", "200000", "-o", boxes}));
  return "detect " + boxes + " --strategy exhaustive --threads 1 -o " + (folder.path() / "pairs.npy").string();
}

TEST(Progress, OfLongWorkIsShownOnATerminalAndTakenAway) {
  if (runScript("command -v script").status != 0) GTEST_SKIP() << "script, which makes a terminal, is not here";
  const TempFolder folder;
  const std::string shown = folder.path() / "shown";
  const ProgramRun run = runScript("script -qefc \"$0 " + longWork(folder) + "\" " + shown + " </dev/null");
  EXPECT_EQ(run.status, 0);
  const std::string text = readBytes(shown);
  EXPECT_NE(text.find("\r\033[Kfinding pairs among 200,000 models: 0 s"), std::string::npos) << text;
  const std::size_t last = text.rfind("\r\033[K");
  ASSERT_NE(last, std::string::npos);
  EXPECT_EQ(text.substr(last + 4, 1).find_first_not_of("\r\n"), std::string::npos) << "the line is empty at the end";
}

TEST(Progress, IsNotShownElsewhere) {
  const TempFolder folder;
  const ProgramRun run = runScript("\"$0\" " + longWork(folder));
  expectSuccess(run);
  EXPECT_EQ(run.out, "");
}

}  // namespace
}  // namespace allpairs::test
