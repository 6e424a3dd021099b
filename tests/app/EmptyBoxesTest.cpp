// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "Expect.h"
#include "support/Boxes.h"
#include "support/Npy.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

TEST(BoxWithMinAboveMax, IsNamedInNoResultWhereStandardErrorIsClosed) {
  const TempFolder folder;
  folder.write("boxes.csv", "a,0,0,0,1,1,1\nb,3,3,3,4,2,4\nc,0,0,0,1,1,1\n");
  expectSuccess(runScript("cd '" + folder.path().string() + "' && \"$0\" detect boxes.csv -o pairs.csv 2>&-"));
  EXPECT_EQ(readBytes(folder.path() / "pairs.csv"), "first,second\nc,a\n");
}

TEST(BoxWithMinAboveMax, IsNamedInAWarning) {
  const TempFolder folder;
  const std::string csv = folder.write("boxes.csv", "a,0,0,0,1,1,1\nb,3,3,3,4,2,4\nc,9,3,3,4,2,4\n");
  const std::string reason = "min above max on y (and 1 other box): empty, in no pair";
  const std::string line = "allpairs: warning: " + csv + ": box 1 'b': " + reason + '\n';
  ProgramRun run = runProgram({"detect", csv, "--format", "csv"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, line);
  const std::string npy = folder.write("boxes.npy", npyBytes({cube(0, 0, 0), Box{{0, 0, 1}, {1, 1, 0}}, kEmptyBox}));
  const std::string ofNpy = "allpairs: warning: " + npy + ": box 1: min above max on z: empty, in no pair\n";
  run = runProgram({"detect", npy, "--format", "csv"});
  EXPECT_EQ(run.err, ofNpy) << "infinite bounds are meant";
  const std::string mesh = folder.write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n");
  EXPECT_EQ(runProgram({"detect", mesh, npy, csv}).err, ofNpy + line) << "beside meshes too";
  EXPECT_NE(runProgram({"info", csv}).out.find("\nwarnings\n  " + csv + ": box 1 'b': " + reason + '\n'),
            std::string::npos);
}

TEST(BoxWithMinAboveMax, IsNamedInJson) {
  const TempFolder folder;
  const std::string csv = folder.write("boxes.csv", "a,0,0,0,1,1,1\nb,3,3,3,4,2,4\nc,0,0,0,1,1,1\n");
  const std::string mesh = folder.write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n");
  std::vector<std::vector<std::string>> inputs{{csv}, {csv, mesh}};
#ifdef ALLPAIRS_HAS_FCL
  inputs.push_back({csv, "--exact"});
#endif
  const auto expected = nlohmann::json::array(
      {{{"file", csv}, {"line", 0}, {"subject", "box 1 'b'"}, {"reason", "min above max on y: empty, in no pair"}}});
  for (std::vector<std::string>& words : inputs) {
    words.insert(words.begin(), {"detect", "--format", "json"});
    EXPECT_EQ(nlohmann::json::parse(runProgram(words).out)["warnings"], expected) << words.back();
  }
}

TEST(AFileOfTextWithoutBoxes, IsNamedInAWarning) {
  const TempFolder folder;
  const std::string page = folder.path() / "page.html";
  for (const char* text : {"", "# nothing\n", "name,minx,miny,minz,maxx,maxy,maxz\n"}) {
    const std::string csv = folder.write("none.csv", text);
    const std::string line = "allpairs: warning: " + csv + ": holds no boxes\n";
    const std::string mesh = folder.write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n");
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"detect", csv}, {"detect", csv, mesh}, {"view", csv, "-o", page}, {"bench", csv, "--repetitions", "1"}}) {
      const ProgramRun run = runProgram(words);
      EXPECT_EQ(run.status, 0) << words.front();
      EXPECT_NE(run.err.find(line), std::string::npos) << words.front() << ": " << run.err;
    }
    EXPECT_NE(runProgram({"info", csv}).out.find("\nwarnings\n  " + csv + ": holds no boxes\n"), std::string::npos);
    EXPECT_EQ(runScript("\"$0\" detect - --input-format csv < '" + csv + "'").err,
              "allpairs: warning: standard input: holds no boxes\n");
  }
  expectSuccess(runProgram({"detect", folder.write("none.npy", npyBytes({}))}));
}

/// Boxes of two frames or worlds of three.
std::string framesBytes() {
  const std::vector<Box> boxes{cube(0, 0, 0), cube(1, 1, 1),          kEmptyBox,
                               cube(0, 0, 0), {{0, 0, 3}, {1, 1, 2}}, {{4, 0, 0}, {3, 1, 1}}};
  return npyBytes(boxes, {.shape = "(2, 3, 6)"});
}

TEST(BoxWithMinAboveMax, IsNamedByItsFrameOrWorld) {
  const TempFolder folder;
  const std::string npy = folder.write("frames.npy", framesBytes());
  const auto warning = [](const std::string& file, const std::string& part) {
    return "allpairs: warning: " + file + ": box 1 of " + part +
           " 1: min above max on z (and 1 other box): empty, in no pair\n";
  };
  EXPECT_EQ(runProgram({"track", npy}).err, warning(npy, "frame"));
  EXPECT_EQ(runProgram({"detect", npy, "--worlds"}).err, warning(npy, "world"));
  EXPECT_EQ(runProgram({"view", npy, "-o", (folder.path() / "page.html").string()}).err, warning(npy, "frame"));
  EXPECT_EQ(runScript("\"$0\" track - --input-format npy < '" + npy + "'").err, warning("standard input", "frame"));
}

TEST(BoxWithMinAboveMax, IsNamedByJoinAndPlan) {
  const TempFolder folder;
  const std::string whole = folder.write("whole.npy", npyBytes({cube(0, 0, 0), cube(1, 1, 1)}));
  const std::string wrong =
      folder.write("wrong.npy", npyBytes({kEmptyBox, Box{{0, 0, 3}, {1, 1, 2}}, Box{{4, 0, 0}, {3, 1, 1}}}));
  const std::string pairs = (folder.path() / "pairs.npy").string();
  const std::string reason = ": min above max on z (and 1 other box): empty, in no pair\n";
  EXPECT_EQ(runProgram({"join", whole, "-o", pairs}).err, "");
  EXPECT_EQ(runProgram({"join", wrong, "-o", pairs}).err, "allpairs: warning: " + wrong + ": box 1" + reason);
  const std::string ofBoth = "allpairs: warning: " + whole + " and 1 more: box 3 of all of them";
  EXPECT_EQ(runProgram({"join", whole, wrong, "--count"}).err, ofBoth + reason);
  EXPECT_EQ(runProgram({"join", whole, "--with", wrong, "--count"}).err,
            "allpairs: warning: " + wrong + ": box 1" + reason);
  EXPECT_EQ(runProgram({"join", whole, "--with", whole, wrong, "--count"}).err, ofBoth + ", in set 2" + reason);
  EXPECT_EQ(runProgram({"plan", wrong, "--ranks", "2"}).err, "allpairs: warning: " + wrong + ": box 1" + reason);
  EXPECT_EQ(runProgram({"plan", wrong, "--work", folder.path().string()}).err,
            "allpairs: warning: " + wrong + ": box 1" + reason);
}

}  // namespace
}  // namespace allpairs::test
