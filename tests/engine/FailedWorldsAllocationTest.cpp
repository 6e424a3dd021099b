// SPDX-License-Identifier: MIT
// Each allocation of a search of many worlds fails once: what it has thrown in is used on, and gives what a fresh one
// gives.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "allpairs/Worlds.h"
#include "support/Boxes.h"
#include "support/FailingAllocation.h"
#include "support/PoolExecutor.h"

namespace allpairs {
namespace {

/// Small worlds and one that is searched by itself, in float32 or float64, filtered or not.
class FailedWorldsAllocation : public ::testing::TestWithParam<std::size_t> {
 protected:
  std::vector<BoxF> boxes = test::randomBoxes(2400, 61, 0.4F);
  std::vector<Box> precise = test::toDouble(boxes);
  std::vector<BoxF> ground = test::randomBoxes(40, 62, 3.0F);
  std::vector<std::uint64_t> begin{0, 20, 90, 90, 150, 1300, 1320, 1700, 2400};
  std::vector<Pair> ignored{{0, 1}, {3, 2}};
  test::PoolExecutor threads{3};

  void checkAll(OverlapOptions options) {
    for (const BoxView& view : {BoxView(boxes), BoxView(precise)}) {
      Worlds worlds(view, begin);
      worlds.setIgnoredPairs(ignored);
      check(worlds, options);
    }
  }

  void check(const Worlds& worlds, const OverlapOptions& options) {
    const WorldPairs own = overlapsInWorlds(worlds, options);
    const WorldPairs met = overlapsInWorlds(worlds, ground, options);
    ASSERT_FALSE(own.pairs.empty());
    ASSERT_FALSE(met.pairs.empty());
    const auto expectBoth = [&](WorldsSearch& search) {
      ASSERT_EQ(test::toVector(search.find(worlds).pairs), own.pairs);
      const std::span<const std::uint64_t> counted = search.count(worlds);
      ASSERT_EQ(std::vector<std::uint64_t>(counted.begin(), counted.end()), own.begin);
      ASSERT_EQ(test::toVector(search.find(worlds, ground).pairs), met.pairs);
    };
    std::vector<Pair> listed(own.pairs.size());
    const std::vector<std::function<void(WorldsSearch&)>> operations{
        [&](WorldsSearch& search) { static_cast<void>(search.find(worlds)); },
        [&](WorldsSearch& search) { static_cast<void>(search.count(worlds)); },
        [&](WorldsSearch& search) { search.list(worlds, own.begin, listed); },
        [&](WorldsSearch& search) { static_cast<void>(search.find(worlds, ground)); },
        [&](WorldsSearch& search) { static_cast<void>(search.count(worlds, ground)); }};
    const auto operation = operations[GetParam()];
    test::failEachAllocation([&](test::Fault& fault) {
      WorldsSearch search(options);
      static_cast<void>(fault.during([&] { operation(search); }));
      expectBoth(search);
    });
  }
};

INSTANTIATE_TEST_SUITE_P(OfEachOperation, FailedWorldsAllocation, ::testing::Range<std::size_t>(0, 5));

TEST_P(FailedWorldsAllocation, LeavesASearchUsable) { checkAll({}); }

TEST_P(FailedWorldsAllocation, LeavesASearchWithAFilterUsable) {
  OverlapOptions options;
  options.filter.accept = [](std::uint32_t a, std::uint32_t b) { return (a + b) % 7 != 0; };
  checkAll(options);
}

TEST_P(FailedWorldsAllocation, OnOtherThreadsLeavesASearchUsable) {
  OverlapOptions options;
  options.executor = &threads;
  checkAll(options);
}

}  // namespace
}  // namespace allpairs
