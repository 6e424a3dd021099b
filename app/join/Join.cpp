// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "Commands.h"
#include "allpairs/join/Join.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/TargetFile.h"
#include "cli/ExitStatus.h"
#include "cli/Options.h"
#include "cli/Output.h"
#include "cli/Progress.h"
#include "cli/SignalCleanup.h"
#include "cli/Text.h"
#include "cli/Timer.h"
#include "join/JoinArguments.h"

namespace allpairs::app {
namespace {

struct JoinSettings {
  JoinArguments shared;
  std::string output;  ///< Empty for standard output, if it was given at all.
  bool hasOutput = false;
  std::string work;
  std::string threads = "0";
  bool resume = false;
  bool count = false;
};

constexpr const char* kJoinExamples =
    R"(Boxes are .npy arrays (n, 6), float32 or float64: minx miny minz maxx maxy maxz.
Several files are one set, numbered on from file to file. The result is a .npy
array (m, 2), uint32, or uint64 of more than 2^32 boxes in a set, ordered by
(first, second): the same bytes as 'allpairs detect -o' where that fits in memory.
With --with the pairs are those of a box of BOXES, first, and a box of a second
set of files, second; both sets are numbered by themselves. --with comes after
BOXES: it takes all files up to the next option.
Margins are .npy arrays (n,) of floats or integers, groups, categories and masks
of integers or bools: one number for each box, in one file or several, numbered
on.

Examples:
  allpairs join boxes.npy -o pairs.npy --memory 4G
  allpairs join part0.npy part1.npy -o pairs.npy --work /scratch/join
  allpairs join parts.npy --with obstacles.npy -o pairs.npy
  allpairs join boxes.npy -o pairs.npy --margins margins.npy --box 0,0,0,9,9,9
  allpairs join boxes.npy -o pairs.npy --resume     after a kill or a full disk
  allpairs join boxes.npy --count

'allpairs plan' says before how much disk and memory it takes.)";

/// Shows the step that a join is in, how far it is, and the time that is left of it.
class JoinLine {
 public:
  void show(const join::JoinProgress& progress) {
    if (progress.step != m_step) {
      m_step = progress.step;
      m_sinceStep = Timer();
    }
    if (!m_line.isTerminal() || progress.total == 0) return;
    const double share = static_cast<double>(progress.done) / static_cast<double>(progress.total);
    std::string text = fmt::format("{}: {:.0f} %", m_step, 100.0 * share);
    const double seconds = m_sinceStep.seconds();
    if (share > 0.0 && seconds > 1.0) text += fmt::format(", {:.0f} s left of this step", seconds / share - seconds);
    m_line.show(text);
  }

  void clear() { m_line.clear(); }

