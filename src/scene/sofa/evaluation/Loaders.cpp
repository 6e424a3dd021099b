// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/mesh/TetraStuffing.h"
#include "sofa/mesh/Topology.h"

namespace allpairs::scene::sofa {
namespace {

/// Adds elements to a list unless it has them already, whatever the order of their corners.
template <std::size_t N>
class Completion {
 public:
  Completion(Elements<N>& list, const ReadScope& scope) : m_list(list), m_scope(scope) {
    for (const auto& element : list) m_seen.insert(sorted(element));
  }
  void add(const std::array<Index, N>& element) {
    m_scope.checkStop();
    if (m_seen.insert(sorted(element)).second) m_list.push_back(element);
  }

 private:
  Elements<N>& m_list;
  const ReadScope& m_scope;
  std::set<std::array<Index, N>> m_seen;
};

void triangulate(Mesh& mesh) {
  addHalves(mesh.quads, mesh.triangles);
  mesh.quads.clear();
}

void addFaces(Mesh& mesh, const ReadScope& scope) {
  Completion<4> quads(mesh.quads, scope);
  for (const auto& h : mesh.hexahedra) {
    quads.add({h[0], h[3], h[2], h[1]});
    quads.add({h[4], h[5], h[6], h[7]});
    quads.add({h[0], h[1], h[5], h[4]});
    quads.add({h[1], h[2], h[6], h[5]});
    quads.add({h[2], h[3], h[7], h[6]});
    quads.add({h[3], h[0], h[4], h[7]});
  }
  Completion<3> triangles(mesh.triangles, scope);
  for (const auto& t : mesh.tetrahedra) {
    triangles.add({t[0], t[2], t[1]});
    triangles.add({t[0], t[1], t[3]});
    triangles.add({t[0], t[3], t[2]});
    triangles.add({t[1], t[2], t[3]});
  }
}

void addEdges(Mesh& mesh, const ReadScope& scope) {
  Completion<2> edges(mesh.edges, scope);
  for (const auto& q : mesh.quads)
    for (std::size_t j = 0; j < 4; ++j) edges.add({q[(j + 1) % 4], q[(j + 2) % 4]});
  for (const auto& t : mesh.triangles)
    for (std::size_t j = 0; j < 3; ++j) edges.add({t[(j + 1) % 3], t[(j + 2) % 3]});
}

/// Drops the points that no element uses, and renumbers.
void keepAttachedPoints(Mesh& mesh) {
  std::vector<Index> renumbered(mesh.positions.size(), 0);
  const auto forAllCorners = [&mesh](const auto& visit) {
    const auto visitList = [&](auto& list) {
      for (auto& element : list)
        for (auto& corner : element) visit(corner);
    };
    visitList(mesh.edges), visitList(mesh.triangles), visitList(mesh.quads);
    visitList(mesh.tetrahedra), visitList(mesh.hexahedra);
  };
  forAllCorners([&](Index& corner) { renumbered[corner] = 1; });
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < renumbered.size(); ++i) {
    if (renumbered[i] == 0) continue;
    renumbered[i] = static_cast<Index>(kept.size());
    kept.push_back(mesh.positions[i]);
  }
  mesh.positions = std::move(kept);
  forAllCorners([&](Index& corner) { corner = renumbered[corner]; });
}

void transformByMatrix(Mesh& mesh, const std::vector<double>& m) {
  for (auto& p : mesh.positions) {
    const Vec3 q = p;
    for (std::size_t row = 0; row < 3; ++row)
      p[row] = m[4 * row] * q[0] + m[4 * row + 1] * q[1] + m[4 * row + 2] * q[2] + m[4 * row + 3];
  }
}

void transform(Evaluation& evaluation, const Component& loader, Mesh& mesh) {
  const auto matrix = evaluation.numbers(loader, {"transformation"}, Evaluation::kFlat);
  const std::vector<double> identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // counts as none, as in SOFA
  if (matrix && matrix->values.size() == 16 && matrix->values != identity)
    return transformByMatrix(mesh, matrix->values);
  const auto scale = evaluation.vector(loader, {"scale3d"}, {1, 1, 1}) * evaluation.single(loader, "scale", 1);
  const auto rotation = fromEulerDegrees(evaluation.vector(loader, {"rotation"}, {}));
  const auto translation = evaluation.vector(loader, {"translation"}, {});
  for (auto& p : mesh.positions) p = rotate(rotation, scaled(p, scale)) + translation;
}

/// Since 20.12 SOFA turns spheres too, and leaves their radii as they are.
void transformSpheres(Evaluation& evaluation, const Component& loader, Mesh& mesh) {
  const bool isOld = evaluation.generation() == Generation::Sofa20;
  const auto scale = isOld ? evaluation.vector(loader, {"scale"}, {1, 1, 1})
                           : evaluation.vector(loader, {"scale", "scale3d"}, {1, 1, 1});
  const auto rotation = fromEulerDegrees(isOld ? Vec3{} : evaluation.vector(loader, {"rotation"}, {}));
  const auto translation = evaluation.vector(loader, {"translation"}, {});
  if (isOld)
    for (auto& radius : mesh.radii) radius *= scale[0];
  for (auto& p : mesh.positions) p = rotate(rotation, scaled(p, scale)) + translation;
}

/// The numbers of the corners of one square of a grid.
struct Square {
  Index a, b, c, d;
};

void cut(const Square& s, bool downward, Elements<3>& triangles) {
  if (downward)
    triangles.insert(triangles.end(), {{s.a, s.b, s.d}, {s.b, s.c, s.d}});
  else
    triangles.insert(triangles.end(), {{s.a, s.b, s.c}, {s.a, s.c, s.d}});
}

/// Each edge once, the way round in which it comes first, in ascending order.
template <std::size_t N>
void addEdgesInOrder(const Elements<N>& elements, Elements<2>& edges) {
  std::set<std::array<Index, 2>> unique;
  for (const auto& e : elements)
    for (std::size_t j = 0; j < N; ++j)
      if (!unique.contains({e[(j + 1) % N], e[j]})) unique.insert({e[j], e[(j + 1) % N]});
  edges.insert(edges.end(), unique.begin(), unique.end());
}

/// Whether a square of a grid is cut from its second corner, by the number of SOFA's pattern.
bool isDownward(int pattern, std::size_t x, std::size_t y) {
  constexpr int kAlternate = 1, kDownward = 3;
  return pattern == kDownward || (pattern == kAlternate && (x + y) % 2 == 1);
}

/// A square of one by one, of so many points in each direction.
Mesh gridMesh(Evaluation& evaluation, const Component& creator) {
  const auto counts = evaluation.vector(creator, {"resolution"}, {2, 2, 0});
  if (!(counts[0] >= 2) || !(counts[1] >= 2))
    throw Unplaceable(creator, "a grid has two points in each direction or more");
  if (!(counts[0] * counts[1] <= kMaxPoints)) throw Unplaceable(creator, "its resolution is out of all reason");
  const auto nx = static_cast<std::size_t>(counts[0]), ny = static_cast<std::size_t>(counts[1]);
  const auto pattern = static_cast<int>(clamped(evaluation.number(creator, {"trianglePattern"}, 2), -1, 9));
  constexpr std::uint64_t kElements = 8;  // which take this many times the memory of the points
  evaluation.takePoints(creator, std::uint64_t{nx} * ny, kElements);
  Mesh mesh;
  for (std::size_t y = 0; y < ny; ++y)
    for (std::size_t x = 0; x < nx; ++x)
      mesh.positions.push_back({static_cast<double>(x) / static_cast<double>(nx - 1),
                                static_cast<double>(y) / static_cast<double>(ny - 1), 0});
  const auto at = [nx](std::size_t x, std::size_t y) { return static_cast<Index>(x + nx * y); };
  for (std::size_t y = 0; y + 1 < ny; ++y)
    for (std::size_t x = 0; x + 1 < nx; ++x) {
      const Square s{at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)};
      if (pattern == 0) mesh.quads.push_back({s.a, s.b, s.c, s.d});
      if (pattern >= 1 && pattern <= 3) cut(s, isDownward(pattern, x, y), mesh.triangles);
    }
  addEdgesInOrder(mesh.quads, mesh.edges);
  addEdgesInOrder(mesh.triangles, mesh.edges);
  return mesh;
}

