// SPDX-License-Identifier: MIT
#include "sofa/mesh/CubeSurface.h"

namespace allpairs::scene::sofa {
namespace {

using GridPlace = std::array<std::size_t, 3>;
constexpr std::size_t kX = 0, kY = 1, kZ = 2;

bool isEnd(const CubeSurface& cube, const GridPlace& p, std::size_t axis) {
  return p[axis] == 0 || p[axis] + 1 == cube.points[axis];
}

class Numbering {
 public:
  explicit Numbering(const CubeSurface& cube) : m_cube(cube) {
    const auto [nx, ny, nz] = cube.points;
    m_isHollow = !cube.inner && nx > 1 && ny > 1 && nz > 1;
  }

  [[nodiscard]] bool isHollow() const { return m_isHollow; }

  [[nodiscard]] Index of(const GridPlace& p) const {
    const auto [nx, ny, nz] = m_cube.points;
    const auto [x, y, z] = p;
    if (!m_isHollow) return static_cast<Index>(x + nx * (y + ny * z));
    if (z == 0) return static_cast<Index>(x + nx * y);
    if (z + 1 == nz) return static_cast<Index>(x + nx * (y + ny));
    return static_cast<Index>(2 * nx * ny + (2 * nx + 2 * ny - 4) * (z - 1) + onSide(x, y));
  }

 private:
  [[nodiscard]] std::size_t onSide(std::size_t x, std::size_t y) const {
    const auto [nx, ny, nz] = m_cube.points;
    if (y == 0) return x;
    if (y + 1 == ny) return nx + x;
    return 2 * nx + (x == 0 ? 0 : ny - 2) + y - 1;
  }

  const CubeSurface& m_cube;
  bool m_isHollow = false;
};

template <class Visit>
void forAll(const CubeSurface& cube, const Visit& visit) {
  for (std::size_t z = 0; z < cube.points[2]; ++z)
    for (std::size_t y = 0; y < cube.points[1]; ++y)
      for (std::size_t x = 0; x < cube.points[0]; ++x) visit(GridPlace{x, y, z});
}

void addPoints(const CubeSurface& cube, const Numbering& numbers, Mesh& mesh) {
  forAll(cube, [&](const GridPlace& p) {
    if (numbers.isHollow() && !isEnd(cube, p, 0) && !isEnd(cube, p, 1) && !isEnd(cube, p, 2)) return;
    const auto index = numbers.of(p);
    if (index >= mesh.positions.size()) mesh.positions.resize(std::size_t{index} + 1);
    for (std::size_t axis = 0; axis < 3; ++axis)
      mesh.positions[index][axis] = cube.origin[axis] + cube.spacing[axis] * static_cast<double>(p[axis]);
  });
}

void addEdges(const CubeSurface& cube, const Numbering& numbers, Mesh& mesh) {
  forAll(cube, [&](const GridPlace& p) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (p[axis] + 1 == cube.points[axis]) continue;
      if (!isEnd(cube, p, (axis + 1) % 3) && !isEnd(cube, p, (axis + 2) % 3)) continue;
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

void addSide(const CubeSurface& cube, const Numbering& numbers, const Side& side, Mesh& mesh) {
  for (std::size_t c = 0; c + 1 < cube.points[side.column]; ++c)
    for (std::size_t r = 0; r + 1 < cube.points[side.row]; ++r) {
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

Mesh meshOf(const CubeSurface& cube) {
  const Numbering numbers(cube);
  const auto [nx, ny, nz] = cube.points;
  Mesh mesh;
  addPoints(cube, numbers, mesh);
  addEdges(cube, numbers, mesh);
  addSide(cube, numbers, {kZ, 0, kY, kX, kX, kY}, mesh);
  if (nz > 1) addSide(cube, numbers, {kZ, nz - 1, kX, kY, kX, kY}, mesh);
  addSide(cube, numbers, {kY, 0, kX, kZ, kX, kZ}, mesh);
  if (ny > 1) addSide(cube, numbers, {kY, ny - 1, kZ, kX, kX, kZ}, mesh);
  addSide(cube, numbers, {kX, 0, kZ, kY, kY, kZ}, mesh);
  if (nx > 1) addSide(cube, numbers, {kX, nx - 1, kY, kZ, kY, kZ}, mesh);
  return mesh;
}

}  // namespace allpairs::scene::sofa
