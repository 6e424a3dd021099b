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
#include "cli/Options.h"
#include "cli/Output.h"
#include "cli/Progress.h"
#include "cli/Text.h"
#include "join/Calibration.h"
#include "join/JoinArguments.h"

namespace allpairs::app {
namespace {

struct PlanSettings {
  JoinArguments shared;
  std::string work;
  std::string threads = "0";
  std::size_t ranks = 0;
};

constexpr const char* kPlanExamples =
    R"(Reads the boxes. Cells, copies and room for boxes are exact; the number of
pairs is estimated from a sample, and the time from as many boxes, 10,000 to 8 million,
that are joined for it (fewer with less --memory) in a folder within --work, which is
gone afterwards.

With --ranks it says what 'allpairs-mpi join' would send over the network instead.

Examples:
  allpairs plan boxes.npy
  allpairs plan boxes.npy --ranks 64
  allpairs plan part*.npy --memory 4G --work /scratch
  allpairs plan parts.npy --with obstacles.npy)";

/// The boxes of each set.
std::string boxesText(std::uint64_t all, std::uint64_t second, const JoinArguments& arguments) {
  if (arguments.sets.with.empty()) return grouped(all);
  return grouped(all - second) + " and " + grouped(second);
}

std::string planText(const join::JoinSummary& plan, const JoinArguments& arguments) {
  std::string text = fmt::format("boxes    {}\n", boxesText(plan.boxes, plan.secondBoxes, arguments));
  text += fmt::format("cells    {}\n", grouped(plan.cells));
  text += fmt::format("copies   {} of boxes in more than one cell\n", grouped(plan.copies));
  text += fmt::format("wide     {} in many cells, kept apart\n", grouped(plan.wideBoxes));
  text += fmt::format("pairs    about {}\n", grouped(plan.pairs));
  text += fmt::format("disk     {} for boxes, about {} for pairs", mebibytes(plan.boxBytes), mebibytes(plan.pairBytes));
  if (plan.scratchBytes != 0) text += fmt::format(", {} to put them in order", mebibytes(plan.scratchBytes));
  text += '\n';
  return text + fmt::format("result   about {}\n", mebibytes(plan.pairBytes));
}

std::string ranksText(const join::RanksPlan& plan, const PlanSettings& settings) {
  std::string text =
      fmt::format("boxes    {}, {} on each rank\n", boxesText(plan.boxes, plan.secondBoxes, settings.shared),
                  grouped(plan.boxes / settings.ranks));
  text += fmt::format("cells    {}\n", grouped(plan.cells));
  text += fmt::format("copies   {} of boxes in more than one cell\n", grouped(plan.copies));
  text += fmt::format("wide     {} sent to all ranks: in many cells, or where no cut divides them\n",
                      grouped(plan.wideBoxes));
  text += fmt::format("pairs    about {}\n", grouped(plan.pairs));
  return text + fmt::format("network  {} for boxes, about {} for pairs, at most\n", mebibytes(plan.boxBytes),
                            mebibytes(plan.pairBytes));
}

void runPlan(const PlanSettings& settings) {
  join::JoinOptions options = joinOptions(settings.shared);
  const std::unique_ptr<Executor> executor = executorOf(settings.threads);
  options.executor = executor.get();
  std::optional<ProgressClock> clock(std::in_place, "counting");
  if (settings.ranks != 0) {
    const join::RanksPlan plan = join::planRanks(pathsOf(settings.shared.sets.paths), settings.ranks, options);
    clock.reset();
    warnOfEmpty(settings.shared, plan.empty);
    Output(std::nullopt).write(ranksText(plan, settings));
    return;
  }
  const join::JoinSummary plan = join::planFiles(pathsOf(settings.shared.sets.paths), options);
  clock.reset();
  warnOfEmpty(settings.shared, plan.empty);
  // What is known is said before what may fail, as where the disk is too small.
  Output(std::nullopt).write(planText(plan, settings.shared));
  clock.emplace("measuring the time of a join");
  const JoinCost cost = measureJoinCost(settings.work.empty() ? "." : settings.work, plan, options);
  clock.reset();
  const double seconds = cost.secondsFor(plan);
  Output(std::nullopt).write(fmt::format("time     about {:.{}f} s\n", seconds, seconds < 10.0 ? 1 : 0));
}

}  // namespace

void addPlan(CLI::App& program) {
  const auto settings = std::make_shared<PlanSettings>();
  CLI::App* command = program.add_subcommand("plan", "What a join would take: cells, copies, disk, time");
  command->footer(kPlanExamples);
  addJoinArguments(*command, settings->shared);
  CLI::Option* const work =
      command->add_option("--work", settings->work, "The folder that a join would work in; default: this one");
  work->type_name("DIR");
  CLI::Option* const ranks = command->add_option("--ranks", settings->ranks, "What so many ranks of MPI would send");
  ranks->type_name("N");
  takeNumber(*ranks, 1, 1'000'000);
  CLI::Option* const threads = addThreads(*command, settings->threads);
  ranks->excludes(work)->excludes(threads);
  command->callback([settings] { runPlan(*settings); });
}

}  // namespace allpairs::app
