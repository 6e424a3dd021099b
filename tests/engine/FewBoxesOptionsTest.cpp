// SPDX-License-Identifier: MIT
// Sets of a few boxes with all options at once, against a double loop: bounds a rounding apart, from denormal to
// infinite.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/StopFlag.h"
#include "support/Boxes.h"
#include "support/Numbers.h"
#include "support/Oracle.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t end) { return random() % end; }

template <class T, std::size_t kSize>
T oneOf(Random& random, const std::array<T, kSize>& values) {
  return values[below(random, kSize)];
}

/// Boxes that overlap by more than a margin, touch, or are some margins apart, up to a rounding: multiples of a tenth,
/// from some place on. One in ten is empty, one in ten has an infinite bound.
std::vector<Box> boxesOnGrid(Random& random, std::size_t size, double place) {
  std::vector<Box> boxes(size);
  for (Box& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t cell = below(random, 12);
      box.min[axis] = place + 0.1 * static_cast<double>(cell);
      box.max[axis] = place + 0.1 * static_cast<double>(cell + below(random, 8));
    }
    const std::size_t kind = below(random, 10);
    const std::size_t axis = below(random, 3);
    if (kind == 0) box.max[axis] = box.min[axis] - 0.1;
    if (kind == 1) box.min[axis] = oneOf(random, std::array{-test::kInfinity, test::kInfinity});
    if (kind == 1) box.max[axis] = test::kInfinity;
    if (kind == 2) box.max[axis] = test::kMost;
    if (kind == 3) box.min[axis] = -test::kMost;
    if (kind == 4) box.max[axis] = -test::kInfinity;
    if (kind == 4) box.min[axis] = -test::kInfinity;
    if (kind == 5) box.min[axis] = box.max[axis] = std::numeric_limits<double>::denorm_min();
  }
  return boxes;
}

/// A set as a user may have it: in either precision, in rows, backwards or in columns, with margins and filters or not.
struct Set {
  std::vector<Box> boxes;
  std::vector<float> numbers32;
  std::vector<double> numbers64;
  std::vector<double> margins;
  std::vector<std::uint32_t> categories;
  std::vector<std::uint32_t> masks;
  std::vector<std::uint32_t> groups;
  BoxView view;

  [[nodiscard]] FilterBits bits() const { return {categories, masks, groups}; }
  [[nodiscard]] double margin(std::size_t i) const { return margins.empty() ? 0.0 : margins[i]; }
};

constexpr std::array kReaches{0.0, 0.1, 0.2, 1e-17, std::numeric_limits<double>::denorm_min(), 3e7};
constexpr std::array kOddReaches{-0.1, 0.1, 1e300, 1.1e300, 0.9e308, test::kMost, test::kInfinity};

template <class T>
BoxView layOut(Random& random, const std::vector<Box>& boxes, std::vector<T>& numbers) {
  const auto size = static_cast<std::ptrdiff_t>(boxes.size());
  using Strides = std::pair<std::ptrdiff_t, std::ptrdiff_t>;
  const std::array layouts{Strides{6, 1}, Strides{7, 1}, Strides{1, size}, Strides{-6, 1}};
  const auto [boxStride, axisStride] = oneOf(random, layouts);
  numbers.assign(7 * boxes.size() + 1, T{0});
  T* const first = numbers.data() + (boxStride < 0 && size > 0 ? 6 * (size - 1) : 0);
  for (std::ptrdiff_t i = 0; i < size; ++i) {
    for (std::ptrdiff_t axis = 0; axis < 3; ++axis) {
      const Box& box = boxes[static_cast<std::size_t>(i)];
      first[i * boxStride + axis * axisStride] = static_cast<T>(box.min[static_cast<std::size_t>(axis)]);
      first[i * boxStride + (axis + 3) * axisStride] = static_cast<T>(box.max[static_cast<std::size_t>(axis)]);
    }
  }
  const CornerView<T> min{first, boxStride, axisStride};
  const CornerView<T> max{first + 3 * axisStride, boxStride, axisStride};
  return BoxView::fromStrided(boxes.size(), min, max);
}

template <class Value, class Draw>
void drawSometimes(Random& random, std::vector<Value>& values, std::size_t size, const Draw& draw) {
  if (below(random, 2) == 0) return;
  values.resize(size);
  for (Value& value : values) value = draw();
}

Set makeSet(Random& random, std::size_t size, double place) {
  Set set;
  const std::vector<Box> boxes = boxesOnGrid(random, size, place);
  set.view = below(random, 2) == 0 ? layOut(random, boxes, set.numbers32) : layOut(random, boxes, set.numbers64);
  for (std::size_t i = 0; i < size; ++i) set.boxes.push_back(set.view[i]);
  const bool areOdd = below(random, 8) == 0;
  const std::array odd{oneOf(random, kOddReaches), oneOf(random, kOddReaches)};
  drawSometimes(random, set.margins, size, [&] { return areOdd ? oneOf(random, odd) : oneOf(random, kReaches); });
  if (!set.margins.empty()) set.view.setMargins(set.margins);
  const auto bits = [&] { return static_cast<std::uint32_t>(1U + below(random, 7)); };
  drawSometimes(random, set.categories, size, bits);
  drawSometimes(random, set.masks, size, bits);
  drawSometimes(random, set.groups, size, [&] { return static_cast<std::uint32_t>(below(random, 4)); });
  return set;
}

