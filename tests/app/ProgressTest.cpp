// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Expect.h"
#include "support/Boxes.h"
#include "support/Npy.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// A folder with boxes that all overlap, whose pairs are more than a pipe holds, and a pipe to write them to.
class Progress : public testing::Test {
 protected:
  Progress() { m_folder.write("boxes.npy", npyBytes(std::vector<Box>(500, cube(0, 0, 0)))); }

  /// Runs a command while `reader` reads the pipe, which it has opened as its descriptor 5; "$0" is the program.
  ProgramRun write(const std::string& command, const std::string& reader) const {
    return runScript("cd '" + m_folder.path().string() + "' && mkfifo pipe || exit 99; (exec 5<pipe; " + reader +
                     "; cat <&5 >pairs.csv) & " + command + "; status=$?; wait; exit $status");
  }

  TempFolder m_folder;
};

TEST_F(Progress, OfLongWorkIsShownOnATerminalAndTakenAway) {
  if (runScript("command -v script").status != 0) GTEST_SKIP() << "script, which makes a terminal, is not here";
  const ProgramRun run =
      write("script -qefc \"$0 detect boxes.npy --format csv -o pipe\" shown </dev/null",
            "i=0; until grep -q 'writing: ' shown || [ $i = 600 ]; do sleep 0.1; i=$((i + 1)); done 2>/dev/null");
  EXPECT_EQ(run.status, 0);
  const std::string text = readBytes(m_folder.path() / "shown");
  EXPECT_NE(text.find("\r\033[Kwriting: 0 s"), std::string::npos) << text;
  const std::size_t last = text.rfind("\r\033[K");
  ASSERT_NE(last, std::string::npos);
  EXPECT_TRUE(text.substr(last + 4).starts_with("124,750 pairs → pipe\r\n")) << "what was written stands in its place";
}

TEST_F(Progress, IsNotShownElsewhere) {
  const ProgramRun run = write("\"$0\" detect boxes.npy --format csv -o pipe", "sleep 1");
  expectSuccess(run);
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(readBytes(m_folder.path() / "pairs.csv").starts_with("first,second\n1,0\n"));
}

}  // namespace
}  // namespace allpairs::test
