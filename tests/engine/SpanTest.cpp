// SPDX-License-Identifier: MIT
// Compiled as C++20 and as C++17.
#include "allpairs/Span.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <deque>
#include <initializer_list>
#include <list>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "allpairs/BoxView.h"
#include "allpairs/Overlaps.h"
#include "allpairs/World.h"
#include "allpairs/Worlds.h"

#ifdef __cpp_lib_span
#include <algorithm>
#include <ranges>
#include <span>
#endif

namespace allpairs {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

template <class From, class To>
constexpr bool kConverts = std::is_convertible_v<From, To>;

// What it is made of, without being asked to.
static_assert(kConverts<std::vector<int>&, Span<int>> && kConverts<std::vector<int>&, Span<const int>>);
static_assert(kConverts<const std::vector<int>&, Span<const int>> && kConverts<std::vector<int>, Span<const int>>);
static_assert(kConverts<std::array<int, 3>&, Span<int>> && kConverts<const std::array<int, 3>&, Span<const int>>);
static_assert(kConverts<std::array<const int, 3>&, Span<const int>>);
static_assert(kConverts<int (&)[3], Span<int>> && kConverts<const int (&)[3], Span<const int>>);
static_assert(kConverts<std::initializer_list<int>, Span<const int>> &&
              kConverts<const std::string&, Span<const char>>);
static_assert(kConverts<Span<int>, Span<const int>>);
static_assert(kConverts<std::vector<int*>&, Span<int* const>> && kConverts<std::vector<int*>&, Span<const int* const>>);

// Nothing that would have to be converted, lacks what has been asked for, or may be changed and is gone after the call.
static_assert(!std::is_constructible_v<Span<int>, const std::vector<int>&>);
static_assert(!std::is_constructible_v<Span<int>, std::vector<int>> &&
              !std::is_constructible_v<Span<int>, Span<const int>>);
static_assert(!std::is_constructible_v<Span<int>, const std::array<int, 3>&>);
static_assert(!std::is_constructible_v<Span<const double>, std::vector<float>&>);
static_assert(!std::is_constructible_v<Span<const int>, std::vector<unsigned>&>);
static_assert(!std::is_constructible_v<Span<const bool>, std::vector<bool>&>);
static_assert(!std::is_constructible_v<Span<const int>, std::deque<int>&>);
static_assert(!std::is_constructible_v<Span<const int>, std::list<int>&>);
static_assert(!std::is_constructible_v<Span<const int>, int*> && !std::is_constructible_v<Span<const int>, int>);
struct Base {};
struct Derived : Base {
  int more = 0;
};
static_assert(!std::is_constructible_v<Span<Base>, std::vector<Derived>&>);
static_assert(!std::is_constructible_v<Span<Base>, Derived*, std::size_t>);
static_assert(std::is_constructible_v<Span<const Base>, Base*, std::size_t> &&
              !std::is_constructible_v<Span<Base>, const Base*, std::size_t>);

// Two numbers are neither a pointer and a size, nor two elements: world.remove({0, 3}) would read from address 0.
template <class Ids, class = void>
constexpr bool kRemovesTwoNumbers = false;
template <class Ids>
constexpr bool kRemovesTwoNumbers<Ids, std::void_t<decltype(std::declval<World&>().remove(Ids{0, 3}))>> = true;
static_assert(!kRemovesTwoNumbers<Span<const BoxId>>);

/// An array of arrays: data() points to its numbers, of which size() counts the first dimension only.
struct Table {
  using size_type = std::size_t;
  using Row = std::array<double, 6>;
  [[nodiscard]] const double* data() const { return rows.front().data(); }
  [[nodiscard]] std::size_t size() const { return rows.size(); }
  [[nodiscard]] auto begin() const { return rows.begin(); }
  [[nodiscard]] auto end() const { return rows.end(); }
  std::array<Row, 4> rows{};
};
static_assert(!std::is_constructible_v<Span<const double>, const Table&>);

/// A column of a matrix: like Eigen's, it has data() and size(), and its elements don't follow each other.
struct Column {
  struct Iterator {
    using value_type = double;
    using reference = const double&;
    using pointer = const double*;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::random_access_iterator_tag;
    const double* at;
  };
  [[nodiscard]] const double* data() const { return values.data(); }
  [[nodiscard]] std::ptrdiff_t size() const { return 2; }
  [[nodiscard]] Iterator begin() const { return {values.data()}; }
  std::array<double, 6> values;
};
static_assert(!std::is_constructible_v<Span<const double>, const Column&>);

static_assert(std::is_trivially_copyable_v<Span<int>> && sizeof(Span<int>) == 2 * sizeof(int*));

// A view of boxes that would be gone does not compile, whatever they are in.
static_assert(!std::is_constructible_v<BoxView, std::vector<Box>> &&
              !std::is_constructible_v<BoxView, std::vector<BoxF>>);
static_assert(!std::is_constructible_v<BoxView, const std::vector<Box>>);
static_assert(!std::is_constructible_v<BoxView, std::array<Box, 2>>);
static_assert(kConverts<std::vector<Box>&, BoxView> && kConverts<const std::vector<BoxF>&, BoxView>);
static_assert(kConverts<Span<const Box>, BoxView> && kConverts<Span<BoxF>, BoxView> && kConverts<Box (&)[2], BoxView>);
static_assert(!std::is_constructible_v<BoxView, std::vector<double>&>);

TEST(Span, IsWhatItWasMadeOf) {
  std::vector<int> values{1, 2, 3};
  const Span<int> span = values;
  EXPECT_EQ(span.data(), values.data());
  EXPECT_EQ(span.size(), 3U);
  EXPECT_FALSE(span.empty());
  EXPECT_EQ(span.front(), 1);
  EXPECT_EQ(span.back(), 3);
  EXPECT_EQ(&span[1], &values[1]);
  EXPECT_THAT(span, ElementsAre(1, 2, 3));
  EXPECT_EQ(std::vector<int>(span.begin(), span.end()), values);
  for (int& value : span) value *= 2;
  EXPECT_THAT(values, ElementsAre(2, 4, 6));
  const int array[] = {7, 8};
  EXPECT_THAT(Span<const int>(array), ElementsAre(7, 8));
  EXPECT_THAT(Span<const int>(array, 1), ElementsAre(7));
}

TEST(Span, OfNothingIsEmpty) {
  const auto sizeOf = [](Span<const int> span) { return span.size(); };
  EXPECT_EQ(sizeOf({}), 0U);
  EXPECT_THAT(Span<const int>(), IsEmpty());
  EXPECT_EQ(Span<const int>().begin(), Span<const int>().end());
  EXPECT_THAT(Span<const int>(std::vector<int>()), IsEmpty());
  EXPECT_THAT(Span<const int>().subspan(0), IsEmpty());
}

TEST(Span, HasParts) {
  const std::array<int, 5> values{1, 2, 3, 4, 5};
  const Span<const int> span = values;
  EXPECT_THAT(span.first(2), ElementsAre(1, 2));
  EXPECT_THAT(span.last(2), ElementsAre(4, 5));
  EXPECT_THAT(span.subspan(3), ElementsAre(4, 5));
  EXPECT_THAT(span.subspan(1, 2), ElementsAre(2, 3));
  EXPECT_THAT(span.subspan(5), IsEmpty());
  constexpr std::size_t kDynamicExtent = static_cast<std::size_t>(-1);
  EXPECT_THAT(span.subspan(3, kDynamicExtent), ElementsAre(4, 5));
  EXPECT_THAT(span.first(0), IsEmpty());
}

TEST(Span, IsKnownWhenAProgramIsCompiled) {
  static constexpr std::array<int, 3> kValues{1, 2, 3};
  constexpr Span<const int> kSpan = kValues;
  static_assert(kSpan.size() == 3 && kSpan[1] == 2 && kSpan.last(1).front() == 3 && kSpan.begin() + 3 == kSpan.end());
}

/// Some boxes of which each overlaps a few others, some of which touch.
std::vector<Box> someBoxes() {
  std::vector<Box> boxes;
  for (unsigned i = 0; i < 300; ++i) {
    const Box box{{double(i % 7), double(i % 11), double(i % 13)},
                  {double(i % 7) + 1, double(i % 11) + 2, double(i % 13) + 1}};
    boxes.push_back(box);
  }
  return boxes;
}

std::vector<Pair> byDoubleLoop(const std::vector<Box>& boxes) {
  std::vector<Pair> pairs;
  for (std::uint32_t first = 0; first < boxes.size(); ++first) {
    for (std::uint32_t second = first + 1; second < boxes.size(); ++second) {
      if (overlap(boxes[first], boxes[second])) pairs.push_back({first, second});
    }
  }
  return pairs;
}

TEST(Span, IsWhatSearchesGiveAndTake) {
  const std::vector<Box> boxes = someBoxes();
  const std::vector<Pair> expected = byDoubleLoop(boxes);
  OverlapSearch search;
  const Span<const Pair> found = search.find(boxes);
  EXPECT_EQ(std::vector<Pair>(found.begin(), found.end()), expected);

  std::vector<Pair> streamed;
  search.stream(
      boxes, [&](Span<const Pair> batch) { streamed.insert(streamed.end(), batch.begin(), batch.end()); }, 100);
  EXPECT_EQ(streamed, expected);

  const Neighbors rows = neighbors(boxes, NeighborRows::Half);
  std::vector<Pair> ofRows;
  for (std::uint32_t first = 0; first < rows.size(); ++first) {
    for (const std::uint32_t second : rows[first]) ofRows.push_back({first, second});
  }
  EXPECT_EQ(ofRows, expected);

  const std::vector<std::uint64_t> begin{0, boxes.size()};
  EXPECT_EQ(overlapsInWorlds(Worlds(boxes, begin)).pairs, expected);
}

TEST(Span, IsWhatAWorldGivesAndTakes) {
  const std::vector<Box> boxes = someBoxes();
  const std::vector<Pair> expected = byDoubleLoop(boxes);
  World world;
  std::vector<BoxId> ids(boxes.size());
  world.add(boxes, {}, ids);
  const StepResult step = world.step();
  EXPECT_EQ(std::vector<Pair>(step.began.begin(), step.began.end()), expected);
  world.move(ids, boxes);
  const auto [pairs, began, persisted, ended] = world.step();
  EXPECT_EQ(std::vector<Pair>(persisted.begin(), persisted.end()), expected);
  EXPECT_THAT(began, IsEmpty());
  EXPECT_THAT(ended, IsEmpty());
  EXPECT_EQ(pairs.size(), expected.size());
}

TEST(Span, PairsCompareByFirstAndThenSecond) {
  const std::vector<Pair> ascending{{0, 1}, {0, 2}, {1, 0}, {1, 2}};
  for (std::size_t i = 0; i < ascending.size(); ++i) {
    for (std::size_t k = 0; k < ascending.size(); ++k) {
      const Pair& a = ascending[i];
      const Pair& b = ascending[k];
      EXPECT_EQ(a == b, i == k);
      EXPECT_EQ(a != b, i != k);
      EXPECT_EQ(a < b, i < k);
      EXPECT_EQ(a > b, i > k);
      EXPECT_EQ(a <= b, i <= k);
      EXPECT_EQ(a >= b, i >= k);
    }
  }
  static_assert(Pair{1, 2} == Pair{1, 2} && Box{{0, 0, 0}, {1, 1, 1}} != Box{{0, 0, 0}, {1, 1, 2}});
}

#ifdef __cpp_lib_span
static_assert(kConverts<Span<int>, std::span<int>> && kConverts<Span<int>, std::span<const int>>);
static_assert(kConverts<Span<const int>, std::span<const int>> && !kConverts<Span<const int>, std::span<int>>);
static_assert(kConverts<std::span<int>, Span<int>> && kConverts<std::span<int>, Span<const int>>);
static_assert(kConverts<std::span<const int>, Span<const int>> && kConverts<std::span<int, 3>, Span<int>>);
static_assert(!std::is_constructible_v<Span<int>, std::span<const int>>);
static_assert(std::ranges::contiguous_range<Span<int>> && std::ranges::borrowed_range<Span<int>> &&
              std::ranges::view<Span<int>> && std::ranges::sized_range<const Span<int>>);
static_assert(kConverts<std::span<const Box>, BoxView> && kConverts<std::span<BoxF>, BoxView>);
static_assert(std::three_way_comparable<Pair>);

TEST(Span, IsAStdSpanWhereOneIsAskedFor) {
  const std::vector<Box> boxes = someBoxes();
  const std::vector<Pair> expected = byDoubleLoop(boxes);
  OverlapSearch search;
  const std::span<const Pair> found = search.find(boxes);
  EXPECT_TRUE(std::ranges::equal(found, expected));
  EXPECT_EQ(std::span(search.find(boxes)).size(), expected.size());

  std::vector<Pair> streamed;
  search.stream(boxes,
                [&](std::span<const Pair> batch) { streamed.insert(streamed.end(), batch.begin(), batch.end()); });
  EXPECT_EQ(streamed, expected);

  std::vector<Pair> memory(expected.size());
  const std::span<Pair> all = memory;
  EXPECT_EQ(std::span<Pair>(search.findInto(boxes, all)).data(), memory.data());

  const std::vector<std::uint32_t> groups(boxes.size(), 1);
  const std::span<const std::uint32_t> ofGroups = groups;
  EXPECT_EQ(countOverlaps(boxes, {.filter = {.first = {.groups = ofGroups}}}), 0U);
}

TEST(Span, IsMadeOfIteratorsAsAStdSpanIs) {
  const std::vector<int> values{1, 2, 3};
  Span<const int> span{values.begin() + 1, values.end()};
  EXPECT_THAT(span, ElementsAre(2, 3));
  span = {values.data(), values.data() + 2};
  EXPECT_THAT(span, ElementsAre(1, 2));
  span = {values.data(), 1};
  EXPECT_THAT(span, ElementsAre(1));
}

TEST(Span, TakesPartInRanges) {
  const std::vector<int> values{3, 1, 2};
  const Span<const int> span = values;
  EXPECT_EQ(std::ranges::max(span), 3);
  EXPECT_EQ(std::ranges::find(Span<const int>(values), 2) - span.begin(), 2);  // does not dangle
  std::vector<int> doubled;
  for (const int value : span | std::views::transform([](int x) { return 2 * x; })) doubled.push_back(value);
  EXPECT_THAT(doubled, ElementsAre(6, 2, 4));
}
#endif

}  // namespace
}  // namespace allpairs
