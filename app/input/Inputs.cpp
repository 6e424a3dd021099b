// SPDX-License-Identifier: MIT
#include "input/Inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <utility>

#include "allpairs/collision/BoxModel.h"
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

/// The axis on which a box is empty, as a rule by mistake: infinite bounds are meant. 3 if there is none.
std::size_t emptyAxis(const Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool isFinite = std::isfinite(box.min[axis]) && std::isfinite(box.max[axis]);
    if (isFinite && box.min[axis] > box.max[axis]) return axis;
  }
  return 3;
}

/// What to say of a file's boxes with min above max: which one is the first, and how many others. Its reason is empty
/// if there is none. `boxOf` and `nameOf` take the row of a box.
template <class BoxOf, class NameOf>
scene::Remark remarkOnEmpty(std::filesystem::path file, std::size_t boxes, const BoxOf& boxOf, const NameOf& nameOf) {
  std::size_t count = 0;
  scene::Remark remark{.file = std::move(file)};
  for (std::size_t i = 0; i < boxes; ++i) {
    const std::size_t axis = emptyAxis(boxOf(i));
    if (axis == 3 || ++count > 1) continue;
    const std::string name = nameOf(i);
    remark.subject = fmt::format("box {}", i) + (name == std::to_string(i) ? "" : " '" + name + "'");
    remark.reason = fmt::format("min above max on {}", "xyz"[axis]);
  }
  if (count > 1) remark.reason += " (and " + counted(count - 1, "other box", "other boxes") + ")";
  if (count > 0) remark.reason += ": empty, in no pair";
  return remark;
}

void add(scene::Remark remark, std::vector<scene::Remark>& remarks) {
  if (!remark.reason.empty()) remarks.push_back(std::move(remark));
}

std::filesystem::path shownPath(const InputSettings& settings, const std::string& path) {
  return settings.spooled == nullptr ? std::filesystem::path(path) : settings.spooled->shown(path);
}

BoxInput readBoxArrays(const InputSettings& settings, const scene::ReadOptions& options) {
  BoxInput input;
  std::vector<scene::BoxArray> arrays;
  for (const std::string& path : settings.paths) {
    arrays.push_back(scene::readBoxArray(path, options));
    const scene::BoxArray& boxes = arrays.back();
    const auto boxOf = [&boxes](std::size_t i) { return boxes.boxes()[i]; };
    const auto nameOf = [&boxes](std::size_t i) { return boxes.name(i); };
    add(remarkOnEmpty(shownPath(settings, path), boxes.size(), boxOf, nameOf), input.warnings);
  }
  input.boxes = scene::BoxArray::concatenate(std::move(arrays));
  return input;
}

/// Files by the names that the user gave them.
void nameAsGiven(const SpooledInputs& spooled, scene::Scene& scene) {
  for (auto& file : scene.files) file = spooled.shown(file);
  for (scene::Remark& remark : scene.remarks) remark.file = spooled.shown(remark.file);
  for (scene::Remark& warning : scene.warnings) warning.file = spooled.shown(warning.file);
}

/// The box of a model that was made of a row of a file.
Box boxAsRead(const collision::CollisionModel& model) {
  return dynamic_cast<const collision::BoxModel&>(model).boxes().front();
}

scene::Scene readScene(const InputSettings& settings, std::size_t input, const scene::ReadOptions& options) {
  const std::string& path = settings.paths[input];
  scene::Scene scene = scene::readInput(path, options);
  if (scene::isBoxArrayFile(path)) {
    const auto boxOf = [&scene](std::size_t i) { return boxAsRead(*scene.models[i]); };
    const auto nameOf = [&scene](std::size_t i) { return scene.models[i]->getName(); };
    add(remarkOnEmpty(path, scene.models.size(), boxOf, nameOf), scene.warnings);
  }
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
void warn(const std::vector<scene::Remark>& warnings, ProgressLine& line) {
  line.clear();
  for (const scene::Remark& warning : warnings) {
    const std::string place = warning.line == 0 ? "" : fmt::format(":{}", warning.line);
    const std::string subject = warning.subject.empty() ? "" : warning.subject + ": ";
    fmt::print(stderr, "allpairs: warning: {}\n",
               printable(fmt::format("{}{}: {}{}", warning.file.string(), place, subject, warning.reason)));
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
  if (areBoxes) {
    BoxInput input = readBoxArrays(settings, options);
    warn(input.warnings, line);
    return input;
  }
  scene::Scene scene = readScenes(settings, options);
  warn(scene.warnings, line);
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
