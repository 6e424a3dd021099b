// SPDX-License-Identifier: MIT
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/scene.h>
#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "allpairs/scene/FileError.h"
#include "input/FileBytes.h"
#include "input/ReadScope.h"
#include "input/UniqueNames.h"
#include "input/Words.h"
#include "mesh/Assemblies.h"
#include "mesh/Faces.h"
#include "mesh/MeshObject.h"
#include "mesh/PathNames.h"
#include "mesh/Transform.h"
#include "mesh/assimp/AmfFile.h"
#include "mesh/assimp/AssimpFrame.h"
#include "mesh/assimp/AssimpLog.h"
#include "mesh/assimp/AssimpWarnings.h"
#include "mesh/assimp/ChildProcess.h"
#include "mesh/assimp/IfcNames.h"
#include "mesh/assimp/X3dNodes.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

/// The most levels of nodes: those of Assimp are taken apart by recursion.
constexpr std::size_t kMaxNodeDepth = 1000;

// What the answer of the process that runs Assimp begins with.
constexpr char kResult = 'R';
constexpr char kProblem = 'P';

Point pointOf(const aiVector3D& position) {
  return {static_cast<double>(position.x), static_cast<double>(position.y), static_cast<double>(position.z)};
}

template <class T>
std::span<T* const> spanOf(T* const* items, unsigned count) {
  return {items, count};
}

/// Names that Assimp's readers make up where the file has none.
bool isMadeUp(std::string_view name) { return name.empty() || isOneOf(name, {"ROOT", "RootNode", "<DummyRootNode>"}); }

/// Whether Assimp has made a node of a part of an FBX's transform: "arm_$AssimpFbx$_PreRotation".
bool isStepOfTransform(const aiNode& node) {
  return node.mNumMeshes == 0 && std::string_view(node.mName.C_Str()).find("_$AssimpFbx$_") != std::string_view::npos;
}

/// Takes a name as IfcColumn_name_2AvctVUKr0kugbFTf53O9L apart; another one is no product's.
std::optional<IfcProduct> ifcProductOf(const std::string& text) {
  constexpr std::size_t kIdLength = 22;
  constexpr std::string_view kUnnamed = "Unnamed";  // what Assimp writes where there is no name
  const std::size_t kindEnd = text.find('_');
  if (!text.starts_with("Ifc") || text.size() < kindEnd + 2 + kIdLength) return std::nullopt;
  const std::size_t idBegin = text.size() - kIdLength;
  if (kindEnd == std::string::npos || text[idBegin - 1] != '_') return std::nullopt;
  const std::string kind = text.substr(0, kindEnd);
  const std::string name = kindEnd + 1 < idBegin - 1 ? text.substr(kindEnd + 1, idBegin - 2 - kindEnd) : "";
  return IfcProduct{name.empty() || name == kUnnamed ? kind : name, kind, text.substr(idBegin)};
}

/// Whether a class is of a place, which holds products and is no part of one.
bool isSpatial(std::string_view kind) {
  return isOneOf(kind, {"IfcProject", "IfcSite", "IfcBuilding", "IfcBuildingStorey", "IfcSpace"});
}

/// Whether products of a class have no body: holes, ports, loads, and what drawings show.
bool isWithoutBody(std::string_view kind) {
  return isSpatial(kind) || kind.starts_with("IfcStructural") ||
         isOneOf(kind, {"IfcOpeningElement", "IfcVoidingFeature", "IfcAnnotation", "IfcVirtualElement",
                        "IfcDistributionPort", "IfcGrid"});
}

class NodeReader {
 public:
  NodeReader(const aiScene& scene, const Path& path, ReadScope& scope)
      : m_scene(scene), m_path(path), m_scope(scope), m_isIfc(lowerExtension(path).starts_with(".ifc")) {
    if (m_isIfc) m_ifcNames = ifcNames(readText(path));
  }

