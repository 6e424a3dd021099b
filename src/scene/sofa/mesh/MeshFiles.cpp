// SPDX-License-Identifier: MIT
#include "allpairs/scene/FileError.h"
#include "input/FileBytes.h"
#include "input/TextScanner.h"
#include "sofa/mesh/Mesh.h"

namespace allpairs::scene::sofa {
namespace {

template <std::size_t N>
void checkElements(const Elements<N>& elements, const char* kind, const Mesh& mesh, const std::filesystem::path& path) {
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (const auto corner : elements[i])
      if (corner >= mesh.positions.size())
        throw FileError(path, std::string{kind} + ' ' + std::to_string(i) + " names point " + std::to_string(corner) +
                                  " of " + std::to_string(mesh.positions.size()));
}

Index readIndex(TextScanner& text, std::size_t count) {
  const auto index = text.integer();
  if (index < 0 || static_cast<std::size_t>(index) >= count) text.fail("a face names a point that isn't there");
  return static_cast<Index>(index);
}

}  // namespace

void checkMesh(const Mesh& mesh, const std::filesystem::path& path) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (!isFinite(mesh.positions[i])) throw FileError(path, "point " + std::to_string(i) + " is not finite");
  checkElements(mesh.edges, "edge", mesh, path);
  checkElements(mesh.triangles, "triangle", mesh, path);
  checkElements(mesh.quads, "quad", mesh, path);
  checkElements(mesh.tetrahedra, "tetrahedron", mesh, path);
  checkElements(mesh.hexahedra, "hexahedron", mesh, path);
}

Mesh readSpheres(const std::filesystem::path& path, const StopFlag* stop) {
  TextScanner text(path, stop);
  if (text.wordInLine() != "sph") text.fail("a file of spheres starts with 'sph 1.0'");
  text.skipLine();
  Mesh mesh;
  for (auto word = text.word(); !word.empty(); word = text.word()) {
    if (word == "sphe") {
      text.integer();
      mesh.positions.push_back(text.point());
      mesh.radii.push_back(text.number());
    } else {
      text.skipLine();
    }
  }
  return mesh;
}

/// Lines that begin with '#' are comments, as in SOFA: before the counts, a point, or a face.
Mesh readOff(const std::filesystem::path& path, const StopFlag* stop) {
  TextScanner text(path, stop);
  text.expect("OFF");
  text.skipComments();
  const auto points = text.integer(), faces = text.integer();
  text.integer();
  Mesh mesh;
  for (std::int64_t i = 0; i < points; ++i) {
    text.skipComments();
    mesh.positions.push_back(text.point());
  }
  for (std::int64_t i = 0; i < faces; ++i) {
    text.skipComments();
    std::vector<Index> corners;
    for (auto left = text.integer(); left > 0; --left) corners.push_back(readIndex(text, mesh.positions.size()));
    if (corners.size() == 3)
      mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    else if (corners.size() == 4)
      mesh.quads.push_back({corners[0], corners[1], corners[2], corners[3]});
    else
      ++mesh.passedOver;
    text.skipLine();
  }
  return mesh;
}

Mesh readTrian(const std::filesystem::path& path, const StopFlag* stop) {
  TextScanner text(path, stop);
  Mesh mesh;
  const auto points = text.integer();
  for (std::int64_t i = 0; i < points; ++i) mesh.positions.push_back(text.point());
  const auto faces = text.integer();
  for (std::int64_t i = 0; i < faces; ++i) {
    std::array<Index, 3> corners{};
    for (auto& corner : corners) corner = readIndex(text, mesh.positions.size());
    for (int neighbour = 0; neighbour < 3; ++neighbour) text.integer();
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

Mesh readMesh(const std::filesystem::path& path, const StopFlag* stop) {
  const std::string extension = lowerExtension(path);
  if (extension == ".obj") return readObj(path, {}, stop);
  if (extension == ".msh") return readGmsh(path, stop);
  if (extension == ".sph") return readSpheres(path, stop);
  if (extension == ".vtk" || extension == ".vtu" || extension == ".vtp") return readVtk(path, XmlSurfaces::Read, stop);
  if (extension == ".off") return readOff(path, stop);
  if (extension == ".trian") return readTrian(path, stop);
  throw FileError(path, "meshes of the kind '" + extension + "' cannot be read here");
}

}  // namespace allpairs::scene::sofa
