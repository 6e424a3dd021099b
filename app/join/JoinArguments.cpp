// SPDX-License-Identifier: MIT
#include "join/JoinArguments.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "allpairs/parallel/TbbExecutor.h"
#include "cli/ExitStatus.h"
#include "cli/Options.h"
#include "cli/Warning.h"

namespace allpairs::app {

void addJoinArguments(CLI::App& command, JoinArguments& arguments) {
  addBoxSets(command, arguments.sets);
  command.add_option("--memory", arguments.memory, "Never take more; by default half of the machine's, least 64M")
      ->type_name("SIZE");
  addDistance(command, arguments.distance, "Pairs up to D apart on every axis");
  addBoxValues(command, arguments.sets);
}

join::JoinOptions joinOptions(const JoinArguments& arguments) {
  join::JoinOptions options;
  if (!arguments.memory.empty()) options.memory = parseMemory("--memory", arguments.memory);
  if (!arguments.memory.empty() && options.memory < join::kLeastMemory)
    throw UsageError("--memory: '" + arguments.memory + "' is less than the least, 64M");
  if (!arguments.distance.empty()) options.distance = parseDistance(arguments.distance);
  options.second = pathsOf(arguments.sets.with);
  if (!arguments.sets.box.empty()) options.region = parseRegion(arguments.sets.box);
  options.values = filesOf(arguments.sets.values);
  options.secondValues = filesOf(arguments.sets.withValues);
  return options;
}

void warnOfEmpty(const JoinArguments& arguments, const std::array<scene::EmptyBoxes, 2>& empty) {
  for (const std::string& text : emptyTexts(arguments.sets, empty)) warn(text);
}

std::unique_ptr<Executor> executorOf(const std::string& threads) {
  const std::size_t count = parseThreads(threads);
  return count == 1 ? nullptr : std::make_unique<parallel::TbbExecutor>(count);
}

}  // namespace allpairs::app
