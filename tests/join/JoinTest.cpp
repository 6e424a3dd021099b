// SPDX-License-Identifier: MIT
// What users call: whole files within real limits.
#include "allpairs/join/Join.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "JoinCase.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "allpairs/partition/Partition.h"
#include "allpairs/scene/FileError.h"
#include "support/Numbers.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

using join::countFiles;
using join::joinFiles;
using join::kLeastMemory;
using join::planFiles;

/// More boxes than a cell has in the least memory, which are 200,000.
constexpr std::size_t kMany = kIsSanitized ? 210'000 : 300'000;

TEST(Join, WritesAFileAndLeavesNothingElse) {
  const std::vector<Box> boxes = toDouble(randomBoxes(2'000, 11));
  const JoinCase with(boxes);
  const std::filesystem::path output = with.folder.path() / "pairs.npy";
  const join::JoinSummary summary = joinFiles(with.paths, output);
  EXPECT_TRUE(bytesOfFile(output) == expectedBytes(boxes));
  EXPECT_EQ(summary.pairs, oracle(boxes).size());
  EXPECT_EQ(summary.boxes, 2'000U);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(with.folder.path()), {}), 2);
}

TEST(Join, ReplacesAFileAndNothingElse) {
  namespace fs = std::filesystem;
  const std::vector<Box> boxes = toDouble(randomBoxes(200, 11));
  const JoinCase with(boxes);
  const fs::path output = with.folder.write("pairs.npy", "old");
  const fs::perms secret = fs::perms::owner_read | fs::perms::owner_write;
  fs::permissions(output, secret);
  const fs::path link = with.folder.path() / "link.npy";
  fs::create_symlink("pairs.npy", link);
  joinFiles(with.paths, link);
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_TRUE(bytesOfFile(output) == expectedBytes(boxes));
  EXPECT_EQ(fs::status(output).permissions(), secret);
  const fs::path toNothing = with.folder.path() / "to-nothing.npy";
  fs::create_symlink("new.npy", toNothing);
  joinFiles(with.paths, toNothing);
  EXPECT_TRUE(fs::is_symlink(toNothing));
  EXPECT_TRUE(bytesOfFile(with.folder.path() / "new.npy") == expectedBytes(boxes));
  ASSERT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_THROW(joinFiles(with.paths, "/dev/null", with.options()), FileError);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

/// With the names of the join's own files it would be removed with them.
TEST(Join, AResultInTheWorkFolderIsRefused) {
  namespace fs = std::filesystem;
  const JoinCase with(toDouble(randomBoxes(200, 11)));
  join::JoinOptions options = with.options();
  const fs::path link = with.folder.path() / "link";
  fs::create_directory_symlink("work", link);
  const fs::path toPairs = with.folder.path() / "to-pairs";
  fs::create_symlink("work/pairs", toPairs);
  for (const bool isThere : {false, true}) {
    if (isThere) fs::create_directory(options.work);
    for (const fs::path& output :
         {options.work, options.work / "pairs", link / "pairs", options.work / "." / "result.npy", toPairs}) {
      if (!isThere && output == link / "pairs") continue;  // a link to nothing is no folder
      EXPECT_THROW(joinFiles(with.paths, output, options), FileError) << output;
      join::JoinOptions ofSink = options;
      ofSink.output = output;
      EXPECT_THROW(joinFiles(
                       with.paths, [](std::string_view) {}, ofSink),
                   FileError)
          << output;
      EXPECT_EQ(fs::exists(options.work), isThere) << output;
    }
  }
  options.work = link / "";
  EXPECT_THROW(joinFiles(with.paths, with.folder.path() / "work" / "pairs", options), FileError);
  options.work = with.folder.path() / "pairs.work";
  joinFiles(with.paths, with.folder.path() / "pairs", options);
  EXPECT_TRUE(fs::exists(with.folder.path() / "pairs"));
}

TEST(Join, NoInputIsReplaced) {
  const JoinCase with(toDouble(randomBoxes(200, 11)));
  const std::string before = bytesOfFile(with.paths[0]);
  const std::filesystem::path link = with.folder.path() / "link.npy";
  std::filesystem::create_symlink(with.paths[0].filename(), link);
  for (const auto& output : {with.paths[0], link}) {
    EXPECT_THROW(joinFiles(with.paths, output), FileError);
    join::JoinOptions options;
    options.second = with.paths;
    const JoinCase others(toDouble(randomBoxes(20, 12)));
    EXPECT_THROW(joinFiles(others.paths, output, options), FileError);
    options.second.clear();
    options.values.margins = with.paths;
    EXPECT_THROW(joinFiles(others.paths, output, options), FileError);
  }
  EXPECT_EQ(bytesOfFile(with.paths[0]), before);
}

TEST(Join, InTheLeastMemoryAndWithThreadsItIsTheSearchInMemory) {
  const std::vector<Box> boxes = toDouble(randomBoxes(kMany, 12));
  const JoinCase with(boxes);
  join::JoinOptions options = with.options();
  options.memory = kLeastMemory;
  const std::vector<Pair> expected = overlaps(boxes);
  const std::filesystem::path output = with.folder.path() / "pairs.npy";
  EXPECT_GT(joinFiles(with.paths, output, options).cells, 1U);
  EXPECT_TRUE(pairsOfNpy(bytesOfFile(output)) == expected);
  parallel::TbbExecutor executor(3);
  options.executor = &executor;
  EXPECT_LT(joinFiles(with.paths, output, options).cells, 4U) << "memory for one thread";
  EXPECT_TRUE(pairsOfNpy(bytesOfFile(output)) == expected);
  options.memory = kLeastMemory + 2 * join::kMemoryPerThread;
  EXPECT_GT(joinFiles(with.paths, output, options).cells, 3U);
  EXPECT_TRUE(pairsOfNpy(bytesOfFile(output)) == expected);
}

TEST(Join, APlanSaysWhatAJoinThenDoes) {
  const std::vector<Box> boxes = toDouble(randomBoxes(kMany, 13));
  const JoinCase with(boxes);
  join::JoinOptions options = with.options();
  options.memory = kLeastMemory;
  const join::JoinSummary plan = planFiles(with.paths, options);
  EXPECT_FALSE(std::filesystem::exists(options.work));
  const join::JoinSummary done = countFiles(with.paths, options);
  EXPECT_EQ(plan.boxes, done.boxes);
  EXPECT_EQ(plan.cells, done.cells);
  EXPECT_EQ(plan.copies, done.copies);
  EXPECT_EQ(plan.wideBoxes, done.wideBoxes);
  EXPECT_EQ(plan.boxBytes, done.boxBytes);
  EXPECT_NEAR(static_cast<double>(plan.pairs), static_cast<double>(done.pairs), 0.1 * static_cast<double>(done.pairs));
}

/// Thirty boxes of one range overlap all: their pairs are more than the memory holds.
TEST(Join, APlanSaysWhatPuttingPairsInOrderTakes) {
  constexpr std::size_t kLarge = 30;
  std::vector<Box> boxes = toDouble(randomBoxes(120'000, 13));
  const JoinCase without(boxes);
  join::JoinOptions options = without.options();
  options.memory = kLeastMemory;
  EXPECT_EQ(planFiles(without.paths, options).scratchBytes, 0U);
  for (std::size_t i = 0; i < kLarge; ++i) boxes[i] = {{-kInfinity, 0, 0}, {kInfinity, 1e6, 1e6}};
  const JoinCase with(boxes);
  const std::uint64_t copied = kLarge * boxes.size() * sizeof(Pair);
  const std::uint64_t scratch = planFiles(with.paths, options).scratchBytes;
  EXPECT_GT(scratch, copied * 9 / 10);
  EXPECT_LT(scratch, copied * 11 / 10);
}

/// They are sent to no cell.
TEST(Join, EmptyBoxesDoNotCountAmongCopies) {
  std::vector<Box> boxes = toDouble(randomBoxes(kMany, 13));
  JoinCase with(boxes);
  join::JoinOptions options = with.options();
  options.memory = kLeastMemory;
  const std::uint64_t copies = planFiles(with.paths, options).copies;
  EXPECT_GT(copies, 1'000U);
  with.add(std::vector<Box>(5'000, kEmptyBox));
  EXPECT_GT(planFiles(with.paths, options).copies, copies / 2);
  const join::JoinSummary done = countFiles(with.paths, options);
  EXPECT_EQ(done.copies, planFiles(with.paths, options).copies);
  EXPECT_EQ(done.copies * 32 + 32 * kMany, done.boxBytes);
}

/// A cell that no cut divides, of more than a rank's share, is sent to all ranks.
TEST(Join, APlanForRanksCountsTheBoxesOfCrowdedCells) {
  const JoinCase with(std::vector<Box>(100'000, cube(1, 2, 3)));
  const join::RanksPlan plan = join::planRanks(with.paths, 16, {});
  EXPECT_EQ(plan.wideBoxes, 100'000U);
  EXPECT_EQ(plan.boxBytes, 15U * 100'000U * 32U);
}

TEST(Join, APlanForRanksCountsWhatTravels) {
  std::vector<Box> boxes = toDouble(randomBoxes(40'000, 13));
  const JoinCase with(boxes);
  const join::RanksPlan alone = join::planRanks(with.paths, 1, {});
  EXPECT_EQ(alone.copies, 0);
  EXPECT_EQ(alone.boxBytes, 0);
  EXPECT_EQ(alone.pairBytes, 0);
  std::uint64_t before = 0;
  for (const std::size_t ranks : {2U, 4U, 8U}) {
    const join::RanksPlan plan = join::planRanks(with.paths, ranks, {});
    EXPECT_EQ(plan.boxes, boxes.size());
    EXPECT_GE(plan.cells, 6 * ranks);
    EXPECT_LE(plan.cells, 12 * ranks);
    EXPECT_GT(plan.boxBytes, before);
    EXPECT_LE(plan.boxBytes, 32 * (plan.boxes + plan.copies) * (ranks - 1) / ranks);
    before = plan.boxBytes;
  }
  EXPECT_THROW((void)join::planRanks(with.paths, 0, {}), InvalidArgument);
}

/// How many cells a search on several ranks has, as mpi::Distribution makes them where its sample is all boxes.
std::size_t cellsOfRanks(const std::vector<Box>& boxes, std::size_t ranks) {
  const std::size_t wanted = partition::cellsOnRanks(boxes.size(), ranks);
  const std::uint64_t fair = boxes.size() / wanted;
  partition::Partition cells(boxes, wanted);
  for (int round = 0; round < 3; ++round) {
    const std::vector<std::uint64_t> counts = partition::boxesPerCell(cells, boxes);
    for (std::size_t cell = 0; cell < counts.size(); ++cell) {
      if (counts[cell] > 2 * fair)
        cells.cutAgain(cell, boxes, static_cast<std::size_t>((counts[cell] + fair - 1) / fair));
    }
  }
  return cells.size();
}

/// Cells of few boxes have many copies, so that many have more boxes than their share.
TEST(Join, APlanForManyRanksHasAsManyCellsAsTheyMake) {
  const std::vector<Box> boxes = toDouble(randomBoxes(20'000, 13));
  const JoinCase with(boxes);
  for (const std::size_t ranks : {2U, 64U, 128U})
    EXPECT_EQ(join::planRanks(with.paths, ranks, {}).cells, cellsOfRanks(boxes, ranks)) << ranks;
}

/// Ranks cut space for all boxes, not for those that a region leaves.
TEST(Join, APlanForRanksHasAsManyCellsInARegion) {
  const std::vector<Box> boxes = toDouble(randomBoxes(40'000, 13));
  const JoinCase with(boxes);
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (const Box& box : boxes) {
    least = std::min(least, box.min[0]);
    greatest = std::max(greatest, box.max[0]);
  }
  join::JoinOptions options;
  options.region = Box{{least, least, least}, {least + 0.2 * (greatest - least), greatest, greatest}};
  const join::RanksPlan plan = join::planRanks(with.paths, 4, options);
  EXPECT_GE(plan.cells, 24);
  EXPECT_LT(plan.boxBytes, join::planRanks(with.paths, 4, {}).boxBytes);
}

TEST(Join, BadInputIsNamedAndNothingIsWritten) {
  std::vector<Box> boxes = toDouble(randomBoxes(100, 14));
  boxes[42].max[1] = kNan;
  JoinCase with(toDouble(randomBoxes(10, 15)));
  with.add(boxes);
  const std::filesystem::path output = with.folder.path() / "pairs.npy";
  try {
    joinFiles(with.paths, output);
    FAIL();
  } catch (const FileError& problem) {
    EXPECT_NE(std::string(problem.what()).find("boxes1.npy: box 42: max y is not a number (NaN)"), std::string::npos)
        << problem.what();
  }
  EXPECT_FALSE(std::filesystem::exists(output));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(with.folder.path()), {}), 2) << "the inputs alone";
  const std::filesystem::path text = with.folder.write("text.npy", "no array");
  EXPECT_THROW(joinFiles(std::vector{text}, output), FileError);
  EXPECT_THROW(joinFiles(std::vector{with.folder.path() / "missing.npy"}, output), FileError);
}

/// Of many it is the first, though some are looked at before all are read in order.
TEST(Join, TheFirstBoxThatIsNoneIsNamed) {
  for (const std::size_t count : {3'000U, 100'000U}) {
    std::vector<Box> boxes = toDouble(randomBoxes(count, 15));
    for (std::size_t i = 1'001; i < count; ++i) boxes[i].min[0] = kNan;
    const JoinCase with(boxes);
    try {
      (void)countFiles(with.paths, with.options());
      ADD_FAILURE() << "nothing was thrown";
    } catch (const FileError& problem) {
      EXPECT_EQ(problem.problem(), "box 1001: min x is not a number (NaN)") << count;
    }
  }
}

TEST(Join, AFolderThatIsNotThereIsNotMade) {
  const JoinCase with(toDouble(randomBoxes(10, 16)));
  const std::filesystem::path missing = with.folder.path() / "missing";
  try {
    joinFiles(with.paths, missing / "pairs.npy");
    ADD_FAILURE() << "nothing was thrown";
  } catch (const FileError& problem) {
    EXPECT_EQ(problem.code(), std::errc::no_such_file_or_directory) << problem.what();
  }
  join::JoinOptions options = with.options();
  options.work = missing / "work";
  EXPECT_THROW(joinFiles(with.paths, with.folder.path() / "pairs.npy", options), FileError);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(with.folder.path()), {}), 1) << "the input alone";
}

/// Before anything is read: with a work folder of its own, a join would only say so in the end.
TEST(Join, AnOutputThatCannotBeWrittenIsRefusedAtOnce) {
  const JoinCase with(toDouble(randomBoxes(10, 16)));
  join::JoinOptions options = with.options();
  options.progress = [](const join::JoinProgress&) { ADD_FAILURE() << "it begins"; };
  const auto problemOf = [&](const std::filesystem::path& output) {
    try {
      joinFiles(with.paths, output, options);
    } catch (const FileError& problem) {
      EXPECT_EQ(problem.path(), output);
      return problem.problem();
    }
    return std::string("none");
  };
  EXPECT_EQ(problemOf(with.folder.path() / "missing" / "pairs.npy"), "cannot be written: No such file or directory");
  EXPECT_EQ(problemOf(with.folder.path() / std::string(300, 'p')), "cannot be written: File name too long");
  options.progress = {};
  const std::filesystem::path longest = with.folder.path() / (std::string(250, 'p') + ".npy");
  EXPECT_EQ(joinFiles(with.paths, longest, options).boxes, 10U) << "what it is made as has another name";
}

TEST(Join, AWorkFolderThatIsALinkStays) {
  namespace fs = std::filesystem;
  const JoinCase with(toDouble(randomBoxes(10, 16)));
  fs::create_directory(with.folder.path() / "large");
  fs::create_directory_symlink("large", with.folder.path() / "link");
  join::JoinOptions options = with.options();
  options.work = with.folder.path() / "link";
  EXPECT_EQ(joinFiles(with.paths, with.folder.path() / "pairs.npy", options).boxes, 10U);
  EXPECT_TRUE(fs::is_symlink(options.work));
  EXPECT_TRUE(fs::is_empty(options.work));
}

TEST(Join, AFailureAtTheEndCanBeResumed) {
  const std::vector<Box> boxes = toDouble(randomBoxes(500, 17));
  const JoinCase with(boxes);
  EXPECT_THROW(joinFiles(with.paths, with.folder.path()), FileError) << "a folder is no file";
  join::JoinOptions options = with.options();
  options.commit = [] { throw Error("no"); };
  std::size_t received = 0;
  const auto sink = [&received](std::string_view bytes) { received += bytes.size(); };
  EXPECT_THROW(joinFiles(with.paths, join::ResultSink(sink), options), Error);
  EXPECT_GT(received, 0U);
  options.resume = true;
  const std::filesystem::path output = with.folder.path() / "pairs.npy";
  EXPECT_GT(joinFiles(with.paths, output, options).resumedCells, 0U);
  EXPECT_TRUE(bytesOfFile(output) == expectedBytes(boxes));
}

TEST(Join, OfWhatAKillLeavesBesideTheResultNothingStays) {
  namespace fs = std::filesystem;
  const std::vector<Box> boxes = toDouble(randomBoxes(500, 17));
  const JoinCase with(boxes);
  const fs::path output = with.folder.path() / "pairs.npy";
  join::JoinOptions options;
  options.work = with.folder.path() / "work" / "";  // with a slash behind it, as a shell completes it
  options.resume = true;
  options.progress = [](const join::JoinProgress& progress) {
    if (progress.step == "writing") ::_exit(9);
  };
  const auto files = [&with] { return std::distance(fs::directory_iterator(with.folder.path()), {}); };
  for (int kill = 0; kill < 3; ++kill) {
    if (const pid_t child = ::fork(); child == 0) {
      joinFiles(with.paths, output, options);
      ::_exit(1);
    } else {
      int status = 0;
      ASSERT_EQ(::waitpid(child, &status, 0), child);
      ASSERT_EQ(WEXITSTATUS(status), 9);
    }
    EXPECT_EQ(files(), 3) << "the boxes, the work folder, and a part of the result";
  }
  options.progress = {};
  EXPECT_GT(joinFiles(with.paths, output, options).resumedCells, 0U);
  EXPECT_TRUE(bytesOfFile(output) == expectedBytes(boxes));
  EXPECT_EQ(files(), 2);
}

TEST(Join, ADiskThatHasNoRoomForTheResultBesideThePairsIsRefusedAtOnce) {
  JoinCase with;
  const std::filesystem::path folder = with.folder.path();
  const std::uintmax_t room = std::filesystem::space(folder).available;
  const double pairs = 0.7 * static_cast<double>(room) / 8;  // of boxes in one place
  with.add(std::vector<Box>(static_cast<std::size_t>(std::sqrt(2.0 * pairs)), cube(0, 0, 0)));
  join::JoinOptions options = with.options();
  options.progress = [](const join::JoinProgress& progress) {
    if (progress.step == "distributing") throw std::runtime_error("it writes");
  };
  const std::uint64_t planned = planFiles(with.paths, options).pairBytes;
  EXPECT_TRUE(planned < room && room < 2 * planned) << planned << " of " << room;
  EXPECT_THROW(joinFiles(with.paths, folder / "pairs.npy", options), FileError);
  const auto ignore = [](std::string_view) {};
  EXPECT_THROW(joinFiles(with.paths, join::ResultSink(ignore), options), std::runtime_error) << "it may be a pipe";
}

TEST(Join, AnyMemoryWillDo) {
  const JoinCase with(toDouble(randomBoxes(500, 18)));
  join::JoinOptions options = with.options();
  for (const std::uint64_t memory : {kLeastMemory, std::uint64_t{1} << 42, ~std::uint64_t{0}}) {
    options.memory = memory;
    EXPECT_EQ(countFiles(with.paths, options).boxes, 500U);
    EXPECT_EQ(joinFiles(with.paths, with.folder.path() / "pairs.npy", options).boxes, 500U);
  }
}

TEST(Join, OptionsThatMakeNoSenseAreRefused) {
  const JoinCase with(toDouble(randomBoxes(10, 16)));
  join::JoinOptions options = with.options();
  const auto refused = [&] { EXPECT_THROW(countFiles(with.paths, options), InvalidArgument); };
  options.memory = kLeastMemory - 1;
  refused();
  options = with.options();
  options.distance = kNan;
  refused();
  options.distance = -kInfinity;
  refused();
  options = {};
  refused();
  EXPECT_THROW(countFiles({}, with.options()), InvalidArgument);
}

}  // namespace
}  // namespace allpairs::test
