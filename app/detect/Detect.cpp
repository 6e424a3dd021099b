// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "Commands.h"
#include "allpairs/scene/ReadInput.h"
#include "cli/Arguments.h"
#include "cli/ExitStatus.h"
#include "cli/NpyOutput.h"
#include "cli/Options.h"
#include "cli/Output.h"
#include "cli/Progress.h"
#include "cli/Table.h"
#include "cli/Terminal.h"
#include "cli/Text.h"
#include "cli/TextParts.h"
#include "cli/Timer.h"
#include "detect/DetectWorlds.h"
#include "detect/Detection.h"
#include "detect/Exact.h"
#include "detect/SearchArguments.h"
#include "detect/Why.h"
#include "input/Inputs.h"

namespace allpairs::app {
namespace {

struct DetectSettings {
  InputSettings input;
  SearchArguments search;
  std::string strategy = "auto";
  std::string threads = "0";
  bool verify = false;
  bool exact = false;
  bool worlds = false;
  std::string format;  ///< Empty: as the output file's extension says, else a table.
  std::string output;
  std::string color = "auto";
  std::string failOn;
  std::vector<std::string> why;  ///< Two models, or none.
};

constexpr const char* kDetectExamples = R"(INPUT is one or more of
  .scn, .xml                     a SOFA scene
  .obj .stl .ply .glb .off ...   a mesh file: each object or node is a model
  a folder                       all mesh files in it; --recursive: and in those within it
  .npy                           boxes as a NumPy array (n, 6), float32 or float64:
                                 minx miny minz maxx maxy maxz
  .csv                           the same as text, with a name in the first or last column
With --worlds it is one .npy array (w, n, 6): w worlds of n boxes, each searched by itself.

Examples:
  allpairs detect scene.scn
  allpairs detect Demos/chain.scn --data share/sofa --data share/sofa/examples
  allpairs detect parts/ --distance 0.5
  allpairs detect structure.glb pipes.glb --between-inputs
  allpairs detect parts/ --exact --clearance 0.5
  allpairs detect parts/ --exact --min-depth 0.05 --fail-on clash
  allpairs detect boxes.npy -o pairs.npy
  allpairs detect robots.npy --worlds -o pairs.npy
  allpairs detect boxes.csv --box -10,-10,0,10,10,5 --format csv
  allpairs detect scene.scn --why /Ball/Surface/model 7
  allpairs detect scene.scn --verify --format json | jq '.pairs | length'

Boxes are closed: boxes that share a corner are a pair.)";

const std::vector<std::string> kDetectFormats = {"table", "csv", "json", "npy"};

DetectionOptions detectionOptions(const DetectSettings& settings) {
  DetectionOptions options = detectionOptions(settings.search);
  options.strategy = strategyOf(settings.strategy);
  options.threads = parseThreads(settings.threads);
  options.verify = settings.verify;
  return options;
}

void write(const scene::ResultView& result, const TableNotes& notes, const std::string& format, Output& output) {
  const auto sink = [&output](std::string_view bytes) { output.write(bytes); };
  if (format == "json") {
    scene::writeJson(result, sink);
  } else if (format == "csv") {
    scene::writeCsv(result, sink);
  } else if (format == "npy") {
    scene::writeNpy(result, sink);
  } else {
    writeTable(result, notes, sink);
  }
}

/// A detection and all that is needed to write it down.
struct Outcome {
  Detection detection{};
  scene::ResultView result{};
  TableNotes notes{};
  std::optional<ExactReport> exact{};
  BoxPairOrder order = BoxPairOrder::NewestFirst;  ///< Of the pairs that are written as .npy.
};

void writeExact(const Outcome& outcome, const std::string& format, Output& output) {
  const scene::ResultView& result = outcome.result;
  const ExactReport& exact = *outcome.exact;
  TextParts parts(output);
  const auto sink = [&parts](std::string_view bytes) { parts.write(bytes); };
  if (format == "json") {
    writeExactJson(result, exact, sink);
  } else if (format == "csv") {
    writeExactCsv(result, exact, sink);
  } else if (format == "npy") {
    writeExactNpy(result, exact, outcome.order, sink);
  } else {
    writeExactTable(result, exact, outcome.notes, sink);
  }
  parts.flush();
}

std::string summaryOf(const Outcome& outcome) {
  if (outcome.exact) return countText(countStates(outcome.exact->pairs));
  return counted(outcome.result.pairs.size(), "pair");
}

template <class Work>
Detection withClock(std::size_t count, const Work& work) {
  const ProgressClock clock("finding pairs among " + counted(count, "model"));
  return work();
}

Outcome detect(const BoxInput& input, const DetectSettings& settings, DetectionOptions options) {
  options.groups = input.groups;
  const scene::BoxArray& boxes = input.boxes;
  const BoxPairOrder order = settings.format == "npy" ? BoxPairOrder::FirstBelowSecond : BoxPairOrder::NewestFirst;
  Outcome outcome{.detection = withClock(boxes.size(), [&] { return detectBoxes(boxes, order, options); }),
                  .notes = {.method = boxMethod(options.distance, options.region) + betweenText(settings.input),
                            .simulated = boxes.size()}};
  outcome.result.modelCount = boxes.size();
  outcome.result.model = [&input](std::size_t i) {
    scene::ModelRecord record = boxRecord(input.boxes, i);
    if (!input.groups.empty()) record.groups = {static_cast<int>(input.groups[i])};
    return record;
  };
  outcome.result.warnings = input.warnings;
  return outcome;
}

Outcome detect(scene::Scene& scene, const DetectSettings& settings, const DetectionOptions& options) {
  warnOfPart(settings.input, scene);
  Outcome outcome{.detection = withClock(scene.models.size(), [&] { return detectScene(scene, options); })};
  if (settings.exact)
    outcome.exact =
        examine(scene, outcome.detection.pairs, {.clearance = options.clearance, .leastDepth = options.leastDepth});
  const auto& models = scene.models;
  outcome.notes.method = methodText(scene) + betweenText(settings.input);
  outcome.notes.remarkCount = scene.remarks.size();
  outcome.notes.isPartial = settings.input.partial;
  outcome.result.ignored = scene.remarks;
  outcome.result.warnings = scene.warnings;
  for (const auto& model : models) outcome.notes.simulated += model->isSimulated() ? 1U : 0U;
  outcome.result.modelCount = models.size();
  outcome.result.model = [&scene](std::size_t i) { return scene::modelRecord(scene, i); };
  return outcome;
}

void makeScene(Inputs& inputs) {
  if (const auto* input = std::get_if<BoxInput>(&inputs)) inputs = toScene(*input);
}

/// What --why is given with changes the pairs, and does not ask for them.
void checkWhy(const DetectSettings& settings) {
  const std::initializer_list<std::pair<std::string, bool>> others{
      {"--exact", settings.exact},
      {"--worlds", settings.worlds},
      {"--verify", settings.verify},
      {"--strategy", settings.strategy != "auto"},
      {"--threads", settings.threads != "0"},
      {"--fail-on", !settings.failOn.empty()},
      {"format " + settings.format, settings.format != kDetectFormats.front()}};
  for (const auto& [name, isGiven] : others) {
    if (isGiven) throw UsageError("--why says of two models whether their boxes are a pair; it takes no " + name);
  }
}

void explain(const DetectSettings& settings, const DetectionOptions& options, Output& output) {
  checkWhy(settings);
  Inputs inputs = readInputs(settings.input);
  makeScene(inputs);
  output.write(whyText(std::get<scene::Scene>(inputs), settings.why, options));
  output.commit();
  if (!settings.output.empty()) sayWritten("the answer", settings.output);
}

void runDetect(const DetectSettings& settings, const DetectionOptions& options) {
  checkOutputs(settings.input);
  Output output(targetOf(settings.output));
  if (settings.format == "npy") refuseTerminal(output);
  if (settings.search.clearance && !settings.exact)
    throw UsageError("--clearance is measured between shapes: add --exact, or use --distance for boxes");
  if (settings.search.leastDepth && !settings.exact) throw UsageError("--min-depth is of shapes: add --exact");
  if (settings.failOn == "clash" && !settings.exact) throw UsageError("--fail-on clash is of shapes: add --exact");
  if (settings.color == "always" && (settings.format != "table" || settings.worlds || !settings.why.empty()))
    throw UsageError("--color is of the table of pairs, and there is none");
  if (!settings.why.empty()) return explain(settings, options, output);
  if (settings.worlds) {
    if (settings.exact) throw UsageError("--exact tests shapes; the boxes of --worlds have none");
    if (settings.input.betweenInputs)
      throw UsageError("--between-inputs is of several inputs; --worlds takes one array");
    const std::size_t pairs = detectWorlds(settings.input, options, settings.format, output);
    output.commit();
    if (!settings.output.empty()) sayWritten(counted(pairs, "pair"), settings.output);
    if (settings.failOn == "pair" && pairs != 0) throw Found(counted(pairs, "pair"));
    return;
  }
  if (settings.exact) requireExact();
  const Timer timer;
  Inputs inputs = readInputs(settings.input);
  const bool areBoxes = std::holds_alternative<BoxInput>(inputs);
  if (settings.exact) makeScene(inputs);
  const double readSeconds = timer.seconds();
  Outcome outcome = std::visit([&](auto& input) { return detect(input, settings, options); }, inputs);
  if (areBoxes) outcome.order = BoxPairOrder::FirstBelowSecond;
  outcome.result.pairs = outcome.detection.pairs;
  outcome.result.pipelines = outcome.detection.pipelines;
  outcome.result.swapped = outcome.detection.swapped;
  outcome.result.statistics = outcome.detection.statistics;
  outcome.result.statistics.readSeconds = readSeconds;
  outcome.notes.width = output.isTerminal() ? terminalWidth(STDOUT_FILENO) : std::nullopt;
  outcome.notes.isColoured = wantsColour(settings.color, output.isTerminal());
  std::optional<ProgressClock> clock;
  if (!settings.output.empty()) clock.emplace("writing");  // not into a pager, which may wait for long
  if (outcome.exact) {
    writeExact(outcome, settings.format, output);
  } else {
    write(outcome.result, outcome.notes, settings.format, output);
  }
  output.commit();
  clock.reset();
  if (!settings.output.empty()) sayWritten(summaryOf(outcome), settings.output);
  const bool isFound = settings.failOn == "clash"  ? countStates(outcome.exact->pairs).clashes() != 0
                       : settings.failOn == "pair" ? !outcome.result.pairs.empty()
                                                   : false;
  if (isFound)
    throw Found(settings.failOn == "pair" ? counted(outcome.result.pairs.size(), "pair") : summaryOf(outcome));
}

}  // namespace

