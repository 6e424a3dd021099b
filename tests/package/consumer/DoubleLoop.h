// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

// What the programs that are compiled as C++17 have in common.

/// minx miny minz maxx maxy maxz
using Row = std::array<float, 6>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Boxes with a few neighbors each, in other places each time.
inline std::vector<Row> someRows(std::size_t count, std::uint32_t seed) {
  std::vector<Row> rows(count);
  std::uint32_t state = seed;
  for (Row& row : rows) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      state = state * 1664525U + 1013904223U;
      row[axis] = static_cast<float>(state >> 24U) / 16.0F;
      row[3 + axis] = row[axis] + 2.0F;
    }
  }
  return rows;
}

/// The pairs that overlap, in order.
inline Pairs byDoubleLoop(const std::vector<Row>& rows) {
  Pairs pairs;
  for (std::size_t first = 0; first < rows.size(); ++first) {
    for (std::size_t second = first + 1; second < rows.size(); ++second) {
      bool isPair = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        isPair = isPair && rows[first][axis] <= rows[second][3 + axis] && rows[second][axis] <= rows[first][3 + axis];
      }
      if (isPair) pairs.emplace_back(first, second);
    }
  }
  return pairs;
}
