// SPDX-License-Identifier: MIT
// One query against the sixteen boxes of a block, on a grid on which float32 is exact: what the kernels say is then
// known to the last lane.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "kernels/Kernels.h"

namespace allpairs::engine {
namespace {

using Point = std::array<double, 3>;

/// A box on the grid, and as lanes.
struct GridBox {
  Point min;
  Point max;

  [[nodiscard]] LaneBox lanes() const {
    LaneBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.bound[axis] = static_cast<float>(min[axis]);
      box.bound[axis + 3] = static_cast<float>(max[axis]);
    }
    return box;
  }
};

/// Multiples of an eighth up to four, of both signs.
class GridNumbers {
 public:
  std::size_t below(std::size_t n) { return m_random() % n; }
  double any() { return static_cast<double>(below(65)) / 8.0 - 4.0; }
  Point point() { return {any(), any(), any()}; }

  GridBox box() {
    GridBox result{point(), point()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.max[axis] = std::min(result.max[axis], result.min[axis] + 3.0);
      if (result.max[axis] < result.min[axis]) std::swap(result.min[axis], result.max[axis]);
    }
    return result;
  }

 private:
  std::mt19937 m_random{3};
};

class QueryLanes : public ::testing::TestWithParam<std::string_view> {
 protected:
  /// Fills the block with boxes, and leaves some of the last lanes without one.
  void fill() {
    m_block.clear();
    m_size = kFanOut - m_numbers.below(4);
    for (std::size_t lane = 0; lane < m_size; ++lane) {
      m_boxes[lane] = m_numbers.box();
      m_block.set(lane, m_boxes[lane].lanes());
    }
  }

  /// A bit for each box of the block of which that is true.
  template <class Is>
  std::uint32_t bitsOf(const Is& is) const {
    std::uint32_t bits = 0;
    for (std::size_t lane = 0; lane < m_size; ++lane) bits |= (is(m_boxes[lane]) ? 1U : 0U) << lane;
    return bits;
  }

  const Kernels& m_kernels = *findKernels(GetParam());
  GridNumbers m_numbers;
  LaneBlock m_block;
  std::array<GridBox, kFanOut> m_boxes;
  std::size_t m_size = 0;
};

INSTANTIATE_TEST_SUITE_P(EachInstructionSet, QueryLanes,
                         ::testing::ValuesIn(kernelNames().begin(), kernelNames().end()));

/// Whether a number is a lower bound of another that is hardly below it.
bool isCloseBelow(float bound, double exact) {
  const auto value = static_cast<double>(bound);
  return value <= exact && value >= exact - exact * 0x1p-17 - 1e-35;
}

TEST_P(QueryLanes, ABoxTouchesThoseThatItOverlaps) {
  std::size_t touched = 0;
  for (int round = 0; round < 300; ++round) {
    fill();
    const GridBox query = m_numbers.box();
    const std::uint32_t expected = bitsOf([&](const GridBox& box) {
      bool overlaps = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        overlaps = overlaps && query.min[axis] <= box.max[axis] && box.min[axis] <= query.max[axis];
      }
      return overlaps;
    });
    ASSERT_EQ(m_kernels.touchingLanes(m_block, query.lanes()), expected) << "round " << round;
    touched += expected != 0 ? 1U : 0U;
  }
  EXPECT_GT(touched, 100U);
}

TEST_P(QueryLanes, VisitsFindInTheirOrderWhatEachBoxTouchesInItsBlock) {
  std::size_t touched = 0;
  for (std::size_t round = 0; round < 300; ++round) {
    std::array<LaneBlock, 3> blocks;
    for (LaneBlock& block : blocks) {
      fill();
      block = m_block;
    }
    std::array<LaneBox, 5> boxes;
    for (LaneBox& box : boxes) box = m_numbers.box().lanes();
    std::vector<std::uint32_t> boxOf(round % 20);
    std::vector<std::uint32_t> blockOf(round % 20);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;
    for (std::size_t i = 0; i < boxOf.size(); ++i) {
      boxOf[i] = static_cast<std::uint32_t>(m_numbers.below(boxes.size()));
      blockOf[i] = static_cast<std::uint32_t>(m_numbers.below(blocks.size()));
      forEachBit(m_kernels.touchingLanes(blocks[blockOf[i]], boxes[boxOf[i]]),
                 [&](std::size_t lane) { expected.emplace_back(boxOf[i], blockOf[i] * kFanOut + lane); });
    }
    std::vector<std::uint32_t> foundBox(boxOf.size() * kFanOut + kVectorSlack);
    std::vector<std::uint32_t> places(foundBox.size());
    const BlockVisits visits{boxes.data(), blocks.data(), boxOf.data(), blockOf.data(), boxOf.size()};
    const std::size_t size = m_kernels.touchingPlaces(visits, foundBox.data(), places.data());
    ASSERT_EQ(size, expected.size()) << "round " << round;
    for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(std::pair(foundBox[i], places[i]), expected[i]) << round;
    touched += size;
  }
  EXPECT_GT(touched, 1000U);
}

