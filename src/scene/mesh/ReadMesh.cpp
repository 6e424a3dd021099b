// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/collision/LineModel.h"
#include "allpairs/collision/PointModel.h"
#include "allpairs/collision/TriangleModel.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/FolderNames.h"
#include "allpairs/scene/ReadInput.h"
#include "allpairs/scene/TargetFile.h"
#include "input/FileBytes.h"
#include "input/ModelNames.h"
#include "input/SceneFrame.h"
#include "input/UniqueNames.h"
#include "input/Words.h"
#include "mesh/MeshObject.h"

namespace allpairs::scene {
namespace {

namespace fs = std::filesystem;

/// Of a folder that has other files to read; the other commands do not take it.
constexpr const char* kPartialHint = "; --partial of detect, info, view and report leaves it out";

std::vector<MeshObject> readObjects(const fs::path& path, ReadScope& scope, FileNotes& notes) {
  scope.admit(path);
  std::error_code ignored;
  if (fs::file_size(path, ignored) == 0) throw FileError(path, "is empty");
  const std::string extension = lowerExtension(path);
  if (extension == ".obj") return readObjObjects(path, scope);
  if (extension == ".ply") return readPlyObjects(path, scope);
  if (extension == ".stl") return readStlObjects(path, scope);
  if (extension == ".off") return readOffObjects(path, scope);
  if (extension == ".dxf") return readDxfObjects(path, scope, notes);
  if (extension == ".gltf" || extension == ".glb") return readGltfObjects(path, scope, notes);
  return readAssimpObjects(path, scope, notes);
}

/// The models of an object's triangles, its lines and its points, where it has any.
std::vector<std::unique_ptr<collision::CollisionModel>> modelsOf(MeshObject& object) {
  std::vector<std::unique_ptr<collision::CollisionModel>> models(3);
  std::vector<Point> isolated;
  for (const std::uint32_t index : object.points) isolated.push_back(object.positions[index]);
  if (!isolated.empty()) models[2] = std::make_unique<collision::PointModel>(object.name, std::move(isolated));
  if (!object.lines.empty()) {
    models[1] = std::make_unique<collision::LineModel>(object.name, object.positions, std::move(object.lines));
  }
  if (!object.triangles.empty()) {
    models[0] = std::make_unique<collision::TriangleModel>(object.name, std::move(object.positions),
                                                           std::move(object.triangles));
  }
  std::erase(models, nullptr);
  return models;
}

/// Adds the models of an object of the scene's last file, all of one owner, under names that are new in the file.
void addObject(Scene& scene, MeshObject object, UniqueNames& names, ReadScope& scope) {
  scope.take(ReadScope::kBytesPerModel +
             4 * object.name.size() +  // its owner, its model and the names in use have it too
             3 * (object.body.size() + object.assembly.size() + object.path.size()));  // of up to three models
  scene.owners.push_back(std::make_unique<Owner>(Owner{object.name}));
  for (auto& model : modelsOf(object)) {
    model->setName(names.unique(object.name));
    model->setOwner(scene.owners.back().get());
    scene.sources.push_back({.file = scene.files.size() - 1,
                             .name = model->getName(),
                             .kind = object.kind,
                             .id = object.id,
                             .body = object.body,
                             .assembly = object.assembly,
                             .assemblyId = object.assemblyId,
                             .path = object.path});
    scene.models.push_back(std::move(model));
  }
}

std::vector<fs::path> sortedEntries(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (const std::string& name : folderNames(folder, error)) entries.push_back(folder / name);
  if (error) throw FileError::ofSystem(folder, "cannot be listed", error);
  std::sort(entries.begin(), entries.end());
  return entries;
}

/// The remark on a file or folder that cannot be read and is therefore skipped.
Remark remarkOfMissing(const fs::path& path, const FileError& problem) {
  return {.file = path,
          .line = problem.line(),
          .subject = path.filename().string(),
          .reason = problem.problem(),
          .isPartial = true};
}

/// Whether this is what macOS keeps of a file's properties beside it, as `._part.stl` beside `part.stl`, on disks that
/// are not its own and in archives: AppleDouble (RFC 1740), whose first four bytes are these. A link is none, and its
/// target may be one that must not be read.
bool isAppleDouble(const fs::path& file) {
  std::error_code ignored;
  if (!file.filename().string().starts_with("._") || fs::is_symlink(file, ignored)) return false;
  std::array<char, 4> begin{};
  std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  return begin == std::array<char, 4>{0x00, 0x05, 0x16, 0x07};
}

/// Finds the mesh files of a folder; its other entries become remarks.
class MeshSearch {
 public:
  MeshSearch(const ReadOptions& options, std::vector<Remark>& remarks) : m_options(options), m_remarks(remarks) {}

