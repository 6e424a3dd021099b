// SPDX-License-Identifier: MIT
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <optional>
#include <string>

#include "Arguments.h"
#include "Commands.h"
#include "Detection.h"
#include "ExitStatus.h"
#include "Inputs.h"
#include "Output.h"
#include "Progress.h"
#include "Table.h"

namespace allpairs::app {
namespace {

struct DetectSettings {
  InputSettings input;
  std::string margin;
  std::string box;
  std::string strategy = "auto";
  std::string threads = "0";
  bool verify = false;
  std::string format = "table";
  std::string output;
};

constexpr const char* kExamples = R"(INPUT is one or more of
  .scn, .xml                     a SOFA scene
  .obj .stl .ply .glb .off ...   a mesh file: each object or node in it is a model
  a folder                       all mesh files in it
  .npy                           boxes as a NumPy array (n, 6), float32 or float64:
                                 minx miny minz maxx maxy maxz
  .csv                           the same as lines of text, with a name first or last

Examples:
  allpairs detect scene.scn
  allpairs detect Demos/chain.scn --data share/sofa --data share/sofa/examples
  allpairs detect parts/ --margin 0.5
  allpairs detect boxes.npy --format npy -o pairs.npy
  allpairs detect boxes.csv --box -10,-10,0,10,10,5 --format csv
  allpairs detect scene.scn --verify --format json | jq '.pairs | length'

Boxes are closed: two that share a corner are a pair.)";

Strategy strategyOf(const std::string& name) {
  if (name == "exhaustive") return Strategy::Exhaustive;
  return name == "blocked" ? Strategy::Blocked : Strategy::Automatic;
}

std::size_t threadsOf(const std::string& text) {
  constexpr std::size_t kMostDigits = 4;
  const bool isCount = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  if (!isCount || text.size() > kMostDigits) throw UsageError("--threads: '" + text + "' is not a number of threads");
  return static_cast<std::size_t>(std::stoul(text));
}

DetectionOptions detectionOptions(const DetectSettings& settings, bool hasMargin, bool hasBox) {
  DetectionOptions options;
  if (hasMargin) options.margin = parseMargin(settings.margin);
  if (hasBox) options.region = parseRegion(settings.box);
  options.strategy = strategyOf(settings.strategy);
  options.threads = threadsOf(settings.threads);
  options.verify = settings.verify;
  return options;
}

scene::ModelRecord boxRecord(const scene::BoxArray& boxes, std::size_t i) {
  return {.name = boxes.name(i), .type = "BoxModel", .elements = 1, .box = boxes.boxes()[i]};
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

std::string boxMethod(const DetectionOptions& options) {
  std::string text = "boxes against boxes";
  if (options.margin) text += ", at most " + std::to_string(*options.margin) + " apart on every axis";
  if (options.region) text += ", in the region " + boxText(*options.region);
  return text;
}

void detectAndWrite(const scene::BoxArray& boxes, const DetectSettings& settings, const DetectionOptions& options,
                    double readSeconds, Output& output) {
  const BoxPairOrder order = settings.format == "npy" ? BoxPairOrder::FirstBelowSecond : BoxPairOrder::NewestFirst;
  Detection detection = detectBoxes(boxes, order, options);
  detection.statistics.readSeconds = readSeconds;
  const scene::ResultView result{.modelCount = boxes.size(),
                                 .model = [&boxes](std::size_t i) { return boxRecord(boxes, i); },
                                 .pairs = detection.pairs,
                                 .swapped = detection.swapped,
                                 .statistics = detection.statistics};
  write(result, {.method = boxMethod(options), .simulated = boxes.size()}, settings.format, output);
}

void runDetect(const DetectSettings& settings, const DetectionOptions& options) {
  Output output(settings.output.empty() ? std::nullopt : std::optional<std::filesystem::path>(settings.output));
  if (settings.format == "npy" && output.isTerminal()) {
    throw UsageError("--format npy is binary and not for a terminal: name a file with -o, or redirect the output");
  }
  const Timer timer;
  const Inputs inputs = readInputs(settings.input);
  const double readSeconds = timer.seconds();
  if (const auto* boxes = std::get_if<scene::BoxArray>(&inputs)) {
    detectAndWrite(*boxes, settings, options, readSeconds, output);
  }
  output.commit();
}

}  // namespace

void addDetect(CLI::App& program) {
  const auto settings = std::make_shared<DetectSettings>();
  CLI::App* command = program.add_subcommand("detect", "Find the pairs of models that may touch");
  command->footer(kExamples);
  command->add_option("INPUT", settings->input.paths, "Scenes, meshes, folders of meshes, box arrays; taken together")
      ->required()
      ->type_name("");
  CLI::Option* margin = command->add_option("--margin", settings->margin,
                                            "Pairs may be this far apart on every axis; for a scene: its alarmDistance")
                            ->type_name("D");
  CLI::Option* box = command->add_option("--box", settings->box, "Leave out models that do not touch this region")
                         ->type_name("x0,y0,z0,x1,y1,z1");
  command->add_option("--strategy", settings->strategy, "How to search; every strategy gives the same pairs")
      ->check(CLI::IsMember({"auto", "exhaustive", "blocked"}))
      ->type_name("auto|exhaustive|blocked")
      ->default_str("auto");
  command->add_option("--threads", settings->threads, "How many threads may work; 0: one per core")->type_name("N");
  command->add_flag("--verify", settings->verify, "Search exhaustively too, and fail on any difference");
  command->add_option("--format", settings->format, "How to write the result")
      ->check(CLI::IsMember({"table", "csv", "json", "npy"}))
      ->type_name("table|csv|json|npy");
  command->add_option("-o,--output", settings->output, "Write to FILE, which appears only when it is complete")
      ->type_name("FILE");
  command->add_flag("--partial", settings->input.partial, "Leave out what a scene has and is not known, and go on");
  command->add_option("--data", settings->input.searchRoots, "Look here for the files that a scene names; repeatable")
      ->type_name("DIR")
      ->take_all()
      ->allow_extra_args(false);
  command->callback([settings, margin, box] {
    runDetect(*settings, detectionOptions(*settings, margin->count() != 0, box->count() != 0));
  });
}

}  // namespace allpairs::app
