// SPDX-License-Identifier: MIT
// Results in memory of the caller: all that find() gives, nothing beside it, and an error that says how much is needed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "CountingMemory.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "support/Boxes.h"
#include "support/Oracle.h"

namespace allpairs {
namespace {

constexpr Pair kUntouched{0xABCDABCD, 0x12341234};

struct IntoCase {
  std::size_t boxes;
  float size;
  Strategy strategy;
  Order order;
  std::size_t threads;
};

/// Few boxes, buckets and lists, and dense ones, which an exhaustive search writes directly.
std::vector<IntoCase> cases() {
  std::vector<IntoCase> all;
  for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
    for (const std::size_t threads : {std::size_t{1}, std::size_t{3}}) {
      all.push_back({7, 3.0F, Strategy::Automatic, order, threads});
      all.push_back({100, 1.0F, Strategy::Automatic, order, threads});
      for (const Strategy strategy : {Strategy::Exhaustive, Strategy::Bvh}) {
        all.push_back({900, 0.7F, strategy, order, threads});
        all.push_back({1100, 3.0F, strategy, order, threads});
      }
      all.push_back({700, 100.0F, Strategy::Automatic, order, threads});
    }
  }
  return all;
}

class FindInto : public ::testing::TestWithParam<IntoCase> {
 protected:
  std::vector<BoxF> boxes = test::randomBoxes(GetParam().boxes, 1, GetParam().size);
  std::vector<BoxF> others = test::randomBoxes(GetParam().boxes / 2, 2, GetParam().size);
  parallel::TbbExecutor executor{GetParam().threads};
  OverlapOptions options{.strategy = GetParam().strategy, .order = GetParam().order, .executor = &executor};

