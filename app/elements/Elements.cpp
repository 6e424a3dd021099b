// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "Commands.h"
#include "cli/Arguments.h"
#include "cli/ExitStatus.h"
#include "cli/NpyOutput.h"
#include "cli/Options.h"
#include "cli/Output.h"
#include "cli/Progress.h"
#include "cli/Terminal.h"
#include "cli/Text.h"
#include "cli/Timer.h"
#include "cli/Warning.h"
#include "detect/Detection.h"
#include "elements/ElementReport.h"
#include "input/Inputs.h"
#include "input/MeshSteps.h"

namespace allpairs::app {
namespace {

struct ElementSettings {
  InputSettings input;
  std::string distance = "0";
  std::string threads = "0";
  std::string format;
  std::string output;
  bool between = false;
};

constexpr const char* kElementsExamples =
    R"(START and END are mesh files (.obj .ply .stl ...), or folders of them, with the same
triangles: the vertices at the start and at the end of a step. For several meshes,
such as a cloth and the body it falls on, give a START and an END for each; for a
mesh that does not move, give the same file twice.

With -o FILE the candidates are written beside FILE as NumPy arrays (m, 2), uint32:
BASE.vertex_face.npy, BASE.edge_edge.npy and BASE.face_face.npy; and the elements that
they index, BASE.edges.npy and BASE.faces.npy. BASE is FILE without .json or .txt.

Examples:
  allpairs elements cloth_92.ply cloth_93.ply
  allpairs elements cloth_92.ply cloth_93.ply --distance 0.001 -o cloth.json
  allpairs elements cloth_92.ply cloth_93.ply ball.ply ball.ply --between)";

std::vector<MeshStep> readSteps(const InputSettings& input) {
  const std::vector<std::string>& paths = input.paths;
  if (paths.size() % 2 != 0) throw UsageError("START and END come in pairs: '" + paths.back() + "' has no END");
  ProgressLine line;
  std::vector<MeshStep> steps;
  for (std::size_t i = 0; i < paths.size(); i += 2) {
    line.show("reading: " + printable(std::filesystem::path(paths[i]).filename().string()));
    for (MeshStep& step : readMeshSteps(input, i)) steps.push_back(std::move(step));
  }
  return steps;
}

elements::MeshTopology topologyOf(const std::vector<MeshStep>& steps) {
  std::vector<elements::MeshView> views;
  views.reserve(steps.size());
  for (const MeshStep& step : steps) views.push_back({step.start.positions.size() / 3, step.start.triangles});
  return elements::MeshTopology(views);
}

/// FILE without an extension that says what is in it, and ".key.npy".
std::string besideOutput(const std::string& output, std::string_view key) {
  const std::string extension = lowerExtension(output);
  const bool isReport = extension == ".json" || extension == ".txt";
  const std::string base = isReport ? output.substr(0, output.size() - extension.size()) : output;
  return base + '.' + std::string(key) + ".npy";
}

/// The report and the lists.
std::vector<std::filesystem::path> outputsOf(const std::string& output) {
  if (output.empty()) return {};
  std::vector<std::filesystem::path> outputs{output, besideOutput(output, "edges"), besideOutput(output, "faces")};
  for (const auto& kind : kKindNames) outputs.emplace_back(besideOutput(output, kind.key));
  return outputs;
}

/// Writes rows of numbers beside the output, and notes the file; complete when the report is.
class ElementFiles {
 public:
  ElementFiles(std::string output, ElementReport& report) : m_output(std::move(output)), m_report(report) {}

  void write(std::string_view key, std::size_t columns, std::span<const std::uint32_t> numbers) {
    const std::string path = besideOutput(m_output, key);
    m_files.push_back(std::make_unique<Output>(std::filesystem::path(path)));
    NpyOutput(*m_files.back(), "<u4", {numbers.size() / columns, columns}).add(numbers);
    m_report.files.push_back({std::string(key), path});
  }

  void complete() {
    for (const auto& file : m_files) file->complete();
  }

  void commit() {
    for (const auto& file : m_files) file->commit();
  }

