// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <limits>

#include "Expect.h"
#include "support/Boxes.h"
#include "support/Npy.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

constexpr int kClosedPipe = 141;

std::size_t entriesOf(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(WrongUsage, IsOneLineAndStatusTwo) {
  const TempFolder folder;
  const std::string path = folder.write("boxes.npy", npyBytes({cube(0, 0, 0)}));
  expectFailure(runProgram({"find"}), kWrongUsage, "unknown command 'find'");
  expectFailure(runProgram({"detect"}), kWrongUsage, "no INPUT given");
  expectFailure(runProgram({"detect", path, "--frob"}), kWrongUsage, "--frob");
  expectFailure(runProgram({"detect", path, "--format", "xml"}), kWrongUsage,
                "'xml' is not one of table, csv, json, npy");
  expectFailure(runProgram({"detect", path, "--strategy", "fast"}), kWrongUsage, "'fast' is not one of");
  expectFailure(runProgram({"detect", path, "--distance"}), kWrongUsage, "--distance: D is missing");
  expectFailure(runProgram({"detect", path, "--box="}), kWrongUsage, "--box: x0,y0,z0,x1,y1,z1 is missing");
  expectFailure(runProgram({"detect", path, "--distance", "1", "--distance", "2"}), kWrongUsage,
                "--distance may be given only once");
  expectFailure(runProgram({"detect", path, "--distance", "wide"}), kWrongUsage, "--distance: 'wide'");
  expectFailure(runProgram({"detect", path, "--distance", "nan"}), kWrongUsage, "--distance: 'nan'");
  expectFailure(runProgram({"detect", path, "--distance", "-inf"}), kWrongUsage, "--distance: '-inf'");
  expectFailure(runProgram({"detect", path, "--threads", "-1"}), kWrongUsage, "--threads");
  expectFailure(runProgram({"detect", path, "--threads", "many"}), kWrongUsage, "--threads: 'many'");
  expectFailure(runProgram({"detect", path, "--threads", "100000"}), kWrongUsage, "from 0 to 9999");
  expectFailure(runProgram({"detect", path, "--box", "0,0,0,1,1"}), kWrongUsage, "has 5 numbers");
  expectFailure(runProgram({"detect", path, "--box", "0,0,0,1,1,1,"}), kWrongUsage, "is not a number");
  expectFailure(runProgram({"detect", path, "--box", "0,0,0,1,1,1,2"}), kWrongUsage, "has 7 numbers");
  expectFailure(runProgram({"detect", path, "--box", "0 0 0 1 1 1"}), kWrongUsage,
                "--box: '0 0 0 1 1 1' is not x0,y0,z0,x1,y1,z1, six numbers with commas between them");
  expectFailure(runProgram({"detect", path, "--box", "0,0,0,1,0,1"}), kWrongUsage, "is not on y");
  expectFailure(runProgram({"detect", path, "--box", "0,0,nan,1,0,1"}), kWrongUsage, "'nan'");
  expectFailure(runProgram({"info"}), kWrongUsage, "no INPUT given");
  expectFailure(runProgram({"completion"}), kWrongUsage, "no SHELL given");
}

TEST(BadInput, IsOneLineThatNamesTheFileAndStatusThree) {
  const TempFolder folder;
  std::vector<Box> boxes{cube(0, 0, 0), cube(1, 1, 1)};
  boxes[1].min[1] = std::numeric_limits<double>::quiet_NaN();
  const std::string nan = folder.write("nan.npy", npyBytes(boxes));
  const std::string cut = folder.write("cut.npy", npyBytes({cube(0, 0, 0)}).substr(0, 150));
  const std::string csv = folder.write("bad.csv", "0,0,0,1,1,1\n0,0,0,1,x,1\n");
  const std::string obj = folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
  const std::string text = folder.write("notes.txt", "hello");
  std::filesystem::create_directory(folder.path() / "empty");
  for (const char* command : {"detect", "info"}) {
    expectFailure(runProgram({command, "nowhere.npy"}), kBadInput, "nowhere.npy: no such file");
    expectFailure(runProgram({command, nan}), kBadInput, nan + ": box 1: min y is not a number");
    expectFailure(runProgram({command, cut}), kBadInput, cut + ": ");
    expectFailure(runProgram({command, csv}), kBadInput, csv + ":2:9: 'x' is not a number");
    expectFailure(runProgram({command, obj}), kBadInput, obj + ":2: ");
    expectFailure(runProgram({command, text}), kBadInput, text + ": ");
    expectFailure(runProgram({command, folder.path() / "empty"}), kBadInput, "is a folder without mesh files");
    expectFailure(runProgram({command, ALLPAIRS_SOURCE_DIR "/examples/boxes.csv", "--data", text}), kBadInput,
                  text + ": is not a folder");
  }
}

TEST(BadInput, WhatStandsBehindTwoDashesIsAFile) {
  const TempFolder folder;
  const std::string path = folder.write("boxes.npy", npyBytes({cube(0, 0, 0)}));
  expectFailure(runProgram({"detect", path, "--", "--frob"}), kBadInput, "allpairs: --frob: no such file");
  expectFailure(runProgram({"detect", "--", path, "-x.npy"}), kBadInput, "allpairs: -x.npy: no such file");
  expectFailure(runProgram({"detect", "./-x.npy"}), kBadInput, "allpairs: ./-x.npy: no such file");
  expectFailure(runProgram({"detect", "--", "-"}), kBadInput, "allpairs: ./-: no such file");
  expectFailure(runProgram({"join", "--count", path, "--with", "--", "--x.npy"}), kBadInput,
                "allpairs: --x.npy: no such file");
  expectFailure(runProgram({"generate", "uniform", "--", "--x"}), kWrongUsage, "one argument too many: '--x'");
  expectFailure(runProgram({"help", "detect", "--", "-x"}), kWrongUsage, "one argument too many: '-x'");
  expectFailure(runProgram({"--", "--x"}), kWrongUsage, "'--x'");
  expectSuccess(runProgram({"detect", "--", path}));
}

TEST(BadInput, NamesOfFilesCannotSendCommandsToTheTerminal) {
  const ProgramRun run = runProgram({"detect", "no\nwhere\x1b[2J.npy"});
  expectFailure(run, kBadInput, "no\\x0awhere\\x1b[2J.npy: no such file");
  EXPECT_EQ(run.err.find('\x1b'), std::string::npos);
  const std::string c1 =
      "a\xC2\x9B"
      "31m\xC2\xA0\xC3\x9B";  // CSI as one character, and two letters
  expectFailure(runProgram({"detect", c1 + ".npy"}), kBadInput, "a\\xc2\\x9b31m\xC2\xA0\xC3\x9B.npy: no such file");
  const TempFolder folder;
  const ProgramRun table = runProgram({"info", folder.write("c1.csv", c1 + ",0,0,0,1,1,1\n")});
  EXPECT_EQ(table.out.find("\xC2\x9B"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("a\\xc2\\x9b31m\xC2\xA0\xC3\x9B"), std::string::npos) << table.out;
}

TEST(BadInput, APipeInAFolderIsLeftOutAndNotWaitedFor) {
  const TempFolder folder;
  const std::string pipe = folder.path() / "pipe.obj";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const ProgramRun run = runProgram({"info", folder.path()});
  expectSuccess(run);
  EXPECT_NE(run.out.find(pipe + ": is not a regular file"), std::string::npos) << run.out;
}

TEST(OutputFile, AppearsWholeAndUnderItsName) {
  const TempFolder folder;
  const std::string path = folder.write("boxes.npy", npyBytes({cube(0, 0, 0), cube(1, 1, 1)}));
  const std::string target = folder.path() / "pairs.npy";
  const ProgramRun run = runProgram({"detect", path, "-o", target});
  expectSuccess(run);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(pairsOfNpy(readBytes(target)), (std::vector<Pair>{{0, 1}})) << "the extension says the format";
  EXPECT_EQ(entriesOf(folder.path()), 2U) << "no temporary is left";
}

TEST(OutputFile, IsNotTouchedWhenTheInputIsBad) {
  const TempFolder folder;
  const std::string target = folder.write("pairs.csv", "before");
  expectFailure(runProgram({"detect", "nowhere.npy", "-o", target}), kBadInput, "nowhere.npy");
  EXPECT_EQ(readBytes(target), "before");
  EXPECT_EQ(entriesOf(folder.path()), 1U);
}

TEST(OutputFile, InAMissingFolderOrWhereAFolderIsIsAnError) {
  const TempFolder folder;
  const std::string path = folder.write("boxes.npy", npyBytes({cube(0, 0, 0)}));
  const std::string missing = folder.path() / "no" / "pairs.npy";
  expectFailure(runProgram({"detect", path, "-o", missing}), kBadInput, missing + ": cannot be created");
  expectFailure(runProgram({"detect", path, "-o", folder.path()}), kBadInput, "is a folder");
}

TEST(OutputFile, ALinkStaysALinkAndKeepsItsTargetsPermissions) {
  const TempFolder folder;
  const std::string path = folder.write("boxes.npy", npyBytes({cube(0, 0, 0)}));
  const std::filesystem::path target = folder.write("real.json", "");
  std::filesystem::permissions(target, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  std::filesystem::create_symlink("real.json", folder.path() / "link.json");
  expectSuccess(runProgram({"detect", path, "-o", folder.path() / "link.json"}));
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.json"));
  EXPECT_TRUE(readBytes(target).starts_with("{\"models\""));
  EXPECT_EQ(std::filesystem::status(target).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST(OutputFile, ALinkToNothingYetStaysALinkToo) {
  const TempFolder folder;
  const std::string path = folder.write("boxes.npy", npyBytes({cube(0, 0, 0)}));
  const std::filesystem::path link = folder.path() / "link.csv";
  std::filesystem::create_symlink("second", link);
  std::filesystem::create_symlink(folder.path() / "new.csv", folder.path() / "second");
  expectSuccess(runProgram({"detect", path, "-o", link}));
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(readBytes(folder.path() / "new.csv"), "first,second\n");
}

TEST(StandardOutput, ThatCannotBeWrittenIsAnError) {
  const TempFolder folder;
  const std::string path = folder.write("boxes.npy", npyBytes({cube(0, 0, 0), cube(1, 1, 1)}));
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"detect", path}, {"detect", path, "--format", "json"}, {"info", path}, {"--help"}, {"--version"}}) {
    expectFailure(runProgram(words, StandardOutput::FullDevice), kBadInput, "standard output: cannot be written");
    expectFailure(runProgram(words, StandardOutput::Closed), kBadInput, "standard output: cannot be written");
    const ProgramRun run = runProgram(words, StandardOutput::ClosedPipe);
    EXPECT_EQ(run.status, kClosedPipe);
    EXPECT_EQ(run.err, "") << "who closed the pipe knows";
  }
  expectFailure(runProgram({"detect", path, "-o", "/dev/full"}), kBadInput, "/dev/full: cannot be written");
}

}  // namespace
}  // namespace allpairs::test
