// SPDX-License-Identifier: MIT
// Sixteen boxes from the caller's memory as lanes: from wherever they lie, rounded outward or to the nearest, relative
// to an origin, and widened.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "kernels/Kernels.h"

namespace allpairs::engine {
namespace {

constexpr float kMost = std::numeric_limits<float>::max();

/// Sixteen boxes: minx miny minz maxx maxy maxz.
using SixteenBoxes = std::array<std::array<double, 6>, kFanOut>;

/// Where the bounds of a box are in its record, and how many values on the next box begins.
struct Arrangement {
  std::array<std::size_t, 6> place;
  std::size_t stride;
};

/// Rows of six and others that resemble them.
constexpr std::array<Arrangement, 15> kArrangements{{
    {{0, 1, 2, 3, 4, 5}, 6},
    {{0, 1, 2, 3, 4, 5}, 7},
    {{1, 2, 3, 4, 5, 6}, 8},
    {{0, 1, 2, 4, 5, 6}, 8},
    {{0, 1, 2, 48, 49, 50}, 3},
    {{0, 1, 2, 64, 65, 66}, 4},
    {{3, 4, 5, 0, 1, 2}, 6},
    {{0, 2, 4, 1, 3, 5}, 6},
    {{0, 1, 3, 4, 5, 6}, 7},
    {{0, 2, 3, 4, 5, 6}, 7},
    {{0, 1, 2, 3, 4, 6}, 7},
    {{0, 1, 3, 4, 5, 7}, 8},
    {{1, 0, 3, 5, 4, 7}, 8},
    {{0, 4, 2, 5, 3, 7}, 8},
    {{0, 16, 32, 48, 64, 80}, 1},
}};

/// The boxes in that arrangement, in reverse order, in an array that ends with the last of their values.
template <class T>
class Arranged {
 public:
  Arranged(const SixteenBoxes& boxes, const Arrangement& arrangement) {
    const std::size_t last = *std::max_element(arrangement.place.begin(), arrangement.place.end());
    m_values.resize((kFanOut - 1) * arrangement.stride + last + 1);
    for (std::size_t k = 0; k < 6; ++k) m_places.bound[k] = m_values.data() + arrangement.place[k];
    for (std::size_t i = 0; i < kFanOut; ++i) {
      const std::size_t from = (kFanOut - 1 - i) * arrangement.stride;
      m_places.offset[i] = static_cast<std::int32_t>(from);
      for (std::size_t k = 0; k < 6; ++k) m_values[from + arrangement.place[k]] = static_cast<T>(boxes[i][k]);
    }
  }

  [[nodiscard]] const BoxPlaces<T>& places() const { return m_places; }

 private:
  std::vector<T> m_values;
  BoxPlaces<T> m_places;
};

/// The greatest float32 that is not above, of the finite ones.
float below(double value) {
  float result = static_cast<float>(std::clamp(value, -static_cast<double>(kMost), static_cast<double>(kMost)));
  if (static_cast<double>(result) > value) result = std::nextafter(result, -kMost);
  return result;
}

float lane(const LaneBlock& block, std::size_t bound, std::size_t i) { return block.bound[bound][i]; }

/// That the lanes are the boxes rounded outward, and that what is said of them is true.
void expectRounded(const SixteenBoxes& boxes, const LaneBlock& block, const BlockRead& read) {
  bool exact = true;
  std::uint32_t empty = 0;
  for (std::size_t i = 0; i < kFanOut; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double min = boxes[i][axis];
      const double max = boxes[i][axis + 3];
      ASSERT_EQ(lane(block, axis, i), below(min)) << "box " << i << ", axis " << axis << ": " << min;
      ASSERT_EQ(lane(block, axis + 3, i), -below(-max)) << "box " << i << ", axis " << axis << ": " << max;
      exact = exact && static_cast<double>(below(min)) == min && static_cast<double>(-below(-max)) == max;
      if (min > max) empty |= 1U << i;
    }
  }
  ASSERT_EQ(read.exact, exact);
  ASSERT_EQ(read.emptyLanes, empty);
}

/// Boxes whose bounds are some of these numbers, a few of them empty.
class AnyBoxes {
 public:
  explicit AnyBoxes(std::vector<double> numbers) : m_numbers(std::move(numbers)) {}

  SixteenBoxes next() {
    SixteenBoxes boxes;
    for (auto& box : boxes) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto [min, max] = std::minmax({number(), number()});
        box[axis] = min;
        box[axis + 3] = max;
        if (m_random() % 12 == 0) std::swap(box[axis], box[axis + 3]);
      }
    }
    return boxes;
  }

 private:
  double number() { return m_numbers[m_random() % m_numbers.size()]; }

  std::vector<double> m_numbers;
  std::mt19937 m_random{8};
};

