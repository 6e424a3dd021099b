// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <CLI/Validators.hpp>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "Clash.h"
#include "Commands.h"
#include "WritePage.h"
#include "allpairs/scene/FileError.h"
#include "cli/ExitStatus.h"
#include "cli/Options.h"
#include "cli/Output.h"
#include "cli/SignalCleanup.h"
#include "cli/TemporaryFolder.h"
#include "cli/Terminal.h"
#include "cli/Text.h"
#include "input/Inputs.h"
#include "view/MakeViewScene.h"
#include "view/OpenFile.h"
#include "view/ServePage.h"
#include "view/ViewFrames.h"
#include "view/ViewRequest.h"

namespace allpairs::app {
namespace {

struct ViewSettings {
  InputSettings input;
  ViewArguments view;
  std::string output;
  bool sequence = false;
  bool open = false;
  bool serve = false;
  int port = 0;
};

constexpr const char* kViewExamples =
    R"(Of a SOFA scene the page shows the pairs that detect finds, and why two other models are
none; with --exact, which surfaces meet. A scene with several collision pipelines is for
detect only. Of meshes shapes are tested, unless --boxes is given.
The page needs no network and no other file. Press ? in it for help.

Examples:
  allpairs view scene.scn -o scene.html
  allpairs view parts/ --clearance 0.5 --open
  allpairs view parts/ --boxes -o boxes.html
  allpairs view --sequence cloth_*.ply -o cloth.html
  allpairs view boxes.npy --serve)";

void writeFile(const view::ViewScene& scene, Output& output) {
  view::writePage(scene, [&output](std::string_view bytes) { output.write(bytes); });
  output.commit();
}

/// A new file in the folder for temporary files, which only the user may read; it goes with this object, or by a
/// signal, unless it is kept.
class TemporaryPage {
 public:
  TemporaryPage() : m_name(temporaryFolder() / "allpairs-XXXXXX.html") {
    const int descriptor = ::mkstemps(m_name.data(), 5);
    if (descriptor < 0) throw FileError(m_name, "cannot create a temporary file");
    ::close(descriptor);
    removeOnSignal(m_name);
  }
  ~TemporaryPage() {
    if (!m_isKept) ::unlink(m_name.c_str());
    keepOnSignal(m_name);
  }
  TemporaryPage(const TemporaryPage&) = delete;
  TemporaryPage& operator=(const TemporaryPage&) = delete;
  TemporaryPage(TemporaryPage&&) = delete;
  TemporaryPage& operator=(TemporaryPage&&) = delete;

  [[nodiscard]] const std::string& name() const { return m_name; }
  void keep() { m_isKept = true; }

 private:
  std::string m_name;
  bool m_isKept = false;
};

std::string writeTemporaryPage(const view::ViewScene& scene) {
  TemporaryPage page;
  Output output(page.name());
  writeFile(scene, output);
  page.keep();
  return page.name();
}

void serve(const view::ViewScene& scene, const ViewSettings& settings) {
  std::string page;
  view::writePage(scene, [&page](std::string_view bytes) { page += bytes; });
  servePage(page, settings.port, [&settings](const std::string& address) {
    Output(std::nullopt).write(address + " (end with Ctrl+C)\n");
    if (settings.open) tryToOpen(address);
  });
}

std::string whatIsIn(const view::ViewScene& scene) {
  return scene.frames.size() > 1 ? counted(scene.frames.size(), "frame") : view::headlineOf(scene);
}

view::ViewScene sceneOf(const ViewSettings& settings) {
  ViewRequest request = viewRequest(settings.view);
  request.isForPage = true;
  if (settings.sequence && settings.input.betweenInputs)
    throw UsageError("--between-inputs: the inputs of --sequence are one mesh at several times");
  return settings.sequence ? makeViewFrames(settings.input, request) : makeViewScene(settings.input, request);
}

void runView(const ViewSettings& settings) {
  checkOutputs(settings.input);
  std::optional<std::filesystem::path> path = targetOf(settings.output);
  std::optional<Output> output;
  if (path || (!settings.serve && !settings.open)) output.emplace(path);
  if (output && output->isTerminal())
    throw UsageError("a page is not written to a terminal: use -o FILE, --open or --serve");
  const view::ViewScene scene = sceneOf(settings);
  if (output) writeFile(scene, *output);
  if (!output && !settings.serve) path = writeTemporaryPage(scene);
  if (path) sayWritten(whatIsIn(scene), *path);
  if (settings.serve) return serve(scene, settings);
  if (settings.open) openInBrowser(std::filesystem::absolute(*path));
}

}  // namespace

void addView(CLI::App& program) {
  const auto settings = std::make_shared<ViewSettings>();
  CLI::App* command = program.add_subcommand("view", "Write an HTML page that shows models and pairs in 3D");
  command->footer(kViewExamples);
  addInputs(*command, settings->input);
  addBetweenInputs(*command, settings->input);
  addViewOptions(*command, settings->view);
  command->add_flag("--sequence", settings->sequence,
                    "Each INPUT is one frame of the same meshes: show pairs of triangles, frame by frame");
  const CLI::Option* const output = addOutput(*command, settings->output);
  command->add_flag("--open", settings->open, "Open the page in the browser");
  CLI::Option* const serve =
      command->add_flag("--serve", settings->serve, "Serve the page to this machine until the program is stopped");
  CLI::Option* const port =
      command->add_option("--port", settings->port, "Port to serve on; 0, the default: any free port");
  port->type_name("P")->needs(serve);
  takeNumber(*port, 0, 65535);
  command->callback([settings, output] {
    if (output->count() != 0 && settings->output.empty() && (settings->open || settings->serve))
      throw UsageError("-o -: a page for a browser is not written to standard output: name a file, or leave -o out");
    const std::string extension = lowerExtension(settings->output);
    if (!extension.empty() && extension != ".html" && extension != ".htm") {
      throw UsageError("-o: '" + settings->output + "': a page is written as .html");
    }
    settings->input.outputs = {settings->output};
    withInputs(settings->input, [settings] { runView(*settings); });
  });
}

}  // namespace allpairs::app
