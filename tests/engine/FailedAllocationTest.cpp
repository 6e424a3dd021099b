// SPDX-License-Identifier: MIT
// Each allocation of each search fails once: what a search has thrown in is used on, and gives what a fresh one gives.
#include <gtest/gtest.h>

#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "allpairs/Overlaps.h"
#include "support/Boxes.h"
#include "support/FailingAllocation.h"
#include "support/PoolExecutor.h"

namespace allpairs {
namespace {

/// What is searched, and how.
struct SearchCase {
  std::string name;
  std::size_t boxes;
  float size;  ///< Of a box: 1 gives about two pairs a box.
  Strategy strategy;
  Order order;
  std::uint64_t stride = 1;
};
void PrintTo(const SearchCase& c, std::ostream* out) { *out << c.name; }

class FailedAllocation : public ::testing::TestWithParam<SearchCase> {
 protected:
  std::vector<BoxF> first = test::randomBoxes(GetParam().boxes, 51, GetParam().size);
  std::vector<BoxF> second = test::randomBoxes(GetParam().boxes / 2, 52, GetParam().size);
  std::vector<Box> tested = test::toDouble(test::randomBoxes(100, 53));
  OverlapOptions options;
  std::vector<Pair> wantedOfTested;

  FailedAllocation() {
    for (Box& box : tested) box.min[0] += 1e-9;  // no float32: tested again in double
    options.strategy = GetParam().strategy;
    options.order = GetParam().order;
    options.filter.accept = [](std::uint32_t a, std::uint32_t b) { return (a + b) % 7 != 0; };
    wantedOfTested = overlaps(tested, options);
  }

  /// The search gives the right pairs, or throws and gives them the next time.
  using Run = std::function<void(OverlapSearch&, std::vector<Pair>&)>;
  void check(const Run& run) {
    std::vector<Pair> wanted;
    OverlapSearch fresh(options);
    run(fresh, wanted);
    ASSERT_FALSE(wanted.empty());
    std::vector<Pair> found;
    found.reserve(wanted.size());
    const auto scene = [&](test::Fault& fault) {
      OverlapSearch search(options);
      found.clear();
      const bool passed = fault.during([&] { run(search, found); });
      if (passed) {
        ASSERT_EQ(found, wanted);
      }
      ASSERT_EQ(test::toVector(search.find(tested)), wantedOfTested);
      found.clear();
      run(search, found);
      ASSERT_EQ(found, wanted);
    };
    test::failEachAllocation(scene, GetParam().stride);
  }

