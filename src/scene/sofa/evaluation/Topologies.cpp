// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "allpairs/scene/FileError.h"
#include "input/FileBytes.h"
#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/graph/Links.h"
#include "sofa/mesh/CubeSurface.h"
#include "sofa/mesh/SparseGrid.h"

namespace allpairs::scene::sofa {
namespace {

using enum ComponentKind;

/// One more than the highest point that cells name of which nothing else is read.
std::size_t highestOf(Evaluation& evaluation, const Component& component, std::string_view list, std::size_t width) {
  std::size_t used = 0;
  if (const auto given = evaluation.numbers(component, {list}, width))
    for (const double corner : given->values)
      if (corner >= 0 && corner < kMaxPoints) used = std::max(used, static_cast<std::size_t>(corner) + 1);
  return used;
}

/// The file that a topology is read from: SOFA reads two kinds, as they are spelled here, and has nothing of others.
std::optional<std::filesystem::path> meshFileOf(Evaluation& evaluation, const Component& component) {
  auto file = evaluation.file(component, {"filename", "fileTopology"});
  if (!file || file->extension() == ".obj" || file->extension() == ".msh") return file;
  evaluation.warn(component, "a topology reads files .obj and .msh alone, and nothing of this one, as in SOFA");
  return std::nullopt;
}

Topology meshTopology(Evaluation& evaluation, const Component& component) {
  Topology topology;
  if (const auto file = meshFileOf(evaluation, component)) {
    topology.given = readMesh(*file, evaluation.scope().stop());
    checkMesh(topology.given, *file);
    warnOfPassedOver(evaluation, component, topology.given);
    topology.pointCount = topology.given.positions.size();
  } else {
    topology.given = evaluation.elementLists(component);
    topology.given.positions = evaluation.points(component, {"position", "points"});
    topology.pointCount = std::max({indicesUsed(topology.given), highestOf(evaluation, component, "prisms", 6),
                                    highestOf(evaluation, component, "pyramids", 5)});
  }
  topology.hasPositions = !topology.given.positions.empty();
  return topology;
}

Mesh containerLists(Evaluation& evaluation, const Component& component) {
  const auto holds = [&](ComponentKind element) { return canHold(component.kind(), element); };
  Mesh mesh;
  mesh.positions = evaluation.points(component, {"position", "points"});
  if (holds(EdgeContainer)) mesh.edges = evaluation.elements<2>(component, {"edges"});
  if (holds(TriangleContainer)) mesh.triangles = evaluation.elements<3>(component, {"triangles"});
  if (holds(QuadContainer)) mesh.quads = evaluation.elements<4>(component, {"quads"});
  if (holds(TetrahedronContainer)) mesh.tetrahedra = evaluation.elements<4>(component, {"tetrahedra", "tetras"});
  if (holds(HexahedronContainer)) mesh.hexahedra = evaluation.elements<8>(component, {"hexahedra", "hexas"});
  return mesh;
}

Topology containerTopology(Evaluation& evaluation, const Component& component) {
  Topology topology;
  topology.family = Topology::Family::Container;
  topology.given = containerLists(evaluation, component);
  const double count = evaluation.number(component, {"nbPoints"}, 0);
  topology.pointCount = static_cast<std::size_t>(clamped(count, 0, kMaxPoints));
  Mesh counted;  // Beside positions only tetrahedra make room for the points that they use; since 19.06 all do alone.
  counted.tetrahedra = topology.given.tetrahedra;
  const std::size_t used = indicesUsed(topology.given.positions.empty() ? topology.given : counted);
  topology.pointCount = std::max({topology.pointCount, used, topology.given.positions.size()});
  topology.hasPositions = !topology.given.positions.empty();
  return topology;
}

GridPlace toCounts(const Component& grid, const Vec3& numbers) {
  double product = 1;
  for (const double n : numbers) {
    if (!(n >= 0)) throw Unplaceable(grid, fmt::format("a grid of {} points along an axis is none", n));
    product *= std::max(1.0, n);
  }
  if (!(product <= kMaxPoints))
    throw Unplaceable(grid, fmt::format("a grid of {} points is more than this reader makes", product));
  return {static_cast<std::size_t>(numbers[0]), static_cast<std::size_t>(numbers[1]),
          static_cast<std::size_t>(numbers[2])};
}

/// The number of points along each axis, as written.
Vec3 gridCounts(Evaluation& evaluation, const Component& grid) {
  Vec3 counts = evaluation.vector(grid, {"n"}, {2, 2, 2});
  if (grid.attributes.has("nx") && grid.attributes.has("ny") && grid.attributes.has("nz"))
    counts = {evaluation.number(grid, {"nx"}, counts[0]), evaluation.number(grid, {"ny"}, counts[1]),
              evaluation.number(grid, {"nz"}, counts[2])};
  for (auto& n : counts) n = std::trunc(n);
  return counts;
}

Box gridCorners(Evaluation& evaluation, const Component& grid) {
  constexpr std::array<std::string_view, 6> kNames{"xmin", "ymin", "zmin", "xmax", "ymax", "zmax"};
  if (!std::ranges::all_of(kNames, [&](auto name) { return grid.attributes.has(name); }))
    return {evaluation.vector(grid, {"min"}, {}), evaluation.vector(grid, {"max"}, {1, 1, 1})};
  Box corners;
  const double scale = evaluation.single(grid, "scale", 1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    corners.min[axis] = evaluation.single(grid, kNames[axis], 0) * scale;
    corners.max[axis] = evaluation.single(grid, kNames[axis + 3], 1) * scale;
  }
  return corners;
}

/// Origin and spacing of a grid with that many points between two corners; an axis with one point is special.
GridShape gridBetween(const Box& corners, const Vec3& counts) {
  GridShape shape;
  shape.origin = corners.min;
  const auto extent = corners.max - corners.min;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    shape.spacing[axis] = counts[axis] > 1 ? extent[axis] / (counts[axis] - 1) : extent[axis];
    if (counts[axis] <= 1 && axis < 2) shape.origin[axis] = (corners.max[axis] + corners.min[axis]) / 2;
  }
  return shape;
}

/// A grid as it is written, and the number of its points along each axis.
struct WrittenGrid {
  Box corners;
  Vec3 counts{};
  GridShape shape;
};

WrittenGrid writtenGrid(Evaluation& evaluation, const Component& component) {
  WrittenGrid grid;
  grid.counts = gridCounts(evaluation, component);
  grid.corners = gridCorners(evaluation, component);
  grid.shape = gridBetween(grid.corners, grid.counts);
  if (const double width = evaluation.number(component, {"cellWidth"}, 0); width != 0)
    for (std::size_t axis = 0; axis < 3; ++axis)  // SOFA keeps the spacing of the resolution that was written.
      grid.counts[axis] = std::ceil((grid.corners.max[axis] - grid.corners.min[axis]) / width) + 1;
  if (*std::ranges::min_element(grid.counts) < 1) {
    grid.counts = {2, 2, 2};
    grid.shape = gridBetween(grid.corners, grid.counts);
  }
  grid.shape.origin = evaluation.vector(component, {"p0"}, grid.shape.origin);
  return grid;
}

GridLists gridLists(Evaluation& evaluation, const Component& component) {
  if (evaluation.generation() == Generation::Sofa20) return {};
  return {.cubes = evaluation.flag(component, "computeHexaList", true),
          .quads = evaluation.flag(component, "computeQuadList", true),
          .triangles = evaluation.flag(component, "computeTriangleList", true),
          .edges = evaluation.flag(component, "computeEdgeList", true),
          .diagonals = true};
}

/// Newer SOFA empties a grid that names a mesh file, and fills it from that file, if it is there.
bool isEmptied(Evaluation& evaluation, const Component& component) {
  if (evaluation.generation() == Generation::Sofa20 || !evaluation.isGiven(component, {"filename", "fileTopology"}))
    return false;
  if (evaluation.hasFile(component, {"filename", "fileTopology"}))
    throw Unplaceable(component, "a regular grid that is read from a file is not known to this reader");
  evaluation.warn(component, "it names a file that is not there, and has no points, as in SOFA");
  return true;
}

Topology regularGrid(Evaluation& evaluation, const Component& component) {
  Topology topology;
  topology.hasPositions = true;
  if (isEmptied(evaluation, component)) return topology;
  const auto grid = writtenGrid(evaluation, component);
  auto shape = grid.shape;
  shape.points = toCounts(component, grid.counts);
  constexpr std::uint64_t kElements = 8;  // elements of a grid take this many times the memory of its points
  evaluation.takePoints(component, std::uint64_t{shape.points[0]} * shape.points[1] * shape.points[2], kElements);

  forAllPlaces(shape.points, [&](const GridPlace& p) { topology.given.positions.push_back(shape.point(p)); });
  fillGrid(topology, shape.points, gridLists(evaluation, component));
  topology.pointCount = topology.given.positions.size();
  topology.cells = {shape.points[0] - 1, shape.points[1] - 1, shape.points[2] - 1};
  topology.grid = shape;
  return topology;
}

Topology cubeTopology(Evaluation& evaluation, const Component& component) {
  if (evaluation.flag(component, "splitNormals", false))
    throw Unplaceable(component, "a cube whose corners are split is not known to this reader");
  Vec3 counts{evaluation.number(component, {"nx"}, 0), evaluation.number(component, {"ny"}, 0),
              evaluation.number(component, {"nz"}, 0)};
  for (auto& n : counts) n = std::max(0.0, std::trunc(n));
  const auto corners = gridCorners(evaluation, component);
  GridShape grid{.points = toCounts(component, counts), .origin = corners.min};
  const bool hasInner = evaluation.flag(component, "internalPoints", false);
  for (std::size_t axis = 0; axis < 3; ++axis)
    grid.spacing[axis] = counts[axis] > 1 ? (corners.max[axis] - corners.min[axis]) / (counts[axis] - 1) : 0.0;
  constexpr std::uint64_t kElements = 4;  // elements take this many times the memory of the points
  std::uint64_t count = 1;
  for (const auto points : grid.points) count *= std::max<std::size_t>(points, 1);  // SOFA lists sides of no points.
  evaluation.takePoints(component, count, kElements);
  Topology topology;
  topology.given = cubeSurface(grid, hasInner);
  topology.pointCount = topology.given.positions.size();
  topology.hasPositions = topology.pointCount > 0;
  return topology;
}

/// The surface that a sparse grid is made around: that of its Wavefront file or of its own lists; nothing of others.
std::optional<Mesh> surfaceOf(Evaluation& evaluation, const Component& component) {
  if (evaluation.isGiven(component, {"facets"})) return std::nullopt;
  Mesh surface;
  if (const auto file = evaluation.file(component, {"filename", "fileTopology"})) {
    if (lowerExtension(*file) != ".obj") return std::nullopt;
    surface = readObj(*file, {}, evaluation.scope().stop());
    checkMesh(surface, *file);
  } else {
    surface = evaluation.elementLists(component);
    surface.positions = evaluation.points(component, {"position", "points"});
    if (indicesUsed(surface) > surface.positions.size()) return std::nullopt;
  }
  if (surface.positions.empty()) return std::nullopt;
  return surface;
}

/// A surface that cannot be read is an error only to those that need the points of the grid around it.
std::optional<Mesh> readableSurfaceOf(Evaluation& evaluation, const Component& component) {
  try {
    return surfaceOf(evaluation, component);
  } catch (const FileError&) {
    return std::nullopt;
  }
}

/// The regular grid that a sparse grid is cut from; with a spacing of zero where the surface is flat.
GridShape shapeAround(Evaluation& evaluation, const Component& component, const Mesh& surface) {
  Box corners{evaluation.vector(component, {"min"}, {}), evaluation.vector(component, {"max"}, {})};
  if (corners.min == Vec3{} && corners.max == Vec3{}) corners = boxToFill(surface.positions);
  Vec3 counts = evaluation.vector(component, {"n"}, {2, 2, 2});
  for (auto& n : counts) n = std::max(2.0, std::trunc(n));
  if (const double width = evaluation.number(component, {"cellWidth"}, 0); width != 0)
    for (std::size_t axis = 0; axis < 3; ++axis)
      counts[axis] = std::ceil((corners.max[axis] - corners.min[axis]) / width) + 1;
  auto shape = gridBetween(corners, counts);
  shape.points = toCounts(component, counts);
  return shape;
}

/// The points and cells of a sparse grid; nothing where this reader does not know how SOFA finds them.
std::optional<Mesh> sparseMesh(Evaluation& evaluation, const Component& component) {
  const bool isPlain = component.type == "SparseGridTopology" || component.type == "SparseGrid";
  const auto* loader = inContext(*component.node, [](const Component& c) { return c.type == "VoxelGridLoader"; });
  if (!isPlain || loader != nullptr || evaluation.number(component, {"nbVirtualFinerLevels"}, 0) != 0 ||
      evaluation.flag(component, "onlyInsideCells", false) ||
      evaluation.isGiven(component, {"nx", "ny", "nz", "xmin", "xmax", "ymin", "ymax", "zmin", "zmax"}))
    return std::nullopt;
  const auto surface = readableSurfaceOf(evaluation, component);
  if (!surface) return std::nullopt;
  const auto shape = shapeAround(evaluation, component, *surface);
  if (!std::ranges::all_of(shape.spacing, [](double step) { return step > 0; })) return std::nullopt;
  if (!shape.isVolume()) return std::nullopt;
  constexpr std::uint64_t kElements = 8;  // cells take this many times the memory of the points
  evaluation.takePoints(component, std::uint64_t{shape.points[0]} * shape.points[1] * shape.points[2], kElements);
  return sparseGrid(shape, *surface, [&](std::uint64_t pairs) { takeWork(evaluation, component, pairs); });
}

Topology sparseGridTopology(Evaluation& evaluation, const Component& component) {
  Topology topology;
  topology.sparse = true;
  topology.hasPositions = true;
  auto mesh = sparseMesh(evaluation, component);
  topology.unknown = !mesh;
  if (!mesh) return topology;
  topology.given = std::move(*mesh);
  topology.pointCount = topology.given.positions.size();
  return topology;
}

}  // namespace

