// SPDX-License-Identifier: MIT
#include "cli/HelpFormatter.h"

#include <unistd.h>

#include <CLI/StringTools.hpp>
#include <algorithm>
#include <optional>
#include <sstream>

#include "cli/Terminal.h"

namespace allpairs::app {

HelpFormatter::HelpFormatter() {
  constexpr std::size_t kLeast = 24;  // below it, a line has no room for words
  const std::optional<std::size_t> width = terminalWidth(STDOUT_FILENO);
  if (width) m_width = std::max(kLeast, *width - std::min(*width, column_width_));
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return wrapped(CLI::Formatter::make_option_desc(option), m_width);
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  std::ostringstream text;
  CLI::detail::format_help(text, command->get_name(), wrapped(command->get_description(), m_width), column_width_);
  return text.str();
}

}  // namespace allpairs::app
