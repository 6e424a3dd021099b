// SPDX-License-Identifier: MIT
// A few boxes beside a large set, which is searched as it lies in memory: whole lists beside a double loop, for counts
// around the limits of vectors and of parts.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "support/Boxes.h"
#include "support/Corners.h"
#include "support/Oracle.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

/// Rows of six, of which some are empty, some reach to infinity, and some touch others at whole numbers.
template <class T>
std::vector<T> someRows(std::size_t boxes, unsigned seed, double side) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> place(0.0, 1.0);
  std::vector<T> rows;
  for (std::size_t i = 0; i < boxes; ++i) {
    std::array<double, 6> row;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      row[axis] = place(generator);
      row[axis + 3] = row[axis] + side * place(generator);
      if (i % 5 == 1) row[axis] = std::floor(4.0 * row[axis]) / 4.0;
      if (i % 5 == 1) row[axis + 3] = row[axis] + 0.25;
    }
    if (i % 11 == 3) std::swap(row[i % 3], row[i % 3 + 3]);
    if (i % 13 == 5) row[i % 3] = -std::numeric_limits<double>::infinity();
    if (i % 17 == 2) row[i % 3 + 3] = std::numeric_limits<double>::infinity();
    if (i % 29 == 7) row[i % 3] = row[i % 3 + 3] = std::numeric_limits<double>::infinity();
    for (const double bound : row) rows.push_back(static_cast<T>(bound));
  }
  return rows;
}

template <class T>
std::vector<Box> boxesOf(const std::vector<T>& rows) {
  const BoxView view = BoxView::fromRows(rows);
  std::vector<Box> boxes(view.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i] = view[i];
  return boxes;
}

template <class T>
std::vector<Pair> pairsByLoop(const std::vector<T>& first, const std::vector<T>& second) {
  return test::oracleBetween(boxesOf(first), boxesOf(second));
}

void expectPairs(OverlapSearch& search, const BoxView& first, const BoxView& second,
                 const std::vector<Pair>& expected) {
  const Order order = search.options().order;
  const auto comparable = [&](std::vector<Pair> pairs) {
    if (order == Order::Unordered) std::sort(pairs.begin(), pairs.end());
    return pairs;
  };
  const Span<const Pair> found = search.find(first, second);
  ASSERT_EQ(comparable({found.begin(), found.end()}), test::inOrder(expected, order));
  ASSERT_EQ(search.statistics().pairs, expected.size());
  ASSERT_EQ(comparable(overlaps(first, second, search.options())), test::inOrder(expected, order));
  ASSERT_EQ(search.count(first, second), expected.size());
  std::vector<Pair> memory(expected.size());
  ASSERT_EQ(search.findInto(first, second, memory).size(), expected.size());
  ASSERT_EQ(comparable(memory), test::inOrder(expected, order));
}

void expectRows(const BoxView& first, const BoxView& second, const std::vector<Pair>& expected) {
  const Neighbors rows = neighbors(first, second);
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i + 1 < rows.offsets.size(); ++i) {
    for (std::uint64_t k = rows.offsets[i]; k < rows.offsets[i + 1]; ++k) pairs.push_back({i, rows.indices[k]});
  }
  ASSERT_EQ(pairs, expected);
}

template <class T>
class FewBesideMany : public ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(FewBesideMany, Precisions);