 private:
  ProgressLine m_line;
  std::string m_step;
  Timer m_sinceStep;
};

std::string boxesText(const join::JoinSummary& summary, bool isTwoSets) {
  if (!isTwoSets) return counted(summary.boxes, "box", "boxes");
  return countedBoxes(summary.boxes - summary.secondBoxes, summary.secondBoxes);
}

std::string summaryText(const join::JoinSummary& summary, const std::string& output, bool isTwoSets) {
  std::string text = fmt::format("{} among {}", counted(summary.pairs, "pair"), boxesText(summary, isTwoSets));
  if (!output.empty()) text += " -> " + printable(output);
  text += fmt::format("\n{}", counted(summary.cells, "cell"));
  if (summary.resumedCells != 0) text += fmt::format(", {} of them from before", grouped(summary.resumedCells));
  text += fmt::format(", {}", counted(summary.copies, "copy of a box", "copies of boxes"));
  if (summary.wideBoxes != 0) text += fmt::format(", {} in many cells", counted(summary.wideBoxes, "box", "boxes"));
  return text + '\n';
}

/// What is said where a signal ends a join, perhaps behind a line that shows progress.
std::string stoppedLine(const std::filesystem::path& work) {
  const std::string text = "allpairs: stopped; the work folder " + printable(work.string()) + " stays, for --resume\n";
  return ::isatty(STDERR_FILENO) == 1 ? "\r\033[K" + text : text;
}

/// Whether a folder that the user has not named cannot be worked in, where another may do: inputs may lie where nobody
/// may write.
bool isForAnotherFolder(const FileError& problem, const std::filesystem::path& work) {
  return problem.path() == work && problem.code();
}

void runJoin(const JoinSettings& settings) {
  if (!settings.hasOutput && !settings.count) throw UsageError("join takes -o FILE, or --count");
  if (settings.hasOutput && settings.count) throw UsageError("--count writes no pairs: -o has nothing to hold");
  checkPairFileName(settings.output);
  scene::checkIsNoInput(settings.output, filesOf(settings.shared.sets));
  join::JoinOptions options = joinOptions(settings.shared);
  const std::unique_ptr<Executor> executor = executorOf(settings.threads);
  options.executor = executor.get();
  options.resume = settings.resume;
  std::optional<Output> output;
  if (!settings.count) output.emplace(targetOf(settings.output));
  if (output && output->isTerminal()) throw UsageError("pairs are binary and not written to a terminal: use -o FILE");
  const bool isFile = output && output->isFile();
  options.work = settings.work;
  if (options.work.empty()) options.work = (isFile ? settings.output : settings.shared.sets.paths.front()) + ".work";
  JoinLine line;
  sayOnSignal(options.work, stoppedLine(options.work));
  options.progress = [&line, &options, isInFolder = false](const join::JoinProgress& progress) mutable {
    if (!std::exchange(isInFolder, true)) sayOnSignal(options.work, stoppedLine(options.work));  // perhaps another
    line.show(progress);
  };
  join::JoinSummary summary;
  const std::vector<std::filesystem::path> inputs = pathsOf(settings.shared.sets.paths);
  try {
    if (settings.count) {
      summary = join::countFiles(inputs, options);
    } else {
      options.commit = [&output, &settings, isFile] {  // on disk before what it was made from is removed
        output->sync();
        output->commit();
        if (isFile) scene::syncNameOf(settings.output);
      };
      options.output = settings.output;
      summary = join::joinFiles(
          inputs, [&output](std::string_view bytes) { output->write(bytes); }, options);
    }
  } catch (const FileError& problem) {
    if (settings.work.empty() && isForAnotherFolder(problem, options.work))
      throw FileError(problem.path(), problem.problem() + "; --work DIR works in another folder");
    const std::filesystem::path manifest = options.work / "manifest";
    const std::vector<std::filesystem::path> read = filesOf(settings.shared.sets);
    const bool isOfInput = std::find(read.begin(), read.end(), problem.path()) != read.end();
    if (isOfInput || problem.path() == options.work || problem.path() == manifest) throw;
    if (!std::filesystem::exists(manifest)) throw;
    throw FileError(problem.path(),
                    problem.problem() + "; what is complete is in " + options.work.string() + ", and --resume goes on");
  }
  line.clear();
  warnOfEmpty(settings.shared, summary.empty);
  const std::string text = summaryText(summary, settings.output, !options.second.empty());
  if (settings.count || isFile) {
    Output(std::nullopt).write(text);
  } else {
    fmt::print(stderr, "{}", text);  // standard output may be the result
  }
}

}  // namespace

void addJoin(CLI::App& program) {
  const auto settings = std::make_shared<JoinSettings>();
  CLI::App* command = program.add_subcommand("join", "Find the pairs of more boxes than memory holds");
  command->footer(kJoinExamples);
  addJoinArguments(*command, settings->shared);
  command
      ->add_option("--work", settings->work,
                   "The folder of its own files; default: the name of the output, or input, and .work")
      ->type_name("DIR");
  command->add_flag("--resume", settings->resume, "Go on with a join that was stopped");
  command->add_flag("--count", settings->count, "Only count the pairs");
  addThreads(*command, settings->threads);
  const CLI::Option* const output = addOutput(*command, settings->output);
  command->callback([settings, output] {
    settings->hasOutput = output->count() != 0;
    runJoin(*settings);
  });
}

}  // namespace allpairs::app
