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
  Voxels(const GridShape& grid, TakeWork takeWork) : m_grid(grid), m_takeWork(takeWork) {
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
    auto triangles = surface.triangles;
    addHalves(surface.quads, triangles);
    const auto rangeOf = [&](const std::array<Index, 3>& t) {
      return between({cells[t[0]], cells[t[1]], cells[t[2]]});
    };
    std::uint64_t tests = 0;
    for (const auto& t : triangles) tests += rangeOf(t).count();
    m_takeWork(kPairsPerTest * tests);
    const auto& p = surface.positions;
    for (const auto& t : triangles) mark({p[t[0]], p[t[1]], p[t[2]]}, rangeOf(t));
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

  /// All cells from one to another, both included.
  struct Range {
    GridPlace low, high;

    [[nodiscard]] std::uint64_t count() const {
      return std::uint64_t{high[0] - low[0] + 1} * (high[1] - low[1] + 1) * (high[2] - low[2] + 1);
    }
  };

  static Range between(const std::array<GridPlace, 3>& cells) {
    Range range{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      range.low[axis] = std::min({cells[0][axis], cells[1][axis], cells[2][axis]});
      range.high[axis] = std::max({cells[0][axis], cells[1][axis], cells[2][axis]});
    }
    return range;
  }

  void mark(const Corners& triangle, const Range& range) {
    const auto& low = range.low;
    const auto& high = range.high;
    for (auto x = low[0]; x <= high[0]; ++x) {
      m_takeWork(0);  // was taken; asks for a stop
      for (auto y = low[1]; y <= high[1]; ++y)
        for (auto z = low[2]; z <= high[2]; ++z)
          if (filling({x, y, z}) != Filling::Boundary && meets(triangle, {x, y, z}))
            filling({x, y, z}) = Filling::Boundary;
    }
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

  static constexpr std::uint64_t kPairsPerTest = 16;  ///< It takes as long as comparing so many pairs of points.

  const GridShape& m_grid;
  TakeWork m_takeWork;
  GridPlace m_cells{};
  std::vector<Filling> m_filling;
};

}  // namespace

std::optional<Mesh> sparseGrid(const GridShape& grid, const Mesh& surface, TakeWork takeWork) {
  Voxels voxels(grid, takeWork);
  if (!voxels.add(surface)) return std::nullopt;
  voxels.clearOutside();
  return voxels.mesh();
}

}  // namespace allpairs::scene::sofa