TYPED_TEST(FewBesideMany, GiveTheLoopsPairsInEveryOrderLayoutAndInstructionSet) {
  unsigned seed = 0;
  for (const std::size_t many : {65U, 66U, 71U, 79U, 80U, 97U, 128U, 300U, 1025U, 2049U, 5000U}) {
    for (const std::size_t few : {0U, 1U, 2U, 3U, 4U, 5U, 7U, 8U, 9U}) {
      const std::vector<TypeParam> a = someRows<TypeParam>(few, ++seed, many < 1000 ? 1.5 : 0.1);
      const std::vector<TypeParam> b = someRows<TypeParam>(many, ++seed, many < 1000 ? 0.4 : 0.05);
      const test::Corners<TypeParam> aCorners(a);
      const test::Corners<TypeParam> bCorners(b);
      const std::vector<Pair> fewFirst = pairsByLoop(a, b);
      const std::vector<Pair> fewSecond = pairsByLoop(b, a);
      for (std::size_t i = 0; i < instructionSets().size(); ++i) {
        if (test::kIsSanitized && (seed / 2 + i) % instructionSets().size() != 0) continue;  // each in turn
        const std::string_view instructionSet = instructionSets()[i];
        for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
          SCOPED_TRACE(std::to_string(few) + " beside " + std::to_string(many) + ", " + std::string(instructionSet));
          OverlapSearch search({.order = order, .instructionSet = instructionSet});
          ASSERT_NO_FATAL_FAILURE(expectPairs(search, BoxView::fromRows(a), BoxView::fromRows(b), fewFirst));
          ASSERT_NO_FATAL_FAILURE(expectPairs(search, BoxView::fromRows(b), BoxView::fromRows(a), fewSecond));
          ASSERT_NO_FATAL_FAILURE(expectPairs(search, aCorners.view(), bCorners.view(), fewFirst));
          ASSERT_NO_FATAL_FAILURE(expectPairs(search, BoxView::fromRows(b), aCorners.view(), fewSecond));
        }
      }
      ASSERT_NO_FATAL_FAILURE(expectRows(BoxView::fromRows(a), BoxView::fromRows(b), fewFirst));
      ASSERT_NO_FATAL_FAILURE(expectRows(BoxView::fromRows(b), BoxView::fromRows(a), fewSecond));
    }
  }
}

/// Boxes in a part of space; one of them is empty, and one a point.
template <class T>
std::vector<T> localRows(std::size_t boxes, double begin, double side, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> place(begin, begin + side);
  std::vector<T> rows;
  for (std::size_t i = 0; i < boxes; ++i) {
    std::array<double, 6> row;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      row[axis] = place(generator);
      row[axis + 3] = row[axis] + (i == 1 ? 0.0 : 0.1 * side);
    }
    if (i == 2) std::swap(row[1], row[4]);
    for (const double bound : row) rows.push_back(static_cast<T>(bound));
  }
  return rows;
}

/// Those that touch the common bounds of the few are none, some, or many, in all parts or in some of them.
TYPED_TEST(FewBesideMany, ThatAreInAPartOfSpaceGiveTheLoopsPairs) {
  std::vector<TypeParam> many = someRows<TypeParam>(20000, 200, 0.05);
  for (const bool sorted : {false, true}) {
    if (sorted) {
      std::vector<Box> boxes = boxesOf(many);
      std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.min[0] < b.min[0]; });
      many.clear();
      for (const Box& box : boxes) {
        for (const double bound : box.min) many.push_back(static_cast<TypeParam>(bound));
        for (const double bound : box.max) many.push_back(static_cast<TypeParam>(bound));
      }
    }
    for (const std::size_t few : {3U, 4U, 8U}) {
      for (const double side : {0.05, 0.3, 0.6}) {
        SCOPED_TRACE(std::to_string(few) + " in " + std::to_string(side) + (sorted ? ", sorted" : ""));
        const std::vector<TypeParam> a = localRows<TypeParam>(few, 0.3, side, static_cast<unsigned>(few));
        const std::vector<Pair> fewFirst = pairsByLoop(a, many);
        const std::vector<Pair> fewSecond = pairsByLoop(many, a);
        ASSERT_FALSE(fewFirst.empty());
        for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
          OverlapSearch search({.order = order});
          ASSERT_NO_FATAL_FAILURE(expectPairs(search, BoxView::fromRows(a), BoxView::fromRows(many), fewFirst));
          ASSERT_NO_FATAL_FAILURE(expectPairs(search, BoxView::fromRows(many), BoxView::fromRows(a), fewSecond));
        }
      }
    }
    const std::vector<TypeParam> far = localRows<TypeParam>(8, 50.0, 0.1, 1);
    OverlapSearch search;
    ASSERT_NO_FATAL_FAILURE(
        expectPairs(search, BoxView::fromRows(many), BoxView::fromRows(far), pairsByLoop(many, far)));
  }
}

