// SPDX-License-Identifier: MIT
// Worlds of few boxes that are apart by just the distance and their margins, or by a hair more: the sum depends on the
// order in which it is added, which is that of their ids whatever the order of the pairs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/Overlaps.h"
#include "allpairs/World.h"
#include "allpairs/Worlds.h"
#include "support/Boxes.h"
#include "support/Corners.h"
#include "support/Numbers.h"
#include "support/Oracle.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

using ::testing::ElementsAreArray;

/// Box i and the i-th from the end lie beside each other, those of other numbers elsewhere.
struct ApartBySums {
  std::vector<Box> boxes;
  std::vector<double> margins;

  ApartBySums(std::size_t size, double distance, unsigned seed) : boxes(size), margins(size, 0.0) {
    static constexpr double kMargins[] = {0.1, 0.2, 0.3, 0.7, 1.0 / 3.0, 0.0};
    std::mt19937 generator(seed);
    for (double& margin : margins) margin = kMargins[generator() % std::size(kMargins)];
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t other = size - 1 - i;
      const double y = 10.0 * static_cast<double>(std::min(i, other));
      boxes[i] = {{-1, y, 0}, {0, y + 1, 1}};
      if (other >= i) continue;
      const double sum = distance + margins[other] + margins[i];
      boxes[i].min[0] = generator() % 2 == 0 ? sum : std::nextafter(sum, 100.0);
      boxes[i].max[0] = boxes[i].min[0] + 1.0;
    }
  }
};

class WorldsApart : public ::testing::TestWithParam<std::string_view> {
 protected:
  static void expectPairs(const BoxView& boxes, double distance, const std::vector<Pair>& expected) {
    const std::vector<std::uint64_t> offsets{0, boxes.size()};
    for (const Order order : {Order::ByFirst, Order::BySecond}) {
      OverlapOptions options;
      options.instructionSet = GetParam();
      options.order = order;
      options.distance = distance;
      const WorldPairs found = overlapsInWorlds({boxes, offsets}, options);
      ASSERT_EQ(found.pairs, test::inOrder(expected, order)) << boxes.size() << " boxes, distance " << distance;
    }
  }
};

INSTANTIATE_TEST_SUITE_P(EachInstructionSet, WorldsApart,
                         ::testing::ValuesIn(instructionSets().begin(), instructionSets().end()),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(WorldsApart, BySumsOfMarginsAreComparedInTheOrderOfIds) {
  auto seed = static_cast<unsigned>(GetParam().back());
  for (const std::size_t size : {2U, 21U, 64U, 65U, 130U, 400U}) {
    for (const double distance : {0.01, 0.0, 1.0, -1.0}) {
      const ApartBySums scene(size, distance, ++seed);
      BoxView view(scene.boxes);
      view.setMargins(scene.margins);
      ASSERT_NO_FATAL_FAILURE(expectPairs(view, distance, test::oracle(scene.boxes, distance, scene.margins)));
      ASSERT_NO_FATAL_FAILURE(expectPairs(BoxView(scene.boxes), distance, test::oracle(scene.boxes, distance)));
    }
  }
}

/// Worlds on a grid of so small a size, or so large, that float32 has no such numbers, or has one for several of them:
/// bounds are those of the grid, or the next number below or above it, and so are those of empty boxes.
struct HairsApart {
  std::vector<Box> boxes;
  std::vector<std::uint64_t> begin{0};

  explicit HairsApart(unsigned seed) {
    // 40 have each scale with hairs and without, and each size.
    constexpr std::size_t kWorlds = test::kIsSanitized ? 40 : 96;
    std::mt19937 generator(seed);
    for (std::size_t world = 0; world < kWorlds; ++world) {
      static constexpr double kScales[] = {1.0, 0.1, 1e300, 3e38, 1e-40, 1e-46, 1e-310};
      static constexpr std::size_t kWorldSizes[] = {1, 2, 5, 20, 33, 64, 65, 130, 190, 250, 320, 440};
      const double scale = kScales[world / 3 % std::size(kScales)];
      const bool isOnGrid = world % 40 < 20;  // Long rows of worlds with hairs, and without.
      const auto bound = [&](double value) {
        if (!isOnGrid) return scale * (value + std::generate_canonical<double, 53>(generator));
        const double end = generator() % 2 == 0 ? -1.0 : 1.0;
        return generator() % 3 == 0 ? std::nextafter(scale * value, end * test::kInfinity) : scale * value;
      };
      for (std::size_t i = kWorldSizes[world % std::size(kWorldSizes)]; i > 0; --i) {
        Box box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto min = static_cast<double>(generator() % 4);
          box.min[axis] = bound(min);
          box.max[axis] = bound(min + static_cast<double>(generator() % 2));
        }
        boxes.push_back(box);
      }
      begin.push_back(boxes.size());
    }
  }

  [[nodiscard]] std::vector<Box> world(std::size_t k) const {
    return {boxes.begin() + static_cast<std::ptrdiff_t>(begin[k]),
            boxes.begin() + static_cast<std::ptrdiff_t>(begin[k + 1])};
  }
};

