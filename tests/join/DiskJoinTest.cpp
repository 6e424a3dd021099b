// SPDX-License-Identifier: MIT
// Joins in so little memory that each way of cutting, dividing and merging is taken, against the double loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "Divider.h"
#include "JoinCase.h"
#include "PairMerge.h"
#include "allpairs/Error.h"
#include "allpairs/StopFlag.h"
#include "allpairs/scene/FileError.h"
#include "support/Numbers.h"
#include "support/PoolExecutor.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

std::vector<Box> uniform(std::size_t n = 700) { return toDouble(randomBoxes(n, 3)); }

/// As float32 holds them.
std::vector<Box> rounded(std::vector<Box> boxes) {
  for (Box& box : boxes) {
    for (double& bound : box.min) bound = asFloat32(bound);
    for (double& bound : box.max) bound = asFloat32(bound);
  }
  return boxes;
}

std::vector<Box> clusters() {
  std::vector<Box> boxes = uniform(200);
  for (int i = 0; i < 150; ++i) boxes.push_back(cube(3, 3, 3));
  return boxes;
}

/// Faces, edges and corners on one another, and on every cut.
std::vector<Box> lattice() {
  std::vector<Box> boxes;
  for (int i = 0; i < 512; ++i) boxes.push_back(cube(i % 8, i / 8 % 8, i / 64));
  return boxes;
}

std::vector<Box> needles() {
  std::vector<Box> boxes;
  std::mt19937 random(8);
  const auto number = [&random](double scale) { return scale * static_cast<double>(random()) * 0x1p-32; };
  for (int i = 0; i < 400; ++i) {
    Box box = cube(number(40), number(40), number(40), 0.1);
    box.max[static_cast<std::size_t>(i % 3)] += 30.0;
    boxes.push_back(box);
  }
  return rounded(boxes);
}

/// Some boxes in so many cells that they are kept apart.
std::vector<Box> giants() {
  constexpr std::size_t kOthers = kIsSanitized ? 1'200 : 3'000;
  std::vector<Box> boxes = uniform(kOthers);
  for (std::size_t i = 0; i < 30; ++i)
    boxes.insert(boxes.begin() + static_cast<std::ptrdiff_t>(kOthers / 33 * i), cube(-1, -1, -1, 30));
  return boxes;
}

std::vector<Box> oddOnes() {
  std::vector<Box> boxes = uniform(300);
  boxes.push_back({{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}});
  boxes.push_back({{kInfinity, kInfinity, kInfinity}, {kInfinity, kInfinity, kInfinity}});
  boxes.push_back({{-kInfinity, 0, 0}, {-kInfinity, 9, 9}});
  boxes.push_back({{2, 2, 2}, {1, 3, 3}});  // empty
  boxes.push_back({{5, 5, 5}, {5, 5, 5}});
  return boxes;
}

void expectOracle(const std::vector<Box>& boxes, double distance = 0.0) {
  JoinCase with(boxes);
  join::JoinOptions options = with.options();
  options.distance = distance;
  EXPECT_TRUE(with.run(options) == expectedBytes(boxes, distance));
  EXPECT_FALSE(std::filesystem::exists(options.work));
  EXPECT_EQ(with.count(options), oracle(boxes, distance).size());
}

TEST(DiskJoin, GivesTheBytesOfTheDoubleLoop) {
  for (const auto& boxes : {uniform(), clusters(), lattice(), needles(), oddOnes()}) expectOracle(boxes);
}

TEST(DiskJoin, GivesThemAtADistance) {
  for (const double distance : {0.5, -0.25, 3.0, kInfinity}) expectOracle(uniform(300), distance);
  expectOracle(oddOnes(), 1.0);
}

TEST(DiskJoin, BoxesInManyCellsAreKeptApart) {
  const std::vector<Box> boxes = giants();
  JoinCase with(boxes);
  EXPECT_TRUE(with.run(with.options()) == expectedBytes(boxes));
  EXPECT_EQ(with.summary.wideBoxes, 30U);
  EXPECT_GT(with.summary.cells, 16U);
}