void addDetect(CLI::App& program) {
  const auto settings = std::make_shared<DetectSettings>();
  CLI::App* command = program.add_subcommand("detect", "Find the pairs of models that may touch");
  command->footer(kDetectExamples);
  addInputs(*command, settings->input);
  addBetweenInputs(*command, settings->input);
  addSearchOptions(*command, settings->search);
  addStrategy(*command, settings->strategy);
  addThreads(*command, settings->threads);
  command->add_flag("--verify", settings->verify, "Also search exhaustively; fail on any difference");
  command->add_flag("--exact", settings->exact,
                    "Test the shapes too: clashes with depth and position, distances of the other pairs");
  command->add_flag("--worlds", settings->worlds, "A .npy array (w, n, 6): pairs of boxes of the same world only");
  addChoice(*command, "--fail-on", settings->failOn, {"pair", "clash"})
      ->description("End with status 4 if there is a pair, or with --exact a clash");
  command
      ->add_option("--why", settings->why, "Say why the models A and B, each by name or number, are or are not a pair")
      ->type_name("MODEL")
      ->option_text("A B")
      ->expected(2);
  addFormat(*command, settings->format, kDetectFormats);
  addOutput(*command, settings->output);
  addChoice(*command, "--color", settings->color, {"auto", "always", "never"})
      ->description("Colours in the table; auto: on a terminal, unless NO_COLOR is set");
  command->callback([settings] {
    settings->format = formatOf(settings->format, settings->output, kDetectFormats);
    settings->input.outputs = {settings->output};
    withInputs(settings->input, [settings] { runDetect(*settings, detectionOptions(*settings)); });
  });
}

}  // namespace allpairs::app
