// SPDX-License-Identifier: MIT
#include "cli/ParseArguments.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <string_view>

#include "cli/Arguments.h"
#include "cli/ExitStatus.h"
#include "cli/Suggestion.h"

namespace allpairs::app {
namespace {

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
  const std::string place = name == "BOXES" ? placeOfBoxes(command) : "";
  return "no " + name + " given" + (place.empty() ? "" : "; they " + place);
}

std::vector<std::string> commandNames(const CLI::App& program) {
  std::vector<std::string> names{"help"};
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// What was meant by an option that does not exist. A margin is of one box, so --margin could be either of two.
std::string hintFor(const std::string& name, std::vector<std::string> names) {
  const auto has = [&names](const char* option) {
    return std::find(names.begin(), names.end(), option) != names.end();
  };
  if (!has("--distance")) return suggestionFor(name, names);
  if (name == "--margin" && has("--margins")) return " - did you mean --distance or --margins?";
  names.emplace_back("--margin");
  const std::string hint = suggestionFor(name, names);
  return hint.ends_with("--margin?") ? suggestionFor("--distance", names) : hint;
}

/// What an argument that nothing takes should have been.
std::string describeExtra(const CLI::App& program) {
  const auto chosen = program.get_subcommands();
  const CLI::App& command = chosen.empty() ? program : *chosen.front();
  const std::vector<std::string> extras = program.remaining(true);
  const auto option =
      std::find_if(extras.begin(), extras.end(), [](const auto& extra) { return extra.starts_with('-'); });
  if (option == extras.end())
    return "one argument too many: '" + (extras.empty() ? std::string() : asGiven(extras.front())) + "'";
  const std::string name = option->substr(0, option->find('='));
  std::vector<std::string> names;
  for (const CLI::Option* known : command.get_options()) {
    for (const std::string& text : known->get_lnames()) names.push_back("--" + text);
  }
  if (std::find(names.begin(), names.end(), name) != names.end())
    return "the option '" + name + "' comes behind '" + command.get_name() + "'";
  return "unknown option '" + name + "'" + hintFor(name, names);
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

[[noreturn]] void failForCommand(const CLI::App& program, const std::string& argument) {
  const std::string word = asGiven(argument);
  const std::string what = word.starts_with('-') ? "a command comes first, not" : "unknown command";
  const std::string suggestion = suggestionFor(word, commandNames(program));
  throw UsageError(what + " '" + word + "'" + suggestion);
}

/// A value as it was given. None may be "", as where a variable of a script has no value: an option would be as if it
/// was not given. Nor is an option the file of the one before it, for which CLI11 takes it.
std::string valueOf(const CLI::Option& option, const std::string& text) {
  if (text.empty()) throw UsageError(namesOf(option) + ": the value is empty");
  if (isOfFiles(option) && option.get_type_name() == "FILE" && text.size() > 1 && text.starts_with('-'))
    throw UsageError(namesOf(option) + ": FILE is missing");
  return asGiven(text);
}

void checkValues(CLI::App& program) {
  for (CLI::App* command : program.get_subcommands({})) {
    for (CLI::Option* option : command->get_options()) {
      if (option->get_expected_max() == 0) continue;  // a flag
      option->transform([option](const std::string& text) { return valueOf(*option, text); });
    }
  }
}

/// `help COMMAND` as `COMMAND --help`.
std::vector<std::string> withoutHelpWord(const CLI::App& program, std::vector<std::string> arguments) {
  if (arguments.empty() || arguments.front() != "help") return arguments;
  arguments.erase(arguments.begin());
  if (arguments.size() > 1) throw UsageError("one argument too many: '" + asGiven(arguments[1]) + "'");
  if (!arguments.empty()) {
    const std::vector<std::string> names = commandNames(program);
    const bool isKnown = std::find(names.begin(), names.end(), arguments.front()) != names.end();
    if (!isKnown && !arguments.front().starts_with('-')) failForCommand(program, arguments.front());
    if (arguments.front() == "help") arguments.clear();
  }
  arguments.emplace_back("--help");
  return arguments;
}

}  // namespace

void parseArguments(CLI::App& program, const std::vector<std::string>& given, const Print& print) {
  checkValues(program);
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
    if (!chosen.empty()) throw UsageError(missingProblem(problem, *chosen.front()));
    if (arguments.empty()) {
      print(program.help());
      throw UsageError("no command given");
    }
    failForCommand(program, arguments.front());
  } catch (const CLI::ExtrasError&) {
    throw UsageError(describeExtra(program));
  } catch (const CLI::ArgumentMismatch& problem) {
    throw UsageError(countProblem(problem));
  } catch (const CLI::ConversionError& problem) {
    throw UsageError(conversionProblem(problem, program));
  } catch (const CLI::ParseError& problem) {
    throw UsageError(problem.what());
  }
}

}  // namespace allpairs::app
