// SPDX-License-Identifier: MIT
// Joins of two sets in so little memory that each way of cutting, dividing and merging is taken, against the double
// loop.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "ResumeCase.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/scene/FileError.h"
#include "support/Numbers.h"
#include "support/PoolExecutor.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

namespace fs = std::filesystem;

std::vector<Box> some(std::size_t n, unsigned seed) { return toDouble(randomBoxes(n, seed)); }

/// Some of them reach so many cells that they are kept apart.
std::vector<Box> withGiants(std::size_t n, unsigned seed, std::size_t giants) {
  std::vector<Box> boxes = some(n, seed);
  for (std::size_t i = 0; i < giants; ++i) {
    boxes.insert(boxes.begin() + static_cast<std::ptrdiff_t>(n / giants * i), cube(-1, -1, -1, 30));
  }
  return boxes;
}

struct Sets {
  std::vector<Box> first{};
  std::vector<Box> second{};
};

class TwoSetsCase : public JoinCase {
 public:
  explicit TwoSetsCase(const Sets& sets, const NpyStyle& style = {.descr = "<f4"}) : JoinCase(sets.first, style) {
    addSecond(sets.second, style);
  }
};

std::string bytesBetween(const Sets& sets, double distance = 0.0) {
  return bytesOfPairs(oracleBetween(sets.first, sets.second, distance));
}

void expectPairs(const Sets& sets, double distance = 0.0) {
  TwoSetsCase with(sets);
  join::JoinOptions options = with.options();
  options.distance = distance;
  EXPECT_TRUE(with.run(options) == bytesBetween(sets, distance));
  EXPECT_EQ(with.summary.boxes, sets.first.size() + sets.second.size());
  EXPECT_EQ(with.summary.secondBoxes, sets.second.size());
  EXPECT_FALSE(fs::exists(options.work));
  EXPECT_EQ(with.count(options), oracleBetween(sets.first, sets.second, distance).size());
}

TEST(TwoSets, GiveTheBytesOfTheDoubleLoop) {
  expectPairs({some(400, 3), some(300, 4)});
  expectPairs({some(20, 3), some(600, 4)});
  expectPairs({some(600, 3), some(20, 4)});
  expectPairs({some(300, 5), some(300, 5)});
}

TEST(TwoSets, GiveThemAtADistance) {
  for (const double distance : {0.5, -0.25, 3.0, kInfinity}) expectPairs({some(150, 6), some(200, 7)}, distance);
}

TEST(TwoSets, GiveThemWhereverCutsLie) {
  std::mt19937 random(17);
  for (unsigned round = 0; round < repeats(40U); ++round) {
    const Sets sets{withGiants(100 + random() % 300, round, 1 + random() % 9),
                    withGiants(100 + random() % 300, 90 + round, 1 + random() % 9)};
    TwoSetsCase with(sets);
    join::Budget budget = tinyBudget();
    budget.cellBoxes = 2 + random() % 60;
    budget.sampleBoxes = 20 + random() % 400;
    budget.mergeBytes = 500 + random() % 5'000;
    join::JoinOptions options = with.options();
    options.distance = round % 3 == 0 ? 0.25 : 0.0;
    ASSERT_TRUE(with.run(options, budget) == bytesBetween(sets, options.distance)) << round;
  }
}

TEST(TwoSets, BoxesInManyCellsAreKeptApart) {
  constexpr std::size_t kOthers = kIsSanitized ? 600 : 1'500;
  const Sets giantFirst{withGiants(kOthers, 8, 20), some(kOthers, 9)};
  const Sets giantSecond{some(kOthers, 8), withGiants(kOthers, 9, 20)};
  const Sets both{withGiants(kOthers, 8, 20), withGiants(kOthers, 9, 30)};
  for (const Sets& sets : {giantFirst, giantSecond, both}) {
    for (const std::size_t cellBoxes : {60U, 12U}) {
      TwoSetsCase with(sets);
      join::Budget budget = tinyBudget();
      budget.cellBoxes = cellBoxes;
      EXPECT_TRUE(with.run(with.options(), budget) == bytesBetween(sets));
      EXPECT_EQ(with.summary.wideBoxes, sets.first.size() + sets.second.size() - 2 * kOthers);
    }
  }
}

TEST(TwoSets, WhatNoCutDividesIsSearchedInParts) {
  expectPairs({std::vector<Box>(150, cube(0, 0, 0)), std::vector<Box>(90, cube(0, 0, 0))});
  expectPairs({std::vector<Box>(3, cube(0, 0, 0)), std::vector<Box>(200, cube(0, 0, 0))});
}

