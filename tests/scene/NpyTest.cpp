// SPDX-License-Identifier: MIT
#include "support/Npy.h"

#include <gtest/gtest.h>

#include <limits>

#include "Expect.h"
#include "allpairs/scene/BoxArray.h"
#include "allpairs/scene/BoxFrames.h"
#include "allpairs/scene/FileError.h"
#include "support/Boxes.h"
#include "support/Numbers.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

std::vector<Box> boxesOf(const scene::BoxArray& array) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < array.size(); ++i) boxes.push_back(array.boxes()[i]);
  return boxes;
}

/// Exact in float32 too.
std::vector<Box> someBoxes() {
  return {{{0, 1, 2}, {3, 4, 5}}, {{-1.5, -2, -3}, {0.25, 0, 7}}, {{-kInfinity, 0, 0}, {kInfinity, 1, 1}}};
}

void expectNpyProblem(const std::string& bytes, const std::string& part) {
  const TempFolder folder;
  expectFileError([path = folder.write("bad.npy", bytes)] { (void)scene::readNpy(path); }, part);
}

TEST(Npy, EveryTypeByteOrderLayoutAndVersionGivesTheSameBoxes) {
  const TempFolder folder;
  for (const char* descr : {"<f4", ">f4", "<f8", ">f8"}) {
    for (const bool fortran : {false, true}) {
      for (const int version : {1, 2, 3}) {
        const NpyStyle style{.descr = descr, .fortran = fortran, .version = version};
        const scene::BoxArray array = scene::readNpy(folder.write("boxes.npy", npyBytes(someBoxes(), style)));
        EXPECT_EQ(boxesOf(array), someBoxes()) << descr << ' ' << fortran << ' ' << version;
        EXPECT_EQ(array.boxes().isFloat64(), descr[2] == '8');
      }
    }
  }
}

TEST(Npy, AnArrayOfNoBoxesIsFine) {
  const TempFolder folder;
  EXPECT_EQ(scene::readNpy(folder.write("none.npy", npyBytes({}))).size(), 0U);
}

TEST(Npy, KeysMayComeInAnyOrderAndQuotesInEitherKind) {
  const TempFolder folder;
  const std::string data = npyBytes(someBoxes()).substr(128);
  const std::string header = npyHeaderBytes(R"({"shape":(3,6),"fortran_order":False,"descr":"<f8"})");
  EXPECT_EQ(boxesOf(scene::readNpy(folder.write("a.npy", header + data))), someBoxes());
}

TEST(Npy, AFileCutAnywhereIsAnError) {
  const TempFolder folder;
  const std::string bytes = npyBytes(someBoxes());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const auto path = folder.write("cut.npy", std::string_view(bytes).substr(0, length));
    EXPECT_THROW((void)scene::readNpy(path), FileError) << length;
  }
}

TEST(Npy, NoByteOfTheHeaderCanBeChangedIntoACrash) {
  const TempFolder folder;
  const std::string bytes = npyBytes({someBoxes()[0]});
  for (std::size_t place = 0; place < 128; ++place) {
    for (const char value : {'\0', '\x7f', '\xff', '9', '(', '\'', ','}) {
      std::string changed = bytes;
      changed[place] = value;
      try {
        EXPECT_LE(scene::readNpy(folder.write("changed.npy", changed)).size(), 1U);
      } catch (const FileError&) {
        // as good: the change was noticed
      }
    }
  }
}

TEST(Npy, HugeClaimsAreRefusedBeforeAnythingIsAllocated) {
  for (const char* shape : {"(4294967295, 6)", "(4294967296, 6)", "(18446744073709551615, 6)",
                            "(99999999999999999999, 6)", "(3074457345618258603, 6)"}) {
    const TempFolder folder;
    const auto path = folder.write("huge.npy", npyBytes({}, {.descr = "<f8", .shape = shape}));
    EXPECT_THROW((void)scene::readNpy(path), FileError) << shape;
  }
}

TEST(Npy, NumbersOfTheShapeMayBeThoseOfPython2) {
  const TempFolder folder;
  const std::vector<Box> boxes = someBoxes();
  const std::string count = std::to_string(boxes.size()) + "L, 6L)";
  EXPECT_EQ(scene::readNpy(folder.write("a.npy", npyBytes(boxes, {.descr = "<f8", .shape = "(" + count}))).size(),
            boxes.size());
  expectNpyProblem(npyBytes({}, {.descr = "<f8", .shape = "(0LL, 6)"}), "malformed");
}

TEST(Npy, OtherShapesAreNamed) {
  expectNpyProblem(npyBytes({}, {.descr = "<f8", .shape = "(7, 5)"}), "shape (7, 5)");
  expectNpyProblem(npyBytes({}, {.descr = "<f8", .shape = "(6,)"}), "shape (6,)");
  expectNpyProblem(npyBytes({}, {.descr = "<f8", .shape = "()"}), "shape ()");
  expectNpyProblem(npyBytes({}, {.descr = "<f8", .shape = "(2, 3, 2)"}), "shape (2, 3, 2)");
  expectNpyProblem(npyBytes({}, {.descr = "<f8", .shape = "(-1, 6)"}), "no whole number");
}

TEST(Npy, OtherTypesAreNamed) {
  for (const char* descr : {"<i8", "<f2", "<f16", "|O", "<c8", "f4", "=f8", ""}) {
    expectNpyProblem(npyHeaderBytes("{'descr': '" + std::string(descr) + "', 'fortran_order': False, 'shape': (0, 6)}"),
                     "type '" + std::string(descr) + "'");
  }
  expectNpyProblem(npyHeaderBytes("{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (0, 6)}"), "structured");
}

