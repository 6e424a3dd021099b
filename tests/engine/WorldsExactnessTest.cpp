// SPDX-License-Identifier: MIT
// Worlds of few boxes that are apart by just the distance and their margins, or by a hair more: the sum depends on the
// order in which it is added, which is that of their ids whatever the order of the pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/Worlds.h"
#include "support/Boxes.h"
#include "support/Oracle.h"

namespace allpairs {
namespace {

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
