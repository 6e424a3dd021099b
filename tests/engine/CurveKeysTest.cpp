// SPDX-License-Identifier: MIT
// The keys of boxes along the curve, by what makes it Hilbert's: a step leads to a neighbour, and each part is such a
// curve.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "kernels/Kernels.h"

namespace allpairs::engine {
namespace {

using Cell = std::array<std::uint32_t, 3>;

/// Cells of a side of a half, from -10 on.
CurveGrid gridOf(unsigned bitsPerAxis) {
  CurveGrid grid;
  grid.bitsPerAxis = bitsPerAxis;
  grid.origin = {-10.0F, -10.0F, -10.0F};
  grid.scale = 2.0F;
  grid.largeExtent = 1.0F;
  return grid;
}

/// A box of that size, the same along all axes, around the centre of a cell.
LaneBox boxIn(const Cell& cell, float size = 0.25F) {
  LaneBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float centre = -9.75F + 0.5F * static_cast<float>(cell[axis]);
    box.bound[axis] = centre - 0.5F * size;
    box.bound[axis + 3] = centre + 0.5F * size;
  }
  return box;
}

class CurveKeys : public ::testing::TestWithParam<std::string_view> {
 protected:
  /// The keys of any number of boxes.
  [[nodiscard]] std::vector<std::uint32_t> keysOf(const std::vector<LaneBox>& boxes, const CurveGrid& grid) const {
    std::vector<LaneBlock> blocks((boxes.size() + kFanOut - 1) / kFanOut);
    for (LaneBlock& block : blocks) block.clear();
    for (std::size_t i = 0; i < boxes.size(); ++i) blocks[i / kFanOut].set(i % kFanOut, boxes[i]);
    std::vector<std::uint32_t> keys(blocks.size() * kFanOut);
    m_kernels.curveKeys(blocks, grid, keys.data());
    keys.resize(boxes.size());
    return keys;
  }

  [[nodiscard]] std::vector<std::uint32_t> keysOf(const std::vector<Cell>& cells, const CurveGrid& grid) const {
    std::vector<LaneBox> boxes;
    for (const Cell& cell : cells) boxes.push_back(boxIn(cell));
    return keysOf(boxes, grid);
  }

  const Kernels& m_kernels = *findKernels(GetParam());
};

INSTANTIATE_TEST_SUITE_P(EachInstructionSet, CurveKeys,
                         ::testing::ValuesIn(kernelNames().begin(), kernelNames().end()));

/// The cells of a cube of 2^bits along each axis.
std::vector<Cell> cube(const Cell& first, unsigned bits) {
  std::vector<Cell> cells;
  for (std::uint32_t i = 0; i < 1U << 3 * bits; ++i) {
    const std::uint32_t mask = (1U << bits) - 1;
    cells.push_back({first[0] + (i & mask), first[1] + (i >> bits & mask), first[2] + (i >> 2 * bits)});
  }
  return cells;
}

std::uint32_t stepsBetween(const Cell& a, const Cell& b) {
  std::uint32_t steps = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) steps += std::max(a[axis], b[axis]) - std::min(a[axis], b[axis]);
  return steps;
}

/// That the keys number the cells, from a multiple of how many there are on, and that each step leads to a neighbour.
void expectCurve(const std::vector<Cell>& cells, const std::vector<std::uint32_t>& keys) {
  std::vector<std::pair<std::uint32_t, Cell>> curve;
  for (std::size_t i = 0; i < cells.size(); ++i) curve.emplace_back(keys[i], cells[i]);
  std::sort(curve.begin(), curve.end());
  ASSERT_EQ(curve.front().first % cells.size(), 0U);
  for (std::size_t i = 1; i < curve.size(); ++i) {
    ASSERT_EQ(curve[i].first, curve[i - 1].first + 1);
    ASSERT_EQ(stepsBetween(curve[i].second, curve[i - 1].second), 1U) << "at key " << curve[i].first;
  }
}

TEST_P(CurveKeys, NumberTheCellsOfAGridFromNeighbourToNeighbour) {
  for (const unsigned bits : {1U, 2U, 3U, 4U}) {
    const std::vector<Cell> cells = cube({0, 0, 0}, bits);
    const std::vector<std::uint32_t> keys = keysOf(cells, gridOf(bits));
    EXPECT_EQ(*std::min_element(keys.begin(), keys.end()), 0U);
    expectCurve(cells, keys);
  }
}

TEST_P(CurveKeys, NumberAnyPartOfTheFinestGridFromNeighbourToNeighbour) {
  std::mt19937 generator(5);
  for (int i = 0; i < 30; ++i) {
    Cell first;
    for (std::uint32_t& place : first) place = static_cast<std::uint32_t>(generator() % 512 / 8 * 8);
    const std::vector<Cell> cells = cube(first, 3);
    expectCurve(cells, keysOf(cells, gridOf(CurveGrid::kMaxBitsPerAxis)));
  }
}

TEST_P(CurveKeys, BeginWithThoseOfACoarserGrid) {
  std::mt19937 generator(6);
  std::vector<Cell> cells(1000);
  for (Cell& cell : cells) {
    for (std::uint32_t& place : cell) place = static_cast<std::uint32_t>(generator() % 512);
  }
  std::vector<std::uint32_t> finer = keysOf(cells, gridOf(9));
  for (unsigned bits = 8; bits > 0; --bits) {
    for (Cell& cell : cells) {
      for (std::uint32_t& place : cell) place /= 2;
    }
    const std::vector<std::uint32_t> keys = keysOf(cells, gridOf(bits));
    for (std::size_t i = 0; i < cells.size(); ++i) ASSERT_EQ(keys[i], finer[i] / 8) << bits << " bits";
    finer = keys;
  }
}

