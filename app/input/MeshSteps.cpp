// SPDX-License-Identifier: MIT
#include "input/MeshSteps.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "allpairs/collision/TriangleModel.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadInput.h"
#include "cli/ExitStatus.h"
#include "cli/Text.h"
#include "input/Inputs.h"

namespace allpairs::app {
namespace {

TriangleMesh toMesh(const collision::TriangleModel& model) {
  TriangleMesh mesh{.name = model.getName(), .positions = {}, .triangles = {}};
  mesh.positions.reserve(3 * model.positions().size());
  for (const auto& point : model.positions()) mesh.positions.insert(mesh.positions.end(), point.begin(), point.end());
  mesh.triangles.reserve(3 * model.triangles().size());
  for (const auto& t : model.triangles()) mesh.triangles.insert(mesh.triangles.end(), t.begin(), t.end());
  return mesh;
}

std::string triangleText(const std::uint32_t* corners) {
  return fmt::format("({}, {}, {})", corners[0], corners[1], corners[2]);
}

void checkSameMesh(const TriangleMesh& earlier, const std::string& earlierName, const TriangleMesh& later,
                   const std::filesystem::path& path) {
  const std::string name = "mesh '" + printable(later.name) + "'";
  if (earlier.positions.size() != later.positions.size()) {
    throw FileError(
        path, fmt::format("{} has {} where {} has {}", name, counted(later.positions.size() / 3, "vertex", "vertices"),
                          earlierName, grouped(earlier.positions.size() / 3)));
  }
  if (earlier.triangles.size() != later.triangles.size()) {
    throw FileError(path,
                    fmt::format("{} has {} where {} has {}", name, counted(later.triangles.size() / 3, "triangle"),
                                earlierName, grouped(earlier.triangles.size() / 3)));
  }
  const auto [there, here] = std::mismatch(earlier.triangles.begin(), earlier.triangles.end(), later.triangles.begin());
  if (there == earlier.triangles.end()) return;
  const auto triangle = static_cast<std::size_t>(there - earlier.triangles.begin()) / 3;
  throw FileError(path, fmt::format("triangle {} of {} joins vertices {} where in {} it joins {}", triangle, name,
                                    triangleText(&later.triangles[3 * triangle]), earlierName,
                                    triangleText(&earlier.triangles[3 * triangle])));
}

}  // namespace

std::vector<TriangleMesh> readTriangleMeshes(const InputSettings& settings, std::size_t input, bool isFirst) {
  const std::string& path = settings.paths[input];
  const scene::Scene scene = scene::readInput(path, readOptions(settings.limits));
  checkOutputs(settings, scene.inputs);
  if (isFirst) warnOf(settings, scene.warnings);
  std::vector<TriangleMesh> meshes;
  for (std::size_t i = 0; i < scene.models.size(); ++i) {
    const auto* triangles = dynamic_cast<const collision::TriangleModel*>(scene.models[i].get());
    if (triangles == nullptr) continue;
    TriangleMesh& mesh = meshes.emplace_back(toMesh(*triangles));
    if (i >= scene.sources.size()) continue;
    const std::string file = scene.files[scene.sources[i].file].filename().string();
    mesh.isNamed = mesh.name.find(file) == std::string::npos;
  }
  if (meshes.empty())
    throw FileError(path, scene::isBoxArrayFile(path) ? "holds boxes, and no triangles" : "holds no triangles");
  if (const std::size_t left = scene.models.size() - meshes.size(); left != 0 && isFirst)
    warnOf(settings, {{.file = path, .subject = {}, .reason = counted(left, "model") + " left out: no triangle mesh"}});
  return meshes;
}

void refuseScenesAsFrames(const InputSettings& settings) {
  for (const std::string& path : settings.paths) {
    if (!scene::isSceneFile(path)) continue;
    throw UsageError(printable(shownPath(settings, path).string()) +
                     ": a SOFA scene is read as it is at its start, and has no frames; 'allpairs detect' finds the "
                     "pairs of the start, and sofa-trace-scene (docs/sofa.md) those of each step, run by SOFA");
  }
}

std::vector<Box> triangleBoxes(const std::vector<TriangleMesh>& meshes) {
  std::vector<Box> boxes;
  for (const TriangleMesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      if (i % 3 == 0) boxes.push_back(kEmptyBox);
      const double* point = &mesh.positions[3 * std::size_t{mesh.triangles[i]}];
      boxes.back() = merge(boxes.back(), Box{{point[0], point[1], point[2]}, {point[0], point[1], point[2]}});
    }
  }
  return boxes;
}

void checkSameMeshes(const std::vector<TriangleMesh>& earlier, const std::filesystem::path& earlierPath,
                     const std::vector<TriangleMesh>& later, const std::filesystem::path& laterPath) {
  const std::string earlierName = "'" + printable(earlierPath.string()) + "'";
  if (earlier.size() != later.size()) {
    throw FileError(laterPath, fmt::format("holds {} where {} holds {}", counted(later.size(), "mesh", "meshes"),
                                           earlierName, grouped(earlier.size())));
  }
  for (std::size_t i = 0; i < later.size(); ++i) {
    const bool areNamed = later.size() > 1 && earlier[i].isNamed && later[i].isNamed;
    if (areNamed && earlier[i].name != later[i].name) {
      throw FileError(laterPath, fmt::format("mesh {} is '{}' where in {} it is '{}'", i, printable(later[i].name),
                                             earlierName, printable(earlier[i].name)));
    }
    checkSameMesh(earlier[i], earlierName, later[i], laterPath);
  }
}

std::vector<MeshStep> readMeshSteps(const InputSettings& settings, std::size_t start) {
  const std::string& before = settings.paths[start];
  const std::string& after = settings.paths[start + 1];
  std::vector<TriangleMesh> first = readTriangleMeshes(settings, start, true);
  std::vector<TriangleMesh> last = before == after ? first : readTriangleMeshes(settings, start + 1, false);
  checkSameMeshes(first, before, last, after);
  std::vector<MeshStep> steps(first.size());
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = {std::move(first[i]), std::move(last[i].positions)};
  return steps;
}

}  // namespace allpairs::app