  void look(const fs::path& folder) {
    checkStop(m_options.stop);
    const std::size_t before = m_meshes.size();
    std::vector<fs::path> unread;
    for (const fs::path& entry : sortedEntries(folder)) take(entry, unread);
    std::set<fs::path> meshes;  // without their extensions
    for (std::size_t i = before; i < m_meshes.size() && !unread.empty(); ++i)
      meshes.insert(fs::path(m_meshes[i]).replace_extension());
    for (const fs::path& file : unread) takeUnread(file, meshes.contains(fs::path(file).replace_extension()));
  }

  [[nodiscard]] const std::vector<fs::path>& meshes() const { return m_meshes; }
  [[nodiscard]] bool hasPassedOverFolders() const { return m_hasPassedOverFolders; }

 private:
  /// Takes meshes, looks into folders, remarks on the rest, and lists those of formats that are not read.
  void take(const fs::path& entry, std::vector<fs::path>& unread) {
    if (!canBeLookedAt(entry)) return;
    std::error_code ignored;
    const bool isSpecial = fs::exists(entry, ignored) && !fs::is_regular_file(entry, ignored);
    if (fs::is_directory(entry, ignored)) {
      takeFolder(entry);
    } else if (!isSpecial && (isMeshFile(entry) || !whyNotRead(entry).empty()) && isAppleDouble(entry)) {
      remarkOn(entry, "is what macOS keeps of a file's properties, no mesh");
    } else if (!isSpecial && !whyNotRead(entry).empty()) {
      unread.push_back(entry);
    } else if (isSpecial || !isMeshFile(entry)) {
      remarkOn(entry, isSpecial ? "is not a regular file" : "is no mesh file by its extension");
    } else {
      m_meshes.push_back(entry);
    }
  }

  /// What nobody may look at, or has too long a path, might be a mesh, or a folder of them.
  bool canBeLookedAt(const fs::path& entry) {
    std::error_code problem;
    const fs::file_status status = fs::symlink_status(entry, problem);
    if (!problem || status.type() == fs::file_type::not_found) return true;  // that which is gone is reported later
    const auto error = [&] { return FileError::ofSystem(entry, "cannot be looked at", problem); };
    if (!m_options.partial) throw error();
    m_remarks.push_back(remarkOfMissing(entry, error()));
    return false;
  }

  /// Where the part is not there as a mesh too, its clashes would be missing without a warning.
  void takeUnread(const fs::path& entry, bool isThereAsMesh) {
    const std::string reason(whyNotRead(entry));
    if (isThereAsMesh) return remarkOn(entry, "is not read; a mesh of the same name beside it is");
    if (!m_options.partial) throw FileError(entry, reason + (m_meshes.empty() ? "" : kPartialHint));
    m_remarks.push_back(remarkOfMissing(entry, FileError(entry, reason)));
  }

  /// A link may lead back to a folder above it, or to one that is searched anyway.
  void takeFolder(const fs::path& folder) {
    std::error_code ignored;
    const bool isLink = fs::is_symlink(folder, ignored);
    if (m_options.recursive && !isLink) return lookWithin(folder);
    m_hasPassedOverFolders = true;
    remarkOn(folder, m_options.recursive ? "is a link to a folder, which is not followed"
                                         : "is a folder; folders within a folder are not searched without --recursive");
  }

  void lookWithin(const fs::path& folder) {
    try {
      look(folder);
    } catch (const FileError& problem) {
      if (!m_options.partial) throw;
      m_remarks.push_back(remarkOfMissing(folder, problem));
    }
  }

