// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace allpairs::app {

/// A text of help in lines of at most so many columns, unless it is so already. Paragraphs are rewrapped; of a line
/// that is indented, what stands behind two blanks is a column of its own, and a command goes on behind a backslash.
[[nodiscard]] std::string filled(std::string_view text, std::size_t width);

/// Help within the width of the terminal.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();

  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_description(const CLI::App* command) const override;
  std::string make_usage(const CLI::App* command, std::string name) const override;
  std::string make_footer(const CLI::App* command) const override;

 private:
  /// In the right column.
  [[nodiscard]] std::string wrappedBesideNames(const std::string& text) const;
  [[nodiscard]] std::string filledToWidth(const std::string& text) const;

  std::optional<std::size_t> m_width;  ///< Of the terminal.
};

}  // namespace allpairs::app
