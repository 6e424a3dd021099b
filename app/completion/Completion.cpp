// SPDX-License-Identifier: MIT
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Commands.h"
#include "allpairs/generate/BoxMotions.h"
#include "allpairs/generate/BoxScenes.h"
#include "cli/Options.h"
#include "cli/Output.h"
#include "completion/Scripts.h"

namespace allpairs::app {
namespace {

constexpr const char* kCompletionExamples =
    R"(Packages install these scripts. Without one:

Examples:
  allpairs completion bash > ~/.local/share/bash-completion/completions/allpairs
  allpairs completion zsh > ~/.zfunc/_allpairs
  allpairs completion fish > ~/.config/fish/completions/allpairs.fish)";

/// What a value may be, by what help calls it: words with a bar between them, FILE, DIR, LAST, which is either.
ValueWords valuesOf(const std::string& type) {
  ValueWords values{.isFile = type == "FILE" || type == "LAST", .isFolder = type == "DIR"};
  if (type.find('|') == std::string::npos) return values;
  for (std::size_t begin = 0; begin <= type.size();) {
    const std::size_t end = std::min(type.find('|', begin), type.size());
    values.choices.push_back(type.substr(begin, end - begin));
    begin = end + 1;
  }
  return values;
}

std::vector<OptionWords> optionsOf(const CLI::App& command) {
  std::vector<OptionWords> options;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) continue;
    OptionWords& words = options.emplace_back(OptionWords{.names = {}, .description = option->get_description()});
    for (const std::string& name : option->get_snames()) words.names.push_back('-' + name);
    for (const std::string& name : option->get_lnames()) words.names.push_back("--" + name);
    if (option->get_type_size() == 0) continue;
    words.value = option->get_type_name();
    words.values = valuesOf(words.value);
  }
  return options;
}

/// What follows a command besides options: words, names of scenes, or files.
ValueWords argumentsOf(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    ValueWords values = valuesOf(option->get_type_name());
    values.isFile = values.choices.empty() && command.get_name() != "generate";
    if (command.get_name() != "generate" && command.get_name() != "bench") return values;
    for (const auto& scene : generate::boxScenes()) values.choices.emplace_back(scene.name);
    if (command.get_name() == "bench") return values;
    for (const auto& motion : generate::boxMotions()) values.choices.emplace_back(motion.name);
    return values;
  }
  return {};
}

ProgramWords wordsOf(const CLI::App& program) {
  ProgramWords words{.name = program.get_name(), .options = optionsOf(program), .commands = {}};
  for (const CLI::App* command : program.get_subcommands({})) {
    words.commands.push_back(
        {command->get_name(), command->get_description(), optionsOf(*command), argumentsOf(*command)});
  }
  return words;
}

std::string scriptFor(const std::string& shell, const ProgramWords& words) {
  if (shell == "zsh") return zshCompletion(words);
  return shell == "fish" ? fishCompletion(words) : bashCompletion(words);
}

}  // namespace

void addCompletion(CLI::App& program) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand("completion", "Print the completion of this command for a shell");
  command->footer(kCompletionExamples);
  addChoice(*command, "SHELL", *shell, {"bash", "zsh", "fish"})->description("The shell")->required();
  command->callback([shell, &program] { Output(std::nullopt).write(scriptFor(*shell, wordsOf(program))); });
}

}  // namespace allpairs::app
