// SPDX-License-Identifier: MIT
// Many worlds in one call: each world's list is that of a call for it alone, and that of a double loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "WorldsScene.h"
#include "allpairs/Error.h"
#include "allpairs/Worlds.h"
#include "support/Boxes.h"
#include "support/Corners.h"
#include "support/Numbers.h"
#include "support/Oracle.h"
#include "support/PoolExecutor.h"
#include "support/Sanitizers.h"
#include "support/Strategies.h"

namespace allpairs {
namespace {

using test::WorldsScene;

const std::vector<std::size_t> kSizes{0, 1, 2, 15, 16, 17, 33, 63, 64, 65, 128, 129, 200, 400, 449, 1000};

std::vector<std::size_t> mixedSizes(std::size_t worlds, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<std::size_t> sizes(worlds);
  for (std::size_t& size : sizes)
    size = generator() % 8 == 0 ? kSizes[generator() % kSizes.size()] : kSizes[generator() % 9];
  return sizes;
}

std::vector<Pair> part(const WorldPairs& all, std::size_t k) {
  return {all.pairs.begin() + static_cast<std::ptrdiff_t>(all.begin[k]),
          all.pairs.begin() + static_cast<std::ptrdiff_t>(all.begin[k + 1])};
}

/// What one call gives is what a call for each world gives, and so do counting, listing, and a search that is kept.
void expectLikeEachAlone(const Worlds& worlds, const OverlapOptions& options, const OverlapOptions& alone,
                         const std::function<FilterBits(std::size_t)>& bitsOf = {}) {
  WorldPairs wanted;
  wanted.begin.push_back(0);
  for (std::size_t k = 0; k < worlds.size(); ++k) {
    OverlapOptions one = alone;
    if (bitsOf) one.filter.first = bitsOf(k);
    const std::vector<Pair> pairs = overlaps(worlds[k], one);
    wanted.pairs.insert(wanted.pairs.end(), pairs.begin(), pairs.end());
    wanted.begin.push_back(wanted.pairs.size());
  }
  const WorldPairs found = overlapsInWorlds(worlds, options);
  ASSERT_EQ(found.begin, wanted.begin);
  ASSERT_EQ(found.pairs, wanted.pairs);
  WorldsSearch kept(options);
  for (int again = 0; again < 2; ++again) {
    const WorldPairsView view = kept.find(worlds);
    ASSERT_EQ(test::toVector(view.pairs), wanted.pairs);
    ASSERT_EQ(std::vector<std::uint64_t>(view.begin.begin(), view.begin.end()), wanted.begin);
    ASSERT_EQ(kept.statistics().pairs, wanted.pairs.size());
  }
  ASSERT_EQ(countOverlapsInWorlds(worlds, options), wanted.begin);
  std::vector<Pair> listed(wanted.pairs.size());
  listOverlapsInWorlds(worlds, wanted.begin, listed, options);
  ASSERT_EQ(listed, wanted.pairs);
}

void expectLikeEachAlone(const Worlds& worlds, const OverlapOptions& options) {
  expectLikeEachAlone(worlds, options, options);
}

template <class T>
class WorldsOf : public ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(WorldsOf, Precisions);

TYPED_TEST(WorldsOf, EverySizeGiveTheDoubleLoopsPairs) {
  for (std::size_t size = 0; size <= 130; ++size) {
    const WorldsScene<TypeParam> scene({size, 3, size}, static_cast<unsigned>(10 * size), 1.5F);
    const WorldPairs found = overlapsInWorlds(scene.worlds());
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(part(found, k), test::oracle(scene.world(k))) << size << " boxes";
  }
}

/// Fewer boxes than a vector has lanes, before a world, in it and behind it.
TYPED_TEST(WorldsOf, TinySizesGiveTheDoubleLoopsPairsWhateverSurroundsThem) {
  constexpr std::size_t kTiny = 6;
  for (std::size_t i = 0; i < kTiny * kTiny * kTiny; ++i) {
    const WorldsScene<TypeParam> scene({i / kTiny / kTiny, i / kTiny % kTiny, i % kTiny}, static_cast<unsigned>(i),
                                       1.5F);
    const test::Corners<TypeParam> corners(scene.boxes);
    for (const std::string_view instructionSet : instructionSets()) {
      const WorldPairs inRows = overlapsInWorlds(scene.worlds(), {.instructionSet = instructionSet});
      const WorldPairs inTwoArrays =
          overlapsInWorlds({corners.view(), scene.begin}, {.instructionSet = instructionSet});
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_EQ(part(inRows, k), test::oracle(scene.world(k))) << i << ", " << instructionSet;
        ASSERT_EQ(part(inTwoArrays, k), test::oracle(scene.world(k))) << i << ", " << instructionSet;
      }
    }
  }
}

TYPED_TEST(WorldsOf, MixedSizesGiveWhatEachGivesAloneInEveryOrderOnEveryInstructionSet) {
  for (const std::string_view instructionSet : instructionSets()) {
    for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
      for (const Strategy strategy : test::kStrategies) {
        SCOPED_TRACE(std::string(instructionSet) + ' ' + std::to_string(static_cast<int>(order)) + ' ' +
                     std::to_string(static_cast<int>(strategy)));
        const WorldsScene<TypeParam> scene(mixedSizes(60, static_cast<unsigned>(order)), 7);
        OverlapOptions options;
        options.instructionSet = instructionSet;
        options.order = order;
        options.strategy = strategy;
        expectLikeEachAlone(scene.worlds(), options);
        if (this->HasFatalFailure()) return;
      }
    }
  }
}

