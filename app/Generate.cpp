// SPDX-License-Identifier: MIT
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Commands.h"
#include "ExitStatus.h"
#include "NpyOutput.h"
#include "Output.h"
#include "OutputOption.h"
#include "SceneArguments.h"

namespace allpairs::app {
namespace {

struct GenerateSettings {
  SceneArguments scene;
  std::string output;
};

constexpr const char* kExamples = R"(Examples:
  allpairs generate uniform -n 100000 -o boxes.npy
  allpairs generate needles -n 50000 --seed 7 --sorted -o needles.npy

The file holds a NumPy array (n, 6), float32: minx miny minz maxx maxy maxz. It is
the same on every machine for the same scene, number, seed and order.)";

/// A name that promises another format would be a lie.
void checkExtension(const std::string& path) {
  const std::string extension = lowerExtension(path);
  if (extension.empty() || extension == ".npy") return;
  throw UsageError("-o: '" + path + "': boxes are written as a NumPy array, whose files end in .npy");
}

void runGenerate(const GenerateSettings& settings) {
  checkExtension(settings.output);
  const generate::SceneRequest request = sceneRequest(settings.scene);
  Output output(settings.output.empty() ? std::nullopt : std::optional<std::filesystem::path>(settings.output));
  if (output.isTerminal()) {
    throw UsageError("boxes are binary and not for a terminal: name a file with -o, or redirect the output");
  }
  NpyOutput(output, "<f4", {request.count, 6}).add(generate::makeBoxes(request));
  output.commit();
}

}  // namespace

void addGenerate(CLI::App& program) {
  const auto settings = std::make_shared<GenerateSettings>();
  CLI::App* command = program.add_subcommand("generate", "Make boxes to measure with");
  command->footer(sceneList() + "\n\n" + kExamples);
  command->add_option("SCENE", settings->scene.scene, "Which boxes to make; see below")->required()->type_name("");
  addSceneOptions(*command, settings->scene);
  addOutputOption(*command, settings->output);
  command->callback([settings] { runGenerate(*settings); });
}

}  // namespace allpairs::app
