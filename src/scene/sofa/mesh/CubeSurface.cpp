// SPDX-License-Identifier: MIT
#include "sofa/mesh/CubeSurface.h"

namespace allpairs::scene::sofa {
namespace {

constexpr std::size_t kX = 0, kY = 1, kZ = 2;

bool isEnd(const GridShape& grid, const GridPlace& p, std::size_t axis) {
  return p[axis] == 0 || p[axis] + 1 == grid.points[axis];
}

class Numbering {
 public:
  Numbering(const GridShape& grid, bool hasInner) : m_points(grid.points), m_isHollow(!hasInner && grid.isVolume()) {}

  [[nodiscard]] bool isHollow() const { return m_isHollow; }

  [[nodiscard]] Index of(const GridPlace& p) const {
    const auto [nx, ny, nz] = m_points;
    const auto [x, y, z] = p;
    if (!m_isHollow) return static_cast<Index>(indexOf(p, m_points));
    if (z == 0) return static_cast<Index>(x + nx * y);
    if (z + 1 == nz) return static_cast<Index>(x + nx * (y + ny));
    return static_cast<Index>(2 * nx * ny + (2 * nx + 2 * ny - 4) * (z - 1) + onSide(x, y));
  }

 private:
  [[nodiscard]] std::size_t onSide(std::size_t x, std::size_t y) const {
    const auto [nx, ny, nz] = m_points;
    if (y == 0) return x;
    if (y + 1 == ny) return nx + x;
    return 2 * nx + (x == 0 ? 0 : ny - 2) + y - 1;
  }

  GridPlace m_points;
  bool m_isHollow;
};

void addPoints(const GridShape& grid, const Numbering& numbers, Mesh& mesh) {
  forAllPlaces(grid.points, [&](const GridPlace& p) {
    if (numbers.isHollow() && !isEnd(grid, p, 0) && !isEnd(grid, p, 1) && !isEnd(grid, p, 2)) return;
    const auto index = numbers.of(p);
    if (index >= mesh.positions.size()) mesh.positions.resize(std::size_t{index} + 1);
    mesh.positions[index] = grid.point(p);
  });
}

void addEdges(const GridShape& grid, const Numbering& numbers, Mesh& mesh) {
  forAllPlaces(grid.points, [&](const GridPlace& p) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (p[axis] + 1 == grid.points[axis]) continue;
      if (!isEnd(grid, p, (axis + 1) % 3) && !isEnd(grid, p, (axis + 2) % 3)) continue;
      auto next = p;
      ++next[axis];
      mesh.edges.push_back({numbers.of(p), numbers.of(next)});
    }
  });
}

/// One side of the cube: at that place on an axis, its quads turning from `u` to `v`, in rows along `row`.
struct Side {
  std::size_t axis, at, u, v, row, column;
};

void addSide(const GridShape& grid, const Numbering& numbers, const Side& side, Mesh& mesh) {
  for (std::size_t c = 0; c + 1 < grid.points[side.column]; ++c)
    for (std::size_t r = 0; r + 1 < grid.points[side.row]; ++r) {
      GridPlace p{};
      p[side.axis] = side.at;
      p[side.column] = c;
      p[side.row] = r;
      auto alongU = p, alongV = p, across = p;
      ++alongU[side.u], ++alongV[side.v], ++across[side.u], ++across[side.v];
      mesh.quads.push_back({numbers.of(p), numbers.of(alongU), numbers.of(across), numbers.of(alongV)});
    }
}

}  // namespace

Mesh cubeSurface(const GridShape& grid, bool hasInner) {
  const Numbering numbers(grid, hasInner);
  const auto [nx, ny, nz] = grid.points;
  Mesh mesh;
  addPoints(grid, numbers, mesh);
  addEdges(grid, numbers, mesh);
  addSide(grid, numbers, {kZ, 0, kY, kX, kX, kY}, mesh);
  if (nz > 1) addSide(grid, numbers, {kZ, nz - 1, kX, kY, kX, kY}, mesh);
  addSide(grid, numbers, {kY, 0, kX, kZ, kX, kZ}, mesh);
  if (ny > 1) addSide(grid, numbers, {kY, ny - 1, kZ, kX, kX, kZ}, mesh);
  addSide(grid, numbers, {kX, 0, kZ, kY, kY, kZ}, mesh);
  if (nx > 1) addSide(grid, numbers, {kX, nx - 1, kY, kZ, kY, kZ}, mesh);
  return mesh;
}

}  // namespace allpairs::scene::sofa