TYPED_TEST(WorldsOf, OneToEightThreadsGiveTheSame) {
  std::vector<std::size_t> sizes = mixedSizes(test::kIsSanitized ? 200 : 400, 3);
  sizes[17] = 5000;  // searched by all threads
  const WorldsScene<TypeParam> scene(sizes, 5);
  OverlapOptions serial;
  for (std::size_t threads = 1; threads <= 8; ++threads) {
    test::PoolExecutor executor(threads);
    OverlapOptions options;
    options.executor = &executor;
    expectLikeEachAlone(scene.worlds(), options, serial);
    if (this->HasFatalFailure()) return;
  }
}

TYPED_TEST(WorldsOf, MarginsDistanceAndRegionHoldInEachWorld) {
  const WorldsScene<TypeParam> scene(mixedSizes(16, 9), 11);
  std::vector<double> margins(scene.boxes.size());
  for (std::size_t i = 0; i < margins.size(); ++i) margins[i] = 0.07 * static_cast<double>(i % 5) - 0.1;
  margins[4] = test::kInfinity;
  for (const std::string_view instructionSet : instructionSets()) {
    for (const Order order : {Order::ByFirst, Order::BySecond}) {
      for (const double distance : {0.0, 0.13, -0.05, test::kInfinity}) {
        SCOPED_TRACE(std::string(instructionSet) + ' ' + std::to_string(distance));
        // Under a sanitizer all pairs of the largest world would take most of the time.
        const std::size_t worlds = test::kIsSanitized && distance == test::kInfinity ? 12 : scene.size();
        const auto begin = std::span(scene.begin).first(worlds + 1);
        BoxView view(std::span(scene.boxes).first(begin.back()));
        OverlapOptions options;
        options.instructionSet = instructionSet;
        options.order = order;
        options.distance = distance;
        expectLikeEachAlone({view, begin}, options);
        view.setMargins(std::span(margins).first(begin.back()));
        expectLikeEachAlone({view, begin}, options);
        options.region = Box{{0, 0, 0}, {0.6, 0.7, 0.8}};
        expectLikeEachAlone({view, begin}, options);
        if (this->HasFatalFailure()) return;
      }
    }
  }
}

