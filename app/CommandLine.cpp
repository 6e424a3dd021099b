// SPDX-License-Identifier: MIT
#include "CommandLine.h"

#include <fcntl.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <string>

#include "Commands.h"
#include "allpairs/Error.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "cli/Arguments.h"
#include "cli/ExitStatus.h"
#include "cli/HelpFormatter.h"
#include "cli/Options.h"
#include "cli/Output.h"
#include "cli/ParseArguments.h"
#include "cli/SignalCleanup.h"

namespace {

using allpairs::app::ExitStatus;

constexpr const char* kProgramExamples = R"(Examples:
  allpairs detect scene.scn                      pairs of models that may touch
  allpairs detect boxes.npy -o pairs.npy         overlapping boxes, from NumPy to NumPy
  allpairs detect parts/ --distance 0.5          meshes of a folder, up to 0.5 apart
  allpairs report parts/ -o clashes              a page of clashes with pictures, and BCF
  allpairs view assembly.glb --open              models and pairs in 3D, in the browser
  allpairs info scene.scn                        its models, and what was ignored
  allpairs track frames.npy                      pairs that begin and end as boxes move
  allpairs elements start.ply end.ply            candidates for contact
  allpairs bench uniform -n 100000               time of a search

See 'allpairs help COMMAND'. Exit status: 0 success, 1 --verify found a
difference, 2 usage error, 3 a file cannot be read or written, 4 --fail-on
found what it names, 129, 130 or 143 a signal ended it, 141 nobody reads the
output.)";

/// One line on standard error, whatever the message holds: names of files are the user's, or a stranger's.
void complain(std::string message) {
  for (char& c : message) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (message.ends_with(' ')) message.pop_back();
  message = allpairs::oneLine("allpairs: " + message);
  std::fprintf(stderr, "%s\n", message.c_str());
}

ExitStatus fail(ExitStatus status, const std::string& message) {
  complain(message);
  return status;
}

/// Without any memory for it.
ExitStatus failForMemory() {
  std::fputs("allpairs: not enough memory for this input or its result\n", stderr);
  return ExitStatus::BadInput;
}

std::string chosenCommand(const CLI::App& program) {
  const auto chosen = program.get_subcommands();
  return chosen.empty() ? "allpairs" : "allpairs " + chosen.front()->get_name();
}

/// Runs the command and turns whatever goes wrong into one line and an exit status.
ExitStatus run(CLI::App& program, int count, const char* const* arguments) {
  try {
    const auto print = [](const std::string& text) { allpairs::app::Output(std::nullopt).write(text); };
    allpairs::app::parseArguments(program, allpairs::app::joinNumbers(count, arguments), print);
    return ExitStatus::Success;
  } catch (const allpairs::app::UsageError& problem) {
    return fail(ExitStatus::WrongUsage, std::string(problem.what()) + " (see '" + chosenCommand(program) + " --help')");
  } catch (const allpairs::collision::VerificationError& problem) {
    return fail(ExitStatus::Difference, problem.what());
  } catch (const allpairs::app::Found& found) {
    return fail(ExitStatus::Found, found.what());
  } catch (const allpairs::app::ClosedPipe&) {
    return ExitStatus::ClosedPipe;
  } catch (const std::bad_alloc&) {
    return failForMemory();
  } catch (const std::exception& problem) {
    return fail(ExitStatus::BadInput, problem.what());
  }
}

/// Opens what the program was started without, so that no file gets its number. To read the standard input or to write
/// the standard output is an error then; complaints go nowhere.
void openMissingStandardFiles() {
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(standard, F_GETFD) >= 0) continue;
    const int opened = ::open("/dev/null", standard == STDOUT_FILENO ? O_RDONLY : O_WRONLY);
    if (opened != standard) return;  // the lowest number that is free would be it
  }
}

/// Making the options allocates, too.
int runProgram(int count, char** arguments) {
  CLI::App program("Finds every pair of objects whose bounding boxes touch: exactly, and fast.", "allpairs");
  program.set_version_flag("-V,--version", "allpairs " ALLPAIRS_VERSION, "Print the version and exit");
  program.require_subcommand(1);
  program.formatter(std::make_shared<allpairs::app::HelpFormatter>());
  program.footer(kProgramExamples);
  allpairs::app::addDetect(program);
  allpairs::app::addJoin(program);
  allpairs::app::addPlan(program);
  allpairs::app::addInfo(program);
  allpairs::app::addElements(program);
  allpairs::app::addTrack(program);
  allpairs::app::addView(program);
  allpairs::app::addReport(program);
  allpairs::app::addGenerate(program);
  allpairs::app::addBench(program);
  allpairs::app::addCompletion(program);
  return static_cast<int>(run(program, count, arguments));
}

}  // namespace

namespace allpairs::app {

int runCommandLine(int count, char** arguments) {
  openMissingStandardFiles();
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error of write(), so that temporaries are taken away
  std::signal(SIGXFSZ, SIG_IGN);  // and so is a file that may not grow
  installSignalCleanup();
  try {
    return runProgram(count, arguments);
  } catch (const std::bad_alloc&) {
    return static_cast<int>(failForMemory());
  }
}

}  // namespace allpairs::app