  std::vector<MeshObject> read(MeshFrame& frame) {
    addNode(*m_scene.mRootNode, rootOfFile(m_scene, lowerExtension(m_path), frame), {}, 0);
    if (m_isIfc) {
      nameProducts();
    } else {
      nameAssemblies();
      nameByPath(m_objects, m_places, m_nodes, m_scope);
    }
    return std::move(m_objects);
  }

  /// Products that should have a body, and of which nothing is shown.
  [[nodiscard]] const std::vector<IfcProduct>& shapeless() const { return m_shapeless; }

 private:
  static constexpr std::size_t kNone = NestedNode::kNoParent;

  /// What a node is below, itself included, by places in lists.
  struct Place {
    std::size_t product = kNone;   ///< The nearest.
    std::size_t assembly = kNone;  ///< The outermost product that is no place.
    std::size_t node = kNone;
  };

  /// Of an object of an IFC.
  struct Origin {
    std::size_t product = kNone;
    std::size_t assembly = kNone;
    bool isPart = false;  ///< Of the product, and not the product itself.
  };

  void addNode(const aiNode& node, const Transform& world, Place place, std::size_t depth) {
    if (depth > kMaxNodeDepth) throw FileError(m_path, "has nodes that are nested too deep");
    const bool isProduct = m_isIfc && enterProduct(node, place);
    const std::size_t before = m_objects.size();
    if (!isStepOfTransform(node)) {
      m_nodes.push_back({place.node, node.mNumMeshes != 0, isProduct ? m_products.back().name : nodeNameOf(node)});
      place.node = m_nodes.size() - 1;
    }
    if (node.mNumMeshes != 0) addObject(node, world, place, isProduct);
    for (const aiNode* child : spanOf(node.mChildren, node.mNumChildren)) {
      addNode(*child, multiply(world, transformOf(child->mTransformation)), place, depth + 1);
    }
    if (!isProduct || m_objects.size() != before) return;
    const IfcProduct& product = m_products[place.product];
    if (!isWithoutBody(product.kind)) m_shapeless.push_back(product);
  }

  /// Where the node is a product, it is what those below are parts of.
  bool enterProduct(const aiNode& node, Place& place) {
    std::optional<IfcProduct> product = ifcProductOf(node.mName.C_Str());
    if (!product) return false;
    const auto exact = m_ifcNames.find(product->id);
    if (exact != m_ifcNames.end() && !exact->second.empty()) product->name = exact->second;
    place.product = m_products.size();
    if (place.assembly == kNone && !isSpatial(product->kind)) place.assembly = place.product;
    m_inNodes.push_back({place.node, product->name});
    m_products.push_back(std::move(*product));
    return true;
  }

  void addObject(const aiNode& node, const Transform& world, const Place& place, bool isProduct) {
    MeshObject& object = m_objects.emplace_back();
    object.name = isProduct ? m_products.back().name : nameOf(node);
    m_places.push_back(place.node);
    m_origins.push_back({place.product, place.assembly, !isProduct});
    for (const unsigned index : std::span(node.mMeshes, node.mNumMeshes)) {
      addMesh(object, *m_scene.mMeshes[index], world);
    }
  }

  /// Products by their names and places. Their parts, such as mapped items, are called by them: window/IfcMappedItem,
  /// or where one is all of it, window.
  void nameProducts() {
    std::vector<PathName> names = pathNames(m_nodes, m_inNodes, m_scope);
    UniqueNames taken;
    for (const PathName& name : names) taken.note(name.name);
    for (PathName& name : names) name.name = taken.unique(name.name);
    std::vector<std::size_t> sizes(m_products.size());
    for (const Origin& origin : m_origins) {
      if (origin.product != kNone) ++sizes[origin.product];
    }
    for (std::size_t i = 0; i < m_objects.size(); ++i) {
      const Origin& origin = m_origins[i];
      if (origin.product == kNone) continue;
      MeshObject& object = m_objects[i];
      const PathName& name = names[origin.product];
      const std::string part = origin.isPart && sizes[origin.product] > 1 ? '/' + object.name : "";
      object.name = name.name + part;
      if (!name.path.empty()) object.path = name.path + part;
      object.body = name.name;
      object.kind = m_products[origin.product].kind;
      object.id = m_products[origin.product].id;
      if (origin.assembly == kNone) continue;
      object.assembly = names[origin.assembly].name;
      object.assemblyId = m_products[origin.assembly].id;
    }
  }

