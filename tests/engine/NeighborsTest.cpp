// SPDX-License-Identifier: MIT
// Rows of neighbors, complete, against those that the double loop's pairs make.
#include "allpairs/Neighbors.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "support/AnyBoxes.h"
#include "support/Boxes.h"
#include "support/Numbers.h"
#include "support/Oracle.h"
#include "support/Sanitizers.h"
#include "support/Strategies.h"

namespace allpairs {
namespace {

using Rows = std::vector<std::vector<std::uint32_t>>;

Rows rowsOf(const std::vector<Pair>& pairs, std::size_t boxes, NeighborRows kind) {
  Rows rows(boxes);
  for (const Pair pair : pairs) {
    rows[pair.first].push_back(pair.second);
    if (kind == NeighborRows::Full) rows[pair.second].push_back(pair.first);
  }
  for (std::vector<std::uint32_t>& row : rows) std::sort(row.begin(), row.end());
  return rows;
}

/// The rows that were found, if their offsets are whole.
template <class Found>
Rows rowsIn(const Found& found) {
  if (found.offsets.empty() || found.offsets.front() != 0 || found.offsets.back() != found.indices.size()) return {};
  Rows rows;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found.offsets[i] > found.offsets[i + 1]) return {};
    rows.emplace_back(found[i].begin(), found[i].end());
  }
  return rows;
}

constexpr NeighborRows kKinds[] = {NeighborRows::Full, NeighborRows::Half};
using test::kStrategies;

/// Each instruction set on one thread, and the best on several.
std::vector<OverlapOptions> waysToSearch(Strategy strategy) {
  static parallel::TbbExecutor two(2);
  static parallel::TbbExecutor three(3);
  static parallel::TbbExecutor eight(8);
  std::vector<OverlapOptions> all;
  for (const std::string_view name : instructionSets()) all.push_back({.strategy = strategy, .instructionSet = name});
  for (Executor* const executor : {&two, &three, &eight}) all.push_back({.strategy = strategy, .executor = executor});
  return all;
}

template <class Boxes>
void expectRows(const Boxes& boxes, const OverlapOptions& options, const std::vector<Pair>& expected) {
  for (const NeighborRows kind : kKinds) {
    ASSERT_EQ(rowsIn(neighbors(boxes, kind, options)), rowsOf(expected, boxes.size(), kind))
        << boxes.size() << ' ' << options.instructionSet;
  }
}

RC_GTEST_PROP(NeighborsProperty, OfAnyBoxesAtAnyDistanceAreTheOraclesPairs, ()) {
  const auto boxes = *test::scene();
  const auto others = *test::scene();
  const auto margins = *rc::gen::container<std::vector<double>>(boxes.size(), test::distance());
  const double d = *test::distance();
  BoxView wide(boxes);
  wide.setMargins(margins);
  const std::vector<Pair> expected = test::oracle(boxes, d);
  const std::vector<Pair> ofWide = test::oracle(boxes, d, margins);
  const std::vector<Pair> between = test::oracleBetween(boxes, others, d);
  for (const Strategy strategy : kStrategies) {
    const OverlapOptions options{.strategy = strategy, .distance = d};
    for (const NeighborRows kind : kKinds) {
      RC_ASSERT(rowsIn(neighbors(boxes, kind, options)) == rowsOf(expected, boxes.size(), kind));
      RC_ASSERT(rowsIn(neighbors(wide, kind, options)) == rowsOf(ofWide, boxes.size(), kind));
    }
    RC_ASSERT(rowsIn(neighbors(boxes, others, options)) == rowsOf(between, boxes.size(), NeighborRows::Half));
  }
}

