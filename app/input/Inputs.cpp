// SPDX-License-Identifier: MIT
#include "input/Inputs.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <system_error>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadInput.h"
#include "allpairs/scene/TargetFile.h"
#include "cli/Arguments.h"
#include "cli/ExitStatus.h"
#include "cli/Progress.h"
#include "cli/Text.h"
#include "cli/Warning.h"
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
  options.recursive = settings.recursive;
  if (!settings.sofa.empty()) options.sofa = scene::sofaVersionOf(settings.sofa);
  options.progress = [&line](const scene::Progress& progress) {
    const std::string name = printable(progress.file.filename().string());
    if (progress.total < 2) return line.show("reading: " + name);
    line.show(progress.done, progress.total,
              fmt::format("reading {} of {}: {}", progress.done + 1, progress.total, name));
  };
  return options;
}

BoxInput readBoxArrays(const InputSettings& settings, const scene::ReadOptions& options) {
  BoxInput input;
  std::vector<scene::BoxArray> arrays;
  for (const std::string& path : settings.paths) {
    arrays.push_back(scene::readBoxArray(path, options));
    const scene::BoxArray& boxes = arrays.back();
    for (scene::Remark& warning : scene::boxWarnings(boxes, path)) {
      warning.file = shownPath(settings, path);
      input.warnings.push_back(std::move(warning));
    }
    const auto group = static_cast<std::uint32_t>(arrays.size());
    if (settings.betweenInputs) input.groups.insert(input.groups.end(), boxes.size(), group);
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

scene::Scene readScene(const InputSettings& settings, std::size_t input, const scene::ReadOptions& options) {
  const std::string& path = settings.paths[input];
  scene::Scene scene = scene::readInput(path, options);
  for (const auto& model : scene.models) {
    if (settings.betweenInputs) model->addGroup(static_cast<int>(input) + 1);
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

void checkBetween(const InputSettings& settings) {
  if (!settings.betweenInputs) return;
  if (settings.paths.size() < 2)
    throw UsageError("--between-inputs leaves out pairs within one input: give two or more");
  for (const std::string& path : settings.paths) {
    if (scene::isSceneFile(path))
      throw UsageError("--between-inputs is not for SOFA scenes, whose groups say what is no pair: " + path);
  }
}

std::string pipelineText(const scene::ScenePipeline& pipeline) {
  std::string text =
      fmt::format("{}: {}, {}, alarm distance {}", printable(pipeline.name), counted(pipeline.models.size(), "model"),
                  pipeline.intersection->typeName(), pipeline.intersection->getAlarmDistance());
  if (pipeline.region) text += fmt::format(", in the region {}", boxText(*pipeline.region));
  return text;
}

/// Which file a path names, by whatever name; nothing where there is none.
std::optional<std::pair<dev_t, ino_t>> identityOf(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return std::pair(status.st_dev, status.st_ino);
}

/// What 'allpairs info --partial' needs besides the inputs to read the same, each word behind a blank.
std::string wordsOfReading(const InputSettings& settings) {
  std::string words = settings.recursive ? " --recursive" : "";
  for (const std::string& folder : settings.searchRoots) words += " --data " + shellWord(folder);
  if (!settings.sofa.empty()) words += " --sofa " + shellWord(settings.sofa);
  if (settings.limits.allowOutside) words += " --allow-outside";
  if (!settings.limits.maxMemory.empty()) words += " --max-memory " + shellWord(settings.limits.maxMemory);
  return words;
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

std::filesystem::path shownPath(const InputSettings& settings, const std::string& path) {
  return settings.spooled == nullptr ? std::filesystem::path(path) : settings.spooled->shown(path);
}

Inputs readInputs(const InputSettings& settings) {
  checkBetween(settings);
  ProgressLine line;
  const scene::ReadOptions options = readOptions(settings, line);
  if (areBoxArrays(settings)) {
    BoxInput input = readBoxArrays(settings, options);
    warnOf(settings, input.warnings);
    return input;
  }
  scene::Scene scene = readScenes(settings, options);
  warnOf(settings, scene.warnings);
  checkOutputs(settings, scene.inputs);
  return scene;
}

scene::Scene toScene(const BoxInput& input) {
  scene::Scene scene = scene::toScene(input.boxes);
  scene.warnings = input.warnings;
  for (std::size_t i = 0; i < input.groups.size(); ++i) scene.models[i]->addGroup(static_cast<int>(input.groups[i]));
  return scene;
}

std::string betweenText(const InputSettings& settings) {
  return settings.betweenInputs ? "; pairs of different inputs only" : "";
}

void checkOutputs(const InputSettings& settings) {
  for (const std::filesystem::path& output : settings.outputs) {
    if (settings.spooled != nullptr && settings.spooled->isSource(output))
      throw FileError(output, "is standard input; the output needs another name");
  }
  checkOutputs(settings, pathsOf(settings.paths));
}

void checkOutputs(const InputSettings& settings, const std::vector<std::filesystem::path>& inputs) {
  std::map<std::pair<dev_t, ino_t>, std::filesystem::path> outputs;
  for (const std::filesystem::path& output : settings.outputs) {
    if (const auto identity = identityOf(output)) outputs.emplace(*identity, output);
  }
  for (const std::filesystem::path& input : inputs) {
    const auto identity = outputs.empty() ? std::nullopt : identityOf(input);
    if (!identity) continue;
    if (const auto same = outputs.find(*identity); same != outputs.end())
      scene::checkIsNoInput(same->second, {&input, 1});
  }
}

void refuseSceneOptions(const InputSettings& settings, const std::string& to) {
  const std::initializer_list<std::pair<const char*, bool>> options{{"--recursive", settings.recursive},
                                                                    {"--partial", settings.partial},
                                                                    {"--data", !settings.searchRoots.empty()},
                                                                    {"--sofa", !settings.sofa.empty()}};
  for (const auto& [name, isGiven] : options) {
    if (isGiven) throw UsageError(fmt::format("{} does not apply to {}", name, to));
  }
}

void requireMemory(const InputSettings& settings, std::uint64_t bytes) {
  const std::uint64_t allowed = readOptions(settings.limits).maxMemory;
  if (bytes <= (allowed == 0 ? scene::halfOfMemory() : allowed)) return;
  throw FileError(settings.paths.front(), allowed == 0
                                              ? "needs more than half of the machine's memory; --max-memory allows more"
                                              : "needs more memory than --max-memory allows");
}

void warnOf(const InputSettings& settings, const std::vector<scene::Remark>& warnings) {
  for (const scene::Remark& warning : warnings) {
    const std::string place = warning.line == 0 ? "" : fmt::format(":{}", warning.line);
    const std::string subject = warning.subject.empty() ? "" : warning.subject + ": ";
    warn(
        fmt::format("{}{}: {}{}", shownPath(settings, warning.file.string()).string(), place, subject, warning.reason));
  }
}

void warnOfPart(const InputSettings& settings, const scene::Scene& scene) {
  const auto count = std::count_if(scene.remarks.begin(), scene.remarks.end(),
                                   [](const scene::Remark& remark) { return remark.isPartial; });
  if (count == 0) return;
  if (scene.models.empty()) {
    throw FileError(
        settings.paths.front(),
        fmt::format("no model of it can be placed or read, and nothing is left: 'allpairs info --partial{}' "
                    "lists why",
                    wordsOfReading(settings)));
  }
  std::vector<std::string> words;
  for (const std::string& path : settings.paths) words.push_back(shellWord(path));
  const std::string paths = fmt::format("{}", fmt::join(words, " "));
  const std::string inputs = settings.spooled == nullptr ? paths : settings.spooled->shownIn(paths);
  warn(fmt::format("{}: {} left out; 'allpairs info --partial{} {}' lists {}", inputs,
                   counted(static_cast<std::uint64_t>(count), "model"), wordsOfReading(settings), inputs,
                   count == 1 ? "it" : "them"));
}

void warnOfEmpty(const InputSettings& settings, const scene::EmptyBoxes& boxes, std::size_t each, const char* part) {
  if (boxes.count == 0) return;
  warn(fmt::format("{}: box {} of {} {}: {}", shownPath(settings, settings.paths.front()).string(), boxes.first % each,
                   part, boxes.first / each, emptyReason(boxes)));
}

scene::ModelRecord boxRecord(const scene::BoxArray& boxes, std::size_t i) {
  return {.name = boxes.name(i), .type = "BoxModel", .elements = 1, .box = boxes.boxes()[i]};
}

std::string boxMethod(std::optional<double> distance, const std::optional<Box>& region) {
  std::string text = distance ? fmt::format("boxes at most {} apart on every axis", *distance) : "boxes";
  if (region) text += fmt::format(", in the region {}", boxText(*region));
  return text;
}

bool isOfSofa(const scene::Scene& scene) {
  return std::any_of(scene.inputs.begin(), scene.inputs.end(), scene::isSceneFile);
}

bool areBoxArrays(const InputSettings& settings) {
  return std::all_of(settings.paths.begin(), settings.paths.end(),
                     [](const std::string& path) { return scene::isBoxArrayFile(path); });
}

bool areScenes(const InputSettings& settings) {
  return std::all_of(settings.paths.begin(), settings.paths.end(),
                     [](const std::string& path) { return scene::isSceneFile(path); });
}

std::string methodText(const scene::Scene& scene) {
  if (!scene.pipelines.empty()) {
    std::string text = fmt::format("{} pipelines, each of its own models", scene.pipelines.size());
    for (const scene::ScenePipeline& pipeline : scene.pipelines) text += "\n         " + pipelineText(pipeline);
    return text;
  }
  const double alarmDistance = scene.intersection->getAlarmDistance();
  if (!isOfSofa(scene))
    return boxMethod(alarmDistance == 0.0 ? std::nullopt : std::optional(alarmDistance), scene.region);
  const std::string method(scene.intersection->typeName());
  std::string text = fmt::format("{}, alarm distance {}", method, alarmDistance);
  if (scene.intersection->isContinuous()) text += fmt::format(", continuous over {} s", scene.timeStep);
  if (scene.region) text += fmt::format(", in the region {}", boxText(*scene.region));
  return text;
}

}  // namespace allpairs::app
