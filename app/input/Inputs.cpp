// SPDX-License-Identifier: MIT
#include "input/Inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadInput.h"
#include "cli/Arguments.h"
#include "cli/Progress.h"
#include "cli/Text.h"

namespace allpairs::app {
namespace {

void checkFolders(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    std::error_code error;
    if (!std::filesystem::is_directory(path, error)) throw FileError(path, "is not a folder; --data takes folders");
  }
}

scene::ReadOptions readOptions(const InputSettings& settings, ProgressLine& line) {
  checkFolders(settings.searchRoots);
  scene::ReadOptions options = readOptions(settings.limits);
  options.searchRoots.assign(settings.searchRoots.begin(), settings.searchRoots.end());
  options.partial = settings.partial;
  if (!settings.sofa.empty())
    options.sofa = settings.sofa == "20.06" ? scene::SofaVersion::Sofa2006 : scene::SofaVersion::Sofa2612;
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

std::string pipelineText(const scene::ScenePipeline& pipeline) {
  std::string text =
      fmt::format("{}: {}, {}, alarm distance {}", printable(pipeline.name), counted(pipeline.models.size(), "model"),
                  pipeline.intersection->typeName(), pipeline.intersection->getAlarmDistance());
  if (pipeline.region) text += fmt::format(", in the region {}", boxText(*pipeline.region));
  return text;
}

/// Says on standard error, a line each, where the result may not be what is expected.
void warn(const scene::Scene& scene, ProgressLine& line) {
  line.clear();
  for (const scene::Remark& warning : scene.warnings) {
    const std::string subject = warning.subject.empty() ? "" : warning.subject + ": ";
    fmt::print(stderr, "allpairs: warning: {}\n",
               printable(fmt::format("{}:{}: {}{}", warning.file.string(), warning.line, subject, warning.reason)));
  }
}

}  // namespace

scene::ReadOptions readOptions(const ReadLimits& limits) {
  scene::ReadOptions options;
  options.allowOutside = limits.allowOutside;
  if (!limits.maxMemory.empty()) options.maxMemory = parseMemory("--max-memory", limits.maxMemory);
  return options;
}

Inputs readInputs(const InputSettings& settings) {
  ProgressLine line;
  const scene::ReadOptions options = readOptions(settings, line);
  const bool areBoxes = std::all_of(settings.paths.begin(), settings.paths.end(),
                                    [](const std::string& path) { return scene::isBoxArrayFile(path); });
  if (areBoxes) return readBoxArrays(settings.paths, options);
  scene::Scene scene = readScenes(settings.paths, options);
  warn(scene, line);
  return scene;
}

scene::ModelRecord boxRecord(const scene::BoxArray& boxes, std::size_t i) {
  return {.name = boxes.name(i), .type = "BoxModel", .elements = 1, .box = boxes.boxes()[i]};
}

std::string methodText(const scene::Scene& scene) {
  if (!scene.pipelines.empty()) {
    std::string text = fmt::format("{} pipelines, each of its own models", scene.pipelines.size());
    for (const scene::ScenePipeline& pipeline : scene.pipelines) text += "\n         " + pipelineText(pipeline);
    return text;
  }
  const std::string method(scene.intersection->typeName());
  std::string text = fmt::format("{}, alarm distance {}", method, scene.intersection->getAlarmDistance());
  if (scene.intersection->isContinuous()) text += fmt::format(", continuous over {} s", scene.timeStep);
  if (scene.region) text += fmt::format(", in the region {}", boxText(*scene.region));
  return text;
}

}  // namespace allpairs::app
