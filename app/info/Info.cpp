// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "Commands.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "cli/Options.h"
#include "cli/Output.h"
#include "cli/Table.h"
#include "cli/Terminal.h"
#include "cli/Text.h"
#include "input/Inputs.h"

namespace allpairs::app {
namespace {

constexpr const char* kInfoExamples =
    R"(One line per model: index, name, type, number of elements, flags, groups, contact
distance, if any model has one, and box. Flags: inactive (ignored), not simulated
(two such models are never paired), static (does not move), self (may collide with
itself), outside (of the scene's region, so in no pair).

Examples:
  allpairs info scene.scn
  allpairs info parts/
  allpairs info boxes.npy
  allpairs info scene.scn --format json | jq '.models[] | select(.outside).name')";

constexpr std::size_t kBoxesShown = 20;  // of an array that may hold millions

/// The columns of the table; that of contact distances is left out where no model has one.
constexpr std::array<const char*, 8> kColumns{"#", "name", "type", "elements", "flags", "groups", "contact", "box"};
constexpr std::size_t kName = 1;
constexpr std::size_t kElements = 3;
constexpr std::size_t kContact = 6;

using Row = std::array<std::string, kColumns.size()>;

struct InfoSettings {
  InputSettings input;
  std::string format;
  std::string output;
};

const std::vector<std::string> kInfoFormats = {"table", "json"};

/// Asks the broad phase whether a model lies in a region, as it does itself when the model is added.
class RegionProbe : public collision::BruteForceBroadPhase {
 public:
  explicit RegionProbe(const scene::SceneSearch& search) {
    setIntersectionMethod(search.intersection);
    if (search.region) setBox(*search.region);
    init();
  }

  bool isOutside(collision::CollisionModel& model) {
    return getBox() && !model.getLast()->empty() && !intersectWithBoxModel(&model);
  }
};

/// The models that lie outside of the region of each pipeline that takes them.
std::vector<bool> outsideModels(const scene::Scene& scene) {
  std::vector<std::size_t> searches(scene.models.size());
  std::vector<std::size_t> outside(scene.models.size());
  for (const scene::SceneSearch& search : scene::searchesOf(scene)) {
    RegionProbe probe(search);
    for (std::size_t i = 0; i < search.models.size(); ++i) {
      ++searches[search.indices[i]];
      outside[search.indices[i]] += probe.isOutside(*search.models[i]) ? 1U : 0U;
    }
  }
  std::vector<bool> result(scene.models.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = searches[i] != 0 && outside[i] == searches[i];
  return result;
}

std::string flagsText(const scene::ModelRecord& model) {
  std::vector<std::string> flags;
  if (!model.active) flags.emplace_back("inactive");
  if (!model.simulated) flags.emplace_back("not simulated");
  if (!model.moving) flags.emplace_back("static");
  if (model.selfCollision) flags.emplace_back("self");
  if (model.outside.value_or(false)) flags.emplace_back("outside");
  return flags.empty() ? "-" : fmt::format("{}", fmt::join(flags, ", "));
}

Row rowOf(std::size_t index, const scene::ModelRecord& model) {
  const std::string groups = model.groups.empty() ? "-" : fmt::format("{}", fmt::join(model.groups, " "));
  const std::string contact = model.contactDistance == 0.0 ? "-" : fmt::format("{}", model.contactDistance);
  return {std::to_string(index),
          printable(model.name),
          model.type,
          grouped(model.elements),
          flagsText(model),
          groups,
          contact,
          boxText(model.box)};
}

/// The widths of the columns: 0 for one that is left out.
std::array<std::size_t, kColumns.size()> widthsOf(const std::vector<Row>& rows) {
  std::array<std::size_t, kColumns.size()> widths{};
  for (const Row& row : rows) {
    for (std::size_t column = 0; column < row.size(); ++column) {
      widths[column] = std::max(widths[column], columnsOf(row[column]));
    }
  }
  const auto hasContact = [](const Row& row) { return row[kContact] != "-"; };
  if (std::none_of(rows.begin() + 1, rows.end(), hasContact)) widths[kContact] = 0;
  return widths;
}

/// Shortens names so that rows stay within the width.
void fit(std::vector<Row>& rows, std::optional<std::size_t> width) {
  if (!width) return;
  const auto widths = widthsOf(rows);
  const std::size_t gaps = widths[kContact] == 0 ? widths.size() - 2 : widths.size() - 1;
  const std::size_t others = std::accumulate(widths.begin(), widths.end(), 2 * gaps) - widths[kName];
  for (Row& row : rows) row[kName] = elided(row[kName], std::max(kLeastName, *width - std::min(*width, others)));
}

/// The first `count` models. `width`: of the terminal that it is shown on.
std::string tableOf(const scene::InputView& input, std::size_t count, std::optional<std::size_t> width) {
  std::vector<Row> rows(1);
  std::copy(kColumns.begin(), kColumns.end(), rows.front().begin());
  for (std::size_t i = 0; i < count; ++i) rows.push_back(rowOf(i, input.model(i)));
  fit(rows, width);
  const auto widths = widthsOf(rows);
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t column = 0; column + 1 < row.size(); ++column) {
      if (widths[column] == 0) continue;
      const bool isNumber = column == 0 || column == kElements;
      text +=
          isNumber ? fmt::format("{:>{}}  ", row[column], widths[column]) : padded(row[column], widths[column]) + "  ";
    }
    text += row.back() + '\n';
  }
  return text;
}

std::string remarkText(const scene::Remark& remark) { return fmt::format("  {}\n", printable(textOf(remark))); }

std::string remarksText(const scene::InputView& input) {
  std::string text = input.ignored.empty() ? "" : "\nignored\n";
  for (const scene::Remark& remark : input.ignored) text += remarkText(remark);
  if (!input.warnings.empty()) text += "\nwarnings\n";
  for (const scene::Remark& warning : input.warnings) text += remarkText(warning);
  return text;
}

scene::InputView viewOf(const BoxInput& input) {
  const scene::BoxArray& boxes = input.boxes;
  scene::InputView view{.modelCount = boxes.size(),
                        .model = [&boxes](std::size_t i) { return boxRecord(boxes, i); },
                        .elements = boxes.size(),
                        .method = std::string(scene::emptyScene().intersection->typeName()),
                        .warnings = input.warnings};
  for (std::size_t i = 0; i < boxes.size(); ++i) view.box = merge(view.box, boxes.boxes()[i]);
  return view;
}

std::string tableText(const BoxInput& input, const scene::InputView& view, std::optional<std::size_t> width) {
  const BoxView& boxes = input.boxes.boxes();
  std::size_t empty = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) empty += isEmpty(boxes[i]) ? 1U : 0U;
  std::string text = fmt::format("models   {}, {}\n", counted(boxes.size(), "box", "boxes"),
                                 boxes.isFloat64() ? "float64" : "float32");
  if (empty != 0) text += fmt::format("empty    {}\n", grouped(empty));
  text += fmt::format("box      {}\n\n", boxText(view.box));
  const std::size_t shown = std::min(boxes.size(), kBoxesShown);
  text += tableOf(view, shown, width);
  if (shown < boxes.size())
    text += fmt::format("... and {} more; --format json gives all\n", grouped(boxes.size() - shown));
  return text + remarksText(view);
}

