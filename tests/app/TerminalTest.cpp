// SPDX-License-Identifier: MIT
#include "cli/Terminal.h"

#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "Expect.h"
#include "cli/HelpFormatter.h"
#include "cli/Progress.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

TEST(Elided, TextKeepsItsBeginAndItsEnd) {
  EXPECT_EQ(app::elided("left.obj", 8), "left.obj");
  EXPECT_EQ(app::elided("abcdefghij", 7), "abc…hij");
  EXPECT_EQ(app::elided("abcdefghij", 6), "abc…ij");
  EXPECT_EQ(app::elided("ääääöööö", 5), "ää…öö");
  EXPECT_EQ(app::elided("abc", 1), "…");
  EXPECT_EQ(app::elided("abc", 0), "");
}

TEST(Wrapped, TextBreaksAtBlanks) {
  EXPECT_EQ(app::wrapped("one two three", 7), "one two\nthree");
  EXPECT_EQ(app::wrapped("one two three", 8), "one two\nthree");
  EXPECT_EQ(app::wrapped("immeasurably long", 4), "immeasurably\nlong");
  EXPECT_EQ(app::wrapped("", 4), "");
}

TEST(Filled, HelpIsChangedOnlyWhereItIsTooWide) {
  const std::string text = "Kinds\nof shapes:\n  cube         six faces\n  dodecahedron twelve  of them\n";
  EXPECT_EQ(app::filled(text, 31), text);
}

TEST(Filled, ParagraphsColumnsAndCommandsKeepTheirForm) {
  const std::string text =
      "The kinds of\nshapes that are known:\n  a cube       six faces, all of them squares of the same size\n"
      "               and 8 corners\n\nExamples:\n  allpairs info boxes.csv | jq '.pairs | length' > count.txt\n"
      "  allpairs detect some-long-name.npy -o a.npy --threads 2      as a table of pairs of boxes";
  EXPECT_EQ(app::filled(text, 44),
            "The kinds of shapes that are known:\n"
            "  a cube       six faces, all of them\n"
            "               squares of the same size\n"
            "               and 8 corners\n"
            "\n"
            "Examples:\n"
            "  allpairs info boxes.csv | jq \\\n"
            "      '.pairs | length' > count.txt\n"
            "  allpairs detect some-long-name.npy \\\n"
            "      -o a.npy --threads 2\n"
            "      as a table of pairs of boxes");
}

TEST(ProgressText, HasABarAndTheTimeLeft) {
  EXPECT_EQ(app::progressText("frame 3", 0.25, 10.0, 78), "frame 3  [#####               ]  25 %, 30 s left");
  EXPECT_EQ(app::progressText("x", 0.5, 600.0, 78), "x  [##########          ]  50 %, 10 min left");
  EXPECT_EQ(app::progressText("x", 0.1, 3600.0, 78), "x  [##                  ]  10 %, 9 h left");
  EXPECT_EQ(app::progressText("x", 0.0, 1.0, 78), "x  [                    ]   0 %") << "nothing is known yet";
  EXPECT_EQ(app::progressText("reading a-long-name.obj", 0.5, 2.0, 50),
            "readi….obj  [##########          ]  50 %, 2 s left");
}

/// A folder with two parts of long names that overlap, and what a terminal of so many columns shows.
class Terminal : public testing::Test {
 protected:
  Terminal() {
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n";
    m_folder.write("parts/a.obj", "o " + m_first + '\n' + triangle);
    m_folder.write("parts/b.obj", "o the second part with a long name\n" + triangle);
  }

  void SetUp() override {
    if (runScript("command -v script").status != 0) GTEST_SKIP() << "script, which makes a terminal, is not here";
  }

  [[nodiscard]] std::string shown(const std::string& command, const std::string& environment = {},
                                  const std::string& columns = "60") const {
    const ProgramRun run =
        runScript("cd '" + m_folder.path().string() + "' && unset NO_COLOR && export TERM=xterm && " + environment +
                  " script -qefc \"stty cols " + columns + "; $0 " + command + "\" shown </dev/null");
    EXPECT_EQ(run.status, 0) << run.out;
    return std::regex_replace(run.out, std::regex("\r|\033\\[K"), "");
  }

