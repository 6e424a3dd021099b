// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "support/Boxes.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

struct StreamCase {
  Strategy strategy;
  Order order;
};

class Stream : public ::testing::TestWithParam<StreamCase> {
 protected:
  static OverlapOptions options() {
    OverlapOptions result;
    result.strategy = GetParam().strategy;
    result.order = GetParam().order;
    return result;
  }
};

INSTANTIATE_TEST_SUITE_P(EachStrategyAndOrder, Stream,
                         ::testing::Values(StreamCase{Strategy::Exhaustive, Order::ByFirst},
                                           StreamCase{Strategy::Exhaustive, Order::BySecond},
                                           StreamCase{Strategy::Exhaustive, Order::Unordered},
                                           StreamCase{Strategy::Bvh, Order::ByFirst},
                                           StreamCase{Strategy::Bvh, Order::BySecond},
                                           StreamCase{Strategy::Bvh, Order::Unordered}));

TEST_P(Stream, GivesWhatFindGivesInFullBatches) {
  const std::vector<BoxF> boxes = test::randomBoxes(40000, 21);
  std::vector<Pair> streamed;
  std::vector<std::size_t> batches;
  const OverlapOptions with = options();
  const std::vector<BoxF> part(boxes.begin(), boxes.begin() + (with.strategy == Strategy::Exhaustive ? 6000 : 40000));
  streamOverlaps(
      part,
      [&](std::span<const Pair> pairs) {
        streamed.insert(streamed.end(), pairs.begin(), pairs.end());
        batches.push_back(pairs.size());
      },
      with, 1000);
  EXPECT_EQ(streamed, overlaps(part, with));
  for (const std::size_t size : batches) EXPECT_LE(size, 1000U);
}

TEST_P(Stream, GivesWhereNearlyAllOverlapWhatTheLoopFindsInBatchesOfAnySize) {
  constexpr std::uint32_t kBoxes = test::kIsSanitized ? 1000 : 2000;  // more pairs than all batches but the last
  std::vector<Box> boxes(kBoxes, Box{{0, 0, 0}, {1, 1, 1}});
  boxes[700] = {{3, 3, 3}, {4, 4, 4}};
  std::vector<Pair> expected;
  for (std::uint32_t i = 0; i < kBoxes; ++i) {
    for (std::uint32_t j = i + 1; j < kBoxes; ++j) {
      if (i != 700 && j != 700) expected.push_back({i, j});
    }
  }
  for (const std::size_t batch : {1000U, 262143U, 262144U, 300001U, 5000000U}) {
    std::vector<Pair> streamed;
    streamOverlaps(
        boxes, [&](std::span<const Pair> pairs) { streamed.insert(streamed.end(), pairs.begin(), pairs.end()); },
        options(), batch);
    if (GetParam().order != Order::ByFirst) std::sort(streamed.begin(), streamed.end());
    ASSERT_TRUE(streamed == expected) << batch;
  }
}

TEST_P(Stream, BetweenTwoSetsGivesWhatFindGives) {
  const std::vector<BoxF> first = test::randomBoxes(5000, 22);
  const std::vector<BoxF> second = test::randomBoxes(3000, 23);
  std::vector<Pair> streamed;
  streamOverlaps(
      first, second, [&](std::span<const Pair> pairs) { streamed.insert(streamed.end(), pairs.begin(), pairs.end()); },
      options());
  EXPECT_EQ(streamed, overlaps(first, second, options()));
}

TEST_P(Stream, AppliesFilterMarginsAndRegionToTheRightBoxes) {
  const std::vector<BoxF> boxes = test::randomBoxes(3000, 24);
  std::vector<double> margins(boxes.size());
  for (std::size_t i = 0; i < margins.size(); ++i) margins[i] = 0.001 * static_cast<double>(i % 100);
  BoxView set(boxes);
  set.setMargins(margins);
  OverlapOptions with = options();
  with.region = Box{{2, 2, 2}, {9, 9, 9}};
  with.filter.accept = [](std::uint32_t first, std::uint32_t second) { return (first + second) % 3 != 0; };
  std::vector<Pair> streamed;
  streamOverlaps(
      set, [&](std::span<const Pair> pairs) { streamed.insert(streamed.end(), pairs.begin(), pairs.end()); }, with);
  EXPECT_EQ(streamed, overlaps(set, with));
  EXPECT_FALSE(streamed.empty());
}