/// A scene's models, with what --format json says of their pipelines in `pipelines`.
scene::InputView viewOf(const scene::Scene& scene, const std::vector<scene::PipelineRecord>& pipelines) {
  scene::InputView view{.modelCount = scene.models.size(),
                        .model = {},
                        .method = std::string(scene.intersection->typeName()),
                        .distance = scene.intersection->getAlarmDistance(),
                        .region = scene.pipelines.empty() ? scene.region : std::nullopt,
                        .ignored = scene.remarks,
                        .warnings = scene.warnings,
                        .pipelines = pipelines};
  for (const auto& model : scene.models) {
    if (!model->empty()) model->computeBoundingTree();
    view.box = merge(view.box, scene::modelRecord(*model).box);
    view.elements += model->getSize();
  }
  view.model = [&scene, outside = outsideModels(scene)](std::size_t i) {
    scene::ModelRecord record = scene::modelRecord(scene, i);
    record.outside = outside[i];
    return record;
  };
  return view;
}

std::vector<scene::PipelineRecord> pipelinesOf(const scene::Scene& scene) {
  std::vector<scene::PipelineRecord> pipelines;
  for (const scene::ScenePipeline& pipeline : scene.pipelines) {
    pipelines.push_back({.name = pipeline.name,
                         .method = std::string(pipeline.intersection->typeName()),
                         .distance = pipeline.intersection->getAlarmDistance(),
                         .region = pipeline.region,
                         .models = pipeline.models});
  }
  return pipelines;
}

std::string tableText(const scene::Scene& scene, const scene::InputView& view, std::optional<std::size_t> width) {
  std::string text = fmt::format("models   {}, with {}\n", grouped(view.modelCount), counted(view.elements, "element"));
  text += fmt::format("method   {}\nbox      {}\n\n", methodText(scene), boxText(view.box));
  text += tableOf(view, view.modelCount, width);
  if (view.ignored.empty() && view.warnings.empty()) text += "\nnothing was ignored\n";
  return text + remarksText(view);
}

template <class Input>
void write(const Input& input, const scene::InputView& view, const InfoSettings& settings) {
  Output output(targetOf(settings.output));
  if (settings.format == "json") {
    scene::writeInputJson(view, [&output](std::string_view bytes) { output.write(bytes); });
  } else {
    output.write(tableText(input, view, output.isTerminal() ? terminalWidth(STDOUT_FILENO) : std::nullopt));
  }
  output.commit();
}

void runInfo(const InfoSettings& settings) {
  checkOutputs(settings.input);
  const Inputs inputs = readInputs(settings.input);
  if (const auto* boxes = std::get_if<BoxInput>(&inputs)) return write(*boxes, viewOf(*boxes), settings);
  const auto& scene = std::get<scene::Scene>(inputs);
  const std::vector<scene::PipelineRecord> pipelines = pipelinesOf(scene);
  write(scene, viewOf(scene, pipelines), settings);
}

}  // namespace

void addInfo(CLI::App& program) {
  const auto settings = std::make_shared<InfoSettings>();
  CLI::App* command = program.add_subcommand("info", "Show the models of the input, and what was ignored");
  command->footer(kInfoExamples);
  addInputs(*command, settings->input);
  addFormat(*command, settings->format, kInfoFormats);
  addOutput(*command, settings->output);
  command->callback([settings] {
    settings->format = formatOf(settings->format, settings->output, kInfoFormats);
    settings->input.outputs = {settings->output};
    withInputs(settings->input, [settings] { runInfo(*settings); });
  });
}

}  // namespace allpairs::app