/// Cells of a quarter or a half over a part of the grid, of which some are marked; on some axes there is only one.
struct GridCells {
  std::array<double, 3> origin;
  double scale;
  std::array<int, 3> count;
  std::vector<std::uint32_t> marks;

  explicit GridCells(GridNumbers& numbers)
      : origin(numbers.point()), scale(numbers.below(2) == 0 ? 2.0 : 4.0), count(), marks(256, 0) {
    for (int& cells : count) cells = 1 + static_cast<int>(numbers.below(20) * numbers.below(2));
    for (std::uint32_t& word : marks) {
      for (unsigned bit = 0; bit < 32; ++bit) word |= (numbers.below(3) == 0 ? 1U : 0U) << bit;
    }
  }

  [[nodiscard]] MarkedCells cells() const {
    MarkedCells result;
    for (std::size_t axis = 0; axis < 3; ++axis) result.origin[axis] = static_cast<float>(origin[axis]);
    for (std::size_t axis = 0; axis < 3; ++axis) result.count[axis] = count[axis];
    result.scale = static_cast<float>(scale);
    result.marks = marks.data();
    return result;
  }

  [[nodiscard]] int cellOf(double bound, std::size_t axis) const {
    return std::clamp(static_cast<int>(std::floor((bound - origin[axis]) * scale)), 0, count[axis] - 1);
  }

  [[nodiscard]] bool mayTouch(const GridBox& box) const {
    std::size_t number = 0;
    bool isLong = false;
    for (const std::size_t axis : {2U, 1U, 0U}) {
      const int first = cellOf(box.min[axis], axis);
      number = number * static_cast<std::size_t>(count[axis]) + static_cast<std::size_t>(first);
      isLong = isLong || cellOf(box.max[axis], axis) > first + 1;
    }
    return isLong || (marks[number / 32] >> (number % 32) & 1U) != 0;
  }
};

TEST_P(QueryLanes, ABoxMayTouchWhatIsInAMarkedCellOrIsLongerThanTwoCells) {
  std::size_t far = 0;
  for (int round = 0; round < 1000; ++round) {
    fill();
    const GridCells cells(m_numbers);
    const std::uint32_t expected = bitsOf([&](const GridBox& box) { return cells.mayTouch(box); });
    ASSERT_EQ(m_kernels.markedLanes(m_block, cells.cells()) & ((1U << m_size) - 1U), expected) << "round " << round;
    for (std::size_t lane = 0; lane < m_size; ++lane) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double min = m_boxes[lane].min[axis];
        ASSERT_EQ(cells.cells().cellOf(static_cast<float>(min), axis), cells.cellOf(min, axis));
      }
    }
    far += m_size - static_cast<std::size_t>(std::popcount(expected));
  }
  EXPECT_GT(far, 1000U);
}

/// A box that moves by a power of two along each axis, rests on it, or is tested on the others only.
struct GridSweep {
  GridBox box;
  Point motion;
  std::array<bool, 3> isBounded;

  [[nodiscard]] SweepLanes lanes() const {
    using Axis = SweepLanes::Axis;
    const LaneBox from = box.lanes();
    SweepLanes result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.min[axis] = from.bound[axis];
      result.max[axis] = from.bound[axis + 3];
      const double speed = std::max(motion[axis], -motion[axis]);
      if (speed != 0.0) result.inverse[axis] = static_cast<float>(1.0 / speed);
      const Axis moves = motion[axis] > 0.0 ? Axis::Forward : Axis::Backward;
      result.axis[axis] = !isBounded[axis] ? Axis::Unbounded : speed == 0.0 ? Axis::Rests : moves;
    }
    return result;
  }

  /// The first time at which it overlaps the box, if any up to the limit; else it is infinite.
  [[nodiscard]] double meets(const GridBox& other, double limit) const {
    constexpr double kNotAtAll = std::numeric_limits<double>::infinity();
    double from = 0.0;
    double to = limit;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!isBounded[axis]) continue;
      const double ahead = other.min[axis] - box.max[axis];
      const double behind = other.max[axis] - box.min[axis];
      if (motion[axis] == 0.0) {
        if (ahead > 0.0 || behind < 0.0) return kNotAtAll;
      } else {
        from = std::max(from, std::min(ahead / motion[axis], behind / motion[axis]));
        to = std::min(to, std::max(ahead / motion[axis], behind / motion[axis]));
      }
    }
    return from <= to ? from : kNotAtAll;
  }
};