std::uint32_t valueOr(const std::vector<std::uint32_t>& values, std::size_t i, std::uint32_t otherwise) {
  return values.empty() ? otherwise : values[i];
}

bool bitsAllow(const Set& a, std::size_t i, const Set& b, std::size_t j) {
  if ((valueOr(a.categories, i, ~0U) & valueOr(b.masks, j, ~0U)) == 0) return false;
  if ((valueOr(b.categories, j, ~0U) & valueOr(a.masks, i, ~0U)) == 0) return false;
  const std::uint32_t group = valueOr(a.groups, i, 0);
  return group == 0 || group != valueOr(b.groups, j, 0);
}

/// The double loop; all that a pair has to pass before the predicate is asked.
template <class Use>
void forEachOffered(const Set& a, const Set& b, const OverlapOptions& options, const Use& use) {
  const auto isIn = [&](const Set& set, std::size_t i) {
    return !options.region || test::overlapByOracle(set.boxes[i], *options.region, options.distance + set.margin(i));
  };
  for (std::uint32_t i = 0; i < a.boxes.size(); ++i) {
    for (std::uint32_t j = &a == &b ? i + 1 : 0; j < b.boxes.size(); ++j) {
      const double d = options.distance + a.margin(i) + b.margin(j);
      const bool isOffered = isIn(a, i) && isIn(b, j) && test::overlapByOracle(a.boxes[i], b.boxes[j], d);
      if (isOffered && bitsAllow(a, i, b, j)) use(Pair{i, j});
    }
  }
}

OverlapOptions drawOptions(Random& random, double place) {
  OverlapOptions options;
  if (below(random, 2) == 0) options.distance = oneOf(random, kReaches);
  if (below(random, 16) == 0) options.distance = oneOf(random, kOddReaches);
  if (below(random, 3) == 0) options.region = Box{{place, place, place}, {place + 0.5, place + 0.9, place + 0.5}};
  options.order = oneOf(random, std::array{Order::ByFirst, Order::BySecond, Order::Unordered});
  options.strategy = oneOf(random, std::array{Strategy::Automatic, Strategy::Exhaustive});
  if (below(random, 4) == 0) options.instructionSet = instructionSets()[below(random, instructionSets().size())];
  return options;
}

std::size_t drawSize(Random& random) { return oneOf(random, std::array<std::size_t, 9>{0, 1, 2, 3, 5, 8, 9, 40, 66}); }

bool isOdd(Pair pair) { return (pair.first + pair.second) % 2 == 1; }

/// Compares one search with the double loop, and with each pair how often the predicate was asked.
void compare(Random& random, OverlapSearch& kept) {
  const double place = oneOf(random, std::array{0.0, 0.0, -0.7, 1e8, 1e17, 1e300});
  const Set first = makeSet(random, drawSize(random), place);
  const bool areTwo = below(random, 2) == 0;
  const Set other = areTwo ? makeSet(random, drawSize(random), place) : Set();
  const Set& second = areTwo ? other : first;
  OverlapOptions options = drawOptions(random, place);
  options.filter.first = first.bits();
  if (areTwo) options.filter.second = other.bits();
  std::map<Pair, int> asked;
  const bool isAsked = below(random, 2) == 0;
  if (isAsked) {
    options.filter.accept = [&](std::uint32_t i, std::uint32_t j) {
      ++asked[{i, j}];
      return isOdd({i, j});
    };
  }
  std::map<Pair, int> offered;
  std::vector<Pair> expected;
  forEachOffered(first, second, options, [&](Pair pair) {
    if (isAsked) offered[pair] = 2;
    if (!isAsked || isOdd(pair)) expected.push_back(pair);
  });
  kept.setOptions(options);
  std::vector<Pair> made = areTwo ? overlaps(first.view, other.view, options) : overlaps(first.view, options);
  std::vector<Pair> found = test::toVector(areTwo ? kept.find(first.view, other.view) : kept.find(first.view));
  EXPECT_EQ(kept.statistics().pairs, expected.size());
  EXPECT_EQ(asked, offered);
  const std::size_t batchSize = oneOf(random, std::array<std::size_t, 3>{1, 7, kBatchSize});
  std::vector<Pair> streamed;
  const auto append = [&](Span<const Pair> batch) {
    EXPECT_TRUE(!batch.empty() && batch.size() <= batchSize && streamed.size() % batchSize == 0);
    streamed.insert(streamed.end(), batch.begin(), batch.end());
  };
  areTwo ? kept.stream(first.view, other.view, append, batchSize) : kept.stream(first.view, append, batchSize);
  if (options.order == Order::Unordered) std::sort(made.begin(), made.end());
  if (options.order == Order::Unordered) std::sort(found.begin(), found.end());
  EXPECT_EQ(made, test::inOrder(expected, options.order));
  EXPECT_EQ(found, made);
  if (options.order == Order::Unordered) std::sort(streamed.begin(), streamed.end());
  EXPECT_EQ(streamed, found);
}