TYPED_TEST(WorldsOf, MarginsGiveTheDoubleLoopsPairs) {
  const WorldsScene<TypeParam> scene(mixedSizes(40, 19), 12);
  std::vector<double> margins(scene.boxes.size());
  for (std::size_t i = 0; i < margins.size(); ++i) margins[i] = 0.1 / static_cast<double>(1 + i % 7);
  BoxView view(scene.boxes);
  view.setMargins(margins);
  OverlapOptions options;
  options.distance = 0.01;
  const WorldPairs found = overlapsInWorlds({view, scene.begin}, options);
  for (std::size_t k = 0; k < scene.size(); ++k) {
    const std::vector<double> own(margins.begin() + static_cast<std::ptrdiff_t>(scene.begin[k]),
                                  margins.begin() + static_cast<std::ptrdiff_t>(scene.begin[k + 1]));
    ASSERT_EQ(part(found, k), test::oracle(scene.world(k), 0.01, own)) << k;
  }
}

/// Values in turn, for filters.
std::vector<std::uint32_t> values(std::size_t size, std::uint32_t step, std::uint32_t modulus, std::uint32_t least) {
  std::vector<std::uint32_t> result(size);
  for (std::size_t i = 0; i < size; ++i) result[i] = least + static_cast<std::uint32_t>(i) * step % modulus;
  return result;
}

TYPED_TEST(WorldsOf, FiltersOfAllBoxesHoldInEachWorld) {
  const WorldsScene<TypeParam> scene(mixedSizes(50, 29), 13);
  const auto groups = values(scene.boxes.size(), 7, 5, 0);
  const auto categories = values(scene.boxes.size(), 3, 7, 1);
  const auto masks = values(scene.boxes.size(), 5, 6, 2);
  OverlapOptions options;
  options.filter.first = {categories, masks, groups};
  options.filter.accept = [](std::uint32_t a, std::uint32_t b) { return (a + 2 * b) % 5 != 0; };
  const auto partOf = [&](const std::vector<std::uint32_t>& all, std::size_t k) {
    return std::span(all).subspan(scene.begin[k], scene.begin[k + 1] - scene.begin[k]);
  };
  const auto bitsOf = [&](std::size_t k) {
    return FilterBits{partOf(categories, k), partOf(masks, k), partOf(groups, k)};
  };
  for (const std::size_t threads : {1U, 3U}) {
    test::PoolExecutor executor(threads);
    options.executor = &executor;
    expectLikeEachAlone(scene.worlds(), options, options, bitsOf);
  }
}

TYPED_TEST(WorldsOf, EqualSizeTakeAFilterAndIgnoredPairsOfOneWorldForAll) {
  for (const std::size_t size : {2U, 20U, 64U, 65U, 130U, 460U}) {
    for (const std::string_view instructionSet : instructionSets()) {
      const WorldsScene<TypeParam> scene(std::vector<std::size_t>(test::kIsSanitized ? 4 : 9, size), 17);
      const auto groups = values(size, 7, 5, 0);
      const auto masks = values(size, 5, 6, 2);
      std::vector<Pair> ignored;
      for (std::uint32_t i = 1; i < size; ++i) ignored.push_back({i, i - 1});
      for (std::uint32_t i = 0; i < size; ++i) ignored.push_back({i, i});  // as an adjacency matrix has it
      Worlds worlds = scene.worlds();
      worlds.setIgnoredPairs(ignored);
      const auto isKept = [](std::uint32_t a, std::uint32_t b) { return a + 1 != b; };
      for (const Order order : {Order::ByFirst, Order::BySecond}) {
        OverlapOptions options;
        options.instructionSet = instructionSet;
        options.order = order;
        OverlapOptions alone = options;
        alone.filter.accept = isKept;
        expectLikeEachAlone(worlds, options, alone);
        options.filter.first.groups = alone.filter.first.groups = groups;
        options.filter.first.masks = alone.filter.first.masks = masks;
        expectLikeEachAlone(worlds, options, alone);
        if (this->HasFatalFailure()) return;
      }
    }
  }
}

