// SPDX-License-Identifier: MIT
#include "allpairs/scene/BoxFrames.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "allpairs/Error.h"
#include "support/Npy.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

const std::vector<Box> kBoxes{{{0, 1, 2}, {3, 4, 5}},   {{-1.5, -2, -3}, {0.25, 0, 7}}, {{6, 6, 6}, {8, 8, 8}},
                              {{1, 1, 1}, {2, 2, 2.5}}, {{0, 0, 0}, {1, 1, 1}},         {{9, 9, 9}, {8, 10, 10}}};

/// The six boxes as two frames of three.
std::string framesBytes(NpyStyle style = {}) {
  style.shape = "(2, 3, 6)";
  return npyBytes(kBoxes, style);
}

std::vector<Box> boxesOf(const scene::BoxFrames& frames) {
  std::vector<Box> boxes;
  for (std::size_t frame = 0; frame < frames.frameCount; ++frame) {
    const BoxSet set = frames.frame(frame);
    for (std::size_t i = 0; i < set.size(); ++i) boxes.push_back(set[i]);
  }
  return boxes;
}

void expectProblem(const std::string& bytes, const std::string& part) {
  const TempFolder folder;
  try {
    (void)scene::readBoxFrames(folder.write("bad.npy", bytes));
    FAIL() << "read without a complaint; expected: " << part;
  } catch (const FileError& problem) {
    EXPECT_NE(std::string(problem.what()).find(part), std::string::npos) << problem.what();
  }
}

TEST(BoxFrames, EveryTypeAndByteOrderGivesTheSameBoxes) {
  const TempFolder folder;
  for (const char* descr : {"<f4", ">f4", "<f8", ">f8"}) {
    const scene::BoxFrames frames = scene::readBoxFrames(folder.write("f.npy", framesBytes({.descr = descr})));
    EXPECT_EQ(frames.frameCount, 2U);
    EXPECT_EQ(frames.boxCount, 3U);
    EXPECT_EQ(boxesOf(frames), kBoxes) << descr;
  }
}

TEST(BoxFrames, FortranOrderPutsTheFrameFirst) {
  std::string bytes = npyHeaderBytes("{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3, 6), }");
  for (std::size_t column = 0; column < 6; ++column) {
    for (std::size_t box = 0; box < 3; ++box) {
      for (std::size_t frame = 0; frame < 2; ++frame) {
        const Box& from = kBoxes[frame * 3 + box];
        appendNumber(bytes, column < 3 ? from.min[column] : from.max[column - 3], false);
      }
    }
  }
  const TempFolder folder;
  EXPECT_EQ(boxesOf(scene::readBoxFrames(folder.write("f.npy", bytes))), kBoxes);
}

TEST(BoxFrames, OnlyThreeDimensionsAreFrames) {
  const TempFolder folder;
  EXPECT_TRUE(scene::isBoxFramesFile(folder.write("f.npy", framesBytes())));
  EXPECT_FALSE(scene::isBoxFramesFile(folder.write("b.npy", npyBytes(kBoxes))));
  EXPECT_FALSE(scene::isBoxFramesFile(folder.write("b.csv", "0,0,0,1,1,1\n")));
}

TEST(BoxFrames, WhatIsNoBoxesOverTimeIsNamed) {
  expectProblem(npyBytes(kBoxes), "has shape (6, 6); boxes over time are (t, n, 6)");
  expectProblem(npyBytes(kBoxes, {.shape = "(2, 9, 6)"}), "which is not what its shape (2, 9, 6) needs");
  expectProblem(npyBytes({}, {.shape = "(0, 3, 6)"}), "has no frame");
  expectProblem(npyBytes(kBoxes, {.shape = "(4294967295, 4294967295, 6)"}), "is not what its shape");
  std::vector<Box> bad = kBoxes;
  bad[4].min[1] = std::numeric_limits<double>::quiet_NaN();
  expectProblem(npyBytes(bad, {.shape = "(2, 3, 6)"}), "box 1 of frame 1 has a NaN");
}

}  // namespace
}  // namespace allpairs::test