TEST(Neighbors, OfAnyNumberOfBoxesWithAnyNumberOfPartnersAreTheOraclesPairs) {
  for (const std::size_t n : {0U, 1U, 2U, 8U, 9U, 128U, 129U, 800U}) {
    for (const float size : {0.5F, 1.5F, 6.0F}) {
      const std::vector<BoxF> boxes = test::randomBoxes(n, static_cast<unsigned>(n), size);
      const std::vector<BoxF> others = test::randomBoxes(n / 3, 77, size);
      const std::vector<Pair> expected = test::oracle(test::toDouble(boxes));
      const std::vector<Pair> between = test::oracleBetween(test::toDouble(boxes), test::toDouble(others));
      const std::vector<Pair> back = test::oracleBetween(test::toDouble(others), test::toDouble(boxes));
      for (const OverlapOptions& options : waysToSearch(n < 129 ? Strategy::Automatic : Strategy::Bvh)) {
        expectRows(boxes, options, expected);
        ASSERT_EQ(rowsIn(neighbors(boxes, others, options)), rowsOf(between, boxes.size(), NeighborRows::Half));
        ASSERT_EQ(rowsIn(neighbors(others, boxes, options)), rowsOf(back, others.size(), NeighborRows::Half));
      }
    }
  }
}

TEST(Neighbors, OfAnExhaustiveSearchAreTheOraclesPairs) {
  for (const float size : {1.0F, 50.0F}) {
    const std::vector<BoxF> boxes = test::randomBoxes(400, 3, size);
    const std::vector<BoxF> others = test::randomBoxes(700, 4, size);
    const std::vector<Pair> expected = test::oracle(test::toDouble(boxes));
    const std::vector<Pair> between = test::oracleBetween(test::toDouble(boxes), test::toDouble(others));
    for (const OverlapOptions& options : waysToSearch(Strategy::Exhaustive)) {
      expectRows(boxes, options, expected);
      ASSERT_EQ(rowsIn(neighbors(boxes, others, options)), rowsOf(between, boxes.size(), NeighborRows::Half));
    }
  }
}

TEST(Neighbors, OfAFewBoxesWithManyPartnersAscend) {
  // Most rows of a bucket are ordered by ranks; those with a row of thousands are radix sorted.
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(2500, 7, 0.6F));
  for (const std::size_t giant : {std::size_t{5}, std::size_t{1500}, std::size_t{2499}}) {
    boxes[giant] = {{-1e30, -1e30, -1e30}, {1e30, 1e30, 1e30}};
  }
  boxes[70] = kEmptyBox;
  const std::vector<Box> others(boxes.begin(), boxes.begin() + 1000);
  const std::vector<Pair> expected = test::oracle(boxes);
  const std::vector<Pair> between = test::oracleBetween(boxes, others);
  ASSERT_LT(expected.size(), 4 * boxes.size()) << "too many for buckets";
  for (const OverlapOptions& options : waysToSearch(Strategy::Bvh)) {
    expectRows(boxes, options, expected);
    ASSERT_EQ(rowsIn(neighbors(boxes, others, options)), rowsOf(between, boxes.size(), NeighborRows::Half));
  }
}

TEST(Neighbors, OfMoreBoxesThanBucketsAreForAscend) {
  // Most are empty, so that the double loop need not look at them.
  constexpr std::size_t kBoxes = (std::size_t{1} << 21) + 1000;
  constexpr std::size_t kApart = 1500;
  const std::vector<Box> solid = test::toDouble(test::randomBoxes(kBoxes / kApart, 13));
  std::vector<Box> boxes(kBoxes, kEmptyBox);
  for (std::size_t i = 0; i < solid.size(); ++i) boxes[i * kApart] = solid[i];
  parallel::TbbExecutor two(2);
  for (int way = 0; way < 4; way += test::kIsSanitized ? 3 : 1) {
    const NeighborRows kind = kKinds[way % 2];
    const Rows expected = rowsOf(test::oracle(solid), solid.size(), kind);
    const Neighbors found = neighbors(boxes, kind, {.strategy = Strategy::Bvh, .executor = way < 2 ? nullptr : &two});
    ASSERT_EQ(found.size(), kBoxes);
    std::vector<std::uint32_t> all;
    for (std::size_t i = 0; i < solid.size(); ++i) {
      std::vector<std::uint32_t> row;
      for (const std::uint32_t partner : expected[i]) row.push_back(partner * kApart);
      ASSERT_EQ(std::vector(found[i * kApart].begin(), found[i * kApart].end()), row);
      all.insert(all.end(), row.begin(), row.end());
    }
    ASSERT_GT(all.size(), solid.size());
    ASSERT_EQ(found.indices, all) << "empty boxes have partners";
    ASSERT_TRUE(std::is_sorted(found.offsets.begin(), found.offsets.end()));
  }
}

