// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "sofa/mesh/Math.h"

namespace allpairs::scene::sofa {

/// A point or a cell of a grid, by its numbers along x, y and z; or how many of them there are.
using GridPlace = std::array<std::size_t, 3>;

[[nodiscard]] constexpr GridPlace operator+(const GridPlace& a, const GridPlace& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// From the lowest corner of a cell to each of its corners, in the order of a hexahedron.
inline constexpr std::array<GridPlace, 8> kCellCorners{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};

/// The number of a place, row by row along x.
[[nodiscard]] constexpr std::size_t indexOf(const GridPlace& place, const GridPlace& count) {
  return place[0] + count[0] * (place[1] + count[1] * place[2]);
}

/// Visits all places in the order of their numbers.
template <class Visit>
void forAllPlaces(const GridPlace& count, const Visit& visit) {
  for (std::size_t z = 0; z < count[2]; ++z)
    for (std::size_t y = 0; y < count[1]; ++y)
      for (std::size_t x = 0; x < count[0]; ++x) visit(GridPlace{x, y, z});
}

/// The shape of a grid whose axes are those of space.
struct GridShape {
  GridPlace points{2, 2, 2};
  Vec3 origin{};
  Vec3 spacing{};

  [[nodiscard]] bool isVolume() const { return points[0] > 1 && points[1] > 1 && points[2] > 1; }
  [[nodiscard]] Vec3 point(const GridPlace& p) const {
    return {origin[0] + spacing[0] * static_cast<double>(p[0]), origin[1] + spacing[1] * static_cast<double>(p[1]),
            origin[2] + spacing[2] * static_cast<double>(p[2])};
  }
};

}  // namespace allpairs::scene::sofa