  /// find(search) writes into memory what `wanted` is.
  template <class Find>
  void check(const Find& find, const std::vector<Pair>& wanted) {
    OverlapSearch search(options);
    ASSERT_GT(wanted.size(), 3U);
    for (const std::size_t more : {0U, 1U, 1000U}) {
      std::vector<Pair> memory(1 + wanted.size() + more, kUntouched);
      const std::span<Pair> place = std::span(memory).subspan(1);  // not aligned to a cache line
      const std::span<Pair> found = find(search, place);
      ASSERT_EQ(found.data(), place.data());
      ASSERT_EQ(test::toVector(found), wanted);
      ASSERT_EQ(memory.front(), kUntouched);
      ASSERT_EQ(std::count(memory.begin(), memory.end(), kUntouched), static_cast<std::ptrdiff_t>(more + 1));
      ASSERT_EQ(search.statistics().pairs, wanted.size());
    }
    for (const std::size_t room : {std::size_t{0}, wanted.size() / 2, wanted.size() - 1}) {
      std::vector<Pair> memory(room + 100, kUntouched);
      try {
        static_cast<void>(find(search, std::span(memory).first(room)));
        FAIL() << "memory for " << room << " was enough";
      } catch (const LimitExceeded& error) {
        ASSERT_EQ(error.count(), wanted.size());
        ASSERT_TRUE(error.isTotal());
        ASSERT_EQ(error.what(),
                  "memory for " + std::to_string(room) + " pairs, but there are " + std::to_string(wanted.size()));
      }
      ASSERT_EQ(std::count(memory.begin() + static_cast<std::ptrdiff_t>(room), memory.end(), kUntouched), 100);
      if (options.order != Order::Unordered && options.strategy == Strategy::Bvh) {
        ASSERT_EQ(std::count(memory.begin(), memory.end(), kUntouched), static_cast<std::ptrdiff_t>(memory.size()));
      }
      ASSERT_EQ(test::toVector(search.find(boxes)), test::toVector(OverlapSearch(options).find(boxes)));
    }
  }
};

TEST(FindIntoMemory, OfTooManyPairsIsNotToldThatTheLimitCountedAll) {
  const std::vector<BoxF> boxes(300, BoxF{{0, 0, 0}, {1, 1, 1}});
  OverlapOptions options;
  options.maxPairs = 1000;
  OverlapSearch search(options);
  std::vector<Pair> memory(50000);
  try {
    static_cast<void>(search.findInto(boxes, memory));
    FAIL() << "44,850 pairs are not more than 1,000";
  } catch (const LimitExceeded& error) {
    EXPECT_FALSE(error.isTotal());
  }
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, FindInto, ::testing::ValuesIn(cases()));

TEST_P(FindInto, GivesThePairsOfOneSet) {
  check([&](OverlapSearch& search, std::span<Pair> memory) { return search.findInto(boxes, memory); },
        test::toVector(OverlapSearch(options).find(boxes)));
}

TEST_P(FindInto, GivesThePairsOfTwoSets) {
  check([&](OverlapSearch& search, std::span<Pair> memory) { return search.findInto(boxes, others, memory); },
        test::toVector(OverlapSearch(options).find(boxes, others)));
}

TEST_P(FindInto, ForNeighborsGivesTheirRows) {
  OverlapSearch search(options);
  for (const int form : {0, 1, 2}) {
    const NeighborRows rows = form == 0 ? NeighborRows::Full : NeighborRows::Half;
    const auto find = [&](const NeighborsMemory& memory) {
      return form == 2 ? search.findNeighborsInto(boxes, others, memory)
                       : search.findNeighborsInto(boxes, rows, memory);
    };
    const Neighbors wanted = form == 2 ? neighbors(boxes, others, options) : neighbors(boxes, rows, options);
    std::vector<std::uint64_t> offsets(wanted.offsets.size() + 5, 77);
    std::vector<std::uint32_t> indices(wanted.indices.size() + 5, 0xABCDABCD);
    const NeighborsView found = find({offsets, indices});
    ASSERT_EQ(std::vector(found.offsets.begin(), found.offsets.end()), wanted.offsets);
    ASSERT_EQ(std::vector(found.indices.begin(), found.indices.end()), wanted.indices);
    ASSERT_EQ(found.offsets.data(), offsets.data());
    ASSERT_EQ(found.indices.data(), indices.data());
    ASSERT_EQ(std::count(offsets.end() - 5, offsets.end(), 77), 5);
    ASSERT_EQ(std::count(indices.end() - 5, indices.end(), 0xABCDABCD), 5);
    const std::span<std::uint32_t> few(indices.data(), wanted.indices.size() - 1);
    std::fill(offsets.begin(), offsets.end(), 77);
    std::fill(indices.begin(), indices.end(), 0xABCDABCD);
    try {
      static_cast<void>(find({offsets, few}));
      FAIL();
    } catch (const LimitExceeded& error) {
      ASSERT_EQ(error.count(), wanted.indices.size());
    }
    const std::span<std::uint64_t> tooFew(offsets.data(), boxes.size());
    ASSERT_THROW(static_cast<void>(find({tooFew, indices})), InvalidArgument);
    ASSERT_EQ(std::count(offsets.begin(), offsets.end(), 77), static_cast<std::ptrdiff_t>(offsets.size()));
    ASSERT_EQ(std::count(indices.begin(), indices.end(), 0xABCDABCD), static_cast<std::ptrdiff_t>(indices.size()));
  }
}

TEST(FindIntoMemory, TakesNoMoreThanAPartOfTheResultBesideIt) {
  const std::vector<BoxF> dense = test::randomBoxes(2000, 3, 1000.0F);  // all overlap
  const std::vector<BoxF> sparse = test::randomBoxes(20000, 3, 2.5F);
  for (const Order order : {Order::ByFirst, Order::Unordered}) {
    for (const std::vector<BoxF>& boxes : {dense, sparse}) {
      test::CountingMemory memory;
      const OverlapOptions options{.order = order, .memory = &memory};
      std::vector<Pair> pairs(countOverlaps(boxes));
      OverlapSearch search(options);
      ASSERT_EQ(search.findInto(boxes, pairs).size(), pairs.size());
      // In order, four bytes a pair on the way to it; buffers that grow by doubling add up to twice that and more.
      const bool isSorted = order == Order::ByFirst && boxes.size() == sparse.size();
      const std::size_t onTheWay = isSorted ? 16 * pairs.size() : 0;
      EXPECT_LT(memory.bytes(), 48 * boxes.size() + 300000 + onTheWay) << boxes.size() << ' ' << pairs.size();
      EXPECT_GT(pairs.size() * sizeof(Pair), 2 * (48 * boxes.size() + 300000)) << "too few to tell";
    }
  }
}

TEST(FindIntoMemory, OfNothingTakesNothing) {
  OverlapSearch search;
  EXPECT_TRUE(search.findInto(BoxView(), {}).empty());
  EXPECT_TRUE(search.findInto(test::lent(test::randomBoxes(1, 1)), {}).empty());
  std::vector<std::uint64_t> offset(1, 5);
  EXPECT_EQ(search.findNeighborsInto(BoxView(), NeighborRows::Full, {offset, {}}).size(), 0U);
  EXPECT_EQ(offset[0], 0U);
}

}  // namespace
}  // namespace allpairs