/// All pairs of 8 and 5,000 boxes: more than are collected at once.
TYPED_TEST(FewBesideMany, ThatAllOverlapGiveAllPairs) {
  const std::vector<TypeParam> box{0, 0, 0, 1, 1, 1};
  std::vector<TypeParam> few;
  std::vector<TypeParam> many;
  for (std::size_t i = 0; i < 8; ++i) few.insert(few.end(), box.begin(), box.end());
  for (std::size_t i = 0; i < 5000; ++i) many.insert(many.end(), box.begin(), box.end());
  const std::vector<Pair> expected = pairsByLoop(few, many);
  ASSERT_EQ(expected.size(), 40000U);
  for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
    OverlapSearch search({.order = order});
    ASSERT_NO_FATAL_FAILURE(expectPairs(search, BoxView::fromRows(few), BoxView::fromRows(many), expected));
    search.setOptions({.order = order, .maxPairs = 39999});
    EXPECT_THROW((void)search.find(BoxView::fromRows(few), BoxView::fromRows(many)), LimitExceeded);
    EXPECT_EQ(search.statistics().pairs, 0U);
  }
}

TYPED_TEST(FewBesideMany, GiveAVectorThatHoldsLittleMoreThanItsPairs) {
  const std::vector<TypeParam> few = someRows<TypeParam>(8, 3, 1.5);
  for (const double side : {0.001, 0.1, 2.0}) {
    const std::vector<TypeParam> many = someRows<TypeParam>(20000, 4, side);
    const std::vector<Pair> pairs = overlaps(BoxView::fromRows(few), BoxView::fromRows(many));
    EXPECT_LE(pairs.capacity(), 2 * pairs.size() + 1) << pairs.size();
  }
}

std::vector<Pair> streamed(const BoxView& first, const BoxView& second) {
  std::vector<Pair> pairs;
  const auto append = [&](Span<const Pair> some) { pairs.insert(pairs.end(), some.begin(), some.end()); };
  streamOverlaps(first, second, append, {.order = Order::Unordered});
  return pairs;
}

/// The same boxes as six columns, which are searched as any two sets are.
template <class T>
struct ColumnsOf {
  std::vector<T> values;
  std::size_t size;

  explicit ColumnsOf(const std::vector<T>& rows) : values(rows.size()), size(rows.size() / 6) {
    for (std::size_t i = 0; i < rows.size(); ++i) values[i % 6 * size + i / 6] = rows[i];
  }
  [[nodiscard]] BoxView view() const {
    const auto stride = static_cast<std::ptrdiff_t>(size);
    return BoxView::fromStrided(size, CornerView<T>{values.data(), 1, stride},
                                CornerView<T>{values.data() + 3 * size, 1, stride});
  }
};

TYPED_TEST(FewBesideMany, GiveTheSameUnorderedListWhateverTheExecutorTheCallAndTheLayout) {
  parallel::TbbExecutor two(2);
  for (const std::size_t many : {107U, 5000U, 70000U}) {
    for (const std::size_t few : {1U, 2U, 4U, 8U}) {
      SCOPED_TRACE(std::to_string(few) + " beside " + std::to_string(many));
      const std::vector<TypeParam> a = someRows<TypeParam>(few, 100, 1.5);
      const std::vector<TypeParam> b = someRows<TypeParam>(many, 101, 0.1);
      const ColumnsOf<TypeParam> aColumns(a);
      const ColumnsOf<TypeParam> bColumns(b);
      for (const bool fewFirst : {true, false}) {
        const BoxView first = BoxView::fromRows(fewFirst ? a : b);
        const BoxView second = BoxView::fromRows(fewFirst ? b : a);
        const std::vector<Pair> expected = overlaps(first, second, {.order = Order::Unordered});
        ASSERT_EQ(overlaps(first, second, {.order = Order::Unordered, .executor = &two}), expected);
        ASSERT_EQ(streamed(first, second), expected);
        ASSERT_EQ(overlaps((fewFirst ? aColumns : bColumns).view(), (fewFirst ? bColumns : aColumns).view(),
                           {.order = Order::Unordered}),
                  expected);
      }
    }
  }
}