TYPED_TEST(WorldsOf, EqualSizeTakeValuesOfOneWorldOrOfAllBoxesInAnyMix) {
  constexpr std::size_t kSize = 20;
  const WorldsScene<TypeParam> scene(std::vector<std::size_t>(4, kSize), 61);
  const auto categories = values(scene.boxes.size(), 3, 7, 1);
  const auto masks = values(scene.boxes.size(), 5, 6, 2);
  const auto groups = values(scene.boxes.size(), 7, 5, 0);
  // None, those of one world, or those of all boxes; what world k then has of them.
  const auto given = [](const std::vector<std::uint32_t>& all, std::size_t kind) {
    return std::span(all).first(kind == 2 ? all.size() : kind * kSize);
  };
  const auto partOf = [](std::span<const std::uint32_t> some, std::size_t k) {
    return some.size() > kSize ? some.subspan(k * kSize, kSize) : some;
  };
  for (std::size_t mix = 0; mix < 27; ++mix) {
    SCOPED_TRACE(mix);
    const FilterBits bits{given(categories, mix % 3), given(masks, mix / 3 % 3), given(groups, mix / 9)};
    OverlapOptions options;
    options.filter.first = bits;
    const auto bitsOf = [&](std::size_t k) {
      return FilterBits{partOf(bits.categories, k), partOf(bits.masks, k), partOf(bits.groups, k)};
    };
    ASSERT_NO_FATAL_FAILURE(expectLikeEachAlone(scene.worlds(), options, {}, bitsOf));
  }
}

TYPED_TEST(WorldsOf, ADistanceARegionOrMarginsCountEachAlone) {
  const WorldsScene<TypeParam> scene(mixedSizes(20, 67), 71);
  OverlapOptions distance;
  distance.distance = 0.25;
  OverlapOptions region;
  region.region = Box{{0, 0, 0}, {0.5, 1, 1}};
  const std::vector<double> margins(scene.boxes.size(), 0.125);
  BoxView wide(scene.boxes);
  wide.setMargins(margins);
  for (const std::string_view instructionSet : instructionSets()) {
    distance.instructionSet = region.instructionSet = instructionSet;
    OverlapOptions plain;
    plain.instructionSet = instructionSet;
    ASSERT_NO_FATAL_FAILURE(expectLikeEachAlone(scene.worlds(), distance));
    ASSERT_NO_FATAL_FAILURE(expectLikeEachAlone(scene.worlds(), region));
    ASSERT_NO_FATAL_FAILURE(expectLikeEachAlone({wide, scene.begin}, plain));
  }
}

TYPED_TEST(WorldsOf, UnequalSizeIgnorePairsToo) {
  const WorldsScene<TypeParam> scene(mixedSizes(50, 31), 19);
  std::vector<Pair> ignored;
  for (std::uint32_t i = 1; i < 12; ++i) ignored.push_back({i, i - 1});
  Worlds worlds = scene.worlds();
  worlds.setIgnoredPairs(ignored);
  OverlapOptions alone;
  alone.filter.accept = [](std::uint32_t a, std::uint32_t b) { return a + 1 != b || b >= 12; };
  expectLikeEachAlone(worlds, {}, alone);
  OverlapOptions options;
  options.filter.accept = [](std::uint32_t a, std::uint32_t) { return a % 3 != 0; };
  alone.filter.accept = [](std::uint32_t a, std::uint32_t b) { return (a + 1 != b || b >= 12) && a % 3 != 0; };
  expectLikeEachAlone(worlds, options, alone);
}

