// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "Expect.h"
#include "allpairs/generate/BoxMotions.h"
#include "support/Boxes.h"
#include "support/Npy.h"
#include "support/Oracle.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// Frames of boxes as the bytes of a .npy file.
std::string framesBytes(const std::vector<std::vector<Box>>& frames, const std::string& type = "<f8") {
  std::vector<Box> all;
  for (const auto& boxes : frames) all.insert(all.end(), boxes.begin(), boxes.end());
  const std::string shape =
      '(' + std::to_string(frames.size()) + ", " + std::to_string(frames.empty() ? 0 : frames[0].size()) + ", 6)";
  return npyBytes(all, {.descr = type, .shape = shape});
}

/// Three boxes of which the last one passes from the first to the second.
std::vector<std::vector<Box>> passing() {
  std::vector<std::vector<Box>> frames;
  for (const double x : {0.5, 2.0, 3.5, 3.5}) frames.push_back({cube(0, 0, 0), cube(4, 0, 0), cube(x, 0, 0)});
  return frames;
}

TEST(Track, CountsPairsThatBeginAndEnd) {
  const TempFolder folder;
  for (const char* type : {"<f4", "<f8", ">f4", ">f8"}) {
    const std::string file = folder.write("frames.npy", framesBytes(passing(), type));
    const ProgramRun run = runProgram({"track", file, "--format", "json", "--verify"});
    expectSuccess(run);
    const auto json = nlohmann::json::parse(run.out, nullptr, false);
    EXPECT_EQ(json["boxes"], 3);
    EXPECT_EQ(json["pairs"], (std::vector<int>{1, 0, 1, 1}));
    EXPECT_EQ(json["began"], (std::vector<int>{1, 0, 1, 0}));
    EXPECT_EQ(json["ended"], (std::vector<int>{0, 1, 0, 0}));
    EXPECT_EQ(json["milliseconds"].size(), 4U);
    EXPECT_GE(json["statistics"]["worstMs"], json["statistics"]["medianMs"]);
  }
}

TEST(Track, OfAGeneratedMotionAgreesWithTheDoubleLoop) {
  constexpr std::size_t kFrames = 12;
  const TempFolder folder;
  const std::string file = (folder.path() / "frames.npy").string();
  expectSuccess(runProgram({"generate", "brownian", "-n", "400", "--frames", std::to_string(kFrames), "-o", file}));
  const ProgramRun run = runProgram({"track", file, "--distance", "0.01", "--format", "csv"});
  expectSuccess(run);
  std::istringstream lines(run.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "frame,pairs,began,ended,milliseconds");
  generate::MotionFrames motion({"brownian", 400, 1});
  std::vector<Pair> before;
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    const auto rows = motion.next();
    std::vector<Box> boxes(rows.size() / 6);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const std::size_t axis = k % 3;
      (k % 6 < 3 ? boxes[k / 6].min : boxes[k / 6].max)[axis] = static_cast<double>(rows[k]);
    }
    const std::vector<Pair> pairs = oracle(boxes, 0.01);
    std::vector<Pair> began;
    std::vector<Pair> ended;
    std::set_difference(pairs.begin(), pairs.end(), before.begin(), before.end(), std::back_inserter(began));
    std::set_difference(before.begin(), before.end(), pairs.begin(), pairs.end(), std::back_inserter(ended));
    before = pairs;
    std::getline(lines, line);
    std::ostringstream expected;
    expected << frame << ',' << pairs.size() << ',' << began.size() << ',' << ended.size() << ',';
    EXPECT_EQ(line.substr(0, line.rfind(',') + 1), expected.str());
  }
}

TEST(Track, AnInfiniteDistanceIsWrittenAsOne) {
  const TempFolder folder;
  const std::string file = folder.write("frames.npy", framesBytes(passing(), "<f4"));
  const ProgramRun run = runProgram({"track", file, "--format", "json", "--distance", "inf"});
  expectSuccess(run);
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  EXPECT_EQ(json["statistics"]["distance"], "inf");
  EXPECT_EQ(json["pairs"], (std::vector<int>{3, 3, 3, 3}));
}

TEST(Track, WritesTheCountsAsANumpyArray) {
  const TempFolder folder;
  const std::string file = folder.write("frames.npy", framesBytes(passing()));
  const std::string output = (folder.path() / "counts.npy").string();
  expectSuccess(runProgram({"track", file, "-o", output}));
  EXPECT_NE(readBytes(output).find("{'descr': '<f8', 'fortran_order': False, 'shape': (4, 4), }"), std::string::npos);
}

