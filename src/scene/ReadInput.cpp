// SPDX-License-Identifier: MIT
#include "allpairs/scene/ReadInput.h"

#include <memory>
#include <utility>

#include "allpairs/collision/BoxModel.h"
#include "allpairs/scene/EmptyBoxes.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadSofaScene.h"
#include "input/FileBytes.h"
#include "input/ModelNames.h"
#include "input/ReadScope.h"
#include "mesh/MeshObject.h"

namespace allpairs::scene {

Scene toScene(const BoxArray& boxes) {
  Scene scene = emptyScene();
  scene.models.reserve(boxes.size());
  scene.owners.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    auto model = std::make_unique<collision::BoxModel>(boxes.name(i), boxes.boxes()[i]);
    scene.owners.push_back(std::make_unique<Owner>(Owner{model->getName()}));
    model->setOwner(scene.owners.back().get());
    scene.models.push_back(std::move(model));
  }
  return scene;
}

namespace {

/// Boxes as models take far more memory than the file that holds them.
Scene readBoxes(const std::filesystem::path& path, const ReadOptions& options) {
  const BoxArray boxes = readBoxArray(path, options);
  ReadScope scope(path, options);
  scope.admit(path);
  scope.take(ReadScope::kBytesPerModel * boxes.size());
  Scene scene = toScene(boxes);
  scene.inputs = scope.files();
  scene.warnings = boxWarnings(boxes, path);
  noteSources(scene, path);
  return scene;
}

}  // namespace

bool isSceneFile(const std::filesystem::path& path) {
  const std::string extension = lowerExtension(path);
  return extension == ".scn" || extension == ".xml";
}

Scene readInput(const std::filesystem::path& path, const ReadOptions& options) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return readMeshFolder(path, options);
  requireFile(path);
  if (isBoxArrayFile(path)) return readBoxes(path, options);
  if (isSceneFile(path)) return readSofaScene(path, options);
  if (isMeshFile(path)) return readMesh(path, options);
  const std::string extension = lowerExtension(path);
  if (extension == ".py" || extension == ".pyscn")
    throw FileError(
        path, "is a SOFA scene in Python, which only SOFA can run: open it in runSofa, save it as .scn, and read that");
  if (extension == ".pscn" || extension == ".php")
    throw FileError(path,
                    "is a SOFA scene in PHP, which is a program: read what it prints, `php -f SCENE.pscn > SCENE.scn`");
  if (const std::string_view reason = whyNotRead(path); !reason.empty()) throw FileError(path, std::string(reason));
  throw FileError(path, "is of no kind that is known: .scn or .xml for scenes, .npy or .csv for boxes, or a mesh");
}

}  // namespace allpairs::scene
