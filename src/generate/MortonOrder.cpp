// SPDX-License-Identifier: MIT
#include "MortonOrder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace allpairs::generate {

namespace {

constexpr double kCells = 2097152.0;  // 2^21: three times 21 bits are a key.

double centre(const std::vector<float>& rows, std::size_t box, std::size_t axis) {
  return 0.5 * (static_cast<double>(rows[6 * box + axis]) + static_cast<double>(rows[6 * box + 3 + axis]));
}

/// 21 bits, two free places after each.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | (bits << 32U)) & 0x001F00000000FFFFU;
  bits = (bits | (bits << 16U)) & 0x001F0000FF0000FFU;
  bits = (bits | (bits << 8U)) & 0x100F00F00F00F00FU;
  bits = (bits | (bits << 4U)) & 0x10C30C30C30C30C3U;
  return (bits | (bits << 2U)) & 0x1249249249249249U;
}

struct Grid {
  std::array<double, 3> origin{};
  double cellsPerLength = 0.0;

  [[nodiscard]] std::uint64_t key(const std::vector<float>& rows, std::size_t box) const {
    std::uint64_t result = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double cell = (centre(rows, box, axis) - origin[axis]) * cellsPerLength;
      result |= spread(static_cast<std::uint64_t>(std::clamp(cell, 0.0, kCells - 1.0))) << axis;
    }
    return result;
  }
};

Grid gridOver(const std::vector<float>& rows) {
  Grid grid;
  double longest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t box = 0; box < rows.size() / 6; ++box) {
      low = std::min(low, centre(rows, box, axis));
      high = std::max(high, centre(rows, box, axis));
    }
    grid.origin[axis] = low;
    longest = std::max(longest, high - low);
  }
  grid.cellsPerLength = longest > 0.0 ? kCells / longest : 0.0;
  return grid;
}

}  // namespace

std::vector<float> inMortonOrder(const std::vector<float>& rows) {
  const Grid grid = gridOver(rows);
  std::vector<std::pair<std::uint64_t, std::size_t>> order(rows.size() / 6);
  for (std::size_t box = 0; box < order.size(); ++box) order[box] = {grid.key(rows, box), box};
  std::sort(order.begin(), order.end());
  std::vector<float> result;
  result.reserve(rows.size());
  for (const auto& [key, box] : order) {
    const auto row = rows.begin() + static_cast<std::ptrdiff_t>(6 * box);
    result.insert(result.end(), row, row + 6);
  }
  return result;
}

}  // namespace allpairs::generate