TEST(DiskJoin, MoreOfThemThanAreSearchedAtOnceToo) {
  std::vector<Box> boxes = giants();
  JoinCase with(boxes);
  join::Budget budget = tinyBudget();
  budget.cellBoxes = 20;
  EXPECT_TRUE(with.run(with.options(), budget) == expectedBytes(boxes));
  EXPECT_EQ(with.summary.wideBoxes, 30U);
}

TEST(DiskJoin, WhatNoCutDividesIsSearchedInParts) {
  const std::vector<Box> boxes(250, cube(0, 0, 0));
  JoinCase with(boxes);
  EXPECT_TRUE(with.run(with.options()) == expectedBytes(boxes));
  EXPECT_EQ(with.summary.cells, 1U);
}

TEST(DiskJoin, ARangeThatDoesNotFitIsDividedDownToOneRow) {
  const std::vector<Box> boxes(60, cube(0, 0, 0));
  JoinCase with(boxes);
  join::Budget budget = tinyBudget();
  for (const std::size_t bytes : {12U, 100U, 500U, 3'000U}) {
    budget.mergeBytes = bytes;
    EXPECT_TRUE(with.run(with.options(), budget) == expectedBytes(boxes)) << bytes;
  }
}

TEST(DiskJoin, OfFewBoxesOrNone) {
  expectOracle({});
  expectOracle({cube(0, 0, 0)});
  expectOracle({cube(0, 0, 0), cube(1, 1, 1)});
  expectOracle({{{2, 2, 2}, {1, 3, 3}}, {{2, 2, 2}, {1, 3, 3}}});
}

TEST(DiskJoin, SeveralFilesAreOneSetInAnyOfTheirForms) {
  const std::vector<Box> boxes = uniform(500);
  const auto part = [&boxes](std::size_t begin, std::size_t end) {
    return std::vector<Box>(boxes.begin() + static_cast<std::ptrdiff_t>(begin),
                            boxes.begin() + static_cast<std::ptrdiff_t>(end));
  };
  JoinCase with(part(0, 120));
  with.add({});
  with.add(part(120, 121), {.descr = "<f8"});
  with.add(part(121, 400), {.descr = ">f4", .fortran = true});
  with.add(part(400, 500), {.descr = ">f8", .fortran = true, .version = 2});
  EXPECT_TRUE(with.run(with.options()) == expectedBytes(boxes));
}

TEST(DiskJoin, Float64FarFromTheOriginIsExact) {
  const std::vector<Box> boxes = farFromTheOrigin(uniform(500));
  JoinCase with(boxes, {.descr = "<f8"});
  EXPECT_TRUE(with.run(with.options()) == expectedBytes(boxes));
}

TEST(DiskJoin, ThreadsGiveTheSameBytes) {
  const std::vector<Box> boxes = giants();
  JoinCase with(boxes);
  const std::string expected = expectedBytes(boxes);
  for (const std::size_t threads : {2U, 5U}) {
    PoolExecutor executor(threads);
    join::JoinOptions options = with.options();
    options.executor = &executor;
    join::Budget budget = tinyBudget();
    budget.workers = threads;
    EXPECT_TRUE(with.run(options, budget) == expected) << threads;
  }
}

TEST(DiskJoin, NumbersOf64BitsAreWrittenWhole) {
  constexpr std::uint64_t kFar = std::uint64_t{1} << 33;
  const TempFolder folder;
  const join::KeyRanges ranges = join::KeyRanges::of(0, kFar + 10, false, 16);
  join::RunFile file{join::WorkFile(folder.path() / "pairs", join::WorkFile::Mode::Create)};
  join::RunWriter<std::uint64_t> writer(ranges, 4, file);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> expected;
  for (std::uint64_t i = 0; i < 9; ++i) expected.emplace_back(kFar - 4 + i, kFar + i);
  for (auto pair = expected.rbegin(); pair != expected.rend(); ++pair) writer.add(pair->first, pair->second);
  const std::vector<join::Run> runs = writer.finish();
  std::vector<std::pair<std::uint64_t, std::uint64_t>> found;
  join::PairMerge<std::uint64_t> merge(ranges, kFar + 10, 500, file.file, folder.path() / "divided");
  merge.merge(runs, [&found](std::span<const join::StoredPair<std::uint64_t>> batch) {
    for (const auto& pair : batch) found.emplace_back(pair.first, pair.second);
  });
  EXPECT_EQ(found, expected);
}

/// It is read in several batches.
TEST(DiskJoin, ARangeOfManyPairsIsDividedWhole) {
  constexpr std::uint32_t kPairs = 150'001;
  const TempFolder folder;
  const join::KeyRanges ranges = join::KeyRanges::of(0, kPairs, false, 1);
  join::RunFile file{join::WorkFile(folder.path() / "pairs", join::WorkFile::Mode::Create)};
  join::RunWriter<std::uint32_t> writer(ranges, kPairs, file);
  std::vector<Pair> expected;
  for (std::uint32_t i = 0; i < kPairs; ++i) {
    const auto mixed = static_cast<std::uint32_t>(std::uint64_t{i} * 7919 % kPairs);
    writer.add(mixed, mixed + 1);
    expected.push_back({i, i + 1});
  }
  std::vector<Pair> found;
  join::PairMerge<std::uint32_t> merge(ranges, kPairs + 1, 400'000, file.file, folder.path() / "divided");
  merge.merge(writer.finish(), [&found](std::span<const join::StoredPair<std::uint32_t>> batch) {
    for (const auto& pair : batch) found.push_back({pair.first, pair.second});
  });
  EXPECT_TRUE(found == expected);
}

/// One row of `row` pairs among `keys` keys of five pairs each, put in order in 4 MB.
struct DividedRange {
  bool isOrdered = false;
  std::uint64_t pairs = 0;
  std::uint64_t scratchBytes = 0;  ///< At most at once.
};

DividedRange divideRange(std::uint32_t keys, std::uint32_t row) {
  const TempFolder folder;
  const join::KeyRanges ranges = join::KeyRanges::of(0, keys, false, 1);
  join::RunFile file{join::WorkFile(folder.path() / "pairs", join::WorkFile::Mode::Create)};
  join::RunWriter<std::uint32_t> writer(ranges, 100'000, file);
  std::vector<Pair> expected;
  for (std::uint32_t key = 0; key < keys; ++key) {
    const std::uint32_t pairs = key == 512 ? row : 5;
    for (std::uint32_t i = 0; i < pairs; ++i) expected.push_back({key, 2 * i});
  }
  for (auto pair = expected.rbegin(); pair != expected.rend(); ++pair) writer.add(pair->first, pair->second);
  std::vector<Pair> found;
  DividedRange result{.pairs = expected.size()};
  join::PairMerge<std::uint32_t> merge(ranges, 2 * row, 4'000'000, file.file, folder.path() / "divided");
  merge.merge(writer.finish(), [&](std::span<const join::StoredPair<std::uint32_t>> batch) {
    for (const auto& pair : batch) found.push_back({pair.first, pair.second});
    std::uint64_t room = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
      if (entry.path().filename() != "pairs") room += entry.file_size();
    }
    result.scratchBytes = std::max(result.scratchBytes, room);
  });
  result.isOrdered = found == expected;
  return result;
}

/// Each is a copy of what is divided: the disk has to have room for all of them.
TEST(DiskJoin, RangesOfManyKeysAndOneWithMostOfThePairsTakeTheScratchFilesThatAreCounted) {
  constexpr std::uint32_t kRow = 400'000;
  for (const std::uint32_t keys : {1U, 1'000U, 5'000U, 20'000U}) {
    const DividedRange range = divideRange(keys, keys == 1 ? 5 : kRow);
    EXPECT_TRUE(range.isOrdered) << keys;
    const join::KeyLoad load{keys, range.pairs, kRow};
    const std::uint64_t counted = join::scratchBytesFor(load, sizeof(Pair), 4'000'000);
    EXPECT_LE(range.scratchBytes, counted) << keys;
    EXPECT_LE(counted, range.scratchBytes * 11 / 10) << keys;
    const std::uint64_t copies = keys == 1 ? 0 : keys <= 5'000 ? 2 : 3;
    EXPECT_LE(counted, sizeof(Pair) * range.pairs * copies * 11 / 10) << keys;
  }
}

/// What is expected of a join, which is cut into cells of so many boxes, and how many pairs it has.
struct PlannedRoom {
  double pairs = 0;
  double found = 0;
  std::uint64_t scratchBytes = 0;
};

PlannedRoom planOf(JoinCase& with, std::size_t cellBoxes = 200) {
  const join::JoinOptions options = with.options();
  join::Budget budget = tinyBudget();
  budget.cellBoxes = cellBoxes;
  join::BoxInput input(with.paths, options);
  const join::Division division = join::Divider(input, options, budget).divide();
  return {static_cast<double>(division.pairs), static_cast<double>(with.count(options)),
          division.scratchBytes(sizeof(Pair), 20'000)};
}

/// The sample has every 21st box: that at 0, and none of the others.
TEST(DiskJoin, TheRoomForPairsAndToPutThemInOrderIsCountedWhereASampleHasNoLargeBox) {
  const std::vector<Box> boxes = uniform(6'000);
  for (const std::size_t cellBoxes : {200U, 100'000U}) {
    JoinCase none(boxes);
    EXPECT_EQ(planOf(none, cellBoxes).scratchBytes, 0U);
    for (const std::size_t place : {0U, 1U, 2'999U, 5'000U, 5'999U}) {
      std::vector<Box> all = boxes;
      all[place] = cube(-1, -1, -1, 30);
      JoinCase with(all);
      const PlannedRoom room = planOf(with, cellBoxes);
      EXPECT_NEAR(room.pairs, room.found, 0.1 * room.found) << place;
      // A row of 1,250 pairs fits. All others are copied twice: with the range, and then by themselves.
      const std::uint64_t row = boxes.size() - 1 - place;
      const std::uint64_t copied = row > 1'250 ? 2 * sizeof(Pair) * row : 0;
      EXPECT_GE(room.scratchBytes, copied) << place;
      EXPECT_LE(room.scratchBytes, copied * 12 / 10) << place;
    }
  }
}

TEST(DiskJoin, LargeBoxesOfTwoSetsAndManyOfThemAreEstimatedToo) {
  std::vector<Box> many = uniform(3'000);
  for (std::size_t i = 0; i < many.size(); i += 50) many[i] = cube(-1, -1, -1, 30);
  std::vector<Box> crowd = uniform(3'000);
  for (std::size_t i = 0; i < crowd.size(); i += 3) crowd[i] = {{1, 1, 1}, {14, 14, 14}};
  for (const std::vector<Box>& boxes : {many, crowd}) {
    JoinCase one(boxes);
    PlannedRoom room = planOf(one);
    EXPECT_NEAR(room.pairs, room.found, 0.1 * room.found);
    JoinCase two(boxes);
    two.addSecond(uniform(2'000));
    room = planOf(two);
    EXPECT_NEAR(room.pairs, room.found, 0.1 * room.found);
    JoinCase other(uniform(2'000));
    other.addSecond(boxes);
    room = planOf(other);
    EXPECT_NEAR(room.pairs, room.found, 0.1 * room.found);
    EXPECT_EQ(room.scratchBytes, 0U) << "they are the second";
  }
}

/// Probes at equal distances would all be in the first plane.
TEST(DiskJoin, ALargeBoxIsEstimatedByBoxesInAllOfAGrid) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < 32'768; ++i) {
    boxes.push_back(
        cube(static_cast<double>(i % 32), static_cast<double>(i / 32 % 32), static_cast<double>(i / 1024), 0.4));
  }
  boxes[1] = {{15.5, -1, -1}, {33, 33, 33}};
  JoinCase with(boxes);
  const PlannedRoom room = planOf(with, 100'000);
  EXPECT_NEAR(room.pairs, room.found, 0.2 * room.found);
}

/// The disk may give back other bytes than were written.
TEST(DiskJoin, BoxesThatAreNotOfTheJoinAndRangesThatAreNoneAreErrors) {
  const TempFolder folder;
  const join::KeyRanges ranges = join::KeyRanges::of(0, 100, false, 4);
  const auto problemWith = [&](std::uint64_t at, std::uint64_t number) -> std::string {
    join::RunFile file{join::WorkFile(folder.path() / "pairs", join::WorkFile::Mode::Create)};
    join::RunWriter<std::uint64_t> writer(ranges, 10, file);
    for (const std::uint64_t first : {10U, 40U, 70U}) writer.add(first, first + 1);
    const std::vector<join::Run> runs = writer.finish();
    file.file.write(at, &number, sizeof(number));
    try {
      join::PairMerge<std::uint64_t>(ranges, 100, 4'000, file.file, folder.path() / "divided").merge(runs, [](auto) {});
    } catch (const FileError& problem) {
      return problem.problem();
    }
    return "";
  };
  constexpr std::uint64_t kRanges = 3 * sizeof(join::StoredPair<std::uint64_t>);  // where it is said where they begin
  EXPECT_EQ(problemWith(0, 11), "") << "which only the checksum tells";
  EXPECT_EQ(problemWith(0, 400), join::kForeignBox);
  EXPECT_EQ(problemWith(kRanges + 4 * sizeof(std::uint64_t), 1'000), "is damaged: a run's ranges");
  join::RunFile file{join::WorkFile(folder.path() / "pairs", join::WorkFile::Mode::Create)};
  join::RunWriter<std::uint64_t> writer(ranges, 10, file);
  writer.add(100, 5);
  EXPECT_THROW((void)writer.finish(), FileError);
}

TEST(DiskJoin, ARunCanBeStoppedWhileItIsWritten) {
  const TempFolder folder;
  StopFlag stop;
  join::RunFile file{join::WorkFile(folder.path() / "pairs", join::WorkFile::Mode::Create)};
  join::RunWriter<std::uint64_t> writer(join::KeyRanges::of(0, 10, false, 4), 10, file, &stop);
  writer.add(1, 2);
  stop.set();
  EXPECT_THROW((void)writer.finish(), Stopped);
  stop.clear();
  EXPECT_EQ(writer.finish().size(), 1U);
}

TEST(DiskJoin, ARangeThatIsDividedAgainCanBeStopped) {
  const TempFolder folder;
  const join::KeyRanges ranges = join::KeyRanges::of(0, 10'000, false, 1);
  join::RunFile file{join::WorkFile(folder.path() / "pairs", join::WorkFile::Mode::Create)};
  join::RunWriter<std::uint64_t> writer(ranges, 4'000, file);
  for (std::uint64_t i = 0; i < 4'000; ++i) writer.add(i, i + 1);
  const std::vector<join::Run> runs = writer.finish();
  StopFlag stop;
  std::size_t pairs = 0;
  const auto merge = [&] {
    join::PairMerge<std::uint64_t>(ranges, 10'000, 4'000, file.file, folder.path() / "divided", &stop)
        .merge(runs, [&pairs](std::span<const join::StoredPair<std::uint64_t>> batch) { pairs += batch.size(); });
  };
  merge();
  EXPECT_EQ(pairs, 4'000U);
  stop.set();
  EXPECT_THROW(merge(), Stopped);
  EXPECT_EQ(pairs, 4'000U) << "none was passed on";
}

}  // namespace
}  // namespace allpairs::test
