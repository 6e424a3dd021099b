// SPDX-License-Identifier: MIT
// Joins of boxes that have margins, groups, categories and masks, or that a region leaves out, in so little memory that
// each way of cutting, dividing and merging is taken, against the double loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
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
using Labels = std::vector<std::uint32_t>;

/// Boxes and what they have; what none has is empty.
struct BoxesWith {
  std::vector<Box> boxes{};
  std::vector<double> margins{};
  Labels groups{};
  Labels categories{};
  Labels masks{};
};

struct Search {
  double distance = 0.0;
  std::optional<Box> region{};
};

template <class T>
T valueOr(const std::vector<T>& values, std::size_t i, T otherwise) {
  return values.empty() ? otherwise : values[i];
}

bool areApart(const Box& a, const Box& b, double distance) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a.min[axis] > a.max[axis] || b.min[axis] > b.max[axis]) return true;
    if (a.min[axis] > b.max[axis] + distance || b.min[axis] > a.max[axis] + distance) return true;
  }
  return false;
}

bool isLeftOut(const BoxesWith& set, std::size_t i, const Search& search) {
  return search.region && areApart(set.boxes[i], *search.region, search.distance + valueOr(set.margins, i, 0.0));
}

bool isPair(const BoxesWith& first, std::size_t i, const BoxesWith& second, std::size_t j, const Search& search) {
  constexpr std::uint32_t kAll = std::numeric_limits<std::uint32_t>::max();
  if (isLeftOut(first, i, search) || isLeftOut(second, j, search)) return false;
  const std::uint32_t group = valueOr(first.groups, i, 0U);
  if (group != 0 && group == valueOr(second.groups, j, 0U)) return false;
  if ((valueOr(first.masks, i, kAll) & valueOr(second.categories, j, kAll)) == 0) return false;
  if ((valueOr(second.masks, j, kAll) & valueOr(first.categories, i, kAll)) == 0) return false;
  const double distance = search.distance + valueOr(first.margins, i, 0.0) + valueOr(second.margins, j, 0.0);
  return !areApart(first.boxes[i], second.boxes[j], distance);
}

std::vector<Pair> doubleLoop(const BoxesWith& set, const Search& search) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < set.boxes.size(); ++i) {
    for (std::uint32_t j = i + 1; j < set.boxes.size(); ++j) {
      if (isPair(set, i, set, j, search)) pairs.push_back({i, j});
    }
  }
  return pairs;
}

std::vector<Pair> doubleLoop(const BoxesWith& first, const BoxesWith& second, const Search& search) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < first.boxes.size(); ++i) {
    for (std::uint32_t j = 0; j < second.boxes.size(); ++j) {
      if (isPair(first, i, second, j, search)) pairs.push_back({i, j});
    }
  }
  return pairs;
}

/// A join whose files have what the boxes have, cut into files at another place than the boxes are.
class ValuesCase : public JoinCase {
 public:
  explicit ValuesCase(const BoxesWith& set, const NpyStyle& style = {.descr = "<f4"}) : JoinCase(set.boxes, style) {
    values = filesOf(set, "first");
  }
  ValuesCase(const BoxesWith& first, const BoxesWith& other, const NpyStyle& style = {.descr = "<f4"})
      : ValuesCase(first, style) {
    addSecond(other.boxes, style);
    secondValues = filesOf(other, "second");
  }

  scene::BoxValueFiles filesOf(const BoxesWith& set, const std::string& name) {
    scene::BoxValueFiles files;
    if (!set.margins.empty()) files.margins = twoFiles(name + " margins", set.margins, "<f8");
    if (!set.groups.empty()) files.groups = twoFiles(name + " groups", set.groups, "<u4");
    if (!set.categories.empty()) files.categories = twoFiles(name + " categories", set.categories, ">u4");
    if (!set.masks.empty()) files.masks = twoFiles(name + " masks", set.masks, "<u4");
    return files;
  }

  using JoinCase::options;
  join::JoinOptions options(const Search& search) {
    distance = search.distance;
    region = search.region;
    return options();
  }

 private:
  template <class T>
  std::vector<fs::path> twoFiles(const std::string& name, const std::vector<T>& numbers, const char* descr) {
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 3);
    return {folder.write(name + "0.npy", npyNumbers(std::vector<T>(numbers.begin(), middle), descr)),
            folder.write(name + "1.npy", npyNumbers(std::vector<T>(middle, numbers.end()), descr))};
  }
};