TEST(Npy, HeadersThatAreNotExactlyThatDictionaryAreRefused) {
  expectNpyProblem(npyHeaderBytes("{'descr': '<f8', 'fortran_order': False}"), "'shape' is missing");
  expectNpyProblem(npyHeaderBytes("{'descr': '<f8', 'descr': '<f8', 'shape': (0, 6)}"), "twice");
  expectNpyProblem(npyHeaderBytes("{'descr': '<f8', 'fortran_order': 0, 'shape': (0, 6)}"), "True nor False");
  expectNpyProblem(npyHeaderBytes("{'descr': '<f8', 'fortran_order': False, 'shape': (0, 6)} 1"), "after the closing");
  expectNpyProblem(npyHeaderBytes("{'descr': '<f8', 'fortran_order': False, 'shape': (0, 6), 'x': 1}"), "unknown key");
  expectNpyProblem(npyHeaderBytes("{'descr': '<f8, 'fortran_order': False, 'shape': (0, 6)}"), "malformed");
}

TEST(Npy, BytesAfterTheArrayAreAnError) { expectNpyProblem(npyBytes(someBoxes()) + "x", "145 bytes of numbers"); }

TEST(Npy, AnUnknownVersionIsNamed) {
  expectNpyProblem(npyBytes(someBoxes(), {.descr = "<f8", .version = 4}), "version 4");
}

TEST(Npy, ANanIsNamedWithItsBox) {
  std::vector<Box> boxes = someBoxes();
  boxes[1].max[2] = std::numeric_limits<double>::quiet_NaN();
  expectNpyProblem(npyBytes(boxes), "box 1: max z is not a number");
}

TEST(Npy, AMissingFileAndAFolderAreNamed) {
  expectFileError([] { (void)scene::readNpy("/nowhere/boxes.npy"); }, "/nowhere/boxes.npy: no such file");
  const TempFolder folder;
  expectFileError([&] { (void)scene::readNpy(folder.path()); }, "is a folder");
}

TEST(Npy, WhatTheSystemSaysOfAFileIsACode) {
  const auto codeOf = [](const std::filesystem::path& path) {
    try {
      (void)scene::readNpy(path);
    } catch (const FileError& error) {
      return error.code();
    }
    ADD_FAILURE() << "nothing was thrown";
    return std::error_code();
  };
  const TempFolder folder;
  std::filesystem::create_symlink("loop.npy", folder.path() / "loop.npy");
  EXPECT_EQ(codeOf(folder.path() / "missing.npy"), std::errc::no_such_file_or_directory);
  EXPECT_EQ(codeOf(folder.path()), std::errc::is_a_directory);
  EXPECT_EQ(codeOf(folder.path() / "loop.npy"), std::errc::too_many_symbolic_link_levels);
  EXPECT_EQ(codeOf(folder.path() / (std::string(300, 'x') + ".npy")), std::errc::filename_too_long);
  EXPECT_EQ(codeOf(folder.write("bad.npy", "no array")), std::error_code()) << "its content is wrong";
}

TEST(BoxArray, ConcatenationKeepsTheOrderAndNamesTheFile) {
  const TempFolder folder;
  const TempFolder other;
  std::vector<scene::BoxArray> arrays;
  arrays.push_back(scene::readNpy(folder.write("a.npy", npyBytes({cube(0, 0, 0)}, {.descr = "<f4"}))));
  arrays.push_back(scene::readNpy(folder.write("b.npy", npyBytes({cube(1, 2, 3), cube(4, 5, 6)}))));
  arrays.push_back(scene::readNpy(other.write("a.npy", npyBytes({cube(7, 8, 9)}))));
  const scene::BoxArray all = scene::BoxArray::concatenate(std::move(arrays));
  EXPECT_EQ(boxesOf(all), (std::vector<Box>{cube(0, 0, 0), cube(1, 2, 3), cube(4, 5, 6), cube(7, 8, 9)}));
  EXPECT_TRUE(all.boxes().isFloat64());
  EXPECT_EQ(all.name(0), "a.npy[0]");
  EXPECT_EQ(all.name(2), "b.npy[1]");
  EXPECT_EQ(all.name(3), "a.npy#2[0]");
}

TEST(BoxArray, ConcatenationsAreConcatenatedWithTheirNames) {
  const TempFolder folder;
  const auto named = [&](const std::string& file, const std::string& box) {
    return scene::readCsv(folder.write(file, box + ",0,0,0,1,1,1\n"));
  };
  const auto both = [](scene::BoxArray first, scene::BoxArray second) {
    std::vector<scene::BoxArray> arrays;
    arrays.push_back(std::move(first));
    arrays.push_back(std::move(second));
    return scene::BoxArray::concatenate(std::move(arrays));
  };
  const scene::BoxArray all = both(both(named("a.csv", ""), named("b.csv", "right")), named("c.csv", ""));
  EXPECT_EQ(all.name(0), "a.csv[0]");
  EXPECT_EQ(all.name(1), "right");
  EXPECT_EQ(all.name(2), "c.csv[0]");
  EXPECT_EQ(both(scene::BoxArray(), named("c.csv", "only")).name(0), "only");
}

TEST(Npy, FramesAreKnownByAnExtensionInCapitalsToo) {
  const TempFolder folder;
  const std::string frames = npyBytes(someBoxes(), {.shape = "(1, 3, 6)"});
  EXPECT_TRUE(scene::isBoxFramesFile(folder.write("a.NPY", frames)));
  EXPECT_FALSE(scene::isBoxFramesFile(folder.write("b.NPY", npyBytes(someBoxes()))));
}

}  // namespace
}  // namespace allpairs::test
