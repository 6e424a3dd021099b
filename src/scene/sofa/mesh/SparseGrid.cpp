// SPDX-License-Identifier: MIT
#include "sofa/mesh/SparseGrid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace allpairs::scene::sofa {
namespace {

using Corners = std::array<Vec3, 3>;

enum class Filling : std::uint8_t { Inside, Boundary, Outside };

/// Whether a triangle lies beyond the unit cube about the origin in a direction, on either side.
bool isBeyond(const Corners& triangle, const Vec3& direction) {
  const double reach = (std::abs(direction[0]) + std::abs(direction[1]) + std::abs(direction[2])) / 2;
  const auto [low, high] =
      std::minmax({dot(triangle[0], direction), dot(triangle[1], direction), dot(triangle[2], direction)});
  return low > reach || high < -reach;
}

/// Whether a triangle meets the closed unit cube about the origin: no direction parts the two.
bool meetsUnitCube(const Corners& triangle) {
  constexpr Vec3 kAxes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Vec3 edges[3] = {triangle[1] - triangle[0], triangle[2] - triangle[1], triangle[0] - triangle[2]};
  for (const auto& axis : kAxes) {
    if (isBeyond(triangle, axis)) return false;
    for (const auto& edge : edges)
      if (isBeyond(triangle, cross(axis, edge))) return false;
  }
  return !isBeyond(triangle, cross(edges[0], edges[1]));
}

class Voxels {
 public:
  explicit Voxels(const GridShape& grid) : m_grid(grid) {
    for (std::size_t axis = 0; axis < 3; ++axis) m_cells[axis] = grid.points[axis] - 1;
    m_filling.assign(m_cells[0] * m_cells[1] * m_cells[2], Filling::Inside);
  }

  /// False if a point is in no cell.
  [[nodiscard]] bool add(const Mesh& surface) {
    std::vector<GridPlace> cells;
    for (const auto& point : surface.positions) {
      const auto cell = cellOf(point);
      if (!cell) return false;
      filling(*cell) = Filling::Boundary;
      cells.push_back(*cell);
    }
    const auto addTriangle = [&](Index a, Index b, Index c) {
      const auto& p = surface.positions;
      mark({p[a], p[b], p[c]}, {cells[a], cells[b], cells[c]});
    };
    for (const auto& t : surface.triangles) addTriangle(t[0], t[1], t[2]);
    for (const auto& q : surface.quads) addTriangle(q[0], q[1], q[2]), addTriangle(q[0], q[2], q[3]);
    return true;
  }

  /// What can be reached from the rim without crossing the surface is outside.
  void clearOutside() {
    std::vector<GridPlace> open;
    forAllPlaces(m_cells, [&](const GridPlace& cell) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (cell[axis] == 0 || cell[axis] + 1 == m_cells[axis]) return open.push_back(cell);
    });
    while (!open.empty()) {
      const auto cell = open.back();
      open.pop_back();
      if (filling(cell) != Filling::Inside) continue;
      filling(cell) = Filling::Outside;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (cell[axis] > 0) open.push_back(moved(cell, axis, -1));
        if (cell[axis] + 1 < m_cells[axis]) open.push_back(moved(cell, axis, 1));
      }
    }
  }

  [[nodiscard]] Mesh mesh() const {
    Mesh result;
    const auto numbers = numberCorners(result);
    for (const auto wanted : {Filling::Boundary, Filling::Inside})
      forAllPlaces(m_cells, [&](const GridPlace& cell) {
        if (filling(cell) != wanted) return;
        std::array<Index, 8> corners{};
        for (std::size_t i = 0; i < 8; ++i) corners[i] = numbers[pointIndex(cell + kCellCorners[i])];
        result.hexahedra.push_back(corners);
      });
    return result;
  }

 private:
  static GridPlace moved(GridPlace cell, std::size_t axis, int by) {
    cell[axis] = by > 0 ? cell[axis] + 1 : cell[axis] - 1;
    return cell;
  }

  [[nodiscard]] Filling& filling(const GridPlace& cell) { return m_filling[indexOf(cell, m_cells)]; }
  [[nodiscard]] Filling filling(const GridPlace& cell) const { return m_filling[indexOf(cell, m_cells)]; }

  /// By x, then y, then z: the order in which corners are numbered.
  [[nodiscard]] std::size_t pointIndex(const GridPlace& point) const {
    return point[2] + m_grid.points[2] * (point[1] + m_grid.points[1] * point[0]);
  }

  [[nodiscard]] std::optional<GridPlace> cellOf(const Vec3& point) const {
    GridPlace cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double step = m_grid.spacing[axis];
      const double place = std::floor((point[axis] - m_grid.origin[axis]) * step * (1 / (step * step)));
      if (!(place >= 0) || place >= static_cast<double>(m_cells[axis])) return std::nullopt;
      cell[axis] = static_cast<std::size_t>(place);
    }
    return cell;
  }

  [[nodiscard]] bool meets(const Corners& triangle, const GridPlace& cell) const {
    const auto low = m_grid.point(cell);
    const auto diagonal = m_grid.point(cell + GridPlace{1, 1, 1}) - low;
    const auto centre = low + diagonal * 0.5;
    Corners scaled{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        scaled[i][axis] = static_cast<double>(static_cast<float>((triangle[i][axis] - centre[axis]) / diagonal[axis]));
    return meetsUnitCube(scaled);
  }

  void mark(const Corners& triangle, const std::array<GridPlace, 3>& cells) {
    GridPlace low{}, high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min({cells[0][axis], cells[1][axis], cells[2][axis]});
      high[axis] = std::max({cells[0][axis], cells[1][axis], cells[2][axis]});
    }
    for (auto x = low[0]; x <= high[0]; ++x)
      for (auto y = low[1]; y <= high[1]; ++y)
        for (auto z = low[2]; z <= high[2]; ++z)
          if (filling({x, y, z}) != Filling::Boundary && meets(triangle, {x, y, z}))
            filling({x, y, z}) = Filling::Boundary;
  }

  /// The number of each corner of a kept cell by its place in the grid; also adds the corners to a mesh.
  std::vector<Index> numberCorners(Mesh& mesh) const {
    const auto [nx, ny, nz] = m_grid.points;
    std::vector<Index> numbers(nx * ny * nz, 0);
    forAllPlaces(m_cells, [&](const GridPlace& cell) {
      if (filling(cell) == Filling::Outside) return;
      for (const auto& corner : kCellCorners) numbers[pointIndex(cell + corner)] = 1;
    });
    for (std::size_t x = 0; x < nx; ++x)
      for (std::size_t y = 0; y < ny; ++y)
        for (std::size_t z = 0; z < nz; ++z) {
          auto& number = numbers[pointIndex({x, y, z})];
          if (number == 0) continue;
          number = static_cast<Index>(mesh.positions.size());
          mesh.positions.push_back(m_grid.point({x, y, z}));
        }
    return numbers;
  }

  const GridShape& m_grid;
  GridPlace m_cells{};
  std::vector<Filling> m_filling;
};

}  // namespace

std::optional<Mesh> sparseGrid(const GridShape& grid, const Mesh& surface) {
  Voxels voxels(grid);
  if (!voxels.add(surface)) return std::nullopt;
  voxels.clearOutside();
  return voxels.mesh();
}

}  // namespace allpairs::scene::sofa
