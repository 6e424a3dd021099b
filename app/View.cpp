// SPDX-License-Identifier: MIT
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <string>

#include "Commands.h"
#include "ExitStatus.h"
#include "InputOptions.h"
#include "MakeViewScene.h"
#include "Output.h"
#include "OutputOption.h"
#include "SearchArguments.h"
#include "WritePage.h"

namespace allpairs::app {
namespace {

struct ViewSettings {
  InputSettings input;
  SearchArguments search;
  std::string output;
};

constexpr const char* kExamples = R"(The page needs no network and no other file: send it to whom you like. Press ? in it.

Examples:
  allpairs view scene.scn -o scene.html
  allpairs view parts/ --margin 0.5 --open
  allpairs view boxes.npy --serve)";

void runView(const ViewSettings& settings) {
  const view::ViewScene scene = makeViewScene(settings.input, detectionOptions(settings.search));
  Output output(settings.output);
  view::writePage(scene, [&output](std::string_view bytes) { output.write(bytes); });
  output.commit();
}

}  // namespace

void addView(CLI::App& program) {
  const auto settings = std::make_shared<ViewSettings>();
  CLI::App* command = program.add_subcommand("view", "Write a page that shows models and pairs in 3D");
  command->footer(kExamples);
  addInputOptions(*command, settings->input);
  addSearchOptions(*command, settings->search);
  addOutputOption(*command, settings->output);
  command->callback([settings] { runView(*settings); });
}

}  // namespace allpairs::app
