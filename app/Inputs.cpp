// SPDX-License-Identifier: MIT
#include "Inputs.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "Progress.h"
#include "Records.h"
#include "allpairs/Error.h"
#include "allpairs/scene/ReadInput.h"

namespace allpairs::app {
namespace {

void checkFolders(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    std::error_code error;
    if (!std::filesystem::is_directory(path, error)) throw FileError(path, "is not a folder to look for files in");
  }
}

scene::ReadOptions readOptions(const InputSettings& settings, ProgressLine& line) {
  checkFolders(settings.searchRoots);
  scene::ReadOptions options;
  options.searchRoots.assign(settings.searchRoots.begin(), settings.searchRoots.end());
  options.partial = settings.partial;
  options.progress = [&line](const scene::Progress& progress) {
    const std::string count =
        progress.total == 0 ? "" : ' ' + std::to_string(progress.done + 1) + " of " + std::to_string(progress.total);
    line.show("reading" + count + ": " + printable(progress.file.filename().string()));
  };
  return options;
}

scene::BoxArray readBoxArrays(const std::vector<std::string>& paths, const scene::ReadOptions& options) {
  std::vector<scene::BoxArray> arrays;
  for (const std::string& path : paths) arrays.push_back(scene::readBoxArray(path, options));
  return scene::BoxArray::concatenate(std::move(arrays));
}

scene::Scene readScenes(const std::vector<std::string>& paths, const scene::ReadOptions& options) {
  scene::Scene scene = scene::readInput(paths.front(), options);
  for (std::size_t i = 1; i < paths.size(); ++i) scene::append(scene, scene::readInput(paths[i], options));
  return scene;
}

}  // namespace

Inputs readInputs(const InputSettings& settings) {
  ProgressLine line;
  const scene::ReadOptions options = readOptions(settings, line);
  const bool areBoxes = std::all_of(settings.paths.begin(), settings.paths.end(),
                                    [](const std::string& path) { return scene::isBoxArrayFile(path); });
  if (areBoxes) return readBoxArrays(settings.paths, options);
  return readScenes(settings.paths, options);
}

}  // namespace allpairs::app
