// SPDX-License-Identifier: MIT
// What a narrow phase says of solids made of cubes of a grid, whose faces lie on each other in every way: the relation
// of such solids can be told by their cells alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "FclExamine.h"
#include "Shapes.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

using Cell = std::array<int, 3>;

/// Cubes of a side, in multiples of a cell of the grid, anywhere on it.
struct Cubes {
  int side = 1;
  std::set<Cell> corners{};  ///< The least corner of each cube.
};

std::set<Cell> cellsOf(const Cubes& cubes) {
  std::set<Cell> cells;
  for (const auto& [x, y, z] : cubes.corners) {
    for (int i = 0; i < cubes.side * cubes.side * cubes.side; ++i) {
      cells.insert({x + i % cubes.side, y + i / cubes.side % cubes.side, z + i / cubes.side / cubes.side});
    }
  }
  return cells;
}

class FclSolids : public ::testing::Test {
 protected:
  int upTo(int most) { return std::uniform_int_distribution<int>(0, most)(m_random); }

  /// Some cubes of a block of three by three by two.
  Cubes someCubes() {
    Cubes cubes{.side = 1 + upTo(2)};
    const Cell at{upTo(4), upTo(4), upTo(4)};
    const int share = 1 + upTo(8);
    while (cubes.corners.empty()) {
      for (int i = 0; i < 18; ++i) {
        if (upTo(8) >= share) continue;
        cubes.corners.insert(
            {at[0] + cubes.side * (i % 3), at[1] + cubes.side * (i / 3 % 3), at[2] + cubes.side * (i / 9)});
      }
    }
    return cubes;
  }

  /// The same, with some cubes more or fewer, or none.
  Cubes nearly(Cubes cubes) {
    for (int i = upTo(2); i > 0; --i) {
      const auto any = std::next(cubes.corners.begin(), upTo(static_cast<int>(cubes.corners.size()) - 1));
      Cell beside = *any;
      beside[static_cast<std::size_t>(upTo(2))] += upTo(1) == 0 ? cubes.side : -cubes.side;
      if (upTo(1) == 0) {
        cubes.corners.insert(beside);
      } else if (cubes.corners.size() > 1) {
        cubes.corners.erase(any);
      }
    }
    return cubes;
  }

  /// The surface, two triangles for each square of it, whose diagonal lies either way.
  std::unique_ptr<TriangleModel> surfaceOf(const Cubes& cubes) {
    std::vector<Vec3> points;
    std::vector<TriangleModel::Triangle> triangles;
    for (const Cell& corner : cubes.corners) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int way : {-1, 1}) {
          Cell next = corner;
          next[axis] += way * cubes.side;
          if (cubes.corners.contains(next)) continue;
          const auto first = static_cast<std::uint32_t>(points.size());
          for (const auto& [u, v] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {  // counterclockwise from outside
            Vec3 point{double(corner[0]), double(corner[1]), double(corner[2])};
            if (way > 0) point[axis] += cubes.side;
            point[(axis + 1) % 3] += cubes.side * (way > 0 ? u : v);
            point[(axis + 2) % 3] += cubes.side * (way > 0 ? v : u);
            points.push_back(point);
          }
          const std::uint32_t turn = static_cast<std::uint32_t>(upTo(1));
          triangles.push_back({first + turn, first + 1 + turn, first + 2 + turn});
          triangles.push_back({first + turn, first + 2 + turn, first + (3 + turn) % 4});
        }
      }
    }
    return std::make_unique<TriangleModel>("cubes", points, triangles);
  }

  std::mt19937 m_random{20261127};
};

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

double distanceOf(const Cubes& first, const Cubes& second) {
  double least = 1e300;
  for (const Cell& a : first.corners) {
    for (const Cell& b : second.corners) {
      double square = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int gap = std::max({0, b[axis] - a[axis] - first.side, a[axis] - b[axis] - second.side});
        square += double(gap) * gap;
      }
      least = std::min(least, square);
    }
  }
  return std::sqrt(least);
}

ExactState stateOf(const Cubes& first, const Cubes& second) {
  const std::set<Cell> a = cellsOf(first);
  const std::set<Cell> b = cellsOf(second);
  if (a == b) return ExactState::Duplicate;
  if (std::ranges::includes(a, b) || std::ranges::includes(b, a)) return ExactState::Contained;
  if (std::ranges::any_of(a, [&](const Cell& cell) { return b.contains(cell); })) return ExactState::Clash;
  return distanceOf(first, second) == 0.0 ? ExactState::Touching : ExactState::Apart;
}

std::string textOf(const Cubes& cubes) {
  std::string text = "side " + std::to_string(cubes.side) + ':';
  for (const auto& [x, y, z] : cubes.corners) {
    text += ' ' + std::to_string(x) + ',' + std::to_string(y) + ',' + std::to_string(z);
  }
  return text;
}

TEST_F(FclSolids, StatesAndDistancesAreThoseOfTheirCells) {
  std::array<int, kExactStates> seen{};
  for (int i = 0; i < repeats(1200); ++i) {
    const Cubes first = someCubes();
    const Cubes second = i % 3 == 0 ? nearly(first) : someCubes();
    const std::string text = textOf(first) + '\n' + textOf(second) + '\n' + std::to_string(i);
    auto a = surfaceOf(first);
    auto b = surfaceOf(second);
    double scale = 1.0;
    if (i % 2 == 1) {  // numbers that are rounded
      const double angle = 0.1 * i;
      scale = std::pow(10.0, i % 7 - 3);
      a = turned(*a, angle, scale);
      b = turned(*b, angle, scale);
    }
    const ExactPair pair = examine(*a, *b);
    const ExactState expected = stateOf(first, second);
    ++seen[static_cast<std::size_t>(expected)];
    ASSERT_EQ(stateName(pair.state), stateName(expected)) << text;
    ASSERT_NEAR(pair.distance, scale * distanceOf(first, second), scale * 1e-9) << text;
    if (expected == ExactState::Contained) {
      const std::set<Cell> outer = cellsOf(second);
      const std::set<Cell> inner = cellsOf(first);
      ASSERT_EQ(pair.isFirstInner, std::ranges::includes(outer, inner)) << text;
    }
    if (isClash(expected) && expected != ExactState::Duplicate) {
      ASSERT_GE(pair.depth.value_or(0.0), 0.125 * scale) << text;
      ASSERT_NEAR(distance(pair.pointOnFirst, pair.pointOnSecond), *pair.depth, scale * 1e-9) << text;
    }
  }
  for (const ExactState state :
       {ExactState::Duplicate, ExactState::Contained, ExactState::Clash, ExactState::Touching, ExactState::Apart}) {
    EXPECT_GT(seen[static_cast<std::size_t>(state)], repeats(100)) << stateName(state);
  }
}

}  // namespace
}  // namespace allpairs::test