/// Boxes on a grid of tenths, which no double holds: the order in which margins are added decides now and then. Some
/// are so large, or have such margins, that they are kept apart, some are empty, and a few have no end.
BoxesWith anyBoxes(std::mt19937& random, std::size_t n, unsigned mostTenths = 12) {
  BoxesWith set;
  const auto tenths = [&random](unsigned most) { return 0.1 * static_cast<double>(random() % most); };
  const auto label = [&random](std::uint32_t least, std::uint32_t count) {
    return least + static_cast<std::uint32_t>(random() % count);
  };
  for (std::size_t i = 0; i < n; ++i) {
    Box box;
    const bool isLarge = random() % 30 == 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = tenths(isLarge ? 50 : 150);
      box.max[axis] = box.min[axis] + tenths(isLarge ? 300 : 9);
      if (random() % 300 == 0) box.max[axis] = kInfinity;
      if (random() % 300 == 0) box.min[axis] = -kInfinity;
    }
    if (random() % 40 == 0) box.max[1] = box.min[1] - 1.0;
    set.boxes.push_back(box);
    set.margins.push_back(random() % 50 == 0 ? tenths(mostTenths) : tenths(8) - 0.3);
    set.groups.push_back(label(0, 40));
    set.categories.push_back(label(1, 7));
    set.masks.push_back(label(1, 7));
  }
  return set;
}

/// Without some of what they have.
BoxesWith someOf(BoxesWith set, std::uint_fast32_t which) {
  if ((which & 1U) != 0) set.margins.clear();
  if ((which & 2U) != 0) set.groups.clear();
  if ((which & 4U) != 0) set.categories.clear();
  if ((which & 8U) != 0) set.masks.clear();
  return set;
}

join::Budget anyBudget(std::mt19937& random) {
  join::Budget budget = tinyBudget();
  budget.cellBoxes = 2 + random() % 80;
  budget.sampleBoxes = 20 + random() % 400;
  budget.mergeBytes = 500 + random() % 5'000;
  return budget;
}

Search anySearch(std::mt19937& random) {
  Search search{.distance = 0.1 * (static_cast<double>(random() % 5) - 1.0)};
  if (random() % 2 == 0) search.region = Box{{1.1, 0.3, -kInfinity}, {7.7, 9.2, 4.4}};
  return search;
}