Mesh readBy(Evaluation& evaluation, const Component& loader, const std::filesystem::path& path) {
  const auto* stop = evaluation.scope().stop();
  if (loader.kind() == ComponentKind::SphereLoader) return readSpheres(path, stop);
  if (loader.type == "MeshGmshLoader") return readGmsh(path, stop);
  if (loader.type == "MeshVTKLoader")
    return readVtk(path, evaluation.generation() == Generation::Sofa20 ? XmlSurfaces::Refused : XmlSurfaces::Read,
                   stop);
  if (loader.type == "MeshOffLoader") return readOff(path, stop);
  if (loader.type == "MeshTrianLoader") {
    if (evaluation.flag(loader, "trian2", false)) throw Unplaceable(loader, "files of the form trian2 cannot be read");
    return readTrian(path, stop);
  }
  if (loader.type == "MeshSTLLoader") throw Unplaceable(loader, "STL meshes in scenes cannot be read");
  return readObj(path,
                 {.triangulate = evaluation.flag(loader, "triangulate", false),
                  .splitSeams = evaluation.flag(loader, "handleSeams", false)},
                 stop);
}

}  // namespace

Mesh stuffedMesh(Evaluation& evaluation, const Component& engine) {
  Mesh surface;
  surface.positions = evaluation.points(engine, {"inputPoints"});
  surface.triangles = evaluation.elements<3>(engine, {"inputTriangles"});
  addHalves(evaluation.elements<4>(engine, {"inputQuads"}), surface.triangles);
  if (surface.positions.empty() || surface.triangles.empty()) throw Unplaceable(engine, "it is given no surface");
  if (indicesUsed(surface) > surface.positions.size())
    throw Unplaceable(engine, "its triangles name points that are not there");
  const auto box = evaluation.numbers(engine, {"vbbox"}, 6);
  Stuffing how{.size = evaluation.number(engine, {"size"}, -8),
               .alphaLong = evaluation.number(engine, {"alphaLong"}, Stuffing{}.alphaLong),
               .alphaShort = evaluation.number(engine, {"alphaShort"}, Stuffing{}.alphaShort),
               .snap = evaluation.flag(engine, "snapPoints", false),
               .split = evaluation.flag(
                   engine, evaluation.isGiven(engine, {"splitTetras"}) ? "splitTetras" : "splitTetrahedra", false)};
  if (box && box->size() == 1) {
    how.box.min = {box->values[0], box->values[1], box->values[2]};
    how.box.max = {box->values[3], box->values[4], box->values[5]};
  }
  const double points = stuffingPoints(surface, how);
  constexpr double kMostPoints = 1e8;
  if (!(points >= 0 && points <= kMostPoints)) throw Unplaceable(engine, "its size is out of all reason");
  constexpr std::uint64_t kElements = 40;  // cuts and tetrahedra take this many times the memory of the points
  evaluation.takePoints(engine, static_cast<std::uint64_t>(points), kElements);
  return stuffed(surface, how, [&](std::uint64_t pairs) { takeWork(evaluation, engine, pairs); });
}