  const std::string m_first = "the first part with a long name";

 private:
  TempFolder m_folder;
};

std::size_t widest(const std::string& text) {
  std::istringstream stream(text);
  std::size_t most = 0;
  for (std::string line; std::getline(stream, line);) most = std::max(most, app::columnsOf(line));
  return most;
}

TEST_F(Terminal, TablesAndOptionsStayWithinItsWidth) {
  const std::string table = shown("detect parts");
  const std::size_t pair = table.find("  the second");
  ASSERT_NE(pair, std::string::npos) << table;
  const std::string line = table.substr(pair, table.find('\n', pair) - pair);
  EXPECT_LE(app::columnsOf(line), 60U) << line;
  EXPECT_NE(line.find("the second pa…h a long name   the first par…h a long name"), std::string::npos) << line;
  EXPECT_NE(runProgram({"detect", "--help"}).out.find("Ignore models outside of this region\n"), std::string::npos);
}

TEST_F(Terminal, NamesOfModelsStayWithinItsWidth) {
  const std::string table = shown("info parts", {}, "90");
  const std::size_t row = table.find("0  the first");
  ASSERT_NE(row, std::string::npos) << table;
  EXPECT_LE(app::columnsOf(table.substr(row, table.find('\n', row) - row)), 90U) << table;
}

TEST_F(Terminal, HelpStaysWithinItsWidth) {
  for (const char* command : {"", "detect", "join", "plan", "info", "elements", "track", "view", "report", "generate",
                              "bench", "completion"}) {
    for (const std::string width : {"60", "44"}) {
      if (command == std::string("completion") && width == "44") continue;  // names a file that cannot be broken
      const std::string help = shown(std::string(command) + " --help", {}, width);
      EXPECT_LE(widest(help), std::stoul(width)) << command << '\n' << help;
      EXPECT_NE(help.find("Examples:\n  allpairs"), std::string::npos) << help;
    }
  }
}

TEST_F(Terminal, LastLineSaysWhatWasWritten) {
  EXPECT_TRUE(shown("detect parts -o pairs.csv").ends_with("1 pair → pairs.csv\n"));
  EXPECT_TRUE(shown("generate uniform -n 30 -o b.npy").ends_with("30 boxes → b.npy\n"));
  EXPECT_TRUE(shown("generate brownian -n 3 --frames 2 -o w.npy").ends_with("3 boxes → w.npy\n"));
  EXPECT_TRUE(shown("detect w.npy --worlds --distance inf -o p.csv").ends_with("6 pairs → p.csv\n"));
  EXPECT_TRUE(shown("elements parts parts -o e.json").ends_with(" candidates → e.json\n"));
  EXPECT_TRUE(shown("report parts --boxes -o r").ends_with("1 pair of boxes → r/index.html\n"));
  EXPECT_TRUE(shown("view parts --boxes -o v.html").ends_with("1 pair of boxes → v.html\n"));
}

#ifdef ALLPAIRS_HAS_FCL
TEST_F(Terminal, HasColoursUnlessTheyAreNotWanted) {
  const std::string colour = "\033[";
  EXPECT_NE(shown("detect parts --exact").find(colour), std::string::npos);
  EXPECT_EQ(shown("detect parts --exact", "NO_COLOR=1").find(colour), std::string::npos);
  EXPECT_EQ(shown("detect parts --exact", "TERM=dumb").find(colour), std::string::npos);
  EXPECT_NE(shown("detect parts --exact --color always", "NO_COLOR=1").find(colour), std::string::npos);
  EXPECT_EQ(shown("detect parts --exact --color never").find(colour), std::string::npos);
  EXPECT_EQ(shown("detect parts").find(colour), std::string::npos) << "there is nothing to colour";
}
#endif

}  // namespace
}  // namespace allpairs::test
