// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <memory>
#include <optional>
#include <string>

#include "Commands.h"
#include "allpairs/join/Join.h"
#include "cli/Output.h"
#include "cli/Progress.h"
#include "cli/Text.h"
#include "join/JoinArguments.h"

namespace allpairs::app {
namespace {

constexpr const char* kPlanExamples = R"(Reads the boxes twice and writes nothing. All but the number of pairs, which is
estimated from a sample, is exact.

Examples:
  allpairs plan boxes.npy
  allpairs plan part*.npy --memory 4G)";

std::string planText(const join::JoinSummary& plan) {
  std::string text = fmt::format("boxes    {}\n", grouped(plan.boxes));
  text += fmt::format("cells    {}\n", grouped(plan.cells));
  text += fmt::format("copies   {} of boxes in more than one cell\n", grouped(plan.copies));
  text += fmt::format("wide     {} in many cells, kept apart\n", grouped(plan.wideBoxes));
  text += fmt::format("pairs    about {}\n", grouped(plan.pairs));
  text += fmt::format("disk     {} MiB for boxes, about {} MiB for pairs\n", grouped((plan.boxBytes >> 20) + 1),
                      grouped((plan.pairBytes >> 20) + 1));
  return text + fmt::format("result   about {} MiB\n", grouped((plan.pairBytes >> 20) + 1));
}

}  // namespace

void addPlan(CLI::App& program) {
  const auto arguments = std::make_shared<JoinArguments>();
  CLI::App* command = program.add_subcommand("plan", "What a join would take: cells, copies, disk, memory");
  command->footer(kPlanExamples);
  addJoinArguments(*command, *arguments);
  command->callback([arguments] {
    std::optional<ProgressClock> clock(std::in_place, "counting");
    const join::JoinSummary plan = join::planFiles(inputsOf(*arguments), joinOptions(*arguments));
    clock.reset();
    Output(std::nullopt).write(planText(plan));
  });
}

}  // namespace allpairs::app
