// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "Expect.h"
#include "allpairs/generate/BoxMotions.h"
#include "allpairs/generate/BoxScenes.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// The numbers behind the header of a NumPy file of version 1.
std::vector<float> numbersOf(const std::string& bytes) {
  const auto length = static_cast<std::size_t>(static_cast<unsigned char>(bytes[8])) +
                      256 * static_cast<std::size_t>(static_cast<unsigned char>(bytes[9]));
  std::vector<float> numbers((bytes.size() - 10 - length) / sizeof(float));
  std::memcpy(numbers.data(), bytes.data() + 10 + length, numbers.size() * sizeof(float));
  return numbers;
}

TEST(Generate, WritesTheBoxesOfTheSceneAsANumpyArray) {
  const TempFolder folder;
  const std::string file = (folder.path() / "boxes.npy").string();
  expectSuccess(runProgram({"generate", "needles", "-n", "321", "--seed", "9", "--sorted", "-o", file}));
  const std::string bytes = readBytes(file);
  EXPECT_NE(bytes.find("{'descr': '<f4', 'fortran_order': False, 'shape': (321, 6), }"), std::string::npos);
  EXPECT_EQ(numbersOf(bytes), generate::makeBoxes({.scene = "needles", .count = 321, .seed = 9, .sorted = true}));
}

TEST(Generate, WritesWhatDetectAndBenchRead) {
  const TempFolder folder;
  const std::string file = (folder.path() / "boxes.npy").string();
  expectSuccess(runProgram({"generate", "all-overlap", "-n", "7", "-o", file}));
  const ProgramRun detected = runProgram({"detect", file, "--format", "csv"});
  expectSuccess(detected);
  EXPECT_EQ(std::count(detected.out.begin(), detected.out.end(), '\n'), 1 + 7 * 6 / 2);
}

TEST(Generate, WritesTheFramesOfAMotionAsANumpyArray) {
  const TempFolder folder;
  const std::string file = (folder.path() / "frames.npy").string();
  expectSuccess(runProgram({"generate", "free-fall", "-n", "17", "--frames", "5", "--seed", "3", "-o", file}));
  const std::string bytes = readBytes(file);
  EXPECT_NE(bytes.find("{'descr': '<f4', 'fortran_order': False, 'shape': (5, 17, 6), }"), std::string::npos);
  std::vector<float> expected;
  generate::MotionFrames motion({"free-fall", 17, 3});
  for (int frame = 0; frame < 5; ++frame) {
    const auto rows = motion.next();
    expected.insert(expected.end(), rows.begin(), rows.end());
  }
  EXPECT_EQ(numbersOf(bytes), expected);
}

TEST(Generate, OfFramesOfAtRestBoxesOrOfASortedMotionIsWrongUsage) {
  expectFailure(runProgram({"generate", "uniform", "--frames", "3", "-o", "/dev/null"}), 2, "'uniform' do not move");
  expectFailure(runProgram({"generate", "brownian", "--sorted", "-o", "/dev/null"}), 2, "--sorted");
}

TEST(Generate, OfAnUnknownSceneIsWrongUsage) {
  expectFailure(runProgram({"generate", "forest", "-o", "/dev/null"}), 2, "'forest'");
}

TEST(Generate, TakesNumbersOfBoxesWithAnExponent) {
  const TempFolder folder;
  const auto bytesOf = [&](const std::string& count) {
    const std::string file = folder.path() / (count + ".npy");
    expectSuccess(runProgram({"generate", "uniform", "-n", count, "-o", file}));
    return readBytes(file);
  };
  const std::string expected = bytesOf("1200");
  for (const char* count : {"1.2e3", "12e2", "1.2E+3", "1200.0", "12000e-1"})
    EXPECT_EQ(bytesOf(count), expected) << count;
  for (const char* count : {"1.5", "1e-3", "1e", "-1e3", "1e400", "nan", "1e3x"}) {
    expectFailure(runProgram({"generate", "uniform", "-n", count, "-o", "/dev/null"}), 2, "--boxes");
  }
  expectFailure(runProgram({"generate", "uniform", "-n", "1e12", "-o", "/dev/null"}), 2, "4294967295");
}

TEST(Generate, OfMoreBoxesThanAnIndexCanNumberIsWrongUsage) {
  expectFailure(runProgram({"generate", "uniform", "-n", "4294967296", "-o", "/dev/null"}), 2, "4294967295");
}

TEST(Generate, UnderANameThatPromisesAnotherFormatIsWrongUsage) {
  const TempFolder folder;
  expectFailure(runProgram({"generate", "uniform", "-o", folder.path() / "x.csv"}), 2, "x.csv': boxes are written as");
  expectSuccess(runProgram({"generate", "uniform", "-o", folder.path() / "x.NPY"}));
}

TEST(Generate, ThatCannotWriteLeavesNoFile) {
  const TempFolder folder;
  const std::filesystem::path file = folder.path() / "missing" / "boxes.npy";
  expectFailure(runProgram({"generate", "uniform", "-o", file.string()}), 3, file.string());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Generate, OfMoreThanTheDiskHoldsWritesNothing) {
  const TempFolder folder;
  if (std::filesystem::space(folder.path()).capacity == 0) GTEST_SKIP() << "the disk does not say how large it is";
  const std::string file = folder.write("frames.npy", "before");
  std::vector<std::string> arguments{"generate", "brownian", "-n", "1e6", "--frames", "1e9", "-o", file};  // 24 PB
  const std::string problem = " left, and the result needs 22,888,183,594 MiB";
  expectFailure(runProgram(arguments), 3, file + ": its disk has ");
  expectFailure(runProgram(arguments), 3, problem);
  EXPECT_EQ(readBytes(file), "before");
  arguments[5] = "1000000000000000000";
  expectFailure(runProgram(arguments), 3, " left, and the result needs 17,592,186,044,416 MiB");
  const ProgramRun redirected =
      runScript("exec \"$0\" generate brownian -n 1e6 --frames 1e9 > '" + (folder.path() / "out").string() + "'");
  expectFailure(redirected, 3, "standard output: its disk has ");
  EXPECT_EQ(readBytes(folder.path() / "out"), "");
  expectFailure(runScript("exec \"$0\" generate brownian -n 1e6 --frames 1e9 -o /dev/full"), 3, "No space left");
}

TEST(Generate, FramesWithoutBoxesHaveNoBytesHoweverMany) {
  const TempFolder folder;
  const std::string file = (folder.path() / "frames.npy").string();
  const ProgramRun run = runProgram({"generate", "brownian", "-n", "0", "--frames", "1e15", "-o", file});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(readBytes(file).find("(1000000000000000, 0, 6)"), std::string::npos);
}

}  // namespace
}  // namespace allpairs::test