  void nameAssemblies() {
    const std::vector<std::string> assemblies = assembliesOf(m_nodes, m_scope);
    for (std::size_t i = 0; i < m_objects.size(); ++i) m_objects[i].assembly = assemblies[m_places[i]];
  }

  /// The root of an X3D has the path by which the file is opened.
  [[nodiscard]] bool isUnnamed(const std::string& name) const { return isMadeUp(name) || name == m_path.string(); }

  /// What a node is called as a place; in an IFC only products are places.
  std::string nodeNameOf(const aiNode& node) const {
    const std::string name = node.mName.C_Str();
    const bool isOfReader = isUnnamed(name) || (name.starts_with('<') && name.ends_with('>'));  // <3DSRoot>
    return m_isIfc || isOfReader ? std::string() : name;
  }

  /// The node's own name, else that of its mesh, of which Assimp numbers the parts.
  std::string nameOf(const aiNode& node) const {
    std::string name = node.mName.C_Str();
    const bool isRoot = &node == m_scene.mRootNode && name.starts_with('<') && name.ends_with('>');  // <3DSRoot>
    if (!isUnnamed(name) && !isRoot) return name;
    std::string meshName = m_scene.mMeshes[node.mMeshes[0]]->mName.C_Str();
    if (node.mNumMeshes > 1 && meshName.ends_with("-0")) meshName.resize(meshName.size() - 2);
    return isMadeUp(meshName) ? std::string() : meshName;
  }

  void addMesh(MeshObject& object, const aiMesh& mesh, const Transform& world) {
    if (mesh.HasBones()) object.passedOver = "its skin is passed over: the vertices are where they are without it";
    const std::size_t base = object.positions.size();
    if (base + mesh.mNumVertices > std::numeric_limits<std::uint32_t>::max()) fail(object, "has too many vertices");
    m_scope.take(mesh.mNumVertices * sizeof(Point));
    for (const aiVector3D& position : std::span(mesh.mVertices, mesh.mNumVertices)) {
      object.positions.push_back(placed(world, pointOf(position)));
    }
    for (const aiFace& face : std::span(mesh.mFaces, mesh.mNumFaces)) addFaceOf(object, face, base);
    if (mesh.mNumFaces == 0) object.addAllPoints(base);
  }

  /// Assimp's own triangulation ends the program on bad faces.
  void addFaceOf(MeshObject& object, const aiFace& face, std::size_t base) {
    m_scope.takeElements(face.mNumIndices, sizeof(MeshObject::triangles[0]));
    if (face.mNumIndices == 0) fail(object, "has a face without vertices");
    const auto corner = [&](unsigned i) {
      if (face.mIndices[i] >= object.positions.size() - base) fail(object, "names a vertex that isn't there");
      return static_cast<std::uint32_t>(base + face.mIndices[i]);
    };
    m_corners.clear();
    for (unsigned i = 0; i < face.mNumIndices; ++i) m_corners.push_back(corner(i));
    const std::string problem = addCutFace(object, m_corners, m_scope);
    if (!problem.empty()) fail(object, "has " + problem);
  }

  [[noreturn]] void fail(const MeshObject& object, const std::string& problem) const {
    throw FileError(m_path, (object.name.empty() ? "an object" : "object '" + object.name + '\'') + ' ' + problem);
  }