bool canHold(ComponentKind container, ComponentKind element) {
  if (container == element || element == EdgeContainer) return container != PointContainer || element == PointContainer;
  return (container == TetrahedronContainer && element == TriangleContainer) ||
         (container == HexahedronContainer && element == QuadContainer);
}

bool isTooLate(const Evaluation& evaluation, const Component& asking, const Component& topology) {
  const auto* mapping = evaluation.topologicalMappingOf(topology);
  if (mapping != nullptr) return mapping->node == asking.node && mapping->index > asking.index;
  const auto& order = asking.node->order;
  if (std::ranges::find(order, std::pair{topology.name, asking.name}) != order.end()) return false;
  return topology.node == asking.node && topology.index > asking.index;
}

std::optional<Vec3> gridData(Evaluation& evaluation, const Component& grid, std::string_view name) {
  if (grid.kind() != RegularGrid) return std::nullopt;
  if (name == "n") return gridCounts(evaluation, grid);
  if (name == "min") return gridCorners(evaluation, grid).min;
  if (name == "max") return gridCorners(evaluation, grid).max;
  if (name == "p0") return writtenGrid(evaluation, grid).shape.origin;
  return std::nullopt;
}

Topology buildTopology(Evaluation& evaluation, const Component& component) {
  switch (component.kind()) {
    case MeshTopology:
      return meshTopology(evaluation, component);
    case PointContainer:
    case EdgeContainer:
    case TriangleContainer:
    case QuadContainer:
    case TetrahedronContainer:
    case HexahedronContainer:
      return containerTopology(evaluation, component);
    case RegularGrid:
      return regularGrid(evaluation, component);
    case CubeTopology:
      return cubeTopology(evaluation, component);
    case SparseGrid:
      return sparseGridTopology(evaluation, component);
    default:
      throw Unplaceable(component, "this kind of topology is not known to this reader");
  }
}

}  // namespace allpairs::scene::sofa