TYPED_TEST(WorldsOf, AnyLayoutGiveTheSame) {
  const WorldsScene<TypeParam> scene(mixedSizes(30, 37), 23);
  const WorldPairs wanted = overlapsInWorlds(scene.worlds());
  std::vector<TypeParam> min;
  std::vector<TypeParam> max;
  std::vector<TypeParam> columns(6 * scene.boxes.size());
  const std::size_t n = scene.boxes.size();
  for (std::size_t i = 0; i < n; ++i) {
    min.insert(min.end(), scene.boxes[i].min.begin(), scene.boxes[i].min.end());
    max.insert(max.end(), scene.boxes[i].max.begin(), scene.boxes[i].max.end());
    for (std::size_t axis = 0; axis < 3; ++axis) columns[axis * n + i] = scene.boxes[i].min[axis];
    for (std::size_t axis = 0; axis < 3; ++axis) columns[(3 + axis) * n + i] = scene.boxes[i].max[axis];
  }
  const auto step = static_cast<std::ptrdiff_t>(n);
  const std::vector<BoxView> views{
      BoxView::fromCorners(std::span<const TypeParam>(min), std::span<const TypeParam>(max)),
      BoxView::fromStrided(n, CornerView<TypeParam>{columns.data(), 1, step},
                           CornerView<TypeParam>{columns.data() + 3 * n, 1, step})};
  for (const std::string_view instructionSet : instructionSets()) {
    for (const BoxView& view : views) {
      OverlapOptions options;
      options.instructionSet = instructionSet;
      const WorldPairs found = overlapsInWorlds({view, scene.begin}, options);
      ASSERT_EQ(found.begin, wanted.begin);
      ASSERT_EQ(found.pairs, wanted.pairs);
    }
  }
}

TYPED_TEST(WorldsOf, AnySizeMeetSharedBoxesAsTwoSetsDo) {
  const WorldsScene<TypeParam> scene(mixedSizes(40, 41), 29);
  for (const std::size_t sharedBoxes : {0U, 1U, 12U, 300U}) {
    const WorldsScene<TypeParam> ground({sharedBoxes}, 31);
    for (const Order order : {Order::ByFirst, Order::BySecond}) {
      OverlapOptions options;
      options.order = order;
      options.distance = sharedBoxes == 12 ? 0.1 : 0.0;
      options.filter.accept = [](std::uint32_t a, std::uint32_t b) { return (a + b) % 3 != 0; };
      const Worlds worlds = scene.worlds();
      WorldPairs wanted;
      wanted.begin.push_back(0);
      for (std::size_t k = 0; k < scene.size(); ++k) {
        const std::vector<Pair> pairs = overlaps(worlds[k], ground.boxes, options);
        wanted.pairs.insert(wanted.pairs.end(), pairs.begin(), pairs.end());
        wanted.begin.push_back(wanted.pairs.size());
      }
      for (const std::size_t threads : {1U, 4U}) {
        test::PoolExecutor executor(threads);
        options.executor = &executor;
        const WorldPairs found = overlapsInWorlds(worlds, ground.boxes, options);
        ASSERT_EQ(found.begin, wanted.begin) << sharedBoxes;
        ASSERT_EQ(found.pairs, wanted.pairs) << sharedBoxes;
        ASSERT_EQ(countOverlapsInWorlds(worlds, ground.boxes, options), wanted.begin);
        // Memory for more pairs keeps what it holds behind them.
        const Pair mark{7, 7};
        std::vector<Pair> listed(wanted.pairs.size() + 3, mark);
        WorldsSearch(options).list(worlds, ground.boxes, wanted.begin, listed);
        ASSERT_EQ(std::count(listed.end() - 3, listed.end(), mark), 3);
        listed.resize(wanted.pairs.size());
        ASSERT_EQ(listed, wanted.pairs);
      }
    }
  }
}

