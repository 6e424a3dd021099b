// SPDX-License-Identifier: MIT
// Joins that end in the middle, and go on.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "Checksum.h"
#include "ResumeCase.h"
#include "WorkFile.h"
#include "allpairs/Error.h"
#include "allpairs/scene/FileError.h"

namespace allpairs::test {
namespace {

namespace fs = std::filesystem;

std::vector<Box> someBoxes() {
  std::vector<Box> boxes = toDouble(randomBoxes(500, 21));
  for (std::size_t i = 0; i < 20; ++i) boxes.push_back(cube(-1, -1, -1, 30));
  return boxes;
}

TEST(Resume, AfterAKillAtAnyStepTheBytesAreTheSame) {
  const std::vector<Box> boxes = someBoxes();
  JoinCase with(boxes);
  expectSameBytesAfterEachKill(with, expectedBytes(boxes));
}

TEST(Resume, AfterOneKillUponTheOtherToo) {
  const std::vector<Box> boxes = someBoxes();
  JoinCase with(boxes);
  for (std::size_t step = 0; runKilledAt(with, step); step += 3) {
  }
  EXPECT_TRUE(with.run(with.options()) == expectedBytes(boxes)) << "the last run was to its end, and nothing is left";
}

TEST(Resume, AfterAnErrorAtAnyStepTheBytesAreTheSame) {
  const std::vector<Box> boxes = someBoxes();
  JoinCase with(boxes);
  const std::string expected = expectedBytes(boxes);
  std::size_t resumed = 0;
  bool isComplete = false;
  for (std::size_t step = 0; !isComplete; step += kStride) {
    try {
      isComplete = with.run(endingAt(with, step, [] { throw std::runtime_error("enough"); })) == expected;
      ASSERT_TRUE(isComplete);
    } catch (const std::runtime_error& problem) {
      ASSERT_STREQ(problem.what(), "enough");
      ASSERT_TRUE(with.run(resuming(with)) == expected) << step;
      resumed = std::max<std::size_t>(resumed, with.summary.resumedCells);
    }
  }
  EXPECT_GT(resumed, 5U) << "cells that were not searched again";
}

TEST(Resume, AfterAnErrorAmongTheCellsThoseBeforeItAreNotSearchedAgain) {
  JoinCase with(someBoxes());
  join::JoinOptions failing = with.options();
  failing.progress = [](const join::JoinProgress& progress) {
    if (progress.step == "searching" && progress.done == 7) throw std::runtime_error("enough");
  };
  EXPECT_THROW((void)with.run(failing), std::runtime_error);
  EXPECT_TRUE(with.run(resuming(with)) == expectedBytes(someBoxes()));
  EXPECT_EQ(with.summary.resumedCells, 7U);
}

void flipByte(const fs::path& path, std::streamoff at) {
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekg(at);
  const int byte = file.get();
  file.seekp(at);
  file.put(static_cast<char>(byte ^ 1));
}

TEST(Resume, NothingIsDoneAgainThatIsComplete) {
  JoinCase with(someBoxes());
  stoppedWhileWriting(with);
  EXPECT_TRUE(with.run(resuming(with)) == expectedBytes(someBoxes()));
  EXPECT_EQ(with.summary.resumedCells, with.summary.cells);
}

TEST(Resume, CellsThatAreCompleteAreNotSearchedAgain) {
  JoinCase with(someBoxes());
  stoppedWhileWriting(with);
  join::JoinOptions options = resuming(with);
  std::size_t searched = 0;
  options.progress = [&searched](const join::JoinProgress& progress) {
    searched += progress.step == "searching" ? 1U : 0U;
  };
  EXPECT_TRUE(with.run(options) == expectedBytes(someBoxes()));
  EXPECT_EQ(searched, 0U);
}

TEST(Resume, WhatAKillLeavesOfRangesThatWereDividedIsRemoved) {
  JoinCase with(someBoxes());
  for (const std::vector<const char*>& names : {std::vector{"divided", "divided-", "divided--"},
                                                std::vector{"divided-", "divided---"}}) {  // with more memory, others
    stoppedWhileWriting(with);
    for (const char* name : names) std::ofstream(with.options().work / name) << "pairs";
    EXPECT_TRUE(with.run(resuming(with)) == expectedBytes(someBoxes()));
    EXPECT_FALSE(fs::exists(with.options().work)) << names.front();
  }
}

/// Where the manifest cannot be written either, as on a disk that is full.
TEST(Resume, AnErrorIsTheOneThatEndedTheSearch) {
  JoinCase with(someBoxes());
  join::JoinOptions options = with.options();
  options.progress = [&options](const join::JoinProgress& progress) {
    if (progress.step != "searching" || progress.done != 3) return;
    fs::create_directory(options.work / "manifest.next");
    throw std::logic_error("enough");
  };
  EXPECT_THROW((void)with.run(options), std::logic_error);
  fs::remove(options.work / "manifest.next");
  EXPECT_TRUE(with.run(resuming(with)) == expectedBytes(someBoxes()));
}

TEST(Resume, TheSameFilesMayBeNamedOtherwise) {
  JoinCase with(someBoxes());
  const fs::path file = with.paths[0];
  for (const fs::path& name :
       {file.parent_path() / "." / file.filename(), file.parent_path() / "folder" / ".." / file.filename(),
        file.lexically_relative(fs::current_path())}) {
    fs::create_directories(file.parent_path() / "folder");
    with.paths[0] = file;
    stoppedWhileWriting(with);
    with.paths[0] = name;
    EXPECT_TRUE(with.run(resuming(with)) == expectedBytes(someBoxes())) << name;
    EXPECT_EQ(with.summary.resumedCells, with.summary.cells) << name;
  }
}

TEST(Resume, BoxesThatAreEmptyAreStillKnown) {
  std::vector<Box> boxes = someBoxes();
  boxes[70] = {{0, 2, 0}, {1, 1, 1}};
  boxes[90] = {{3, 2, 0}, {1, 1, 1}};
  JoinCase with(boxes);
  (void)with.run(with.options());
  const std::uint64_t copies = with.summary.copies;
  stoppedWhileWriting(with);
  EXPECT_TRUE(with.run(resuming(with)) == expectedBytes(boxes));
  EXPECT_GT(with.summary.resumedCells, 0U);
  EXPECT_EQ(with.summary.empty[0].count, 2U);
  EXPECT_EQ(with.summary.empty[0].first, 70U);
  EXPECT_EQ(with.summary.empty[0].axis, 1U);
  EXPECT_EQ(with.summary.empty[1].count, 0U);
  EXPECT_EQ(with.summary.copies, copies);
}

TEST(Resume, DamagedFilesAreMadeAgain) {
  for (const char* name : {"boxes", "pairs"}) {
    for (const bool isCut : {false, true}) {
      JoinCase with(someBoxes());
      stoppedWhileWriting(with);
      const fs::path file = with.options().work / name;
      if (isCut) fs::resize_file(file, fs::file_size(file) / 2);
      flipByte(file, 100);
      EXPECT_TRUE(with.run(resuming(with)) == expectedBytes(someBoxes())) << name << isCut;
      EXPECT_LT(with.summary.resumedCells, with.summary.cells);
    }
  }
}

/// On a full disk, the room of what is made again is the only one.
TEST(Resume, WhatIsMadeAgainIsRemovedBefore) {
  JoinCase with(someBoxes());
  stoppedWhileWriting(with);
  flipByte(with.options().work / "boxes", 100);
  const std::uintmax_t before = fs::file_size(with.options().work / "pairs");
  ASSERT_GT(before, 0U);
  join::JoinOptions options = resuming(with);
  bool hasDistributed = false;
  options.progress = [&](const join::JoinProgress& progress) {
    if (progress.step != "distributing") return;
    hasDistributed = true;
    EXPECT_FALSE(fs::exists(options.work / "pairs"));
  };
  EXPECT_TRUE(with.run(options) == expectedBytes(someBoxes()));
  EXPECT_TRUE(hasDistributed);
}

/// Of cells that were searched again the pairs come behind those of cells with greater numbers.
TEST(Resume, PairsOfCellsThatStayAreKeptWhereverTheyLie) {
  JoinCase with(someBoxes());
  stoppedWhileWriting(with);
  const fs::path path = with.options().work / "manifest";
  const auto keepOnly = [&path](const auto& isKept) {
    join::Manifest manifest = *join::Manifest::read(path);
    std::erase_if(manifest.cells, [&](const auto& cell) { return !isKept(cell.first); });
    manifest.write(path);
  };
  keepOnly([](std::size_t cell) { return cell != 2; });
  join::JoinOptions failing = resuming(with);
  failing.commit = [] { throw std::runtime_error("not committed"); };
  EXPECT_THROW((void)with.run(failing), std::runtime_error);
  keepOnly([](std::size_t cell) { return cell == 2 || cell == 3; });
  EXPECT_TRUE(with.run(resuming(with)) == expectedBytes(someBoxes()));
  EXPECT_EQ(with.summary.resumedCells, 2U);
}

TEST(Resume, FilesThatAreGoneAreMadeAgain) {
  for (const char* name : {"boxes", "pairs"}) {
    JoinCase with(someBoxes());
    stoppedWhileWriting(with);
    fs::remove(with.options().work / name);
    EXPECT_TRUE(with.run(resuming(with)) == expectedBytes(someBoxes())) << name;
  }
}

TEST(Resume, AFolderWithOtherFilesIsLeftAlone) {
  JoinCase with(someBoxes());
  fs::create_directories(with.options().work);
  std::ofstream(with.options().work / "boxes") << "mine";
  EXPECT_THROW((void)with.run(resuming(with)), FileError);
  EXPECT_EQ(bytesOfFile(with.options().work / "boxes"), "mine");
}

/// What another hand has put there is no join that ended meanwhile, where it leads nowhere too.
TEST(Resume, AFolderWithALinkToNothingIsLeftAlone) {
  for (const char* target : {"/nowhere/at/all", "link"}) {
    JoinCase with(someBoxes());
    fs::create_directories(with.options().work);
    fs::create_symlink(target, with.options().work / "link");
    try {
      (void)with.run(resuming(with));
      ADD_FAILURE() << "nothing was thrown";
    } catch (const FileError& problem) {
      EXPECT_EQ(problem.problem(), "is not empty, and not the work folder of a join") << target;
    }
    EXPECT_TRUE(fs::is_symlink(with.options().work / "link"));
  }
}

TEST(Resume, LinksInPlaceOfItsFilesAreNotWrittenThrough) {
  for (const char* name : {"manifest.next", "boxes", "pairs", "divided", "allpairs-join.lock"}) {
    JoinCase with(someBoxes());
    const fs::path precious = with.folder.write("precious", "mine");
    fs::create_directories(with.options().work);
    std::ofstream(with.options().work / "allpairs-join.lock").close();
    fs::remove(with.options().work / name);
    fs::create_symlink(precious, with.options().work / name);
    if (name == std::string("allpairs-join.lock")) {
      EXPECT_THROW((void)with.run(with.options()), FileError);
    } else {
      EXPECT_TRUE(with.run(with.options()) == expectedBytes(someBoxes())) << name;
    }
    EXPECT_EQ(bytesOfFile(precious), "mine") << name;
  }
}

TEST(Resume, ADamagedManifestIsAnError) {
  JoinCase with(someBoxes());
  stoppedWhileWriting(with);
  flipByte(with.options().work / "manifest", 20);
  EXPECT_THROW((void)with.run(resuming(with)), FileError);
}

TEST(Resume, AManifestThatAnotherHandHasWrittenIsAnError) {
  const auto refused = [](const std::string& before, const std::string& after) {
    JoinCase with(someBoxes());
    stoppedWhileWriting(with);
    const fs::path path = with.options().work / "manifest";
    std::string text = bytesOfFile(path);
    const std::size_t at = text.find(before);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, before.size(), after);
    std::ofstream(path, std::ios::binary) << text;
    EXPECT_THROW((void)with.run(resuming(with)), FileError) << after;
  };
  refused("\noptions ", "\noptions 0");  // a number that means the same, with a checksum of another text
}

/// With the checksum of what it holds.
TEST(Resume, AManifestOfAnotherFormIsAnError) {
  JoinCase with(someBoxes());
  stoppedWhileWriting(with);
  const fs::path path = with.options().work / "manifest";
  std::string text = bytesOfFile(path);
  text.erase(text.rfind("checksum "));
  ASSERT_TRUE(text.starts_with("allpairs join 2\n"));
  text.replace(0, text.find('\n'), "allpairs join 3");
  for (const std::string& other : {text, std::string("allpairs join 2"), std::string()}) {
    join::Checksum checksum;
    checksum.add(other.data(), other.size());
    std::ofstream(path, std::ios::binary) << other << "checksum " << checksum.value() << '\n';
    EXPECT_THROW((void)with.run(resuming(with)), FileError);
  }
}

/// Of more than is read at once.
TEST(Resume, TheChecksumOfAPartOfAFileIsThatOfItsBytes) {
  const TempFolder folder;
  std::string bytes(3'000'000, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 2'654'435'761U >> 20U);
  const join::WorkFile file(folder.path() / "bytes", join::WorkFile::Mode::Create);
  file.write(0, bytes.data(), bytes.size());
  join::Checksum checksum;
  checksum.add(bytes.data() + 7, 2'500'000);
  EXPECT_EQ(join::checksumOf(file, 7, 2'500'000), checksum.value());
  EXPECT_EQ(join::checksumOf(file, 7, 3'000'000), std::nullopt) << "the file ends before";
}

TEST(Resume, WithoutItAJoinThatDidNotEndIsAnError) {
  JoinCase with(someBoxes());
  stoppedWhileWriting(with);
  EXPECT_THROW((void)with.run(with.options()), FileError);
  EXPECT_TRUE(with.run(resuming(with)) == expectedBytes(someBoxes())) << "nothing was lost";
}

TEST(Resume, OfAnotherJoinIsAnError) {
  JoinCase with(someBoxes());
  stoppedWhileWriting(with);
  join::JoinOptions farther = resuming(with);
  farther.distance = 1.0;
  EXPECT_THROW((void)with.run(farther), FileError);
  EXPECT_THROW((void)with.count(resuming(with)), FileError);
  fs::last_write_time(with.paths[0], fs::file_time_type::clock::now() + std::chrono::seconds(5));
  EXPECT_THROW((void)with.run(resuming(with)), FileError);
}

TEST(Resume, OfAFileOfAnotherSizeIsAnErrorWhateverItsTime) {
  std::vector<Box> boxes = someBoxes();
  JoinCase with(boxes);
  stoppedWhileWriting(with);
  const fs::file_time_type time = fs::last_write_time(with.paths[0]);
  boxes.push_back(cube(0, 0, 0));
  with.folder.write("boxes0.npy", npyBytes(boxes, {.descr = "<f4"}));
  fs::last_write_time(with.paths[0], time);
  EXPECT_THROW((void)with.run(resuming(with)), FileError);
}

TEST(Resume, AfterAKillBetweenTheResultAndItsFolderTheFolderIsTakenAgain) {
  JoinCase with(someBoxes());
  join::JoinOptions options = with.options();
  options.commit = [] { throw std::runtime_error("not committed"); };
  EXPECT_THROW((void)with.run(options), std::runtime_error);
  EXPECT_TRUE(with.run(resuming(with)) == expectedBytes(someBoxes()));
  EXPECT_EQ(with.summary.resumedCells, with.summary.cells) << "nothing was lost before the commit";
  stoppedWhileWriting(with);
  fs::remove(with.options().work / "manifest");  // what clearing the folder does first
  EXPECT_TRUE(with.run(with.options()) == expectedBytes(someBoxes()));
}

TEST(Resume, AnInputThatChangesWhileItIsReadIsAnError) {
  for (const std::size_t size : {300U, 520U}) {
    JoinCase with(someBoxes());
    join::JoinOptions options = with.options();
    options.progress = [&with, size, isChanged = false](const join::JoinProgress& progress) mutable {
      if (isChanged || progress.step != "counting") return;
      isChanged = true;  // while it is counted: cells get other boxes, or it is another file
      std::ofstream(with.paths[0], std::ios::binary)
          << npyBytes(toDouble(randomBoxes(size, 99, 3.0F)), {.descr = "<f4"});
    };
    EXPECT_THROW((void)with.run(options), FileError);
    EXPECT_FALSE(fs::exists(options.work));
  }
}

TEST(Resume, AManifestOfPartsThatDoNotFitIsAnError) {
  const auto refused = [](const auto& change) {
    JoinCase with(someBoxes());
    stoppedWhileWriting(with);
    const fs::path path = with.options().work / "manifest";
    join::Manifest manifest = *join::Manifest::read(path);
    change(manifest);
    manifest.write(path);
    EXPECT_THROW((void)with.run(resuming(with)), FileError);
  };
  refused([](join::Manifest& manifest) { manifest.extents.pop_back(); });
  refused([](join::Manifest& manifest) { manifest.extents.push_back({}); });
  refused([](join::Manifest& manifest) { manifest.extents[1].begin += 1; });
  refused([](join::Manifest& manifest) { manifest.cells[1'000'000] = {}; });
  refused([](join::Manifest& manifest) { manifest.cells.begin()->second.pairs += 7; });
  refused([](join::Manifest& manifest) { manifest.cuts[0].low = 77; });
  refused([](join::Manifest& manifest) { manifest.empty[0] = {.count = 1, .first = 0, .axis = 3}; });
}

TEST(Resume, OneJoinAtATime) {
  JoinCase with(someBoxes());
  fs::create_directories(with.options().work);
  const join::WorkFile other(with.options().work / "allpairs-join.lock", join::WorkFile::Mode::Create);
  ASSERT_TRUE(other.lock());
  EXPECT_THROW((void)with.run(with.options()), FileError);
}

/// Joins in one folder at the same time: each gives its result or finds the folder in use, also one that comes while
/// another removes the folder, when it may lock a file that is no longer there.
TEST(Resume, JoinsInOneFolderNeverGetInEachOthersWay) {
  const std::vector<Box> boxes = toDouble(randomBoxes(40, 5));
  const JoinCase with(boxes);
  std::atomic<int> completed = 0;
  const auto joinOften = [&] {
    for (int i = 0; i < 150; ++i) {
      try {
        JoinCase own;
        own.paths = with.paths;
        EXPECT_TRUE(own.run(with.options()) == expectedBytes(boxes));
        ++completed;
      } catch (const FileError& problem) {
        EXPECT_TRUE(problem.problem().starts_with("is in use by ")) << problem.what();
      }
    }
  };
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread) threads.emplace_back(joinOften);
  for (std::thread& thread : threads) thread.join();
  EXPECT_GT(completed, 0);
  EXPECT_FALSE(fs::exists(with.options().work));
}

TEST(Resume, AJoinThatIsStoppedGoesOn) {
  JoinCase with(someBoxes());
  StopFlag stop;
  join::JoinOptions options = endingAt(with, 15, [&stop] { stop.set(); });
  options.stop = &stop;
  EXPECT_THROW((void)with.run(options), Stopped);
  stop.clear();
  EXPECT_TRUE(with.run(options) == expectedBytes(someBoxes()));
}

}  // namespace
}  // namespace allpairs::test
