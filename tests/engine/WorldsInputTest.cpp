// SPDX-License-Identifier: MIT
// Many worlds whatever way boxes lie in memory, and whatever their filter is given for, against a double loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "WorldsScene.h"
#include "allpairs/Error.h"
#include "allpairs/Worlds.h"
#include "support/Boxes.h"
#include "support/Numbers.h"
#include "support/Oracle.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

using test::WorldsScene;
using Labels = std::vector<std::uint32_t>;

/// How one corner of boxes lies in memory.
struct CornerLayout {
  std::size_t stride;       ///< From box to box.
  std::size_t at = 0;       ///< Of the first number.
  bool isReversed = false;  ///< z y x.
};

/// Boxes in memory of the test, each corner in its own way.
class BoxesInLayout {
 public:
  BoxesInLayout(const std::vector<BoxF>& boxes, const CornerLayout& min, const CornerLayout& max) {
    m_numbers.assign((min.stride + max.stride) * boxes.size() + 6, static_cast<float>(test::kNan));
    float* const data = m_numbers.data();
    const bool isShared = min.stride == 6 && max.stride == 6;
    float* const maxData = isShared ? data : data + min.stride * boxes.size() + 3;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      put(boxes[i].min, data + min.at + i * min.stride, min);
      put(boxes[i].max, maxData + max.at + i * max.stride, max);
    }
    m_view = BoxView::fromStrided(boxes.size(), viewOf(data, min), viewOf(maxData, max));
  }
  BoxesInLayout(const BoxesInLayout&) = delete;
  BoxesInLayout& operator=(const BoxesInLayout&) = delete;

  [[nodiscard]] const BoxView& view() const { return m_view; }

 private:
  static void put(const std::array<float, 3>& corner, float* to, const CornerLayout& layout) {
    for (std::size_t axis = 0; axis < 3; ++axis) to[layout.isReversed ? 2 - axis : axis] = corner[axis];
  }
  static CornerView<float> viewOf(const float* data, const CornerLayout& layout) {
    return {data + layout.at + (layout.isReversed ? 2 : 0), static_cast<std::ptrdiff_t>(layout.stride),
            layout.isReversed ? -1 : 1};
  }

  std::vector<float> m_numbers;
  BoxView m_view;
};

TEST(WorldsInput, EachCornerInItsOwnLayoutGivesTheDoubleLoopsPairs) {
  const WorldsScene<float> scene({40, 3, 20, 0, 65, 130}, 83, 1.3F);
  const std::vector<CornerLayout> layouts{{3}, {4}, {6}, {6, 3}, {3, 0, true}, {6, 0, true}, {6, 3, true}};
  for (const std::string_view instructionSet : instructionSets()) {
    OverlapOptions options;
    options.instructionSet = instructionSet;
    for (std::size_t pair = 0; pair < layouts.size() * layouts.size(); ++pair) {
      const CornerLayout& min = layouts[pair / layouts.size()];
      const CornerLayout& max = layouts[pair % layouts.size()];
      if (min.stride == 6 && max.stride == 6 && min.at == max.at) continue;  // in one place
      SCOPED_TRACE(std::string(instructionSet) + ' ' + std::to_string(pair));
      const BoxesInLayout boxes(scene.boxes, min, max);
      const WorldPairs found = overlapsInWorlds({boxes.view(), scene.begin}, options);
      std::vector<Pair> wanted;
      for (std::size_t k = 0; k < scene.size(); ++k) {
        for (const Pair each : test::oracle(scene.world(k))) wanted.push_back(each);
        ASSERT_EQ(found.begin[k + 1], wanted.size());
      }
      ASSERT_EQ(found.pairs, wanted);
    }
  }
}

/// What a filter says of the boxes of all worlds; what is empty lets all pass.
struct Rules {
  Labels categories, masks, groups;
  std::vector<Pair> ignored;
};

/// The value of a box: there is one for each box of all worlds, or for each of one, or none.
std::uint32_t at(const Labels& values, std::size_t box, std::size_t inWorld, std::uint32_t none) {
  if (values.empty()) return none;
  return values.size() == inWorld ? values[box % inWorld] : values[box];
}

bool isIgnored(const Rules& rules, std::uint32_t i, std::uint32_t j) {
  return std::any_of(rules.ignored.begin(), rules.ignored.end(), [&](Pair pair) {
    return (pair.first == i && pair.second == j) || (pair.first == j && pair.second == i);
  });
}