TEST(Track, FollowsTheTrianglesOfMeshesThatShareNoVertex) {
  const TempFolder folder;
  const std::string mesh = "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 2 0\nf 1 2 3\nf 2 4 3\n";
  const std::string apart = folder.write("0.obj", mesh + "v 0 0 5\nv 1 0 5\nv 0 1 5\nf 5 6 7\n");
  const std::string touching = folder.write("1.obj", mesh + "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 5 6 7\n");
  const ProgramRun run = runProgram({"track", apart, touching, "--format", "json", "--verify"});
  expectSuccess(run);
  const auto json = nlohmann::json::parse(run.out, nullptr, false);
  EXPECT_EQ(json["boxes"], 3);
  EXPECT_EQ(json["pairs"], (std::vector<int>{0, 2}));
  const std::string points = folder.write("points.obj", mesh + "o corner\nv 9 9 9\np 5\n");
  for (const std::vector<std::string>& command : {std::vector<std::string>{"track", points, "--format", "csv"},
                                                  {"track", points, points, points, "--format", "csv"},
                                                  {"elements", apart, apart, points, points, "--format", "json"}}) {
    const ProgramRun left = runProgram(command);
    EXPECT_EQ(left.status, 0);
    EXPECT_EQ(left.err, "allpairs: warning: " + points + ": 1 model left out: no triangle mesh\n");
  }
  const std::string fewer = folder.write("2.obj", mesh);
  expectFailure(runProgram({"track", apart, fewer}), 3, "2.obj: mesh '2.obj' has 4 vertices where");
}

TEST(Track, OfBadFramesNamesFileFrameAndBox) {
  const TempFolder folder;
  auto frames = passing();
  frames[2][1].min[1] = std::numeric_limits<double>::quiet_NaN();
  expectFailure(runProgram({"track", folder.write("nan.npy", framesBytes(frames))}), 3, "nan.npy: frame 2: box 1");
  const std::string cut = framesBytes(passing());
  expectFailure(runProgram({"track", folder.write("cut.npy", cut.substr(0, cut.size() - 8))}), 3, "(4, 3, 6)");
  expectFailure(runProgram({"track", folder.write("flat.npy", npyBytes({cube(0, 0, 0)}))}), 3, "(t, n, 6)");
  const std::string fortran = npyBytes({cube(0, 0, 0)}, {.fortran = true, .shape = "(1, 1, 6)"});
  expectFailure(runProgram({"track", folder.write("fortran.npy", fortran)}), 3, "Fortran");
  const std::string huge = npyBytes({}, {.shape = "(18446744073709551615, 4294967295, 6)"});
  expectFailure(runProgram({"track", folder.write("huge.npy", huge)}), 3, "huge.npy: holds 0 bytes");
}

TEST(Track, TakesTheMemoryOfAFrame) {
  const TempFolder folder;
  const std::string file = folder.write("frames.npy", framesBytes(passing()));
  expectFailure(runProgram({"track", file, "--max-memory", "143"}), 3,
                "frames.npy: needs more memory than --max-memory");
  expectSuccess(runProgram({"track", file, "--max-memory", "144"}));
}

TEST(Track, OfSeveralArraysIsWrongUsage) {
  const TempFolder folder;
  const std::string file = folder.write("frames.npy", framesBytes(passing()));
  expectFailure(runProgram({"track", file, file}), 2, "one mesh file per frame");
}

TEST(Track, OfASofaSceneSaysThatOnlyItsStartIsRead) {
  const TempFolder folder;
  const std::string scene = folder.write("fall.scn", "<Node name='root'/>");
  const std::string message =
      "fall.scn: a SOFA scene is read as it is at its start, and has no frames; 'allpairs detect'";
  expectFailure(runProgram({"track", scene, scene}), kWrongUsage, message);
  expectFailure(runProgram({"view", "--sequence", scene}), kWrongUsage, message);
}

TEST(Track, OfNoFramesOrNoBoxesCountsNothing) {
  const TempFolder folder;
  for (const char* shape : {"(0, 5, 6)", "(3, 0, 6)"}) {
    const ProgramRun run = runProgram({"track", folder.write("frames.npy", npyBytes({}, {.shape = shape}))});
    expectSuccess(run);
    EXPECT_NE(run.out.find("began    0\n"), std::string::npos) << run.out;
    const std::string boxes = shape[1] == '0' ? "frames   0 of 5 boxes\n" : "frames   3 of 0 boxes\n";
    EXPECT_NE(run.out.find(boxes), std::string::npos) << run.out;
  }
}

}  // namespace
}  // namespace allpairs::test