 private:
  std::string m_output;
  ElementReport& m_report;
  std::vector<std::unique_ptr<Output>> m_files;
};

/// Rows of whole numbers, one after the other in memory, as the numbers.
template <class Row>
std::span<const std::uint32_t> numbersOf(std::span<const Row> rows) {
  static_assert(sizeof(Row) % sizeof(std::uint32_t) == 0);
  return {reinterpret_cast<const std::uint32_t*>(rows.data()), rows.size_bytes() / sizeof(std::uint32_t)};
}

void findAll(elements::ElementCandidates& candidates, bool wantsLists, ElementFiles& files, ElementReport& report) {
  const Timer timer;
  std::array<std::span<const Pair>, kKindNames.size()> found;
  for (std::size_t i = 0; i < kKindNames.size(); ++i) {
    if (wantsLists) found[i] = candidates.find(kKindNames[i].kind);
    report.candidates[i] = wantsLists ? found[i].size() : candidates.count(kKindNames[i].kind);
  }
  report.findSeconds = timer.seconds();
  if (!wantsLists) return;
  for (std::size_t i = 0; i < kKindNames.size(); ++i) files.write(kKindNames[i].key, 2, numbersOf(found[i]));
  files.write("edges", 2, numbersOf(std::span(candidates.topology().edges())));
  files.write("faces", 3, numbersOf(std::span(candidates.topology().triangles())));
}

void describeMeshes(const elements::MeshTopology& topology, const std::vector<MeshStep>& steps, ElementReport& report) {
  report.counts = topology.counts();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const elements::ElementCounts& from = topology.before(i);
    const elements::ElementCounts& to = topology.before(i + 1);
    report.meshes.push_back(
        {steps[i].start.name, {to.vertices - from.vertices, to.edges - from.edges, to.triangles - from.triangles}});
  }
}

const std::vector<std::string> kElementFormats = {"table", "json"};

/// A name that promises another format would be a lie.
void checkElementsExtension(const std::string& path) {
  const std::string extension = lowerExtension(path);
  if (extension != ".npy" && extension != ".csv") return;
  throw UsageError("-o: '" + path + "' names the report; the lists are written beside it: name it .json or .txt");
}

void runElements(const ElementSettings& settings) {
  checkElementsExtension(settings.output);
  const std::string format = formatOf(settings.format, settings.output, kElementFormats);
  checkOutputs(settings.input);
  ElementReport report;
  report.distance = parseDistance(settings.distance);
  report.betweenOnly = settings.between;
  const std::size_t threads = parseThreads(settings.threads);
  Output output(targetOf(settings.output));
  const Timer timer;
  const std::vector<MeshStep> steps = readSteps(settings.input);
  report.readSeconds = timer.seconds();

  elements::MeshTopology topology = topologyOf(steps);
  describeMeshes(topology, steps, report);
  if (settings.between && steps.size() == 1) warn("--between: there is one mesh, which has no other");
  const std::unique_ptr<Executor> executor = makeExecutor(threads, topology.counts().edges);
  const bool wantsLists = output.isFile();
  if (executor && wantsLists) report.threads = executor->concurrency();  // counting runs on one
  elements::ElementCandidates candidates(
      std::move(topology),
      {.distance = report.distance, .withinMeshes = !settings.between, .executor = executor.get()});
  for (std::size_t i = 0; i < steps.size(); ++i) {
    candidates.setPositions(i, std::span<const double>(steps[i].start.positions), steps[i].endPositions);
  }
  ElementFiles files(settings.output, report);
  findAll(candidates, wantsLists, files, report);
  output.write(format == "json" ? jsonOf(report) : tableOf(report));
  files.complete();
  output.complete();
  files.commit();
  output.commit();
  if (settings.output.empty()) return;
  const std::uint64_t found = std::accumulate(report.candidates.begin(), report.candidates.end(), std::uint64_t{0});
  sayWritten(counted(found, "candidate"), settings.output);
}

}  // namespace

void addElements(CLI::App& program) {
  const auto settings = std::make_shared<ElementSettings>();
  CLI::App* command =
      program.add_subcommand("elements", "Find candidate vertex, edge and face pairs of deforming meshes");
  command->footer(kElementsExamples);
  command->add_option("START END", settings->input.paths, "Mesh files at the start and the end of a step, alternating")
      ->required()
      ->type_name("");
  addDistance(*command, settings->distance, "Report candidates up to D apart on every axis");
  command->add_flag("--between", settings->between, "Only candidates between two meshes");
  addThreads(*command, settings->threads)->description("Number of threads with -o; 0: one per core");
  addFormat(*command, settings->format, kElementFormats);
  addReadLimits(*command, settings->input.limits);
  addOutput(*command, settings->output);
  command->callback([settings] {
    settings->input.outputs = outputsOf(settings->output);
    withInputs(settings->input, [settings] { runElements(*settings); });
  });
}

}  // namespace allpairs::app
