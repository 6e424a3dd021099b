// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
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
  allpairs info boxes.npy)";

constexpr std::size_t kBoxesShown = 20;  // of an array that may hold millions

/// The columns of the table; that of contact distances is left out where no model has one.
constexpr std::array<const char*, 8> kColumns{"#", "name", "type", "elements", "flags", "groups", "contact", "box"};
constexpr std::size_t kName = 1;
constexpr std::size_t kElements = 3;
constexpr std::size_t kContact = 6;

using Row = std::array<std::string, kColumns.size()>;

/// What the table says of one model.
struct ShownModel {
  scene::ModelRecord record;
  bool isOutside = false;
};

/// Asks the broad phase whether a model lies in the scene's region, as it does itself when the model is added.
class RegionProbe : public collision::BruteForceBroadPhase {
 public:
  explicit RegionProbe(const scene::Scene& scene) {
    setIntersectionMethod(scene.intersection.get());
    if (scene.region && scene.pipelines.empty()) setBox(*scene.region);
    init();
  }

  bool isOutside(collision::CollisionModel& model) {
    return getBox() && !model.getLast()->empty() && !intersectWithBoxModel(&model);
  }
};

std::string flagsText(const ShownModel& shown) {
  const scene::ModelRecord& model = shown.record;
  std::vector<std::string> flags;
  if (!model.active) flags.emplace_back("inactive");
  if (!model.simulated) flags.emplace_back("not simulated");
  if (!model.moving) flags.emplace_back("static");
  if (model.selfCollision) flags.emplace_back("self");
  if (shown.isOutside) flags.emplace_back("outside");
  return flags.empty() ? "-" : fmt::format("{}", fmt::join(flags, ", "));
}

Row rowOf(std::size_t index, const ShownModel& shown) {
  const scene::ModelRecord& model = shown.record;
  const std::string groups = model.groups.empty() ? "-" : fmt::format("{}", fmt::join(model.groups, " "));
  const std::string contact = model.contactDistance == 0.0 ? "-" : fmt::format("{}", model.contactDistance);
  return {std::to_string(index),
          printable(model.name),
          model.type,
          grouped(model.elements),
          flagsText(shown),
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

/// Shortens names so that rows stay within the terminal, if standard output is one.
void fit(std::vector<Row>& rows) {
  const std::optional<std::size_t> width = terminalWidth(STDOUT_FILENO);
  if (!width) return;
  const auto widths = widthsOf(rows);
  const std::size_t gaps = widths[kContact] == 0 ? widths.size() - 2 : widths.size() - 1;
  const std::size_t others = std::accumulate(widths.begin(), widths.end(), 2 * gaps) - widths[kName];
  for (Row& row : rows) row[kName] = elided(row[kName], std::max(kLeastName, *width - std::min(*width, others)));
}

std::string tableOf(std::size_t count, const std::function<ShownModel(std::size_t)>& model) {
  std::vector<Row> rows(1);
  std::copy(kColumns.begin(), kColumns.end(), rows.front().begin());
  for (std::size_t i = 0; i < count; ++i) rows.push_back(rowOf(i, model(i)));
  fit(rows);
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

std::string warningsText(const std::vector<scene::Remark>& warnings) {
  std::string text = warnings.empty() ? "" : "\nwarnings\n";
  for (const scene::Remark& warning : warnings) text += remarkText(warning);
  return text;
}

std::string describe(const BoxInput& input) {
  const scene::BoxArray& boxes = input.boxes;
  Box whole = kEmptyBox;
  std::size_t empty = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    whole = merge(whole, boxes.boxes()[i]);
    empty += isEmpty(boxes.boxes()[i]) ? 1U : 0U;
  }
  std::string text = fmt::format("models   {}, {}\n", counted(boxes.size(), "box", "boxes"),
                                 boxes.boxes().isFloat64() ? "float64" : "float32");
  if (empty != 0) text += fmt::format("empty    {}\n", grouped(empty));
  text += fmt::format("box      {}\n\n", boxText(whole));
  const std::size_t shown = std::min(boxes.size(), kBoxesShown);
  text += tableOf(shown, [&boxes](std::size_t i) { return ShownModel{.record = boxRecord(boxes, i)}; });
  if (shown < boxes.size()) text += fmt::format("... and {} more\n", grouped(boxes.size() - shown));
  return text + warningsText(input.warnings);
}

std::string describe(scene::Scene& scene) {
  Box whole = kEmptyBox;
  std::size_t elements = 0;
  for (const auto& model : scene.models) {
    if (!model->empty()) model->computeBoundingTree();
    whole = merge(whole, scene::modelRecord(*model).box);
    elements += model->getSize();
  }
  std::string text = fmt::format("models   {}, with {}\n", grouped(scene.models.size()), counted(elements, "element"));
  text += fmt::format("method   {}\nbox      {}\n\n", methodText(scene), boxText(whole));
  RegionProbe probe(scene);
  text += tableOf(scene.models.size(), [&](std::size_t i) {
    return ShownModel{.record = scene::modelRecord(scene, i), .isOutside = probe.isOutside(*scene.models[i])};
  });
  if (!scene.remarks.empty()) text += "\nignored\n";
  if (scene.remarks.empty() && scene.warnings.empty()) text += "\nnothing was ignored\n";
  for (const scene::Remark& remark : scene.remarks) text += remarkText(remark);
  return text + warningsText(scene.warnings);
}

void runInfo(const InputSettings& settings) {
  Inputs inputs = readInputs(settings);
  Output(std::nullopt).write(std::visit([](auto& input) { return describe(input); }, inputs));
}

}  // namespace

void addInfo(CLI::App& program) {
  const auto settings = std::make_shared<InputSettings>();
  CLI::App* command = program.add_subcommand("info", "Show the models of the input, and what was ignored");
  command->footer(kInfoExamples);
  addInputs(*command, *settings);
  command->callback([settings] { withInputs(*settings, [settings] { runInfo(*settings); }); });
}

}  // namespace allpairs::app