  static void keep(std::span<const Pair> pairs, std::vector<Pair>& found) {
    found.insert(found.end(), pairs.begin(), pairs.end());
  }
};

INSTANTIATE_TEST_SUITE_P(
    OfEachSearch, FailedAllocation,
    ::testing::Values(SearchCase{"exhaustive", 400, 1.0F, Strategy::Exhaustive, Order::ByFirst},
                      SearchCase{"exhaustive by second", 400, 1.0F, Strategy::Exhaustive, Order::BySecond},
                      SearchCase{"many pairs, exhaustive", 500, 50.0F, Strategy::Exhaustive, Order::ByFirst},
                      SearchCase{"bvh", 2100, 1.0F, Strategy::Bvh, Order::ByFirst},
                      SearchCase{"bvh by second", 2100, 1.0F, Strategy::Bvh, Order::BySecond},
                      SearchCase{"bvh, unordered", 2100, 1.0F, Strategy::Bvh, Order::Unordered},
                      SearchCase{"many pairs", 500, 50.0F, Strategy::Bvh, Order::ByFirst},
                      SearchCase{"in buckets", 17000, 1.0F, Strategy::Bvh, Order::ByFirst, 7}));

TEST_P(FailedAllocation, LeavesFindOfOneSetUsable) {
  check([&](OverlapSearch& search, std::vector<Pair>& found) { keep(search.find(first), found); });
}

TEST_P(FailedAllocation, LeavesFindOfTwoSetsUsable) {
  check([&](OverlapSearch& search, std::vector<Pair>& found) { keep(search.find(first, second), found); });
}

TEST_P(FailedAllocation, LeavesFindIntoUsable) {
  std::vector<Pair> memory(overlaps(first, options).size() + 1);
  check([&](OverlapSearch& search, std::vector<Pair>& found) { keep(search.findInto(first, memory), found); });
}

TEST_P(FailedAllocation, LeavesFindNeighborsUsable) {
  const auto keepRows = [](const NeighborsView& rows, std::vector<Pair>& found) {
    for (std::uint32_t i = 0; i < rows.size(); ++i) {
      for (const std::uint32_t partner : rows[i]) found.push_back({i, partner});
    }
  };
  check([&](OverlapSearch& search, std::vector<Pair>& found) {
    keepRows(search.findNeighbors(first, NeighborRows::Full), found);
    keepRows(search.findNeighbors(first, NeighborRows::Half), found);
    keepRows(search.findNeighbors(first, second), found);
  });
}

TEST_P(FailedAllocation, LeavesCountUsable) {
  check([&](OverlapSearch& search, std::vector<Pair>& found) {
    found.push_back({static_cast<std::uint32_t>(search.count(first)), 0});
    found.push_back({static_cast<std::uint32_t>(search.count(first, second)), 0});
  });
}

TEST_P(FailedAllocation, LeavesStreamUsable) {
  check([&](OverlapSearch& search, std::vector<Pair>& found) {
    search.stream(
        first, [&](std::span<const Pair> pairs) { keep(pairs, found); }, 64);
    search.stream(
        first, second, [&](std::span<const Pair> pairs) { keep(pairs, found); }, 64);
  });
}

TEST_P(FailedAllocation, OnOtherThreadsLeavesASearchUsable) {
  test::PoolExecutor threads(3);
  options.executor = &threads;
  check([&](OverlapSearch& search, std::vector<Pair>& found) { keep(search.find(first), found); });
}

TEST_P(FailedAllocation, LeavesWhatAnObjectHasGivenInItsSecondSearchUsable) {
  const std::vector<Pair> wanted = overlaps(first, options);
  const auto scene = [&](test::Fault& fault) {
    OverlapSearch search(options);
    static_cast<void>(search.find(tested));
    static_cast<void>(fault.during([&] { static_cast<void>(search.find(first)); }));
    ASSERT_EQ(test::toVector(search.find(first)), wanted);
  };
  test::failEachAllocation(scene, GetParam().stride);
}

TEST_P(FailedAllocation, OfAFreeFunctionLeaksNothing) {
  const std::vector<Pair> wanted = overlaps(first, options);
  const auto scene = [&](test::Fault& fault) {
    std::vector<Pair> found;
    if (fault.during([&] { found = overlaps(first, options); })) {
      ASSERT_EQ(found, wanted);
    }
  };
  test::failEachAllocation(scene, GetParam().stride);
}

TEST(FailedAllocation, WhileAnObjectIsMadeLeaksNothing) {
  const auto scene = [](test::Fault& fault) {
    static_cast<void>(fault.during([] { static_cast<void>(OverlapSearch()); }));
  };
  test::failEachAllocation(scene);
}

TEST(FailedAllocation, OfLongerListsLeavesTheMemoryOfShorterOnesUsable) {
  const std::vector<BoxF> few = test::randomBoxes(500, 55, 50.0F);
  const std::vector<BoxF> many = test::randomBoxes(1100, 56, 50.0F);
  const OverlapOptions options{.strategy = Strategy::Bvh};
  const std::vector<Pair> wanted = overlaps(few, options);
  test::failEachAllocation([&](test::Fault& fault) {
    OverlapSearch search(options);
    ASSERT_EQ(test::toVector(search.find(few)), wanted);
    static_cast<void>(fault.during([&] { static_cast<void>(search.find(many)); }));
    ASSERT_EQ(test::toVector(search.find(few)), wanted);
  });
}

TEST(FailedAllocation, HalvesNoRangeOfAnOrderedStreamForGood) {
  const std::vector<BoxF> boxes = test::randomBoxes(3000, 54, 200.0F);  // all overlap: more pairs than a range may have
  OverlapOptions options;
  options.strategy = Strategy::Bvh;
  const std::uint64_t wanted = OverlapSearch(options).count(boxes);
  ASSERT_GT(wanted, std::uint64_t{1} << 22U);
  const auto scene = [&](test::Fault& fault) {
    OverlapSearch search(options);
    std::uint64_t found = 0;
    const auto count = [&](std::span<const Pair> pairs) { found += pairs.size(); };
    if (!fault.during([&] { search.stream(boxes, count); })) {
      found = 0;
      search.stream(boxes, count);
    }
    ASSERT_EQ(found, wanted);
  };
  test::failEachAllocation(scene, 31);
}

}  // namespace
}  // namespace allpairs