void warnOfPassedOver(Evaluation& evaluation, const Component& component, const Mesh& mesh) {
  if (mesh.passedOver == 0) return;
  evaluation.warn(component,
                  std::to_string(mesh.passedOver) +
                      (mesh.passedOver == 1 ? " element of its file is of a kind that SOFA does not read, and is"
                                            : " elements of its file are of kinds that SOFA does not read, and are") +
                      " passed over");
}

Mesh loadMesh(Evaluation& evaluation, const Component& loader) {
  if (loader.kind() == ComponentKind::MeshTetraStuffing) return stuffedMesh(evaluation, loader);
  const bool isMade = loader.type == "GridMeshCreator";
  const auto path = isMade ? std::nullopt : evaluation.file(loader, {"filename"});
  if (!path && !isMade) throw Unplaceable(loader, "it names no file");
  auto mesh = isMade ? gridMesh(evaluation, loader) : readBy(evaluation, loader, *path);
  if (path) checkMesh(mesh, *path);
  warnOfPassedOver(evaluation, loader, mesh);
  if (loader.kind() == ComponentKind::SphereLoader) {
    transformSpheres(evaluation, loader, mesh);
    return mesh;
  }
  transform(evaluation, loader, mesh);
  if (evaluation.flag(loader, "triangulate", false)) triangulate(mesh);
  const bool isGmsh = loader.type == "MeshGmshLoader";  // which alone makes them if it is not told
  if (evaluation.flag(loader, "createSubelements", isGmsh))
    addFaces(mesh, evaluation.scope()), addEdges(mesh, evaluation.scope());
  if (evaluation.flag(loader, "onlyAttachedPoints", false)) keepAttachedPoints(mesh);
  return mesh;
}

}  // namespace allpairs::scene::sofa