  const aiScene& m_scene;
  const Path& m_path;
  ReadScope& m_scope;
  bool m_isIfc;
  std::unordered_map<std::string, std::string> m_ifcNames;  ///< By GlobalId.
  std::vector<NestedNode> m_nodes;
  std::vector<std::size_t> m_places;  ///< Of each object its node's in that list.
  std::vector<IfcProduct> m_products;
  std::vector<NestedItem> m_inNodes;  ///< Of each product the node that it is in.
  std::vector<Origin> m_origins;      ///< Of each object.
  std::vector<MeshObject> m_objects;
  std::vector<IfcProduct> m_shapeless;
  std::vector<std::uint32_t> m_corners;
};

/// Opens what Assimp asks for: the input, and what it may name.
class ScopedFiles final : public Assimp::IOSystem {
 public:
  ScopedFiles(const Path& input, ReadScope& scope) : m_input(input), m_scope(scope) {}

  bool Exists(const char* name) const override {
    std::error_code ignored;
    return std::filesystem::is_regular_file(name, ignored) && isAllowed(name);
  }

  char getOsSeparator() const override { return '/'; }

  Assimp::IOStream* Open(const char* name, const char* mode) override {
    const bool writes = std::string_view(mode).find_first_of("wa+") != std::string_view::npos;
    if (writes || !Exists(name)) return nullptr;
    m_opensOthers |= name != m_input;
    m_scope.admit(name);
    const std::string text = readText(name);
    auto bytes = std::make_unique<std::uint8_t[]>(text.size());
    std::copy(text.begin(), text.end(), bytes.get());
    return new Assimp::MemoryIOStream(bytes.release(), text.size(), true);
  }

  void Close(Assimp::IOStream* stream) override { const std::unique_ptr<Assimp::IOStream> closed(stream); }

  /// The mesh outside that the input names; empty if there is none. What else it may name, such as materials, is
  /// silently left alone: it has no geometry.
  [[nodiscard]] const std::string& refused() const { return m_refused; }

  /// Whether what goes wrong may be due to another file, of which no message must show anything.
  [[nodiscard]] bool opensOthers() const { return m_opensOthers; }

 private:
  bool isAllowed(const char* name) const {
    if (name == m_input || m_scope.allows(name)) return true;
    if (isAssimpFile(name)) m_refused = name;
    return false;
  }

  const Path& m_input;
  ReadScope& m_scope;
  mutable std::string m_refused;
  bool m_opensOthers = false;
};