std::vector<double> exactNumbers() {
  return {0.0, 1.0, -1.0, 0.5, -0.5, 3.25, -7.75, 1e6, -1e6, 0x1p-149, -0x1p-149, 0x1p127, -0x1p127};
}

/// The exact numbers, both infinities, which become the largest finite float32, and that one: often, so that they meet.
std::vector<double> numbersOfFloats() {
  std::vector<double> numbers = exactNumbers();
  for (int times = 0; times < 3; ++times) {
    for (const double sign : {1.0, -1.0}) {
      numbers.push_back(sign * std::numeric_limits<double>::infinity());
      numbers.push_back(sign * static_cast<double>(kMost));
    }
  }
  return numbers;
}

/// Those and some that no float32 holds.
std::vector<double> numbersOfDoubles() {
  std::vector<double> numbers = numbersOfFloats();
  for (const double value : {0.1, 1.0 / 3.0, 16777217.0, 1e-46, 5e-324, 1e-40, 3.5e38, 1e300, 1.0 + 0x1p-30}) {
    numbers.push_back(value);
    numbers.push_back(-value);
  }
  return numbers;
}

class ReadLanes : public ::testing::TestWithParam<std::string_view> {
 protected:
  const Kernels& m_kernels = *findKernels(GetParam());
};

INSTANTIATE_TEST_SUITE_P(EachInstructionSet, ReadLanes,
                         ::testing::ValuesIn(kernelNames().begin(), kernelNames().end()));

TEST_P(ReadLanes, OfFloat32AreThoseWhereverTheyLie) {
  for (const bool areLanes : {true, false}) {
    AnyBoxes any(areLanes ? exactNumbers() : numbersOfFloats());
    for (int round = 0; round < 60; ++round) {
      const SixteenBoxes boxes = any.next();
      for (const Arrangement& arrangement : kArrangements) {
        const Arranged<float> arranged(boxes, arrangement);
        LaneBlock block;
        const BlockRead read = m_kernels.readFloat32(arranged.places(), block);
        ASSERT_NO_FATAL_FAILURE(expectRounded(boxes, block, read)) << &arrangement - kArrangements.data();
        const BlockRead wide = m_kernels.readWide32(arranged.places(), {}, block);
        ASSERT_NO_FATAL_FAILURE(expectRounded(boxes, block, wide)) << &arrangement - kArrangements.data();
      }
      std::vector<float> rows;
      for (const auto& box : boxes) {
        for (const double bound : box) rows.push_back(static_cast<float>(bound));
      }
      LaneBlock block;
      const BlockRead read = m_kernels.readRun32(rows.data(), block);
      ASSERT_NO_FATAL_FAILURE(expectRounded(boxes, block, read));
    }
  }
}

TEST_P(ReadLanes, OfFloat64AreRoundedOutwardWhereverTheyLie) {
  for (const bool areLanes : {true, false}) {
    AnyBoxes any(areLanes ? exactNumbers() : numbersOfDoubles());
    for (int round = 0; round < 60; ++round) {
      const SixteenBoxes boxes = any.next();
      for (const Arrangement& arrangement : kArrangements) {
        const Arranged<double> arranged(boxes, arrangement);
        LaneBlock block;
        const BlockRead read = m_kernels.readWide64(arranged.places(), {}, block);
        ASSERT_NO_FATAL_FAILURE(expectRounded(boxes, block, read)) << &arrangement - kArrangements.data();
      }
    }
  }
}

/// The nearest float32 to sixteen boxes relative to an origin.
void expectNearest(const SixteenBoxes& boxes, const Widening& nearest, const LaneBlock& block, const BlockRead& read) {
  bool exact = true;
  std::uint32_t empty = 0;
  const auto most = static_cast<double>(kMost);
  for (std::size_t i = 0; i < kFanOut; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      const double bound = boxes[i][k] - nearest.origin[k % 3];
      const auto expected = static_cast<float>(std::clamp(bound, -most, most));
      ASSERT_EQ(block.bound[k][i], expected) << bound;
      exact &= static_cast<double>(expected) == bound;
      if (k < 3 && boxes[i][k] > boxes[i][k + 3]) empty |= 1U << i;
    }
  }
  ASSERT_EQ(read.exact, exact);
  ASSERT_EQ(read.emptyLanes, empty);
}

TEST_P(ReadLanes, OfFloat64AreTheNearestWhereThatIsAskedForWhereverTheyLie) {
  AnyBoxes any(numbersOfDoubles());
  AnyBoxes anyFloats(numbersOfFloats());
  for (int round = 0; round < 60; ++round) {
    const SixteenBoxes boxes = any.next();
    const SixteenBoxes floats = anyFloats.next();
    Widening nearest{{round % 2 == 0 ? 0.0 : 0.3, 0.0, round % 3 == 0 ? 0.0 : 1e7}};
    nearest.toNearest = true;
    for (const Arrangement& arrangement : kArrangements) {
      LaneBlock block;
      BlockRead read = m_kernels.readWide64(Arranged<double>(boxes, arrangement).places(), nearest, block);
      ASSERT_NO_FATAL_FAILURE(expectNearest(boxes, nearest, block, read));
      read = m_kernels.readWide32(Arranged<float>(floats, arrangement).places(), nearest, block);
      ASSERT_NO_FATAL_FAILURE(expectNearest(floats, nearest, block, read));
    }
  }
}

