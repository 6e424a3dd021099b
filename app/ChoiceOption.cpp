// SPDX-License-Identifier: MIT
#include "ChoiceOption.h"

#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>

namespace allpairs::app {

CLI::Option* addChoice(CLI::App& command, const std::string& name, std::string& value,
                       std::vector<std::string> choices) {
  const auto check = [choices = std::move(choices)](const std::string& text) {
    if (std::find(choices.begin(), choices.end(), text) != choices.end()) return std::string();
    return fmt::format("'{}' is none of {}", text, fmt::join(choices, ", "));
  };
  return command.add_option(name, value)->type_name("WORD")->check(check);
}

}  // namespace allpairs::app