/// The pairs of worlds of `inWorld` boxes, one world after the other.
std::vector<Pair> filteredOracle(const WorldsScene<float>& scene, std::size_t inWorld, const Rules& rules) {
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < scene.size(); ++k) {
    for (const Pair pair : test::oracle(scene.world(k))) {
      const std::size_t a = k * inWorld + pair.first;
      const std::size_t b = k * inWorld + pair.second;
      const auto accepts = [&](std::size_t one, std::size_t other) {
        return (at(rules.categories, one, inWorld, ~0U) & at(rules.masks, other, inWorld, ~0U)) != 0;
      };
      const std::uint32_t group = at(rules.groups, a, inWorld, 0);
      const bool isOneGroup = group != 0 && group == at(rules.groups, b, inWorld, 0);
      if (accepts(a, b) && accepts(b, a) && !isOneGroup && !isIgnored(rules, pair.first, pair.second))
        pairs.push_back(pair);
    }
  }
  return pairs;
}

Labels someLabels(std::size_t size, std::uint32_t seed, std::uint32_t least, std::uint32_t count) {
  std::mt19937 random(seed);
  Labels labels(size);
  for (std::uint32_t& label : labels) label = least + static_cast<std::uint32_t>(random() % count);
  return labels;
}

/// Pairs in no order, of which either box may come first.
std::vector<Pair> somePairs(std::uint32_t boxes) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < 3 * boxes; ++i) {
    const Pair pair{i * 7 % boxes, (i * 11 + 3) % boxes};
    if (pair.first != pair.second) pairs.push_back(pair);
  }
  return pairs;
}

/// A search that is kept: what the last filter was must not matter to the next.
void expectFiltered(WorldsSearch& search, const WorldsScene<float>& scene, std::size_t inWorld, const Rules& rules) {
  OverlapOptions options = search.options();
  options.filter.first = {.categories = rules.categories, .masks = rules.masks, .groups = rules.groups};
  search.setOptions(options);
  Worlds worlds = Worlds::ofEqualSize(scene.boxes, scene.size());
  worlds.setIgnoredPairs(rules.ignored);
  const std::vector<Pair> wanted = filteredOracle(scene, inWorld, rules);
  ASSERT_EQ(test::toVector(search.find(worlds).pairs), wanted);
  ASSERT_EQ(search.count(worlds).back(), wanted.size());
}

TEST(WorldsInput, AFilterOfOneWorldOrAllBesideIgnoredPairsGivesTheDoubleLoopsPairs) {
  for (const std::size_t size : {20U, 70U, 500U}) {
    const WorldsScene<float> scene(std::vector<std::size_t>(4, size), 89, 1.3F);
    const auto given = [&](std::size_t kind, std::uint32_t least, std::uint32_t count) {
      const std::array<std::size_t, 3> sizes{0, size, 4 * size};
      return someLabels(sizes[kind], static_cast<std::uint32_t>(7 * kind + least), least, count);
    };
    WorldsSearch search;
    for (std::size_t mix = 0; mix < 54; ++mix) {
      if (test::kIsSanitized && size == 500 && mix % 5 != 0) continue;  // the double loop takes long
      SCOPED_TRACE(std::to_string(size) + ' ' + std::to_string(mix));
      Rules rules{given(mix % 3, 1, 7), given(mix / 3 % 3, 2, 6), given(mix / 9 % 3, 0, 4), {}};
      if (mix / 27 != 0) rules.ignored = somePairs(static_cast<std::uint32_t>(size));
      ASSERT_NO_FATAL_FAILURE(expectFiltered(search, scene, size, rules));
      if (mix % 9 != 0) continue;
      ASSERT_NO_FATAL_FAILURE(expectFiltered(search, scene, size, {}));
    }
  }
}

TEST(WorldsInput, OfUnequalSizeIgnorePairsInAnyOrder) {
  const std::vector<std::size_t> sizes{60, 17, 300, 20, 700};
  const WorldsScene<float> scene(sizes, 97, 1.3F);
  Rules rules;
  rules.ignored = somePairs(17);
  Worlds worlds = scene.worlds();
  worlds.setIgnoredPairs(rules.ignored);
  std::vector<Pair> wanted;
  for (std::size_t k = 0; k < scene.size(); ++k) {
    for (const Pair pair : test::oracle(scene.world(k))) {
      if (!isIgnored(rules, pair.first, pair.second)) wanted.push_back(pair);
    }
  }
  EXPECT_EQ(overlapsInWorlds(worlds).pairs, wanted);
}

