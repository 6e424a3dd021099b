// SPDX-License-Identifier: MIT
#include "Inputs.h"

#include <algorithm>
#include <utility>

#include "Progress.h"

namespace allpairs::app {
namespace {

scene::ReadOptions readOptions(const InputSettings& settings, ProgressLine& line) {
  scene::ReadOptions options;
  options.searchRoots.assign(settings.searchRoots.begin(), settings.searchRoots.end());
  options.partial = settings.partial;
  options.progress = [&line](const scene::Progress& progress) {
    const std::string count = progress.total == 0 ? "" : ' ' + std::to_string(progress.done + 1) + " of " +
                                                             std::to_string(progress.total);
    line.show("reading" + count + ": " + progress.file.filename().string());
  };
  return options;
}

scene::BoxArray readBoxArrays(const std::vector<std::string>& paths, const scene::ReadOptions& options) {
  std::vector<scene::BoxArray> arrays;
  for (const std::string& path : paths) arrays.push_back(scene::readBoxArray(path, options));
  return scene::BoxArray::concatenate(std::move(arrays));
}

}  // namespace

Inputs readInputs(const InputSettings& settings) {
  ProgressLine line;
  const scene::ReadOptions options = readOptions(settings, line);
  return readBoxArrays(settings.paths, options);
}

}  // namespace allpairs::app
