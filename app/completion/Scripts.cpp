// SPDX-License-Identifier: MIT
#include "completion/Scripts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>

#include "cli/Text.h"

namespace allpairs::app {
namespace {

std::string joined(const std::vector<std::string>& words, std::string_view between = " ") {
  return fmt::format("{}", fmt::join(words, between));
}

std::vector<std::string> namesOf(const std::vector<OptionWords>& options) {
  std::vector<std::string> names;
  for (const OptionWords& option : options) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

std::vector<std::string> namesOf(const std::vector<CommandWords>& commands) {
  std::vector<std::string> names;
  for (const CommandWords& command : commands) names.push_back(command.name);
  return names;
}

/// The text with a backslash before some characters.
std::string escaped(std::string_view text, std::string_view which) {
  std::string result;
  for (const char c : text) {
    if (which.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

/// What bash is to do with values: a list of words, or one of these two functions of compgen.
std::string bashValues(const ValueWords& values) {
  std::string text;
  if (!values.choices.empty()) text += fmt::format("words='{}'", joined(values.choices));
  if (values.isFile) text += text.empty() ? "files=-f" : " files=-f";
  if (values.isFolder) text += "files=-d";
  return text.empty() ? "return" : text;
}

std::string bashCommand(const CommandWords& command) {
  std::string text = fmt::format("    {})\n      case $previous in\n", command.name);
  for (const OptionWords& option : command.options) {
    if (option.value.empty()) continue;
    text += fmt::format("        {}) {} ;;\n", joined(option.names, " | "), bashValues(option.values));
  }
  text += fmt::format("        *)\n          options='{}'\n", joined(namesOf(command.options)));
  const std::string arguments = bashValues(command.arguments);
  if (arguments != "return") text += "          " + arguments + '\n';
  return text + "          ;;\n      esac\n      ;;\n";
}

/// An option of zsh's _arguments, for one of its names.
std::string zshSpec(const OptionWords& option, const std::string& name) {
  const std::string others = option.names.size() > 1 ? fmt::format("({})", joined(option.names)) : std::string();
  std::string text = others + name;
  if (!option.value.empty() && name.starts_with("--")) text += '=';
  text += fmt::format("[{}]", escaped(option.description, "[]:\\"));
  if (option.value.empty()) return text;
  const std::string action = !option.values.choices.empty() ? fmt::format("({})", joined(option.values.choices))
                             : option.values.isFile         ? "_files"
                             : option.values.isFolder       ? "_files -/"
                                                            : " ";
  const std::string called = option.values.choices.empty() ? option.value : "word";
  return text + fmt::format(":{}:{}", escaped(called, ":\\"), action);
}

std::string zshOptions(const std::vector<OptionWords>& options) {
  std::string text;
  for (const OptionWords& option : options) {
    for (const std::string& name : option.names)
      text += fmt::format(" \\\n        '{}'", betweenQuotes(zshSpec(option, name)));
  }
  return text;
}

std::string zshCommand(const CommandWords& command) {
  std::string text = fmt::format("    {})\n      _arguments{}", command.name, zshOptions(command.options));
  const ValueWords& arguments = command.arguments;
  if (!arguments.choices.empty() && arguments.isFile) {
    text += fmt::format(" \\\n        '*:argument:_alternative \"words:word:({})\" \"files:file:_files\"'",
                        joined(arguments.choices));
  } else if (!arguments.choices.empty()) {
    text += fmt::format(" \\\n        '1:word:({})'", joined(arguments.choices));
  } else if (arguments.isFile) {
    text += " \\\n        '*:file:_files'";
  }
  return text + "\n      ;;\n";
}

std::string fishText(std::string_view text) { return '\'' + escaped(text, "'\\") + '\''; }

std::string fishOption(const OptionWords& option, const std::string& where) {
  std::string text = where;
  for (const std::string& name : option.names)
    text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.value.empty()) {
    if (option.values.isFile) {
      text += " -r -F";
    } else if (option.values.isFolder) {
      text += " -x -a '(__fish_complete_directories)'";
    } else {
      text += " -x";
    }
    if (!option.values.choices.empty()) text += " -a " + fishText(joined(option.values.choices));
  }
  return text + " -d " + fishText(option.description) + '\n';
}

std::string fishCommand(const CommandWords& command, const std::string& program) {
  const std::string where = fmt::format("complete -c {} -n '__fish_seen_subcommand_from {}'", program, command.name);
  std::string text;
  for (const OptionWords& option : command.options) text += fishOption(option, where);
  if (command.arguments.isFile) text += where + " -F\n";
  if (!command.arguments.choices.empty()) text += where + " -a " + fishText(joined(command.arguments.choices)) + '\n';
  return text;
}

}  // namespace

std::string bashCompletion(const ProgramWords& program) {
  std::string text =
      fmt::format("# Completion of the command {0} for bash; made by '{0} completion bash'.\n\n", program.name);
  text += fmt::format("_{}() {{\n", program.name);
  text += "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}\n";
  text += "  local words='' options='' files='' before=''\n  COMPREPLY=()\n  ((COMP_CWORD > 1)) || command=''\n";
  text +=  // --option=value: three words, or one where = does not divide words
      "  if [[ $current == = ]]; then\n    current=''\n  elif [[ $previous == = ]]; then\n"
      "    previous=${COMP_WORDS[COMP_CWORD - 2]}\n  elif [[ $current == --*=* ]]; then\n"
      "    previous=${current%%=*} before=${current%%=*}= current=${current#*=}\n  fi\n  case $command in\n";
  text += fmt::format("    '') words='{} help {}' ;;\n", joined(namesOf(program.commands)),
                      joined(namesOf(program.options)));
  text += fmt::format("    help) words='{}' ;;\n", joined(namesOf(program.commands)));
  for (const CommandWords& command : program.commands) text += bashCommand(command);
  text += "  esac\n  if [[ -n $options && $current == -* ]]; then\n    words=$options files=''\n  fi\n";
  text +=
      "  if [[ -n $words ]]; then\n    mapfile -t COMPREPLY < <(compgen -P \"$before\" -W \"$words\" -- "
      "\"$current\")\n  fi\n";
  text += "  if [[ -n $files ]]; then\n    compopt -o filenames 2>/dev/null\n";
  text +=
      "    mapfile -t -O \"${#COMPREPLY[@]}\" COMPREPLY < <(compgen -P \"$before\" \"$files\" -- \"$current\")\n  "
      "fi\n}\n\n";
  return text + fmt::format("complete -F _{0} {0}\n", program.name);
}

std::string zshCompletion(const ProgramWords& program) {
  std::string text = fmt::format(
      "#compdef {0}\n# Completion of the command {0} for zsh; made by '{0} completion zsh'.\n\n", program.name);
  text += fmt::format("_{}() {{\n  local -a commands\n  commands=(\n", program.name);
  for (const CommandWords& command : program.commands)
    text += fmt::format("    '{}:{}'\n", command.name, betweenQuotes(escaped(command.description, ":\\")));
  text +=
      "    'help:Print the help of a command'\n  )\n  if ((CURRENT == 2)); then\n    if [[ $words[2] == -* ]]; then\n";
  text += fmt::format("      _arguments{}\n    else\n", zshOptions(program.options));
  text += "      _describe command commands\n    fi\n    return\n  fi\n";
  text += "  local command=$words[2]\n  shift words\n  ((CURRENT -= 1))\n  case $command in\n";
  text += "    help) _describe command commands ;;\n";
  for (const CommandWords& command : program.commands) text += zshCommand(command);
  return text + fmt::format("  esac\n}}\n\n_{} \"$@\"\n", program.name);
}

std::string fishCompletion(const ProgramWords& program) {
  const std::string begin = fmt::format("complete -c {}", program.name);
  std::string text = fmt::format("# Completion of the command {0} for fish; made by '{0} completion fish'.\n\n{1} -f\n",
                                 program.name, begin);
  for (const OptionWords& option : program.options) text += fishOption(option, begin + " -n __fish_use_subcommand");
  for (const CommandWords& command : program.commands) {
    text +=
        fmt::format("{} -n __fish_use_subcommand -a {} -d {}\n", begin, command.name, fishText(command.description));
  }
  text += begin + " -n __fish_use_subcommand -a help -d 'Print the help of a command'\n";
  text += fmt::format("{} -n '__fish_seen_subcommand_from help' -a '{}'\n", begin, joined(namesOf(program.commands)));
  for (const CommandWords& command : program.commands) text += fishCommand(command, program.name);
  return text;
}

}  // namespace allpairs::app
