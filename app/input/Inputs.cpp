// SPDX-License-Identifier: MIT
#include "input/Inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadInput.h"
#include "cli/Arguments.h"
#include "cli/Progress.h"
#include "cli/Text.h"
#include "input/SpooledInputs.h"

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
    const std::string name = printable(progress.file.filename().string());
    if (progress.total < 2) return line.show("reading: " + name);
    line.show(progress.done, progress.total,
              fmt::format("reading {} of {}: {}", progress.done + 1, progress.total, name));
  };
  return options;
}

/// Says on standard error where boxes are empty, as a rule by mistake. Infinite bounds are meant.
void warnOfEmpty(const scene::BoxArray& boxes, const std::string& file) {
  const auto axisOf = [](const Box& box) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool isFinite = std::isfinite(box.min[axis]) && std::isfinite(box.max[axis]);
      if (isFinite && box.min[axis] > box.max[axis]) return axis;
    }
    return std::size_t{3};
  };
  std::size_t count = 0;
  std::string first;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::size_t axis = axisOf(boxes.boxes()[i]);
    if (axis == 3) continue;
    if (++count > 1) continue;
    const std::string name = boxes.name(i) == std::to_string(i) ? "" : " '" + boxes.name(i) + "'";
    first = fmt::format("box {}{} has min above max on {}", i, name, "xyz"[axis]);
  }
  if (count == 0) return;
  const std::string more = count > 1 ? " (and " + counted(count - 1, "other box", "other boxes") + ")" : "";
  fmt::print(stderr, "allpairs: warning: {}\n", printable(file + ": " + first + more + ": empty, in no pair"));
}

scene::BoxArray readBoxArrays(const InputSettings& settings, const scene::ReadOptions& options, ProgressLine& line) {
  std::vector<scene::BoxArray> arrays;
  for (const std::string& path : settings.paths) {
    arrays.push_back(scene::readBoxArray(path, options));
    line.clear();
    warnOfEmpty(arrays.back(), settings.spooled == nullptr ? path : settings.spooled->shown(path).string());
  }
  return scene::BoxArray::concatenate(std::move(arrays));
}

/// Files by the names that the user gave them.
void nameAsGiven(const SpooledInputs& spooled, scene::Scene& scene) {
  for (auto& file : scene.files) file = spooled.shown(file);
  for (scene::Remark& remark : scene.remarks) remark.file = spooled.shown(remark.file);
  for (scene::Remark& warning : scene.warnings) warning.file = spooled.shown(warning.file);
}

scene::Scene readScene(const InputSettings& settings, std::size_t input, const scene::ReadOptions& options) {
  scene::Scene scene = scene::readInput(settings.paths[input], options);
  if (settings.spooled != nullptr)
    nameAsGiven(*settings.spooled, scene);  // models are named by it when others are there
  return scene;
}

scene::Scene readScenes(const InputSettings& settings, const scene::ReadOptions& options) {
  scene::Scene scene = readScene(settings, 0, options);
  std::vector<scene::Scene> others;
  for (std::size_t i = 1; i < settings.paths.size(); ++i) others.push_back(readScene(settings, i, options));
  scene::append(scene, std::move(others));
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

void withInputs(InputSettings& settings, const std::function<void()>& work) {
  withSpooledInputs(settings.paths, settings.limits.inputFormat, [&](const SpooledInputs& spooled) {
    settings.spooled = &spooled;
    work();
    settings.spooled = nullptr;
  });
}

Inputs readInputs(const InputSettings& settings) {
  ProgressLine line;
  const scene::ReadOptions options = readOptions(settings, line);
  const bool areBoxes = std::all_of(settings.paths.begin(), settings.paths.end(),
                                    [](const std::string& path) { return scene::isBoxArrayFile(path); });
  if (areBoxes) return readBoxArrays(settings, options, line);
  scene::Scene scene = readScenes(settings, options);
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