TEST(WorldsInput, ListTakesTheOffsetsThatTheSameObjectHasCounted) {
  const WorldsScene<float> scene(std::vector<std::size_t>(1000, 64), 3);
  const Worlds worlds = scene.worlds();
  const StopFlag stop;
  OverlapOptions options;
  options.stop = &stop;  // so that worlds are searched some at a time
  WorldsSearch search(options);
  const Span<const std::uint64_t> begin = search.count(worlds);
  std::vector<Pair> listed(begin.back());
  search.list(worlds, begin, listed);
  EXPECT_EQ(listed, overlapsInWorlds(worlds).pairs);
  const WorldsScene<float> ground({30}, 47);
  const Span<const std::uint64_t> sharedBegin = search.count(worlds, ground.boxes);
  listed.resize(sharedBegin.back());
  search.list(worlds, ground.boxes, sharedBegin, listed);
  EXPECT_EQ(listed, overlapsInWorlds(worlds, ground.boxes).pairs);
}

TEST(WorldsInput, ListRefusesTheOffsetsThatTheSameObjectHasCountedOfOtherWorlds) {
  const WorldsScene<float> scene({30, 40}, 3);
  const WorldsScene<float> other({40, 30}, 5);
  const WorldsScene<float> ground({30}, 47);
  WorldsSearch search;
  std::vector<Pair> memory(10'000);
  EXPECT_THROW(search.list(other.worlds(), search.count(scene.worlds()), memory), InvalidArgument);
  const Span<const std::uint64_t> begin = search.count(scene.worlds(), ground.boxes);
  EXPECT_THROW(search.list(other.worlds(), ground.boxes, begin, memory), InvalidArgument);
}

TEST(WorldsInput, ADistanceOrARegionThatIsNoneIsRefusedHoweverSmallTheWorlds) {
  const std::vector<BoxF> boxes(4);
  const Worlds worlds = Worlds::ofEqualSize(boxes, 2);
  OverlapOptions options;
  options.distance = test::kNan;
  EXPECT_THROW(static_cast<void>(overlapsInWorlds(worlds, options)), InvalidArgument);
  options.distance = -test::kInfinity;
  EXPECT_THROW(static_cast<void>(overlapsInWorlds(worlds, options)), InvalidArgument);
  options.distance = 0.0;
  options.region = Box{{0, 0, 0}, {1, test::kNan, 1}};
  EXPECT_THROW(static_cast<void>(overlapsInWorlds(worlds, options)), InvalidArgument);
}

TEST(WorldsInput, AnOrderThatIsNoneIsRefusedWithSharedBoxesToo) {
  const std::vector<BoxF> boxes(4);
  const Worlds worlds = Worlds::ofEqualSize(boxes, 2);
  OverlapOptions options;
  options.order = static_cast<Order>(77);
  EXPECT_THROW(static_cast<void>(overlapsInWorlds(worlds, options)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(overlapsInWorlds(worlds, boxes, options)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(countOverlapsInWorlds(worlds, boxes, options)), InvalidArgument);
}

TEST(MovedFrom, AWorldsSearchIsAsNew) {
  OverlapOptions options;
  options.distance = 100.0;
  WorldsSearch first(options);
  const std::vector<Box> boxes{test::cube(0, 0, 0), test::cube(0.5, 0, 0), test::cube(9, 0, 0)};
  const Worlds worlds = Worlds::ofEqualSize(boxes, 1);
  EXPECT_EQ(first.options().distance, 100.0);
  EXPECT_EQ(first.find(worlds).pairs.size(), 3U);
  EXPECT_EQ(first.statistics().pairs, 3U);
  first.shrink();
  EXPECT_EQ(first.statistics().pairs, 3U) << "of the last search still";
  EXPECT_EQ(first.options().distance, 100.0);
  WorldsSearch second(std::move(first));
  EXPECT_EQ(second.options().distance, 100.0);
  EXPECT_EQ(second.count(worlds).back(), 3U);
  // NOLINTBEGIN(bugprone-use-after-move): what is tested
  EXPECT_EQ(first.options().distance, 0.0);
  EXPECT_EQ(first.statistics().pairs, 0U);
  first.shrink();
  EXPECT_EQ(first.find(worlds).pairs.size(), 1U);
  first = std::move(second);
  EXPECT_EQ(first.options().distance, 100.0);
  EXPECT_EQ(second.options().distance, 0.0);
  EXPECT_EQ(second.count(worlds).back(), 1U);
  // NOLINTEND(bugprone-use-after-move)
}

/// As a number that has gone below 0 is.
TEST(WorldsInput, MoreWorldsThanOffsetsCanBeKeptOfAreRefused) {
  for (const std::size_t shift : {0U, 1U, 3U, 4U}) {
    EXPECT_THROW(static_cast<void>(Worlds::ofEqualSize({}, SIZE_MAX >> shift)), InvalidArgument) << shift;
  }
  EXPECT_EQ(Worlds::ofEqualSize({}, (SIZE_MAX >> 4U) - 1).size(), (SIZE_MAX >> 4U) - 1);
}

}  // namespace
}  // namespace allpairs