TYPED_TEST(WorldsOf, EqualSizeMeetSharedBoxesWithAFilterOfOneWorld) {
  const WorldsScene<TypeParam> scene(std::vector<std::size_t>(7, 20), 43);
  const WorldsScene<TypeParam> ground({30}, 47);
  const auto groups = values(20, 7, 5, 0);
  const auto groundGroups = values(30, 3, 5, 0);
  OverlapOptions options;
  options.filter.first.groups = groups;
  options.filter.second.groups = groundGroups;
  const Worlds worlds = scene.worlds();
  const WorldPairs found = overlapsInWorlds(worlds, ground.boxes, options);
  for (std::size_t k = 0; k < 7; ++k) ASSERT_EQ(part(found, k), overlaps(worlds[k], ground.boxes, options));
}

TEST(Worlds, OfOneLargeAndAThousandSmallGiveWhatEachGivesAlone) {
  std::vector<std::size_t> sizes(1001, 10);
  sizes[500] = test::kIsSanitized ? 30000 : 100000;
  const WorldsScene<float> scene(sizes, 53, 0.9F);
  test::PoolExecutor executor(2);
  OverlapOptions options;
  options.executor = &executor;
  expectLikeEachAlone(scene.worlds(), options, {});
}

TEST(Worlds, CountMorePairsThan32BitsHold) {
  if (test::kIsSanitized) GTEST_SKIP() << "five billion tests take a minute then";
  constexpr std::size_t kWorlds = 1200;
  constexpr std::size_t kBoxes = 3000;
  const std::vector<BoxF> boxes(kWorlds * kBoxes, {{0, 0, 0}, {1, 1, 1}});
  const std::vector<std::uint64_t> begin = countOverlapsInWorlds(Worlds::ofEqualSize(boxes, kWorlds));
  ASSERT_EQ(begin.size(), kWorlds + 1);
  for (std::size_t k = 0; k <= kWorlds; ++k) ASSERT_EQ(begin[k], k * (kBoxes * (kBoxes - 1) / 2));
  EXPECT_GT(begin.back(), std::uint64_t{1} << 32);
}

TEST(Worlds, OfEqualSizeAreThoseOfTheirOffsets) {
  const WorldsScene<float> scene(std::vector<std::size_t>(8, 21), 59);
  const WorldPairs found = overlapsInWorlds(Worlds::ofEqualSize(scene.boxes, 8));
  const WorldPairs wanted = overlapsInWorlds(scene.worlds());
  EXPECT_EQ(found.begin, wanted.begin);
  EXPECT_EQ(found.pairs, wanted.pairs);
}

TEST(Worlds, ThatAreNoneHaveNoPairs) {
  const WorldPairs none = overlapsInWorlds(Worlds());
  EXPECT_EQ(none.begin, std::vector<std::uint64_t>{0});
  EXPECT_TRUE(none.pairs.empty());
  const std::vector<std::uint64_t> begin{0, 0, 0};
  const std::vector<BoxF> boxes;
  EXPECT_EQ(overlapsInWorlds({boxes, begin}).begin, begin);
  EXPECT_EQ(overlapsInWorlds({boxes, begin}, boxes).begin, begin);
}

std::string messageOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidArgument& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Worlds, NameTheWorldWhoseOffsetsAreWrong) {
  const std::vector<BoxF> boxes(10);
  const auto messageFor = [&](const std::vector<std::uint64_t>& begin) {
    return messageOf([&] { static_cast<void>(Worlds(boxes, begin)); });
  };
  EXPECT_EQ(messageFor({}), "no offsets of worlds: there is one more than there are worlds");
  EXPECT_EQ(messageFor({1, 10}), "world 0 begins at box 1, not at box 0");
  EXPECT_EQ(messageFor({0, 5, 4, 10}), "the offsets of worlds decrease: world 1 begins at box 5 and ends at 4");
  EXPECT_EQ(messageFor({0, 5, 11}), "world 1 ends at box 11, but there are 10 boxes");
  EXPECT_EQ(messageFor({0, 5, 9}), "the last world, 1, ends at box 9 of 10");
  EXPECT_EQ(messageFor({0}), "no worlds, but boxes: 10");
  EXPECT_EQ(messageOf([&] { static_cast<void>(Worlds::ofEqualSize(boxes, 3)); }),
            "10 boxes cannot be divided equally among 3 worlds");
}