TEST_P(Stream, HoldsAnExplosionOfPairsInRanges) {
  // 4.5 million pairs: more than an ordered stream holds at a time.
  const std::vector<Box> boxes(3000, test::cube(0, 0, 0));
  Pair last{0, 0};
  std::uint64_t count = 0;
  bool ordered = true;
  const bool bySecond = GetParam().order == Order::BySecond;
  streamOverlaps(
      boxes,
      [&](std::span<const Pair> pairs) {
        for (const Pair& pair : pairs) {
          const Pair key = bySecond ? Pair{pair.second, pair.first} : pair;
          ordered = ordered && (last < key || count == 0);
          last = key;
          ++count;
        }
      },
      options());
  EXPECT_EQ(count, 3000U * 2999U / 2U);
  if (GetParam().order != Order::Unordered) {
    EXPECT_TRUE(ordered);
  }
}

TEST(OrderedStream, HoldsABoxWithMorePairsThanARange) {
  constexpr std::uint32_t kMoreThanARange = (1U << 22) + 1;  // a range has one less
  const Box one = test::cube(0, 0, 0);
  const BoxView many = BoxView::fromStrided(kMoreThanARange, CornerView<double>{one.min.data(), 0, 1},
                                            CornerView<double>{one.max.data(), 0, 1});
  const std::vector<Box> few{test::cube(5, 0, 0), test::cube(0.5, 0, 0), test::cube(5, 0, 0)};
  for (const Order order : {Order::ByFirst, Order::BySecond}) {
    const bool bySecond = order == Order::BySecond;
    if (test::kIsSanitized && bySecond) continue;  // four million boxes once more
    OverlapOptions options;
    options.strategy = Strategy::Bvh;
    options.order = order;
    std::uint32_t next = 0;
    bool isRight = true;
    const auto look = [&](std::span<const Pair> pairs) {
      for (const Pair pair : pairs) isRight = isRight && pair == (bySecond ? Pair{next++, 1} : Pair{1, next++});
    };
    bySecond ? streamOverlaps(many, few, look, options) : streamOverlaps(few, many, look, options);
    EXPECT_TRUE(isRight) << bySecond;
    EXPECT_EQ(next, kMoreThanARange) << bySecond;
  }
}

TEST_P(Stream, EndsWithALimitThatTheFilterPasses) {
  const std::vector<BoxF> boxes = test::randomBoxes(5000, 26);
  OverlapOptions with = options();
  with.filter.accept = [](std::uint32_t, std::uint32_t) -> bool { throw LimitExceeded(1, "of the filter's own"); };
  EXPECT_THROW(streamOverlaps(
                   boxes, [](std::span<const Pair>) {}, with),
               LimitExceeded);
}

TEST_P(Stream, EndsWithWhatTheVisitorThrows) {
  const std::vector<BoxF> boxes = test::randomBoxes(5000, 25);
  OverlapSearch search(options());
  int calls = 0;
  const auto stop = [&](std::span<const Pair>) {
    if (++calls == 2) throw std::runtime_error("enough");
  };
  EXPECT_THROW(search.stream(boxes, stop, 1000), std::runtime_error);
  EXPECT_EQ(calls, 2);
  EXPECT_EQ(search.count(boxes), countOverlaps(boxes, options()));
}

std::size_t pairsSeen = 0;
void see(Span<const Pair> pairs) { pairsSeen += pairs.size(); }

TEST(StreamTo, AFunctionIsAVisitorLikeAPointerToItAndALambda) {
  const std::vector<BoxF> boxes = test::randomBoxes(300, 27);
  const std::size_t expected = countOverlaps(boxes);
  streamOverlaps(boxes, see);
  EXPECT_EQ(pairsSeen, expected);
  streamOverlaps(boxes, &see);
  EXPECT_EQ(pairsSeen, 2 * expected);
}

}  // namespace
}  // namespace allpairs