TEST_P(WorldsApart, ByLessThanFloat32TellsGiveTheOraclesPairs) {
  const HairsApart scene(static_cast<unsigned>(GetParam().back()));
  const test::Corners<double> corners(scene.boxes);
  for (const BoxView& view : {BoxView(scene.boxes), corners.view()}) {
    for (const Order order : {Order::ByFirst, Order::BySecond}) {
      WorldsSearch search({.order = order, .instructionSet = GetParam()});
      const Worlds worlds(view, scene.begin);
      const WorldPairsView found = search.find(worlds);
      const std::vector<std::uint64_t> ends(found.begin.begin(), found.begin.end());
      for (std::size_t k = 0; k + 1 < scene.begin.size(); ++k) {
        ASSERT_THAT(found[k], ElementsAreArray(test::inOrder(test::oracle(scene.world(k)), order))) << "world " << k;
      }
      EXPECT_THAT(search.count(worlds), ElementsAreArray(ends));
    }
  }
}

/// Few boxes of one set are searched like a world, and their pairs given out part by part.
TEST_P(WorldsApart, ByLessThanFloat32TellsGiveTheOraclesPairsAlone) {
  const HairsApart scene(static_cast<unsigned>(GetParam().back()) + 2);
  for (std::size_t k = 0; k + 1 < scene.begin.size(); ++k) {
    const std::vector<Box> boxes = scene.world(k);
    const test::Corners<double> corners(boxes);
    const std::vector<Pair> expected = test::oracle(boxes);
    for (const Order order : {Order::ByFirst, Order::BySecond}) {
      const OverlapOptions options{.order = order, .instructionSet = GetParam()};
      ASSERT_THAT(overlaps(BoxView(boxes), options), ElementsAreArray(test::inOrder(expected, order))) << k;
      ASSERT_THAT(overlaps(corners.view(), options), ElementsAreArray(test::inOrder(expected, order))) << k;
    }
  }
}

/// The same of two sets, worlds mostly of the same scale.
TEST_P(WorldsApart, ByLessThanFloat32TellsGiveTheOraclesPairsOfTwoSets) {
  const HairsApart scene(static_cast<unsigned>(GetParam().back()) + 4);
  for (std::size_t k = 0; k + 2 < scene.begin.size(); ++k) {
    const std::vector<Box> first = scene.world(k);
    const std::vector<Box> second = scene.world(k + 1);
    const test::Corners<double> firstCorners(first);
    const test::Corners<double> secondCorners(second);
    const std::vector<Pair> expected = test::oracleBetween(first, second);
    for (const Order order : {Order::ByFirst, Order::BySecond}) {
      const OverlapOptions options{.strategy = Strategy::Exhaustive, .order = order, .instructionSet = GetParam()};
      const std::vector<Pair> inOrder = test::inOrder(expected, order);
      ASSERT_THAT(overlaps(BoxView(first), BoxView(second), options), ElementsAreArray(inOrder)) << k;
      ASSERT_THAT(overlaps(firstCorners.view(), BoxView(second), options), ElementsAreArray(inOrder)) << k;
      ASSERT_THAT(overlaps(firstCorners.view(), secondCorners.view(), options), ElementsAreArray(inOrder)) << k;
    }
  }
}

/// An only world of few boxes, on either side of how many are searched as a small one.
TEST_P(WorldsApart, ByLessThanFloat32TellsGiveTheOraclesPairsInAnOnlyWorld) {
  const HairsApart scene(static_cast<unsigned>(GetParam().back()) + 3);
  for (const std::size_t size : {100U, 128U, 129U, 192U, 193U, 320U}) {
    World world({.instructionSet = GetParam()});
    const std::vector<Box> added(scene.boxes.begin(), scene.boxes.begin() + static_cast<std::ptrdiff_t>(size));
    const std::vector<BoxId> ids = world.add(BoxView(added));
    ASSERT_THAT(world.step().pairs, ElementsAreArray(test::oracle(added))) << size;
    std::vector<Box> moved(scene.boxes.end() - static_cast<std::ptrdiff_t>(size), scene.boxes.end());
    world.move(ids, BoxView(moved));
    ASSERT_THAT(world.step().pairs, ElementsAreArray(test::oracle(moved))) << size;
    for (const std::size_t few : {1U, 5U, 24U}) {  // These are tested against all, if those are not too many.
      const std::vector<Box> again(added.begin(), added.begin() + static_cast<std::ptrdiff_t>(few));
      std::copy(again.begin(), again.end(), moved.begin());
      world.move(Span<const BoxId>(ids).first(few), BoxView(again));
      ASSERT_THAT(world.step().pairs, ElementsAreArray(test::oracle(moved))) << few << " of " << size;
    }
  }
}