/// A lattice, three boxes a place, whose faces touch, or are apart by less than float32 can tell. Margins make the sum
/// of a pair's depend on its order.
struct Lattice {
  Lattice(std::size_t count, std::size_t side) {
    for (std::size_t i = 0; i < count; ++i) {
      const double apart = i % 3 == 0 ? 1e-12 : 0.0;
      const std::size_t place = i / 3;
      boxes.push_back(test::cube(static_cast<double>(place % side) + apart,
                                 static_cast<double>(place / side % side) / 3.0,
                                 static_cast<double>(place / (side * side))));
      margins.push_back(i % 2 == 0 ? 0.1 : -1.0 / 3.0);
    }
  }

  std::vector<Box> boxes;
  std::vector<double> margins;
};

TEST(Neighbors, AreDecidedInDoubleWhereLanesCannot) {
  for (const Lattice& lattice : {Lattice(700, 6), Lattice(250, 3)}) {
    const std::vector<Box>& boxes = lattice.boxes;
    BoxView wide(boxes);
    wide.setMargins(lattice.margins);
    const std::vector<Pair> expected = test::oracle(boxes);
    const std::vector<Pair> ofWide = test::oracle(boxes, 0.2, lattice.margins);
    const std::vector<Pair> between = test::oracleBetween(boxes, boxes);
    for (const Strategy strategy : {Strategy::Bvh, Strategy::Exhaustive}) {
      for (OverlapOptions options : waysToSearch(strategy)) {
        expectRows(boxes, options, expected);
        ASSERT_EQ(rowsIn(neighbors(boxes, boxes, options)), rowsOf(between, boxes.size(), NeighborRows::Half));
        options.distance = 0.2;
        expectRows(wide, options, ofWide);
      }
    }
  }
}

/// Boxes with filters of every kind, which leave some pairs.
struct FilteredScene {
  explicit FilteredScene(float size) : boxes(test::toDouble(test::randomBoxes(500, 5, size))) {
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      groups.push_back(i % 5);
      categories.push_back(1U << i % 4);
      masks.push_back(~(1U << i % 3));
    }
    options.strategy = Strategy::Bvh;
    options.distance = 0.25;
    options.filter.first = {categories, masks, groups};
    options.filter.accept = [](std::uint32_t a, std::uint32_t b) { return a < b && (a + 2 * b) % 11 != 0; };
  }

  [[nodiscard]] std::vector<Pair> expected() const {
    std::vector<Pair> kept;
    for (const Pair pair : test::oracle(boxes, 0.25)) {
      const auto [a, b] = pair;
      const bool meet = (categories[a] & masks[b]) != 0 && (categories[b] & masks[a]) != 0;
      const bool alike = groups[a] != 0 && groups[a] == groups[b];
      if (meet && !alike && (a + 2 * b) % 11 != 0) kept.push_back(pair);
    }
    return kept;
  }

  std::vector<Box> boxes;
  std::vector<std::uint32_t> groups;
  std::vector<std::uint32_t> categories;
  std::vector<std::uint32_t> masks;
  OverlapOptions options;
};

TEST(Neighbors, AreFilteredAndTheFilterSeesTheLowerIndexFirst) {
  for (const float size : {1.0F, 4.0F, 30.0F}) {
    const FilteredScene scene(size);
    const std::vector<Pair> expected = scene.expected();
    ASSERT_GT(expected.size(), scene.boxes.size() / 4);
    for (OverlapOptions options : waysToSearch(Strategy::Bvh)) {
      options.distance = scene.options.distance;
      options.filter = scene.options.filter;
      expectRows(scene.boxes, options, expected);
    }
    OverlapOptions exhaustive = scene.options;
    exhaustive.strategy = Strategy::Exhaustive;
    expectRows(scene.boxes, exhaustive, expected);
  }
}

TEST(Neighbors, OutsideARegionHaveNone) {
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(800, 6, 2.0F));
  const Box region{{2, 2, 2}, {5, 6, 7}};
  std::vector<Box> withRegion = boxes;
  withRegion.push_back(region);
  std::vector<bool> inside(boxes.size());
  for (const Pair pair : test::oracle(withRegion)) {
    if (pair.second == boxes.size()) inside[pair.first] = true;
  }
  std::vector<Pair> expected;
  for (const Pair pair : test::oracle(boxes)) {
    if (inside[pair.first] && inside[pair.second]) expected.push_back(pair);
  }
  for (const Strategy strategy : kStrategies) {
    expectRows(boxes, {.strategy = strategy, .region = region}, expected);
  }
}

