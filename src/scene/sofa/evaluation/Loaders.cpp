// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"

namespace allpairs::scene::sofa {
namespace {

/// Adds elements to a list unless it has them already, whatever the order of their corners.
template <std::size_t N>
class Completion {
 public:
  explicit Completion(Elements<N>& list) : m_list(list) {
    for (const auto& element : list) m_seen.insert(sorted(element));
  }
  void add(const std::array<Index, N>& element) {
    if (m_seen.insert(sorted(element)).second) m_list.push_back(element);
  }

 private:
  Elements<N>& m_list;
  std::set<std::array<Index, N>> m_seen;
};

void triangulate(Mesh& mesh) {
  for (const auto& q : mesh.quads) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  mesh.quads.clear();
}

void addFaces(Mesh& mesh) {
  Completion<4> quads(mesh.quads);
  for (const auto& h : mesh.hexahedra) {
    quads.add({h[0], h[3], h[2], h[1]});
    quads.add({h[4], h[5], h[6], h[7]});
    quads.add({h[0], h[1], h[5], h[4]});
    quads.add({h[1], h[2], h[6], h[5]});
    quads.add({h[2], h[3], h[7], h[6]});
    quads.add({h[3], h[0], h[4], h[7]});
  }
  Completion<3> triangles(mesh.triangles);
  for (const auto& t : mesh.tetrahedra) {
    triangles.add({t[0], t[2], t[1]});
    triangles.add({t[0], t[1], t[3]});
    triangles.add({t[0], t[3], t[2]});
    triangles.add({t[1], t[2], t[3]});
  }
}

void addEdges(Mesh& mesh) {
  Completion<2> edges(mesh.edges);
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
  if (matrix && matrix->values.size() == 16) return transformByMatrix(mesh, matrix->values);
  auto scale = evaluation.vector(loader, {"scale3d"}, {1, 1, 1});
  if (const auto* text = loader.attributes.find("scale")) scale = scale * parseWholeFloat(*text).value_or(1);
  const auto rotation = fromEulerDegrees(evaluation.vector(loader, {"rotation"}, {}));
  const auto translation = evaluation.vector(loader, {"translation"}, {});
  for (auto& p : mesh.positions) p = rotate(rotation, scaled(p, scale)) + translation;
}

void transformSpheres(Evaluation& evaluation, const Component& loader, Mesh& mesh) {
  if (loader.attributes.has("scale")) {
    const auto scale = evaluation.vector(loader, {"scale"}, {});
    for (auto& radius : mesh.radii) radius *= scale[0];
    for (auto& p : mesh.positions) p = scaled(p, scale);
  }
  const auto translation = evaluation.vector(loader, {"translation"}, {});
  for (auto& p : mesh.positions) p = p + translation;
}

Mesh readBy(Evaluation& evaluation, const Component& loader, const std::filesystem::path& path) {
  if (loader.kind() == ComponentKind::SphereLoader) return readSpheres(path);
  if (loader.type == "MeshGmshLoader") return readGmsh(path);
  if (loader.type == "MeshVTKLoader") return readVtk(path);
  if (loader.type == "MeshOffLoader") return readOff(path);
  if (loader.type == "MeshTrianLoader") return readTrian(path);
  if (loader.type == "MeshSTLLoader") throw Unplaceable(loader, "STL meshes in scenes cannot be read");
  return readObj(path, {.triangulate = evaluation.flag(loader, "triangulate", false),
                        .splitSeams = evaluation.flag(loader, "handleSeams", false)});
}

}  // namespace

Mesh loadMesh(Evaluation& evaluation, const Component& loader) {
  const auto path = evaluation.file(loader, {"filename"});
  if (!path) throw Unplaceable(loader, "it names no file");
  auto mesh = readBy(evaluation, loader, *path);
  checkMesh(mesh, *path);
  if (loader.kind() == ComponentKind::SphereLoader) {
    transformSpheres(evaluation, loader, mesh);
    return mesh;
  }
  transform(evaluation, loader, mesh);
  if (evaluation.flag(loader, "triangulate", false)) triangulate(mesh);
  if (evaluation.flag(loader, "createSubelements", false)) addFaces(mesh), addEdges(mesh);
  if (evaluation.flag(loader, "onlyAttachedPoints", false)) keepAttachedPoints(mesh);
  return mesh;
}

}  // namespace allpairs::scene::sofa