TEST_P(QueryLanes, ASweepMeetsThoseInItsWayNotBeforeTheTimeSaid) {
  static constexpr std::array<double, 7> kSpeeds{0.0, 0.5, -0.5, 1.0, -1.0, 4.0, -4.0};
  std::size_t met = 0;
  for (int round = 0; round < 1000; ++round) {
    fill();
    GridSweep sweep{m_numbers.box(), {}, {}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sweep.motion[axis] = kSpeeds[m_numbers.below(kSpeeds.size())];
      sweep.isBounded[axis] = m_numbers.below(8) != 0;
    }
    const double limit = 4.0 + m_numbers.any();
    const std::uint32_t expected = bitsOf([&](const GridBox& box) { return sweep.meets(box, limit) <= limit; });
    std::array<float, kFanOut> times;
    const std::uint32_t bits = m_kernels.meetingLanes(m_block, sweep.lanes(), static_cast<float>(limit), times.data());
    ASSERT_EQ(bits, expected) << "round " << round;
    for (std::size_t lane = 0; lane < m_size; ++lane) {
      if ((bits >> lane & 1U) == 0) continue;
      ASSERT_TRUE(isCloseBelow(times[lane], sweep.meets(m_boxes[lane], limit))) << times[lane] << " in " << round;
      ASSERT_GE(times[lane], 0.0F);
      ++met;
    }
  }
  EXPECT_GT(met, 1000U);
}

TEST_P(QueryLanes, APointThatOnlyGrazesAnEdgeMeetsIt) {
  static constexpr std::array<double, 6> kSpeeds{3.0, 5.0, 7.0, 9.0, 11.0, 13.0};
  for (const double ahead : kSpeeds) {
    for (const double aside : kSpeeds) {
      m_block.clear();
      m_size = kFanOut;
      for (std::size_t lane = 0; lane < m_size; ++lane) {
        // At this time the point is where the box begins on the first axis and ends on the second.
        const double time = static_cast<double>(1 + m_numbers.below(1000)) / 8.0;
        m_boxes[lane] = {{ahead * time, -1.0, 0.0}, {ahead * time + 1.0, aside * time, 0.0}};
        m_block.set(lane, m_boxes[lane].lanes());
      }
      SweepLanes sweep{{}, {}, {}, {SweepLanes::Axis::Forward, SweepLanes::Axis::Forward, SweepLanes::Axis::Rests}};
      sweep.inverse = {static_cast<float>(1.0 / ahead), static_cast<float>(1.0 / aside), 0.0F};
      std::array<float, kFanOut> times;
      const std::uint32_t bits = m_kernels.meetingLanes(m_block, sweep, 1000.0F, times.data());
      ASSERT_EQ(bits, 0xFFFFU) << ahead << ' ' << aside;
      for (std::size_t lane = 0; lane < m_size; ++lane) {
        ASSERT_TRUE(isCloseBelow(times[lane], m_boxes[lane].min[0] / ahead)) << times[lane];
      }
    }
  }
}

double squaredDistance(const Point& point, const GridBox& box) {
  double sum = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double apart = std::max({box.min[axis] - point[axis], point[axis] - box.max[axis], 0.0});
    sum += apart * apart;
  }
  return sum;
}

TEST_P(QueryLanes, APointIsNearThoseWithinTheLimit) {
  std::size_t near = 0;
  for (int round = 0; round < 1000; ++round) {
    fill();
    const Point point = m_numbers.point();
    // Every second limit is the distance of one of the boxes.
    double limit = 8.0 + 2.0 * m_numbers.any();
    if (round % 2 == 0) limit = squaredDistance(point, m_boxes[m_numbers.below(m_size)]);
    const std::uint32_t expected = bitsOf([&](const GridBox& box) { return squaredDistance(point, box) <= limit; });
    std::array<float, kFanOut> squares;
    const std::uint32_t bits =
        m_kernels.nearLanes(m_block, GridBox{point, point}.lanes(), static_cast<float>(limit), squares.data());
    ASSERT_EQ(bits, expected) << "round " << round;
    for (std::size_t lane = 0; lane < m_size; ++lane) {
      if ((bits >> lane & 1U) == 0) continue;
      ASSERT_TRUE(isCloseBelow(squares[lane], squaredDistance(point, m_boxes[lane]))) << squares[lane];
      ASSERT_GE(squares[lane], 0.0F);
      ++near;
    }
  }
  EXPECT_GT(near, 1000U);
}

TEST_P(QueryLanes, TheCheapestIsTheFirstOfTheLeastThatAreAsked) {
  for (int round = 0; round < 2000; ++round) {
    std::array<float, kFanOut> costs;
    for (float& cost : costs) cost = static_cast<float>(m_numbers.below(round % 2 == 0 ? 8 : 1000)) * 0.25F;
    costs[m_numbers.below(kFanOut)] = kNever;
    const auto lanes = static_cast<std::uint32_t>(1 + m_numbers.below((1U << kFanOut) - 1));
    std::size_t expected = kFanOut;
    for (std::size_t lane = 0; lane < kFanOut; ++lane) {
      if ((lanes >> lane & 1U) == 0) continue;
      if (expected == kFanOut || costs[lane] < costs[expected]) expected = lane;
    }
    ASSERT_EQ(m_kernels.cheapestLane(lanes, costs.data()), expected) << "round " << round;
  }
}

}  // namespace
}  // namespace allpairs::engine