TEST_P(ReadLanes, OneBoundThatIsNoLaneMakesABlockInexact) {
  SixteenBoxes boxes;
  boxes.fill({-1, -2, -3, 1, 2, 3});
  for (std::size_t k = 0; k < 6 * kFanOut; ++k) {
    double& bound = boxes[k / 6][k % 6];
    const double before = bound;
    LaneBlock block;
    bound = k % 6 < 3 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    const Arranged<float> arranged(boxes, kArrangements[0]);
    ASSERT_FALSE(m_kernels.readFloat32(arranged.places(), block).exact);
    ASSERT_FALSE(m_kernels.readRun32(arranged.places().bound[0], block).exact);
    bound = before + 1e-9;
    ASSERT_FALSE(m_kernels.readWide64(Arranged<double>(boxes, kArrangements[0]).places(), {}, block).exact);
    bound = before;
  }
}

TEST_P(ReadLanes, OfBoxesRelativeToAnOriginAreTheirDifferences) {
  AnyBoxes any({0.0, 1.0, -1.0, 0.125, 1e5, -1e5, 77.5});
  for (int round = 0; round < 20; ++round) {
    SixteenBoxes boxes = any.next();
    const SixteenBoxes moved = boxes;
    const Widening relative{{1000.5, -3.0, 0x1p40}};
    for (auto& box : boxes) {
      for (std::size_t k = 0; k < 6; ++k) box[k] += relative.origin[k % 3];
    }
    LaneBlock block;
    const BlockRead read = m_kernels.readWide64(Arranged<double>(boxes, kArrangements[0]).places(), relative, block);
    ASSERT_NO_FATAL_FAILURE(expectRounded(moved, block, read));
  }
}

/// Whether a lane differs from a number by no more than roundings do.
bool isClose(float lane, double exact, double magnitude) {
  const double most = std::abs(exact) * 0x1p-22 + magnitude * 0x1p-40 + 0x1p-148;
  return std::abs(static_cast<double>(lane) - exact) <= most;
}

TEST_P(ReadLanes, OfWidenedBoxesContainThemAndHardlyMore) {
  AnyBoxes any({0.0, 1.0, -1.0, 0.1, -0.3, 1e5, -1e5, 77.7, 1e-30, 0x1p-52, -0x1p-52, 1.0 + 0x1p-52, -1.0 - 0x1p-52,
                1e20, -1e20});
  std::mt19937 generator(4);
  static constexpr std::array<double, 5> kHalves{0.0, 0.3, 0.6, -1.0, -1.0};
  for (int round = 0; round < 100; ++round) {
    const SixteenBoxes boxes = any.next();
    std::array<double, kFanOut> margins;
    for (double& margin : margins)
      margin = static_cast<double>(generator() % 5) * 0.7 - 0.7 * static_cast<double>(round % 2);
    Widening widening{{0.0, 12.5, -0.1}, true, kHalves[generator() % kHalves.size()], margins.data()};
    if (round % 4 == 0) widening.margins = nullptr;
    LaneBlock block;
    const BlockRead read = m_kernels.readWide64(Arranged<double>(boxes, kArrangements[0]).places(), widening, block);
    ASSERT_FALSE(read.exact);
    for (std::size_t i = 0; i < kFanOut; ++i) {
      const double wide = widening.half + (widening.margins != nullptr ? margins[i] : 0.0);
      bool isEmpty = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double min = boxes[i][axis] - wide - widening.origin[axis];
        const double max = boxes[i][axis + 3] + wide - widening.origin[axis];
        const double magnitude = std::abs(boxes[i][axis]) + std::abs(boxes[i][axis + 3]) + 20.0;
        const float low = lane(block, axis, i);
        const float high = lane(block, axis + 3, i);
        ASSERT_TRUE(isClose(low, std::min(min, max), magnitude)) << low << ": " << min << " to " << max;
        ASSERT_TRUE(isClose(high, std::max(min, max), magnitude)) << high << ": " << min << " to " << max;
        // What a margin has turned over may be smaller: it overlaps only what holds all that is between its bounds.
        ASSERT_TRUE(min > max || (static_cast<double>(low) <= min && static_cast<double>(high) >= max));
        isEmpty = isEmpty || boxes[i][axis] > boxes[i][axis + 3];
      }
      ASSERT_EQ(read.emptyLanes >> i & 1U, isEmpty ? 1U : 0U);
    }
  }
}

}  // namespace
}  // namespace allpairs::engine
