// SPDX-License-Identifier: MIT
#include <assimp/config.h>
#include <assimp/scene.h>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <limits>
#include <new>
#include <span>
#include <string_view>

#include "FileBytes.h"
#include "MeshObject.h"
#include "allpairs/Error.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

/// A node's transform into the world: three rows of four, in double.
using Transform = std::array<std::array<double, 4>, 3>;

constexpr Transform kIdentity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

Transform multiply(const Transform& parent, const aiMatrix4x4& child) {
  Transform result{};
  for (unsigned row = 0; row < 3; ++row) {
    for (unsigned column = 0; column < 4; ++column) {
      double sum = column == 3 ? parent[row][3] : 0.0;
      for (unsigned k = 0; k < 3; ++k) sum += parent[row][k] * static_cast<double>(child[k][column]);
      result[row][column] = sum;
    }
  }
  return result;
}

Point apply(const Transform& transform, const aiVector3D& position) {
  const std::array<double, 3> p{static_cast<double>(position.x), static_cast<double>(position.y),
                                static_cast<double>(position.z)};
  Point result{};
  for (std::size_t row = 0; row < 3; ++row) {
    const std::array<double, 4>& m = transform[row];
    result[row] = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
  }
  return result;
}

template <class T>
std::span<T* const> spanOf(T* const* items, unsigned count) {
  return {items, count};
}

/// Names that Assimp's readers make up where the file has none.
bool isMadeUp(std::string_view name) {
  static constexpr std::array<std::string_view, 2> kMadeUp{"ROOT", "<DummyRootNode>"};
  const bool isNumberedGltf = (name.starts_with("nodes[") || name.starts_with("meshes[")) && name.ends_with(']');
  return name.empty() || isNumberedGltf || std::find(kMadeUp.begin(), kMadeUp.end(), name) != kMadeUp.end();
}

class NodeReader {
 public:
  NodeReader(const aiScene& scene, const Path& path) : m_scene(scene), m_path(path) {}

  std::vector<MeshObject> read() {
    addNode(*m_scene.mRootNode, kIdentity);
    return std::move(m_objects);
  }

 private:
  void addNode(const aiNode& node, const Transform& parent) {
    const Transform world = multiply(parent, node.mTransformation);
    if (node.mNumMeshes != 0) {
      MeshObject& object = m_objects.emplace_back();
      object.name = nameOf(node);
      for (const unsigned index : std::span(node.mMeshes, node.mNumMeshes)) {
        addMesh(object, *m_scene.mMeshes[index], world);
      }
    }
    for (const aiNode* child : spanOf(node.mChildren, node.mNumChildren)) addNode(*child, world);
  }

  /// The node's own name, else that of its mesh, of which Assimp numbers the parts.
  std::string nameOf(const aiNode& node) const {
    std::string name = node.mName.C_Str();
    if (!isMadeUp(name)) return name;
    std::string meshName = m_scene.mMeshes[node.mMeshes[0]]->mName.C_Str();
    if (node.mNumMeshes > 1 && meshName.ends_with("-0")) meshName.resize(meshName.size() - 2);
    return isMadeUp(meshName) ? std::string() : meshName;
  }

  void addMesh(MeshObject& object, const aiMesh& mesh, const Transform& world) {
    const std::size_t base = object.positions.size();
    if (base + mesh.mNumVertices > std::numeric_limits<std::uint32_t>::max()) fail(object, "has too many vertices");
    object.positions.reserve(base + mesh.mNumVertices);
    for (const aiVector3D& position : std::span(mesh.mVertices, mesh.mNumVertices)) {
      object.positions.push_back(apply(world, position));
    }
    for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) addFace(object, face, base);
    if (mesh.mNumFaces == 0) addAllPoints(object, base);
  }

  /// A face of more than three corners becomes a fan. Assimp's own triangulation ends the program on bad faces.
  void addFace(MeshObject& object, const aiFace& face, std::size_t base) {
    if (face.mNumIndices == 0) fail(object, "has a face without vertices");
    const auto corner = [&](unsigned i) {
      if (face.mIndices[i] >= object.positions.size() - base) fail(object, "names a vertex that isn't there");
      return static_cast<std::uint32_t>(base + face.mIndices[i]);
    };
    if (face.mNumIndices == 1) object.points.push_back(corner(0));
    if (face.mNumIndices == 2) object.lines.push_back({corner(0), corner(1)});
    for (unsigned i = 2; i < face.mNumIndices; ++i) object.triangles.push_back({corner(0), corner(i - 1), corner(i)});
  }

  static void addAllPoints(MeshObject& object, std::size_t base) {
    for (std::size_t i = base; i < object.positions.size(); ++i) object.points.push_back(static_cast<std::uint32_t>(i));
  }

  [[noreturn]] void fail(const MeshObject& object, const char* problem) const {
    throw FileError(m_path, (object.name.empty() ? "an object" : "object '" + object.name + '\'') + ' ' + problem);
  }

  const aiScene& m_scene;
  const Path& m_path;
  std::vector<MeshObject> m_objects;
};

std::string problemOf(const Assimp::Importer& importer) {
  const std::string_view text = importer.GetErrorString();
  return text.empty() ? "it is no mesh" : std::string(text);
}

}  // namespace

bool isAssimpFile(const Path& path) {
  const std::string extension = lowerExtension(path);
  return !extension.empty() && Assimp::Importer().IsExtensionSupported(extension.c_str());
}

std::vector<MeshObject> readAssimpObjects(const Path& path) {
  requireFile(path);
  Assimp::Importer importer;
  const aiScene* scene = nullptr;
  try {
    scene = importer.ReadFile(path.string(), 0);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& problem) {
    throw FileError(path, std::string("cannot be read as a mesh: ") + problem.what());
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    throw FileError(path, "cannot be read as a mesh: " + problemOf(importer));
  }
  return NodeReader(*scene, path).read();
}

}  // namespace allpairs::scene