TEST(Neighbors, DoNotDependOnTheOrderOfPairs) {
  for (const std::size_t n : {6U, 100U, 1000U}) {
    const std::vector<Box> boxes = test::toDouble(test::randomBoxes(n, 8, 1.5F));
    const std::vector<Pair> expected = test::oracle(boxes);
    for (const Strategy strategy : kStrategies) {
      for (const Order order : {Order::BySecond, Order::Unordered}) {
        expectRows(boxes, {.strategy = strategy, .order = order}, expected);
      }
    }
  }
}

TEST(Neighbors, AreLimitedByTheNumberOfPairs) {
  for (const std::size_t n : {6U, 100U, test::kIsSanitized ? 700U : 1500U}) {
    for (const float size : {1.5F, 5.0F, 50.0F}) {
      const std::vector<Box> boxes = test::toDouble(test::randomBoxes(n, 9, size));
      const std::vector<Pair> expected = test::oracle(boxes);
      for (OverlapOptions options : {waysToSearch(Strategy::Automatic).front(), waysToSearch(Strategy::Bvh).back()}) {
        options.maxPairs = expected.size();
        expectRows(boxes, options, expected);
        for (const std::uint64_t less : {expected.size() - 1, expected.size() / 2}) {
          options.maxPairs = less;
          for (const NeighborRows kind : kKinds) {
            ASSERT_THROW(static_cast<void>(neighbors(boxes, kind, options)), LimitExceeded);
          }
        }
      }
    }
  }
}

TEST(Neighbors, OfAKeptSearchComeFromSearchToSearch) {
  OverlapSearch search;
  for (const std::size_t most : {900U, 5U, 1500U, 0U, 100U, 1200U}) {
    const std::size_t n = test::kIsSanitized && most >= 900 ? most / 2 : most;
    for (const float size : {0.5F, 3.0F, 60.0F}) {
      const std::vector<Box> boxes = test::toDouble(test::randomBoxes(n, 11, size));
      const std::vector<Box> others = test::toDouble(test::randomBoxes(n / 2, 12, size));
      const std::vector<Pair> expected = test::oracle(boxes);
      const std::vector<Pair> between = test::oracleBetween(boxes, others);
      for (const NeighborRows kind : kKinds) {
        ASSERT_EQ(rowsIn(search.findNeighbors(boxes, kind)), rowsOf(expected, n, kind));
        ASSERT_EQ(search.statistics().pairs, expected.size());
      }
      ASSERT_EQ(test::toVector(search.find(boxes)), expected);
      const NeighborsView found = search.findNeighbors(boxes, others);
      ASSERT_EQ(rowsIn(found), rowsOf(between, n, NeighborRows::Half));
      ASSERT_EQ(search.statistics().pairs, between.size());
      search.shrink();
      ASSERT_EQ(rowsIn(found), rowsOf(between, n, NeighborRows::Half));
      ASSERT_EQ(search.count(boxes), expected.size());
    }
  }
}

TEST(Neighbors, RefuseWhatASearchForPairsRefuses) {
  const std::vector<BoxF> boxes = test::randomBoxes(10, 1);
  const std::vector<std::uint32_t> groups(10);
  OverlapOptions options;
  options.filter.second.groups = groups;
  EXPECT_THROW(static_cast<void>(neighbors(boxes, NeighborRows::Full, options)), InvalidArgument);
  EXPECT_EQ(rowsIn(neighbors(boxes, boxes, options)).size(), boxes.size());
  options = {.instructionSet = "none"};
  EXPECT_THROW(static_cast<void>(neighbors(boxes, NeighborRows::Half, options)), InvalidArgument);
  StopFlag stop;
  stop.set();
  const std::vector<BoxF> many = test::randomBoxes(2000, 2);
  for (const Strategy strategy : kStrategies) {
    EXPECT_THROW(static_cast<void>(neighbors(many, NeighborRows::Full, {.strategy = strategy, .stop = &stop})),
                 Stopped);
  }
}

}  // namespace
}  // namespace allpairs
