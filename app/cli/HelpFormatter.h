// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstddef>
#include <limits>
#include <string>

namespace allpairs::app {

/// Help within the width of the terminal: what options and commands do is broken into lines.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();

  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;

 private:
  std::size_t m_width = std::numeric_limits<std::size_t>::max();  ///< Of the right column.
};

}  // namespace allpairs::app
