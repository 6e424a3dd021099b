// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace allpairs::app {

/// How many columns a terminal has; nothing where the descriptor is none or it does not say.
[[nodiscard]] std::optional<std::size_t> terminalWidth(int descriptor);

/// Says on standard output, if that is a terminal, what was written where: "3 clashes → r/index.html".
void sayWritten(const std::string& what, const std::filesystem::path& file);

/// Whether text is coloured, by --color's word: "always", "never", or else on a terminal, unless NO_COLOR is set or
/// TERM is dumb.
[[nodiscard]] bool wantsColour(std::string_view word, bool isTerminal);

/// About how many columns UTF-8 takes: one for each character.
[[nodiscard]] std::size_t columnsOf(std::string_view text);

/// The text, or where it is wider its begin and its end: names often differ only there.
[[nodiscard]] std::string elided(const std::string& text, std::size_t width);

/// The text with spaces behind it up to a width.
[[nodiscard]] std::string padded(const std::string& text, std::size_t width);

/// The text in lines of at most so many columns, broken at blanks.
[[nodiscard]] std::string wrapped(std::string_view text, std::size_t width);

}  // namespace allpairs::app