/// Carries objects, and notes without remarks, from one process to another of the same program.
class ObjectTransfer {
 public:
  static std::string pack(const std::vector<MeshObject>& objects, const FileNotes& notes) {
    std::string bytes(1, kResult);
    bytes.append(reinterpret_cast<const char*>(&notes.frame), sizeof(notes.frame));
    const std::uint64_t count = notes.warnings.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof(count));
    for (const FileWarning& warning : notes.warnings) {
      put(bytes, warning.subject);
      put(bytes, warning.reason);
    }
    for (const MeshObject& object : objects) forEachPart(object, [&bytes](const auto& part) { put(bytes, part); });
    return bytes;
  }

  static std::vector<MeshObject> unpack(std::string_view bytes, FileNotes& notes) {
    std::vector<MeshObject> objects;
    copy(bytes, &notes.frame, sizeof(notes.frame));
    if (notes.frame.up < 0 || notes.frame.up > 3) notes.frame = {};
    std::uint64_t count = 0;
    for (copy(bytes, &count, sizeof(count)); count > 0; --count) {
      FileWarning& warning = notes.warnings.emplace_back();
      take(bytes, warning.subject);
      take(bytes, warning.reason);
    }
    while (!bytes.empty()) {
      MeshObject& object = objects.emplace_back();
      forEachPart(object, [&bytes](auto& part) { take(bytes, part); });
      check(object);
    }
    return objects;
  }

 private:
  template <class Object, class Visit>
  static void forEachPart(Object& object, const Visit& visit) {
    visit(object.name);
    visit(object.kind);
    visit(object.id);
    visit(object.body);
    visit(object.assembly);
    visit(object.assemblyId);
    visit(object.path);
    visit(object.passedOver);
    visit(object.positions);
    visit(object.triangles);
    visit(object.lines);
    visit(object.points);
  }

  template <class List>
  static void put(std::string& bytes, const List& list) {
    const std::uint64_t count = list.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof(count));
    bytes.append(reinterpret_cast<const char*>(list.data()), count * sizeof(list[0]));
  }

  template <class List>
  static void take(std::string_view& bytes, List& list) {
    std::uint64_t count = 0;
    copy(bytes, &count, sizeof(count));
    if (count > bytes.size() / sizeof(list[0])) throw Error("a mesh arrived in pieces");
    list.resize(static_cast<std::size_t>(count));
    copy(bytes, list.data(), list.size() * sizeof(list[0]));
  }

  static void copy(std::string_view& bytes, void* to, std::size_t count) {
    if (count > bytes.size()) throw Error("a mesh arrived in pieces");
    if (count != 0) std::memcpy(to, bytes.data(), count);
    bytes.remove_prefix(count);
  }

  /// A child that a hostile file has taken over may send anything.
  static void check(const MeshObject& object) {
    const auto isVertex = [&object](std::uint32_t index) { return index < object.positions.size(); };
    const auto areVertices = [&](const auto& corners) { return std::all_of(corners.begin(), corners.end(), isVertex); };
    const bool isWhole = areVertices(object.points) &&
                         std::all_of(object.lines.begin(), object.lines.end(), areVertices) &&
                         std::all_of(object.triangles.begin(), object.triangles.end(), areVertices);
    if (!isWhole) throw Error("a mesh arrived in pieces");
  }
};

/// In the child process, which ends with all that it has.
std::vector<MeshObject> importObjects(const Path& path, ReadScope& scope, FileNotes& notes) {
  const std::string extension = lowerExtension(path);
  const double amfUnit = extension == ".amf" ? checkedAmfUnit(path) : 0.0;
  const AssimpLog& log = AssimpLog::start();
  // Never freed: Assimp crashes where it frees pictures of a 3MF.
  static auto* const importer = new Assimp::Importer;  // NOLINT(cppcoreguidelines-owning-memory)
  auto owned = std::make_unique<ScopedFiles>(path, scope);
  const ScopedFiles* files = owned.get();
  importer->SetIOHandler(owned.release());  // which owns it
  const aiScene* scene = importer->ReadFile(path.string(), 0);
  if (!files->refused().empty()) {
    throw FileError(path, "names the file '" + files->refused() + "', which " + ReadScope::kOutside);
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string reason = files->opensOthers() ? "" : importer->GetErrorString();
    if (reason == std::bad_alloc().what()) throw std::bad_alloc();  // which Assimp has caught
    throw FileError(path, "cannot be read as a mesh" + (reason.empty() ? "" : ": " + reason));
  }
  if (log.parts() > 1) throw FileError(path, "has objects in several parts, which are not read: export it as one part");
  NodeReader reader(*scene, path, scope);
  std::vector<MeshObject> objects = reader.read(notes.frame);
  if (extension == ".fbx") notes.frame.metresPerUnit = unitOfFbx(*scene, readText(path));
  if (extension == ".amf") notes.frame.metresPerUnit = amfUnit;
  const std::set<std::string> nodes = x3dNodesOfShapes(path, log.skippedNodes());
  const std::set<std::string>& missing = log.missingKinds().empty() ? nodes : log.missingKinds();
  if (objects.empty() && !missing.empty())
    throw FileError(path, "holds no triangles, lines or points: " + notRead(missing));
  if (!nodes.empty()) notes.warnings.push_back({"shapes", notRead(nodes) + ": what they hold is missing"});
  if (!log.unknownPlacements().empty())
    notes.warnings.push_back({"placements", notRead(log.unknownPlacements()) + ": products are in wrong places"});
  warnOfMissing(path, log.missingKinds(), reader.shapeless(), notes.warnings);
  warnOfRounding(objects, notes.frame.metresPerUnit, notes.warnings);
  return objects;
}