TEST(Values, GiveTheBytesOfTheDoubleLoopWhereverCutsLie) {
  std::mt19937 random(5);
  std::uint64_t wide = 0;
  std::uint64_t cells = 0;
  for (unsigned round = 0; round < 80; round += kIsSanitized ? 3 : 1) {
    const BoxesWith set =
        someOf(anyBoxes(random, 100 + random() % 500, round % 5 == 0 ? 90 : 12), round < 60 ? 0 : round);
    const Search search = anySearch(random);
    ValuesCase with(set, {.descr = "<f8"});
    const std::vector<Pair> expected = doubleLoop(set, search);
    const join::Budget budget = anyBudget(random);
    ASSERT_TRUE(with.run(with.options(search), budget) == bytesOfPairs(expected)) << round;
    EXPECT_EQ(with.summary.pairs, expected.size());
    wide += with.summary.wideBoxes;
    cells += with.summary.cells;
    ASSERT_EQ(with.count(with.options(search), budget), expected.size()) << round;
  }
  EXPECT_GT(wide, repeats(100U));
  EXPECT_GT(cells, repeats(1'000U));
}

TEST(Values, OfTwoSetsGiveTheBytesOfTheDoubleLoopWhereverCutsLie) {
  std::mt19937 random(6);
  constexpr unsigned kRounds = repeats(80U);
  for (unsigned round = 0; round < kRounds; ++round) {
    const BoxesWith first = someOf(anyBoxes(random, 50 + random() % 400), round < kRounds / 2 ? 0 : random());
    const BoxesWith second = someOf(anyBoxes(random, 50 + random() % 400), round < kRounds / 2 ? 0 : random());
    const Search search = anySearch(random);
    ValuesCase with(first, second, {.descr = "<f8"});
    const std::vector<Pair> expected = doubleLoop(first, second, search);
    const join::Budget budget = anyBudget(random);
    ASSERT_TRUE(with.run(with.options(search), budget) == bytesOfPairs(expected)) << round;
    ASSERT_EQ(with.count(with.options(search), budget), expected.size()) << round;
  }
}

TEST(Values, OfFloat32BoxesAndFarFromTheOriginAreExact) {
  std::mt19937 random(7);
  BoxesWith set = anyBoxes(random, 400);
  set.boxes = toDouble(randomBoxes(400, 9));
  ValuesCase narrow(set);
  const Search search{.distance = 0.1, .region = Box{{2, 2, 2}, {15, 15, 15}}};
  EXPECT_TRUE(narrow.run(narrow.options(search)) == bytesOfPairs(doubleLoop(set, search)));
  set.boxes = farFromTheOrigin(set.boxes);
  ValuesCase far(set, {.descr = "<f8"});
  const Search there{.distance = 0.1, .region = farFromTheOrigin({*search.region})[0]};
  EXPECT_TRUE(far.run(far.options(there)) == bytesOfPairs(doubleLoop(set, there)));
}

TEST(Values, AMarginWithoutEndPairsItsBoxWithAll) {
  BoxesWith set{.boxes = toDouble(randomBoxes(500, 9)), .margins = std::vector<double>(500)};
  set.margins[20] = kInfinity;
  set.margins[450] = kInfinity;
  ValuesCase with(set);
  const std::vector<Pair> expected = doubleLoop(set, {});
  EXPECT_TRUE(with.run(with.options()) == bytesOfPairs(expected));
  EXPECT_GE(expected.size(), 998U);
}

TEST(Values, WhatNoCutDividesIsSearchedInParts) {
  std::mt19937 random(8);
  BoxesWith set = anyBoxes(random, 250);
  set.boxes.assign(250, cube(0, 0, 0));
  ValuesCase with(set);
  const std::vector<Pair> expected = doubleLoop(set, {});
  EXPECT_TRUE(with.run(with.options()) == bytesOfPairs(expected));
  EXPECT_GT(expected.size(), 1'000U);
  EXPECT_LT(expected.size(), 250U * 249 / 2);
}

TEST(Values, OfNoBoxesAndARegionWithoutAny) {
  std::mt19937 random(9);
  const BoxesWith set = anyBoxes(random, 200);
  ValuesCase none(BoxesWith{}, set);
  EXPECT_TRUE(none.run(none.options()) == bytesOfPairs({}));
  ValuesCase with(set, {.descr = "<f8"});
  const Search far{.region = Box{{500, 500, 500}, {501, 501, 501}}};
  EXPECT_TRUE(with.run(with.options(far)) == bytesOfPairs(doubleLoop(set, far)));
}

TEST(Values, ThreadsGiveTheSameBytes) {
  std::mt19937 random(10);
  const BoxesWith set = anyBoxes(random, 900);
  const Search search = {.distance = 0.2, .region = Box{{1, 1, 1}, {9, 9, 9}}};
  ValuesCase with(set, {.descr = "<f8"});
  PoolExecutor executor(3);
  join::JoinOptions options = with.options(search);
  options.executor = &executor;
  join::Budget budget = tinyBudget();
  budget.workers = 3;
  EXPECT_TRUE(with.run(options, budget) == bytesOfPairs(doubleLoop(set, search)));
}

TEST(Values, InTheLeastMemoryTheyAreTheSearchInMemory) {
  std::mt19937 random(11);
  BoxesWith set = anyBoxes(random, 200'000);
  set.boxes = toDouble(randomBoxes(200'000, 12));
  for (double& margin : set.margins) margin *= 0.02;
  ValuesCase with(set);
  const Box region{{5, 5, 5}, {90, 90, 90}};
  BoxView view(set.boxes);
  view.setMargins(set.margins);
  const std::vector<Pair> expected =
      overlaps(view, {.region = region,
                      .filter = {.first = {.categories = set.categories, .masks = set.masks, .groups = set.groups}}});
  const fs::path output = with.folder.path() / "pairs.npy";
  join::JoinOptions options = with.options(Search{.region = region});
  options.memory = join::kLeastMemory;
  const join::JoinSummary plan = join::planFiles(with.paths, options);
  const join::JoinSummary done = join::joinFiles(with.paths, output, options);
  EXPECT_TRUE(pairsOfNpy(bytesOfFile(output)) == expected);
  EXPECT_GT(expected.size(), 1'000U);
  EXPECT_GT(done.cells, 1U);
  EXPECT_EQ(plan.cells, done.cells);
  EXPECT_EQ(plan.copies, done.copies);
  EXPECT_EQ(plan.boxBytes, done.boxBytes);
  EXPECT_NEAR(static_cast<double>(plan.pairs), static_cast<double>(done.pairs), 0.2 * static_cast<double>(done.pairs));
}

TEST(Values, APlanCountsWhatTheyTake) {
  std::mt19937 random(12);
  BoxesWith set = anyBoxes(random, 300);
  set.boxes = toDouble(randomBoxes(300, 13));
  const auto bytesOf = [](const BoxesWith& boxes, const Search& search) {
    ValuesCase with(boxes);
    const join::JoinSummary plan = join::planFiles(with.paths, with.options(search));
    EXPECT_EQ(plan.copies, 0U);
    return plan.boxBytes;
  };
  EXPECT_EQ(bytesOf({.boxes = set.boxes}, {}), 300U * 32);
  EXPECT_EQ(bytesOf({.boxes = set.boxes, .margins = set.margins}, {}), 300U * 40);
  EXPECT_EQ(bytesOf({.boxes = set.boxes, .groups = set.groups}, {}), 300U * 40);
  EXPECT_EQ(bytesOf(set, {}), 300U * 56);
  EXPECT_EQ(bytesOf(set, {.region = Box{{500, 500, 500}, {501, 501, 501}}}), 0U);
}

TEST(Values, AfterAKillAtAnyStepTheBytesAreTheSame) {
  std::mt19937 random(13);
  const BoxesWith first = anyBoxes(random, 700);
  const BoxesWith second = anyBoxes(random, 500);
  const Search search{.distance = 0.1, .region = Box{{0, 0, 0}, {13, 13, 13}}};
  ValuesCase one(first, {.descr = "<f8"});
  (void)one.options(search);
  expectSameBytesAfterEachKill(one, bytesOfPairs(doubleLoop(first, search)));
  ValuesCase two(first, second, {.descr = "<f8"});
  (void)two.options(search);
  expectSameBytesAfterEachKill(two, bytesOfPairs(doubleLoop(first, second, search)));
}

/// Leaves a join of these that has found the pairs of all cells.
join::JoinOptions leftWhileWriting(ValuesCase& with, const Search& search) {
  (void)with.options(search);
  return resuming(stoppedWhileWriting(with));
}

TEST(Values, WhatIsCompleteIsNotDoneAgainAndWhatIsDamagedIs) {
  std::mt19937 random(14);
  const BoxesWith set = anyBoxes(random, 300);
  const Search search{.distance = 0.1, .region = Box{{1, 1, 1}, {9, 9, 9}}};
  ValuesCase whole(set, {.descr = "<f8"});
  (void)whole.run(whole.options(search));
  for (const char* damaged : {"", "boxes", "pairs"}) {
    ValuesCase with(set, {.descr = "<f8"});
    const join::JoinOptions options = leftWhileWriting(with, search);
    const fs::path file = options.work / damaged;
    if (*damaged != '\0') fs::resize_file(file, fs::file_size(file) / 2);
    EXPECT_TRUE(with.run(options) == bytesOfPairs(doubleLoop(set, search))) << damaged;
    EXPECT_EQ(with.summary.copies, whole.summary.copies);
    EXPECT_EQ(with.summary.resumedCells == with.summary.cells, *damaged == '\0');
  }
}

TEST(Values, AreNotResumedAsOthers) {
  std::mt19937 random(15);
  const BoxesWith first = anyBoxes(random, 300);
  const BoxesWith second = anyBoxes(random, 300);
  const Search search{.region = Box{{1, 1, 1}, {9, 9, 9}}};
  const auto refused = [&](const char* problem, const auto& change) {
    ValuesCase with(first, second);
    join::JoinOptions options = leftWhileWriting(with, search);
    change(with, options);
    try {
      (void)with.run(options);
      ADD_FAILURE() << "nothing was thrown; expected: " << problem;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find(problem), std::string::npos) << error.what();
    }
  };
  constexpr const char* kFiles = "has a join of other files, or they changed";
  constexpr const char* kOptions = "has a join with other options";
  refused(kFiles, [](ValuesCase&, join::JoinOptions& options) { options.values.margins.clear(); });
  refused(kFiles, [](ValuesCase&, join::JoinOptions& options) { options.secondValues.masks.clear(); });
  refused(kFiles,
          [](ValuesCase&, join::JoinOptions& options) { std::swap(options.values.categories, options.values.masks); });
  refused(kFiles, [](ValuesCase&, join::JoinOptions& options) { std::swap(options.values, options.secondValues); });
  refused(kFiles, [](ValuesCase&, join::JoinOptions& options) {
    fs::last_write_time(options.values.groups[1], fs::file_time_type::clock::now() + std::chrono::hours(1));
  });
  refused(kOptions, [](ValuesCase&, join::JoinOptions& options) { options.region.reset(); });
  refused(kOptions, [](ValuesCase&, join::JoinOptions& options) { options.region->max[2] += 1.0; });
}

TEST(Values, AreNotResumedWithARegionThatThereWasNot) {
  std::mt19937 random(16);
  const BoxesWith set = anyBoxes(random, 300);
  ValuesCase with(set);
  join::JoinOptions options = leftWhileWriting(with, {});
  options.region = Box{{1, 1, 1}, {9, 9, 9}};
  EXPECT_THROW((void)with.run(options), FileError);
}

TEST(Values, AFileOfThemThatChangesWhileItIsReadIsAnError) {
  std::mt19937 random(19);
  ValuesCase with(anyBoxes(random, 300));
  join::JoinOptions options = with.options();
  options.progress = [file = options.values.groups[0], isChanged = false](const join::JoinProgress&) mutable {
    if (!std::exchange(isChanged, true)) {
      fs::last_write_time(file, fs::file_time_type::clock::now() + std::chrono::hours(1));
    }
  };
  EXPECT_THROW((void)with.run(options), FileError);
  EXPECT_FALSE(fs::exists(options.work));
}

TEST(Values, BadInputIsNamed) {
  std::mt19937 random(17);
  BoxesWith set = anyBoxes(random, 100);
  set.margins[70] = kNan;
  const auto refused = [](const ValuesCase& with, const join::JoinOptions& options, const std::string& problem) {
    try {
      (void)join::countFiles(with.paths, options);
      ADD_FAILURE() << "nothing was thrown; expected: " << problem;
    } catch (const Error& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(problem), std::string::npos) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
      EXPECT_FALSE(fs::exists(options.work));
    }
  };
  const ValuesCase with(set);
  refused(with, with.options(), "first margins1.npy: margin 37 is a NaN");
  join::JoinOptions options = with.options();
  options.values.margins.pop_back();
  refused(with, options, "first margins0.npy: has 33 margins for 100 boxes");
  options.values.margins = with.paths;
  refused(with, options, "boxes0.npy: has shape (100, 6); margins are (n,)");
  BoxesWith many = anyBoxes(random, 3'000);
  std::fill(many.margins.begin() + 5, many.margins.end(), kNan);
  const ValuesCase withMany(many);
  refused(withMany, withMany.options(), "first margins0.npy: margin 5 is a NaN");
}

TEST(Values, SettingsThatMakeNoSenseAreRefused) {
  std::mt19937 random(18);
  const ValuesCase with(anyBoxes(random, 50));
  const auto refused = [&with](const auto& change) {
    join::JoinOptions options = with.options();
    change(options);
    EXPECT_THROW((void)join::countFiles(with.paths, options), InvalidArgument);
    EXPECT_THROW((void)join::planFiles(with.paths, options), InvalidArgument);
    EXPECT_THROW((void)join::planRanks(with.paths, 2, options), InvalidArgument);
  };
  refused([](join::JoinOptions& options) { options.region = Box{{1, 1, 1}, {0, 2, 2}}; });
  refused([](join::JoinOptions& options) { options.region = Box{{kNan, 1, 1}, {2, 2, 2}}; });
  refused([&with](join::JoinOptions& options) { options.secondValues = with.values; });
}

}  // namespace
}  // namespace allpairs::test
