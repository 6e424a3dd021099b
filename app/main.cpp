// SPDX-License-Identifier: MIT
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "Commands.h"
#include "allpairs/Error.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "cli/Arguments.h"
#include "cli/ExitStatus.h"
#include "cli/Output.h"
#include "cli/SignalCleanup.h"

namespace {

using allpairs::app::ExitStatus;

constexpr const char* kProgramExamples = R"(Examples:
  allpairs detect scene.scn                      pairs of models that may touch
  allpairs detect boxes.npy -o pairs.npy         overlapping boxes, from NumPy to NumPy
  allpairs detect parts/ --distance 0.5          meshes of a folder, up to 0.5 apart
  allpairs info scene.scn                        its models, and what was ignored
  allpairs track frames.npy                      pairs that begin and end as boxes move
  allpairs elements start.ply end.ply            candidates for contact
  allpairs bench uniform -n 100000               time of a search

See 'allpairs COMMAND --help'. Exit status: 0 success, 1 --verify found a
difference, 2 usage error, 3 a file cannot be read or written.)";

/// One line on standard error, whatever the message contains: file names may be untrusted.
void complain(std::string message) {
  for (char& c : message) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (message.ends_with(' ')) message.pop_back();
  message = allpairs::oneLine("allpairs: " + message);
  std::fprintf(stderr, "%s\n", message.c_str());
}

/// What CLI11 says of an option that has no value or several, in words: "--distance: D is missing".
std::string countProblem(const CLI::ArgumentMismatch& problem) {
  std::string text = problem.what();
  const std::string option = text.substr(0, text.find(':'));
  if (text.find("At Most") != std::string::npos) return option + " may be given only once";
  constexpr std::string_view kBefore = "1 required ";
  const std::size_t begin = text.find(kBefore);
  const std::size_t end = text.rfind(" missing");
  if (begin == std::string::npos || end == std::string::npos) return text;
  return option + ": " + text.substr(begin + kBefore.size(), end - begin - kBefore.size()) + " is missing";
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

void print(const std::string& text) { allpairs::app::Output(std::nullopt).write(text); }

void parse(CLI::App& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // the order that CLI11 takes
  try {
    program.parse(std::move(reversed));
  } catch (const CLI::CallForHelp&) {
    const auto chosen = program.get_subcommands();
    print(chosen.empty() ? program.help() : chosen.front()->help());
  } catch (const CLI::CallForVersion& version) {
    print(std::string(version.what()) + '\n');
  } catch (const CLI::RequiredError&) {
    const bool hasWord = program.get_subcommands().empty() && !arguments.empty();
    if (hasWord) throw allpairs::app::UsageError("unknown command '" + arguments.front() + "'");
    throw allpairs::app::UsageError(program.get_subcommands().empty() ? "no command given" : "no INPUT given");
  } catch (const CLI::ArgumentMismatch& problem) {
    throw allpairs::app::UsageError(countProblem(problem));
  } catch (const CLI::ParseError& problem) {
    throw allpairs::app::UsageError(problem.what());
  }
}

/// Runs the command and converts every failure to one line and an exit status.
ExitStatus run(CLI::App& program, int count, const char* const* arguments) {
  try {
    parse(program, allpairs::app::joinNumbers(count, arguments));
    return ExitStatus::Success;
  } catch (const allpairs::app::UsageError& problem) {
    return fail(ExitStatus::WrongUsage, std::string(problem.what()) + " (see '" + chosenCommand(program) + " --help')");
  } catch (const allpairs::collision::VerificationError& problem) {
    return fail(ExitStatus::Difference, problem.what());
  } catch (const allpairs::app::ClosedPipe&) {
    return ExitStatus::ClosedPipe;
  } catch (const std::bad_alloc&) {
    return failForMemory();
  } catch (const std::exception& problem) {
    return fail(ExitStatus::BadInput, problem.what());
  }
}

/// Making the options allocates, too.
int runProgram(int count, char** arguments) {
  CLI::App program("Finds every pair of objects whose bounding boxes touch: exactly, and fast.", "allpairs");
  program.set_version_flag("--version", "allpairs " ALLPAIRS_VERSION, "Print the version and exit");
  program.require_subcommand(1);
  program.footer(kProgramExamples);
  allpairs::app::addDetect(program);
  allpairs::app::addInfo(program);
  allpairs::app::addElements(program);
  allpairs::app::addTrack(program);
  allpairs::app::addView(program);
  allpairs::app::addReport(program);
  allpairs::app::addGenerate(program);
  allpairs::app::addBench(program);
  return static_cast<int>(run(program, count, arguments));
}

}  // namespace

int main(int count, char** arguments) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error of write(), so that temporaries are taken away
  std::signal(SIGXFSZ, SIG_IGN);  // and so is a file that may not grow
  allpairs::app::installSignalCleanup();
  try {
    return runProgram(count, arguments);
  } catch (const std::bad_alloc&) {
    return static_cast<int>(failForMemory());
  }
}