/// The objects, or what is wrong.
std::string importInChild(const Path& path, ReadScope& scope) {
  try {
    FileNotes notes;
    const std::vector<MeshObject> objects = importObjects(path, scope, notes);
    return ObjectTransfer::pack(objects, notes);
  } catch (const FileError& problem) {
    return kProblem + problem.problem();
  } catch (const std::bad_alloc&) {
    return kProblem + std::string("takes more memory to read than --max-memory allows");
  } catch (const std::exception& problem) {
    return kProblem + std::string("cannot be read as a mesh: ") + problem.what();
  }
}

/// Versions differ in what they read.
bool assimpKnows(const std::string& extension) { return Assimp::Importer().IsExtensionSupported(extension.c_str()); }

}  // namespace

std::string_view whyNotRead(const Path& path) {
  static constexpr std::string_view kOfCad =
      "has the exact surfaces of a CAD program, which are not read: export a mesh, such as glTF, STL or OBJ";
  static constexpr std::string_view kOfScenes =
      "is of a format that is read only where a scene names it: export another mesh, such as glTF, STL or OBJ";
  static constexpr std::string_view kOfOthers =
      "is of a format that is not read: export a mesh, such as glTF, STL or OBJ";
  static const std::map<std::string_view, std::string_view> kReasons = [] {
    std::map<std::string_view, std::string_view> reasons;
    for (const char* extension : {".step", ".stp",     ".iges",       ".igs", ".brep", ".sldprt", ".sldasm", ".x_t",
                                  ".x_b",  ".catpart", ".ipt",        ".iam", ".prt",  ".sat",    ".sab",    ".jt",
                                  ".3dm",  ".f3d",     ".catproduct", ".par", ".psm",  ".dwg",    ".fcstd"})
      reasons[extension] = kOfCad;
    for (const char* extension : {".vtk", ".vtu", ".msh"}) reasons[extension] = kOfScenes;
    for (const char* extension : {".usd", ".usda", ".usdc", ".usdz", ".vtp", ".vts", ".vtm", ".wrl", ".abc", ".skp",
                                  ".rvt", ".dgn", ".nwd", ".max", ".c4d", ".ma", ".mb"})
      reasons[extension] = kOfOthers;
    return reasons;
  }();
  const std::string extension = lowerExtension(path);
  const auto found = kReasons.find(extension);
  const bool isRead = found == kReasons.end() || (found->second == kOfOthers && assimpKnows(extension));
  return isRead ? std::string_view() : found->second;
}

bool isAssimpFile(const Path& path) {
  const std::string extension = lowerExtension(path);
  return !extension.empty() && whyNotRead(path).empty() && assimpKnows(extension);
}

std::vector<MeshObject> readAssimpObjects(const Path& path, ReadScope& scope, FileNotes& notes) {
  constexpr std::uint64_t kSeconds = 10;
  constexpr std::uint64_t kBytesPerSecond = 1 << 20;       // the slowest of Assimp's readers on honest files
  const std::uint64_t size = InputFile(path).remaining();  // what is no file is refused here
  const std::string answer = runInChild([&] { return importInChild(path, scope); },
                                        {.memory = scope.left(), .cpuSeconds = kSeconds + size / kBytesPerSecond},
                                        [&scope](std::uint64_t bytes) { scope.take(2 * bytes); });
  if (answer.empty()) throw FileError(path, "cannot be read as a mesh: Assimp fails on it");
  if (answer.front() == kProblem) throw FileError(path, answer.substr(1));
  return ObjectTransfer::unpack(std::string_view(answer).substr(1), notes);
}

}  // namespace allpairs::scene