TEST(TwoSets, ARangeThatDoesNotFitIsDividedDownToOneRow) {
  const Sets sets{std::vector<Box>(30, cube(0, 0, 0)), std::vector<Box>(70, cube(0, 0, 0))};
  for (const std::size_t bytes : {12U, 100U, 500U, 3'000U}) {
    TwoSetsCase with(sets);
    join::Budget budget = tinyBudget();
    budget.mergeBytes = bytes;
    EXPECT_TRUE(with.run(with.options(), budget) == bytesBetween(sets)) << bytes;
  }
}

TEST(TwoSets, OfFewBoxesOrNone) {
  const std::vector<Box> odd{{{2, 2, 2}, {1, 3, 3}}, {{-kInfinity, 0, 0}, {kInfinity, 9, 9}}, {{5, 5, 5}, {5, 5, 5}}};
  expectPairs({{}, {}});
  expectPairs({{}, some(200, 3)});
  expectPairs({some(200, 3), {}});
  expectPairs({{cube(0, 0, 0)}, {cube(1, 1, 1)}});
  expectPairs({odd, some(200, 3)});
  expectPairs({some(200, 3), odd});
}

TEST(TwoSets, EachIsSeveralFilesInAnyOfTheirForms) {
  const Sets sets{some(200, 11), some(300, 12)};
  JoinCase with;
  with.add({sets.first.begin(), sets.first.begin() + 90});
  with.add({});
  with.add({sets.first.begin() + 90, sets.first.end()}, {.descr = ">f8", .fortran = true});
  with.addSecond({sets.second.begin(), sets.second.begin() + 1}, {.descr = "<f8"});
  with.addSecond({sets.second.begin() + 1, sets.second.end()}, {.descr = ">f4", .fortran = true});
  EXPECT_TRUE(with.run(with.options()) == bytesBetween(sets));
}

TEST(TwoSets, Float64FarFromTheOriginIsExact) {
  const Sets sets{farFromTheOrigin(some(300, 13)), farFromTheOrigin(some(300, 14))};
  TwoSetsCase with(sets, {.descr = "<f8"});
  EXPECT_TRUE(with.run(with.options()) == bytesBetween(sets));
}

TEST(TwoSets, ThreadsGiveTheSameBytes) {
  const Sets sets{withGiants(900, 15, 9), withGiants(1'200, 16, 9)};
  TwoSetsCase with(sets);
  PoolExecutor executor(3);
  join::JoinOptions options = with.options();
  options.executor = &executor;
  join::Budget budget = tinyBudget();
  budget.workers = 3;
  EXPECT_TRUE(with.run(options, budget) == bytesBetween(sets));
}

TEST(TwoSets, InTheLeastMemoryTheyAreTheSearchInMemory) {
  constexpr std::size_t kSecond = kIsSanitized ? 120'000 : 200'000;
  const Sets sets{some(kSecond * 3 / 4, 17), some(kSecond, 18)};
  const TwoSetsCase with(sets);
  const fs::path output = with.folder.path() / "pairs.npy";
  join::JoinOptions options = with.options();
  options.memory = join::kLeastMemory;
  const join::JoinSummary plan = join::planFiles(with.paths, options);
  const join::JoinSummary done = join::joinFiles(with.paths, output, options);
  EXPECT_TRUE(pairsOfNpy(bytesOfFile(output)) == overlaps(sets.first, sets.second));
  EXPECT_GT(done.cells, 1U);
  EXPECT_EQ(plan.cells, done.cells);
  EXPECT_EQ(plan.copies, done.copies);
  EXPECT_EQ(plan.boxBytes, done.boxBytes);
  EXPECT_EQ(plan.secondBoxes, kSecond);
  EXPECT_NEAR(static_cast<double>(plan.pairs), static_cast<double>(done.pairs), 0.1 * static_cast<double>(done.pairs));
}

TEST(TwoSets, APlanOfASetWithItselfIsNotOfItsBoxesWithThemselves) {
  const std::vector<Box> boxes = some(kIsSanitized ? 110'000 : 200'000, 19);
  const TwoSetsCase with({boxes, boxes});
  join::JoinOptions options = with.options();
  options.memory = join::kLeastMemory;
  const auto pairs = static_cast<double>(join::countFiles(with.paths, options).pairs);
  EXPECT_NEAR(static_cast<double>(join::planFiles(with.paths, options).pairs), pairs, 0.3 * pairs);
}

/// Each box overlaps only the one with its number: the same objects, that is, at two times.
TEST(TwoSets, APlanOfTheSameObjectsAtTwoTimesHasThem) {
  constexpr std::size_t kObjects = kIsSanitized ? 110'000 : 200'000;
  std::vector<Box> before;
  std::vector<Box> after;
  for (std::size_t i = 0; i < kObjects; ++i) {
    const auto x = static_cast<double>(2 * (i % 500));
    const auto y = static_cast<double>(2 * (i / 500));
    before.push_back({{x, y, 0}, {x + 1, y + 1, 1}});
    after.push_back({{x + 0.1, y, 0}, {x + 1.1, y + 1, 1}});
  }
  for (const std::vector<Box>& second : {after, before}) {
    const TwoSetsCase with({before, second});
    join::JoinOptions options = with.options();
    options.memory = join::kLeastMemory;
    ASSERT_EQ(join::countFiles(with.paths, options).pairs, kObjects);
    const auto planned = static_cast<double>(join::planFiles(with.paths, options).pairs);
    EXPECT_NEAR(planned, static_cast<double>(kObjects), 0.1 * static_cast<double>(kObjects));
  }
}

TEST(TwoSets, AfterAKillAtAnyStepTheBytesAreTheSame) {
  const Sets sets{withGiants(250, 21, 9), withGiants(300, 22, 9)};
  TwoSetsCase with(sets);
  expectSameBytesAfterEachKill(with, bytesBetween(sets));
}

TEST(TwoSets, WhatIsCompleteIsNotDoneAgainAndWhatIsDamagedIs) {
  const Sets sets{some(250, 23), some(300, 24)};
  for (const char* damaged : {"", "boxes", "pairs"}) {
    TwoSetsCase with(sets);
    stoppedWhileWriting(with);
    const fs::path file = with.options().work / damaged;
    if (*damaged != '\0') fs::resize_file(file, fs::file_size(file) / 2);
    EXPECT_TRUE(with.run(resuming(with)) == bytesBetween(sets)) << damaged;
    if (*damaged == '\0') {
      EXPECT_EQ(with.summary.resumedCells, with.summary.cells);
    } else {
      EXPECT_LT(with.summary.resumedCells, with.summary.cells);
    }
  }
}

TEST(TwoSets, BoxesThatAreEmptyAreStillKnownAsThoseOfTheirSet) {
  Sets sets{some(250, 23), some(300, 24)};
  sets.first[70] = {{0, 2, 0}, {1, 1, 1}};
  sets.second[90] = {{0, 0, 2}, {1, 1, 1}};
  TwoSetsCase with(sets);
  stoppedWhileWriting(with);
  EXPECT_TRUE(with.run(resuming(with)) == bytesBetween(sets));
  EXPECT_GT(with.summary.resumedCells, 0U);
  for (const std::size_t set : {0U, 1U}) {
    EXPECT_EQ(with.summary.empty[set].count, 1U) << set;
    EXPECT_EQ(with.summary.empty[set].first, set == 0 ? 70U : 90U);
    EXPECT_EQ(with.summary.empty[set].axis, set + 1);
  }
}

TEST(TwoSets, AreNotResumedAsOthers) {
  const Sets sets{some(250, 23), some(300, 24)};
  const auto refused = [&sets](const auto& change) {
    TwoSetsCase with(sets);
    stoppedWhileWriting(with);
    change(with);
    EXPECT_THROW((void)with.run(resuming(with)), FileError);
  };
  refused([](JoinCase& with) { std::swap(with.paths, with.second); });
  refused([](JoinCase& with) {  // the same files as one set
    with.paths.push_back(with.second[0]);
    with.second.clear();
  });
  refused([](JoinCase& with) { with.second.push_back(with.second[0]); });
}

TEST(TwoSets, AreNotResumedWithAnotherBoundaryBetweenThem) {
  JoinCase with(some(250, 23));
  with.addSecond(some(200, 24));
  with.addSecond(some(300, 25));
  stoppedWhileWriting(with);
  with.paths.push_back(with.second[0]);
  with.second.erase(with.second.begin());
  EXPECT_THROW((void)with.run(resuming(with)), FileError);
}

TEST(TwoSets, AManifestOfPartsThatDoNotFitIsAnError) {
  const auto refused = [](const auto& change) {
    TwoSetsCase with(Sets{some(250, 23), some(300, 24)});
    stoppedWhileWriting(with);
    const fs::path path = with.options().work / "manifest";
    join::Manifest manifest = *join::Manifest::read(path);
    change(manifest);
    manifest.write(path);
    EXPECT_THROW((void)with.run(resuming(with)), FileError);
  };
  refused([](join::Manifest& manifest) { manifest.extents.pop_back(); });
  refused([](join::Manifest& manifest) { manifest.secondFiles = 0; });
  refused([](join::Manifest& manifest) { manifest.secondFiles = 3; });
  refused([](join::Manifest& manifest) { manifest.cells[manifest.cuts.size() + 2] = {}; });
}

TEST(TwoSets, BadInputIsNamed) {
  Sets sets{some(30, 25), some(40, 26)};
  sets.second[7].min[2] = kNan;
  JoinCase with(sets.first);
  with.addSecond(some(10, 1));
  with.addSecond(sets.second);
  try {
    (void)with.run(with.options());
    FAIL();
  } catch (const FileError& problem) {
    EXPECT_NE(std::string(problem.what()).find("second1.npy: box 7: min z is not a number (NaN)"), std::string::npos)
        << problem.what();
  }
  with.second = {with.folder.path() / "missing.npy"};
  EXPECT_THROW((void)with.run(with.options()), FileError);
}

}  // namespace
}  // namespace allpairs::test