TEST(FewBoxesWithOptions, GiveTheOraclesPairs) {
  OverlapSearch kept;
  for (unsigned seed = 0; seed < test::repeats(20000U); ++seed) {
    Random random(seed);
    compare(random, kept);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

TEST(FewBoxesWithOptions, BeyondTheLimitAreAnErrorThatLeavesTheSearchUsable) {
  for (const std::size_t n : {3U, 9U, 40U, 64U}) {
    const std::vector<Box> boxes(n, test::cube(0, 0, 0));
    OverlapOptions options{.distance = 0.1};
    options.filter.accept = [](std::uint32_t i, std::uint32_t j) { return isOdd({i, j}); };
    std::size_t odd = 0;
    for (const Pair pair : overlaps(boxes)) odd += isOdd(pair) ? 1U : 0U;
    options.maxPairs = odd - 1;
    OverlapSearch kept(options);
    EXPECT_THROW((void)kept.find(boxes), LimitExceeded) << n;
    EXPECT_THROW((void)kept.count(boxes), LimitExceeded) << n;
    EXPECT_EQ(kept.statistics().pairs, 0U) << n;
    std::size_t streamed = 0;
    const auto count = [&](Span<const Pair> batch) { streamed += batch.size(); };
    EXPECT_THROW(kept.stream(boxes, count, 1), LimitExceeded) << n;
    EXPECT_THROW(streamOverlaps(boxes, count, options, 1), LimitExceeded) << n;
    EXPECT_EQ(streamed, 2 * options.maxPairs) << n;
    options.maxPairs = odd;
    kept.setOptions(options);
    EXPECT_EQ(kept.find(boxes).size(), odd) << n;
    EXPECT_EQ(kept.statistics().boxTests, n * (n - 1) / 2) << n;
  }
}

TEST(FewBoxesWithOptions, ReachAsFarAsTheLeastNumber) {
  const double least = std::numeric_limits<double>::denorm_min();
  std::vector<Box> boxes(20, {{-1, -1, -1}, {0, 0, 0}});
  boxes.back() = {{least, 0, 0}, {1, 1, 1}};
  for (const std::size_t n : {2U, 20U}) {
    const std::vector<Box> some(boxes.end() - static_cast<std::ptrdiff_t>(n), boxes.end());
    EXPECT_EQ(overlaps(some, {.distance = least}).size(), n * (n - 1) / 2) << n;
    EXPECT_EQ(overlaps(some).size(), (n - 1) * (n - 2) / 2) << n;
  }
}

/// However few or many they are, in ranges or not.
TEST(FewBoxesWithOptions, AreStoppedByAVisitorBeforeTheNextBatch) {
  for (const std::size_t n : {30U, 600U}) {
    const std::vector<Box> boxes(n, test::cube(0, 0, 0));
    for (const Order order : {Order::ByFirst, Order::Unordered}) {
      for (const Strategy strategy : {Strategy::Automatic, Strategy::Bvh}) {
        StopFlag stop;
        OverlapOptions options{.strategy = strategy, .order = order};
        options.stop = &stop;
        OverlapSearch search(options);
        std::size_t batches = 0;
        const auto setFlag = [&](Span<const Pair>) {
          stop.set();
          ++batches;
        };
        EXPECT_THROW(search.stream(boxes, setFlag, 16), Stopped);
        EXPECT_EQ(batches, 1U);
        EXPECT_EQ(search.statistics().pairs, 0U);
        stop.clear();
        const auto fail = [](Span<const Pair>) { throw std::runtime_error("the visitor's"); };
        EXPECT_THROW(search.stream(boxes, fail), std::runtime_error);
        EXPECT_EQ(search.statistics().pairs, 0U);
        std::size_t pairs = 0;
        const auto count = [&](Span<const Pair> batch) { pairs += batch.size(); };
        search.stream(boxes, count, 16);
        EXPECT_EQ(pairs, n * (n - 1) / 2);
        EXPECT_EQ(search.statistics().pairs, pairs);
      }
    }
  }
}

TEST(FewBoxesWithOptions, AreStoppedBeforeTheSearch) {
  const std::vector<Box> boxes(5, test::cube(0, 0, 0));
  StopFlag stop;
  stop.set();
  OverlapOptions options{.distance = 0.1};
  options.stop = &stop;
  EXPECT_THROW((void)overlaps(boxes, options), Stopped);
}

}  // namespace
}  // namespace allpairs