TEST_P(CurveKeys, TakeTheAxesInTheOrderOfTheGrid) {
  const std::vector<Cell> cells = cube({0, 0, 0}, 3);
  const std::vector<std::uint32_t> keys = keysOf(cells, gridOf(3));
  std::array<std::uint32_t, 3> axes{0, 1, 2};
  do {
    CurveGrid grid = gridOf(3);
    grid.axes = axes;
    std::vector<Cell> turned(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) turned[i][axes[axis]] = cells[i][axis];
    }
    ASSERT_EQ(keysOf(turned, grid), keys);
  } while (std::next_permutation(axes.begin(), axes.end()));
}

TEST_P(CurveKeys, AlongALineAreThePlacesOnItsAxis) {
  std::vector<Cell> cells;
  for (std::uint32_t i = 0; i < 50; ++i) cells.push_back({7 * i % 512, 300 - i, 11 * i % 512});
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    CurveGrid grid = gridOf(9);
    grid.isLine = true;
    grid.axes = {(axis + 1) % 3, (axis + 2) % 3, axis};
    EXPECT_EQ(grid.classShift(), 9U);
    std::vector<std::uint32_t> expected;
    for (const Cell& cell : cells) expected.push_back(cell[axis]);
    ASSERT_EQ(keysOf(cells, grid), expected);
    ASSERT_EQ(keysOf({boxIn(cells[1], 30.0F)}, grid).front(), cells[1][axis] | 5U << 9U);  // a large one
  }
}

TEST_P(CurveKeys, OfBoxesOutsideTheGridAreThoseOfTheNearestCell) {
  const CurveGrid grid = gridOf(4);
  const std::vector<Cell> cells{{0, 3, 7}, {15, 3, 7}, {3, 0, 7}, {3, 15, 7}, {3, 7, 0}, {3, 7, 15}};
  std::vector<LaneBox> boxes;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    LaneBox box = boxIn(cells[i]);
    const float moved = i % 2 == 0 ? -1e30F : 1e30F;
    box.bound[i / 2] = moved;
    box.bound[i / 2 + 3] = moved;
    boxes.push_back(box);
  }
  EXPECT_EQ(keysOf(boxes, grid), keysOf(cells, grid));
}

TEST_P(CurveKeys, OfAnyNumberOfBlocksAreThoseOfEach) {
  const CurveGrid grid = gridOf(4);
  const std::vector<Cell> cells = cube({3, 5, 7}, 2);
  const std::vector<std::uint32_t> keys = keysOf(cells, grid);
  for (std::size_t size = 1; size <= cells.size(); ++size) {
    const std::vector<Cell> some(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(size));
    const std::vector<std::uint32_t> expected(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_EQ(keysOf(some, grid), expected) << size << " boxes";
  }
}

struct Classed {
  std::array<float, 3> extent;
  std::uint32_t classOf;
};

TEST_P(CurveKeys, OfLargeBoxesBeginWithTheirClass) {
  // Large is what is longer than 1 along any axis; long is what is more than three times as long as along the next.
  const std::vector<Classed> classed{{{1, 1, 1}, 0},
                                     {{0, 1, 0}, 0},
                                     {{1.25F, 0.25F, 0.25F}, 1},
                                     {{0.25F, 1.25F, 0.25F}, 2},
                                     {{0.25F, 0.25F, 1.25F}, 3},
                                     {{30, 10, 1}, 5},
                                     {{31, 10, 1}, 1},
                                     {{1, 31, 10}, 2},
                                     {{10, 1, 31}, 3},
                                     {{1.25F, 1, 1}, 4},
                                     {{1, 1.25F, 1}, 4},
                                     {{1, 1, 1.25F}, 4},
                                     {{8, 8, 8}, 4},
                                     {{8, 8.25F, 8}, 5},
                                     {{64, 64, 64}, 5},
                                     {{64, 64, 64.25F}, 6},
                                     {{500, 500, 500}, 6}};
  const CurveGrid grid = gridOf(5);
  EXPECT_EQ(grid.classShift(), 15U);
  for (const Cell& cell : {Cell{9, 10, 12}, Cell{12, 10, 9}}) {
    const std::uint32_t key = keysOf(std::vector<Cell>{cell}, grid).front();
    std::vector<LaneBox> boxes;
    std::vector<std::uint32_t> expected;
    for (const Classed& one : classed) {
      LaneBox box = boxIn(cell, 0.0F);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.bound[axis] -= 0.5F * one.extent[axis];
        box.bound[axis + 3] += 0.5F * one.extent[axis];
      }
      boxes.push_back(box);
      expected.push_back(one.classOf << 15U | key);
      // As the only one of its block that may be large, too.
      std::vector<LaneBox> block(kFanOut, boxIn(cell));
      block.back() = box;
      ASSERT_EQ(keysOf(block, grid).back(), expected.back()) << boxes.size() - 1;
    }
    EXPECT_EQ(keysOf(boxes, grid), expected);
  }
}

}  // namespace
}  // namespace allpairs::engine