TEST(Worlds, RefuseOptionsThatDoNotFit) {
  const std::vector<BoxF> boxes(10);
  const std::vector<std::uint64_t> begin{0, 4, 10};
  Worlds worlds(boxes, begin);
  const std::vector<std::uint32_t> groups(5);
  OverlapOptions options;
  options.filter.first.groups = groups;
  EXPECT_EQ(messageOf([&] { static_cast<void>(overlapsInWorlds(worlds, options)); }),
            "the filter has 5 groups for 2 worlds with 10 boxes altogether, which are not of equal size");
  EXPECT_EQ(overlapsInWorlds(Worlds::ofEqualSize(boxes, 2), options).begin[2], 20U);
  options.filter.second.groups = groups;
  options.filter.first = {};
  EXPECT_THROW(static_cast<void>(overlapsInWorlds(worlds, options)), InvalidArgument);
  options = {};
  options.instructionSet = "NONE";
  EXPECT_THROW(static_cast<void>(overlapsInWorlds(worlds, options)), InvalidArgument);
  EXPECT_THROW(worlds.setIgnoredPairs(std::vector<Pair>{{1, 6}}), InvalidArgument);
  std::vector<Pair> few(20);
  EXPECT_THROW(listOverlapsInWorlds(worlds, std::vector<std::uint64_t>{0, 6, 21}, few), InvalidArgument);
  EXPECT_THROW(listOverlapsInWorlds(worlds, std::vector<std::uint64_t>{0, 5, 20}, few), InvalidArgument);
  EXPECT_THROW(listOverlapsInWorlds(worlds, std::vector<std::uint64_t>{0, 8, 20}, few), InvalidArgument);
  EXPECT_THROW(listOverlapsInWorlds(worlds, std::vector<std::uint64_t>{0, 20}, few), InvalidArgument);
}

TEST(Worlds, BeyondTheLimitAreAnErrorThatLeavesTheSearchUsable) {
  const std::vector<BoxF> boxes(300, {{0, 0, 0}, {1, 1, 1}});
  const Worlds worlds = Worlds::ofEqualSize(boxes, 30);
  for (const std::size_t threads : {1U, 3U}) {
    test::PoolExecutor executor(threads);
    OverlapOptions options;
    options.executor = &executor;
    options.maxPairs = 45 * 30 - 1;
    WorldsSearch kept(options);
    EXPECT_THROW(static_cast<void>(kept.find(worlds)), LimitExceeded);
    EXPECT_THROW(static_cast<void>(kept.count(worlds)), LimitExceeded);
    ++options.maxPairs;
    kept.setOptions(options);
    EXPECT_EQ(kept.find(worlds).pairs.size(), options.maxPairs);
    EXPECT_EQ(kept.find(worlds)[29].size(), 45U);
  }
}

TEST(Worlds, MustNotBeSearchedByTheFilterOfTheSameSearch) {
  const std::vector<BoxF> boxes(30, {{0, 0, 0}, {1, 1, 1}});
  const Worlds worlds = Worlds::ofEqualSize(boxes, 3);
  WorldsSearch search;
  OverlapOptions options;
  options.filter.accept = [&](std::uint32_t, std::uint32_t) { return search.count(worlds).empty(); };
  search.setOptions(options);
  EXPECT_THROW(static_cast<void>(search.find(worlds)), InvalidArgument);
  search.setOptions({});
  EXPECT_EQ(search.find(worlds).pairs.size(), 3 * 45U);
  WorldsSearch moved = std::move(search);
  moved.shrink();
  EXPECT_EQ(moved.count(worlds).back(), 3 * 45U);
}

}  // namespace
}  // namespace allpairs