  void remarkOn(const fs::path& entry, const char* reason) {
    m_remarks.push_back({.file = entry, .subject = entry.filename().string(), .reason = reason});
  }

  const ReadOptions& m_options;
  std::vector<Remark>& m_remarks;
  std::vector<fs::path> m_meshes;
  bool m_hasPassedOverFolders = false;
};

/// A link in a folder may lead out of it.
void requireAllowed(const fs::path& path, const ReadScope& scope) {
  static_cast<void>(resolvedTarget(path));  // refuses a link to itself
  if (scope.allows(path)) return;
  throw FileError(
      path, "is a link to a file outside of the folder and of those given with --data; --allow-outside allows it");
}

/// Reads the objects of one file behind what the scene has.
void readInto(Scene& scene, const fs::path& path, ReadScope& scope) {
  scene.files.push_back(path);
  UniqueNames names;
  const std::size_t models = scene.models.size();
  const std::size_t owners = scene.owners.size();
  FileNotes notes;
  try {
    std::vector<MeshObject> objects = readObjects(path, scope, notes);
    for (MeshObject& object : objects) {
      if (object.name.empty()) object.name = path.filename().string();
      names.note(object.name);
    }
    for (MeshObject& object : objects) {
      if (!object.passedOver.empty()) {
        scene.remarks.push_back({.file = path, .subject = object.name, .reason = std::move(object.passedOver)});
      }
      addObject(scene, std::move(object), names, scope);
    }
    if (scene.models.size() == models) throw FileError(path, "holds no triangles, lines or points");
  } catch (const Error& problem) {  // none of a file that is left out stays
    scene.models.resize(models);
    scene.sources.resize(models);
    scene.owners.resize(owners);
    scene.files.pop_back();
    if (dynamic_cast<const InvalidArgument*>(&problem) != nullptr) throw FileError(path, problem.what());
    throw;
  }
  for (std::string& reason : notes.passedOver)
    scene.remarks.push_back({.file = path, .subject = path.filename().string(), .reason = std::move(reason)});
  for (FileWarning& warning : notes.warnings)
    scene.warnings.push_back(
        {.file = path, .subject = std::move(warning.subject), .reason = std::move(warning.reason)});
  const MeshFrame& frame = notes.frame;
  noteFrame(scene, path, frame.up, frame.metresPerUnit > 0.0 ? std::optional(frame.metresPerUnit) : std::nullopt);
}

}  // namespace

bool isMeshFile(const fs::path& path) {
  if (isSceneFile(path) || isBoxArrayFile(path)) return false;
  const std::string extension = lowerExtension(path);
  return isOneOf(extension, {".dxf", ".obj", ".ply"}) || isAssimpFile(path);
}

Scene readMesh(const fs::path& path, const ReadOptions& options) {
  if (options.progress) options.progress({.done = 0, .total = 1, .file = path});
  Scene scene = emptyScene();
  ReadScope scope(path, options);
  readInto(scene, path, scope);
  scene.inputs = scope.files();
  return scene;
}

Scene readMeshFolder(const fs::path& path, const ReadOptions& options) {
  Scene scene = emptyScene();
  ReadScope scope(path, options);
  MeshSearch search(options, scene.remarks);
  search.look(path);
  const std::vector<fs::path>& meshes = search.meshes();
  const bool isAnyLeftOut =
      std::any_of(scene.remarks.begin(), scene.remarks.end(), [](const Remark& remark) { return remark.isPartial; });
  if (meshes.empty() && !isAnyLeftOut) {
    const bool isHint = search.hasPassedOverFolders() && !options.recursive;
    const char* hint = isHint ? "; --recursive of detect, info, view and report searches those within it, too" : "";
    throw FileError(path, "is a folder without mesh files" + std::string(hint));
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (options.progress) options.progress({.done = i, .total = meshes.size(), .file = meshes[i]});
    try {
      requireAllowed(meshes[i], scope);
      readInto(scene, meshes[i], scope);
    } catch (const FileError& problem) {
      if (!options.partial) throw;
      scene.remarks.push_back(remarkOfMissing(meshes[i], problem));
    }
  }
  scene.inputs = scope.files();
  nameModels(scene);
  return scene;
}

}  // namespace allpairs::scene
