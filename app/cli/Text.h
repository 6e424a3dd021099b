// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "allpairs/Box.h"
#include "allpairs/Error.h"

namespace allpairs::app {

using allpairs::grouped;

/// `count` and the noun, in the plural unless it is 1: "3 boxes".
[[nodiscard]] std::string counted(std::uint64_t count, const std::string& noun, const std::string& plural = {});

/// A size: "1,234 MiB".
[[nodiscard]] std::string mebibytes(std::uint64_t bytes);

/// The boxes of two sets: "400 and 300 boxes".
[[nodiscard]] std::string countedBoxes(std::uint64_t first, std::uint64_t second);

/// The text with its control characters written as \x1b, so that a terminal shows them and does not obey them.
[[nodiscard]] std::string printable(const std::string& text);

/// The text as it has to stand between single quotes in a shell of Bourne's kind.
[[nodiscard]] std::string betweenQuotes(std::string_view text);

/// The text as one word of a shell's command line: quoted where it contains spaces or other special characters; a file
/// such as -x as ./-x, which is no option.
[[nodiscard]] std::string shellWord(const std::string& text);

/// A coordinate with six digits, or with as many as it takes to tell hundredths apart.
[[nodiscard]] std::string coordinateText(double value);

/// A box as [0, 0, 0] to [1, 1, 1], short enough to read.
[[nodiscard]] std::string boxText(const Box& box);

/// The number that is all of the text, in the form of std::from_chars; none where it is too large, too.
template <class Number>
[[nodiscard]] std::optional<Number> numberOf(std::string_view text) {
  Number value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The end of a file's name from its last dot, in lower case; empty where there is none.
[[nodiscard]] std::string lowerExtension(const std::string& path);

}  // namespace allpairs::app