/// Bounds that float32 cannot tell apart.
TEST(FewBesideManyInDouble, AreNotRounded) {
  const std::vector<Box> few(1, {{0, 0, 0}, {0.1, 1, 1}});
  const std::vector<Box> apart(100, {{std::nextafter(0.1, 1.0), 0, 0}, {1, 1, 1}});
  const std::vector<Box> touching(100, {{0.1, 0, 0}, {1, 1, 1}});
  for (const std::string_view instructionSet : instructionSets()) {
    EXPECT_EQ(overlaps(few, apart, {.instructionSet = instructionSet}).size(), 0U) << instructionSet;
    EXPECT_EQ(overlaps(touching, few, {.instructionSet = instructionSet}).size(), 100U) << instructionSet;
  }
}

TEST(FewBesideManyOptions, AreAppliedOrRefused) {
  const std::vector<double> few = someRows<double>(2, 1, 1.5);
  const std::vector<double> many = someRows<double>(500, 2, 0.4);
  const BoxView a = BoxView::fromRows(few);
  const BoxView b = BoxView::fromRows(many);
  const std::vector<Pair> all = pairsByLoop(few, many);
  std::vector<std::uint32_t> groups(500, 0);
  for (std::size_t i = 0; i < groups.size(); i += 2) groups[i] = 1;
  const std::vector<std::uint32_t> ones(2, 1);
  OverlapOptions options;
  options.filter.first.groups = ones;
  options.filter.second.groups = groups;
  std::vector<Pair> expected = all;
  std::erase_if(expected, [](Pair pair) { return pair.second % 2 == 0; });
  EXPECT_EQ(overlaps(a, b, options), expected);
  options.filter.second.groups = ones;
  EXPECT_THROW((void)overlaps(a, b, options), InvalidArgument);
  EXPECT_THROW((void)overlaps(a, b, {.instructionSet = "NONE"}), InvalidArgument);
  StopFlag stop;
  stop.set();
  EXPECT_THROW((void)overlaps(a, b, {.stop = &stop}), Stopped);
}

/// Every value of sets of every size around those of vectors is looked at.
template <class T>
void expectNanFoundEverywhere() {
  for (const std::size_t boxes : {1U, 10U, 11U, 12U, 16U, 21U, 22U, 33U}) {
    std::vector<T> rows = someRows<T>(boxes, 1, 0.1);
    std::vector<T> other = rows;
    EXPECT_EQ(BoxView::fromRows(rows).size(), boxes);
    EXPECT_EQ(BoxView::fromCorners(rows, other).size(), 2 * boxes);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const T kept = std::exchange(rows[i], std::numeric_limits<T>::quiet_NaN());
      EXPECT_THROW((void)BoxView::fromRows(rows), InvalidBox) << i << " of " << rows.size();
      EXPECT_THROW((void)BoxView::fromCorners(rows, other), InvalidBox) << i << " of " << rows.size();
      EXPECT_THROW((void)BoxView::fromCorners(other, rows), InvalidBox) << i << " of " << rows.size();
      rows[i] = kept;
    }
  }
}

TEST(BoxViewOfManyBoxes, FindsANanAtEveryPlaceInBothPrecisions) {
  expectNanFoundEverywhere<float>();
  expectNanFoundEverywhere<double>();
}

}  // namespace
}  // namespace allpairs