/// The few that have moved have several parts of pairs.
TEST_P(WorldsApart, ByNothingGiveAllPairsWhenAFewMove) {
  for (const std::size_t size : {100U, 256U, 320U}) {
    std::vector<Box> boxes(size, test::cube(0, 0, 0));
    World world({.instructionSet = GetParam()});
    const std::vector<BoxId> ids = world.add(BoxView(boxes));
    ASSERT_EQ(world.step().pairs.size(), size * (size - 1) / 2);
    for (const std::size_t few : {size / 5, size / 4}) {
      for (std::size_t i = 0; i < few; ++i) boxes[3 * i].min[i % 3] -= 0.25;
      std::vector<BoxId> moved;
      for (std::size_t i = 0; i < few; ++i) moved.push_back(ids[3 * i]);
      std::vector<Box> bounds;
      for (std::size_t i = 0; i < few; ++i) bounds.push_back(boxes[3 * i]);
      world.move(moved, BoxView(bounds));
      const StepResult step = world.step();
      ASSERT_THAT(step.pairs, ElementsAreArray(test::oracle(boxes))) << few << " of " << size;
      ASSERT_TRUE(step.began.empty() && step.ended.empty()) << few << " of " << size;
    }
  }
}

TEST_P(WorldsApart, ByLessThanFloat32TellsGiveTheOraclesPairsInEachStep) {
  for (const Order order : {Order::ByFirst, Order::BySecond}) {
    World world({.order = order, .instructionSet = GetParam()});
    HairsApart scene(static_cast<unsigned>(GetParam().back()));
    std::vector<BoxProperties> properties(scene.boxes.size());
    for (std::size_t k = 0; k + 1 < scene.begin.size(); ++k) {
      for (std::uint64_t i = scene.begin[k]; i < scene.begin[k + 1]; ++i)
        properties[i].world = static_cast<std::uint32_t>(k);
    }
    std::vector<BoxId> ids(scene.boxes.size());
    world.add(BoxView(scene.boxes), properties, ids);
    for (unsigned step = 0; step < 3; ++step) {
      std::vector<Pair> expected;
      for (std::size_t k = 0; k + 1 < scene.begin.size(); ++k) {
        const auto first = static_cast<BoxId>(scene.begin[k]);
        for (const Pair& pair : test::oracle(scene.world(k)))
          expected.push_back({pair.first + first, pair.second + first});
      }
      ASSERT_THAT(world.step().pairs, ElementsAreArray(test::inOrder(expected, order))) << "step " << step;
      scene = HairsApart(1000 + step);
      world.move(ids, BoxView(scene.boxes));
    }
  }
}

/// In whatever direction the processor rounds.
TEST_P(WorldsApart, ByLessThanFloat32TellsGiveTheSameWhateverTheRounding) {
  const HairsApart scene(static_cast<unsigned>(GetParam().back()) + 1);
  WorldsSearch search({.instructionSet = GetParam()});
  const Worlds worlds(BoxView(scene.boxes), scene.begin);
  const WorldPairsView found = search.find(worlds);
  const std::vector<Pair> expected(found.pairs.begin(), found.pairs.end());
  for (const int direction : {FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO}) {
    ASSERT_EQ(std::fesetround(direction), 0);
    const Span<const Pair> pairs = search.find(worlds).pairs;
    ASSERT_EQ(std::fesetround(FE_TONEAREST), 0);
    EXPECT_THAT(pairs, ElementsAreArray(expected)) << direction;
  }
}

/// Searches of few boxes raise none, though larger ones may.
TEST_P(WorldsApart, ByMoreThanFloat32HasSignalNoOverflow) {
  const std::vector<Box> boxes(70, {{-1e300, -3e38, -test::kInfinity}, {1e300, 1e308, 1e39}});
  const std::vector<std::uint64_t> begin{0, 5, 70};
  WorldsSearch search({.instructionSet = GetParam()});
  std::feclearexcept(FE_ALL_EXCEPT);
  const std::size_t found = search.find(Worlds(BoxView(boxes), begin)).pairs.size();
  const std::size_t alone = overlaps(BoxView(boxes), {.instructionSet = GetParam()}).size();
  const std::size_t between = overlaps(BoxView(boxes), BoxView(boxes), {.instructionSet = GetParam()}).size();
  EXPECT_EQ(std::fetestexcept(FE_OVERFLOW | FE_DIVBYZERO), 0);
  EXPECT_EQ(found, 10U + 65U * 64U / 2);
  EXPECT_EQ(alone, 70U * 69U / 2);
  EXPECT_EQ(between, 70U * 70U);
}

/// They are read as they are; other boxes with the scalar kernels.
TEST_P(WorldsApart, OfFloat32GiveTheOraclesPairs) {
  auto seed = static_cast<unsigned>(GetParam().back());
  for (const std::size_t size : {3U, 50U, 64U, 100U}) {
    const std::vector<BoxF> boxes = test::randomBoxes(size, ++seed, 2.0F);
    ASSERT_NO_FATAL_FAILURE(expectPairs(BoxView(boxes), 0.0, test::oracle(test::toDouble(boxes))));
  }
}

}  // namespace
}  // namespace allpairs
