// SPDX-License-Identifier: MIT
#include "CommandLine.h"

#include <fcntl.h>
#include <unistd.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "Commands.h"
#include "allpairs/Error.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "cli/Arguments.h"
#include "cli/ExitStatus.h"
#include "cli/HelpFormatter.h"
#include "cli/Options.h"
#include "cli/Output.h"
#include "cli/SignalCleanup.h"
#include "cli/Suggestion.h"

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
found what it names.)";

/// One line on standard error, whatever the message holds: names of files are the user's, or a stranger's.
void complain(std::string message) {
  for (char& c : message) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (message.ends_with(' ')) message.pop_back();
  message = allpairs::oneLine("allpairs: " + message);
  std::fprintf(stderr, "%s\n", message.c_str());
}

/// What CLI11 says of an option that has no value, too few or too many, in words: "--distance: D is missing".
std::string countProblem(const CLI::ArgumentMismatch& problem) {
  std::string text = problem.what();
  const std::string option = text.substr(0, text.find(':'));
  if (text.find("At Most") != std::string::npos) return option + " may be given only once";
  if (text.find("At least 2") != std::string::npos) return option + " takes two values, and got one";
  constexpr std::string_view kBefore = "1 required ";
  const std::size_t begin = text.find(kBefore);
  const std::size_t end = text.rfind(" missing");
  if (begin == std::string::npos || end == std::string::npos) return text;
  return option + ": " + text.substr(begin + kBefore.size(), end - begin - kBefore.size()) + " is missing";
}

/// What CLI11 says of an argument that is missing: "no INPUT given" for "INPUT is required".
std::string missingProblem(const CLI::RequiredError& problem, const CLI::App& command) {
  std::string text = problem.what();
  const std::size_t end = text.rfind(" is required");
  if (end == std::string::npos) return text;
  const std::string name = text.substr(0, end);
  const std::string place = name == "BOXES" ? allpairs::app::placeOfBoxes(command) : "";
  return "no " + name + " given" + (place.empty() ? "" : "; they " + place);
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

std::vector<std::string> commandNames(const CLI::App& program) {
  std::vector<std::string> names{"help"};
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// What an argument that nothing takes should have been.
std::string describeExtra(const CLI::App& program) {
  const auto chosen = program.get_subcommands();
  const CLI::App& command = chosen.empty() ? program : *chosen.front();
  const std::vector<std::string> extras = program.remaining(true);
  const auto option =
      std::find_if(extras.begin(), extras.end(), [](const auto& extra) { return extra.starts_with('-'); });
  if (option == extras.end())
    return "one argument too many: '" + (extras.empty() ? std::string() : extras.front()) + "'";
  const std::string name = option->substr(0, option->find('='));
  std::vector<std::string> names;
  for (const CLI::Option* known : command.get_options()) {
    for (const std::string& text : known->get_lnames()) names.push_back("--" + text);
    if (names.back() == "--distance") names.emplace_back("--margin");  // its name of before is taken too
  }
  if (std::find(names.begin(), names.end(), name) != names.end())
    return "the option '" + name + "' comes behind '" + command.get_name() + "'";
  std::string hint = allpairs::app::suggestionFor(name, names);
  if (hint.ends_with("--margin?")) hint = allpairs::app::suggestionFor("--distance", names);
  return "unknown option '" + name + "'" + hint;
}

/// CLI11 says "Could not convert: --name = text". All that it converts are numbers, and what a flag is given.
std::string conversionProblem(const CLI::ConversionError& problem, const CLI::App& program) {
  std::string text = problem.what();
  const std::size_t begin = text.find("--");
  const std::size_t value = text.find(" = ", begin);
  if (begin == std::string::npos || value == std::string::npos) return text;
  const std::string name = text.substr(begin, value - begin);
  for (const CLI::App* command : program.get_subcommands()) {
    const CLI::Option* option = command->get_option_no_throw(name);
    if (option != nullptr && option->get_expected_max() == 0) return name + " takes no value";
  }
  return name + ": '" + text.substr(value + 3) + "' is not a number";
}

[[noreturn]] void failForCommand(const CLI::App& program, const std::string& word) {
  const std::string what = word.starts_with('-') ? "a command comes first, not" : "unknown command";
  const std::string suggestion = allpairs::app::suggestionFor(word, commandNames(program));
  throw allpairs::app::UsageError(what + " '" + word + "'" + suggestion);
}

/// `help COMMAND` as `COMMAND --help`.
std::vector<std::string> withoutHelpWord(const CLI::App& program, std::vector<std::string> arguments) {
  if (arguments.empty() || arguments.front() != "help") return arguments;
  arguments.erase(arguments.begin());
  arguments.resize(std::min<std::size_t>(arguments.size(), 1));
  if (!arguments.empty()) {
    const std::vector<std::string> names = commandNames(program);
    const bool isKnown = std::find(names.begin(), names.end(), arguments.front()) != names.end();
    if (!isKnown && !arguments.front().starts_with('-')) failForCommand(program, arguments.front());
    if (arguments.front() == "help") arguments.clear();
  }
  arguments.emplace_back("--help");
  return arguments;
}

void print(const std::string& text) { allpairs::app::Output(std::nullopt).write(text); }

void parse(CLI::App& program, const std::vector<std::string>& given) {
  const std::vector<std::string> arguments = withoutHelpWord(program, given);
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // the order that CLI11 takes
  try {
    program.parse(std::move(reversed));
  } catch (const CLI::CallForHelp&) {
    const auto chosen = program.get_subcommands();
    print(chosen.empty() ? program.help() : chosen.front()->help(program.get_name()));
  } catch (const CLI::CallForVersion& version) {
    print(std::string(version.what()) + '\n');
  } catch (const CLI::RequiredError& problem) {
    const auto chosen = program.get_subcommands();
    if (!chosen.empty()) throw allpairs::app::UsageError(missingProblem(problem, *chosen.front()));
    if (arguments.empty()) {
      print(program.help());
      throw allpairs::app::UsageError("no command given");
    }
    failForCommand(program, arguments.front());
  } catch (const CLI::ExtrasError&) {
    throw allpairs::app::UsageError(describeExtra(program));
  } catch (const CLI::ArgumentMismatch& problem) {
    throw allpairs::app::UsageError(countProblem(problem));
  } catch (const CLI::ConversionError& problem) {
    throw allpairs::app::UsageError(conversionProblem(problem, program));
  } catch (const CLI::ParseError& problem) {
    throw allpairs::app::UsageError(problem.what());
  }
}

/// Runs the command and turns whatever goes wrong into one line and an exit status.
ExitStatus run(CLI::App& program, int count, const char* const* arguments) {
  try {
    parse(program, allpairs::app::joinNumbers(count, arguments));
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
  allpairs::app::refuseEmptyValues(program);
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
