// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace allpairs::scene {

/// What separates words within a line; the end of a line from another system counts as one.
inline constexpr std::string_view kBlanks = " \t\r\f\v";

/// What separates words where lines mean nothing.
inline constexpr std::string_view kBlanksAndLineEnds = " \t\r\f\v\n";

[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Takes the first line off the text, without its end.
[[nodiscard]] inline std::string_view takeLine(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(line.size() == text.size() ? line.size() : line.size() + 1);
  return line;
}

/// As much of a word at fault as a message repeats.
[[nodiscard]] inline std::string shortWord(std::string_view word) {
  constexpr std::size_t kRepeated = 40;
  return std::string(word.substr(0, kRepeated));
}

[[nodiscard]] inline std::string quotedWord(std::string_view word) { return "'" + shortWord(word) + "'"; }

[[nodiscard]] inline std::string lowerCase(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

/// Takes the first word off the text; empty at its end.
[[nodiscard]] inline std::string_view takeWord(std::string_view& text) {
  text = trimmed(text);
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

/// The number that is all of the text, in any form that C knows but hexadecimal; NaN and infinities included.
[[nodiscard]] inline std::optional<double> parseNumber(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || problem == std::errc::invalid_argument) return std::nullopt;
  // from_chars leaves the value alone where it is too large or too small for a double.
  if (problem == std::errc::result_out_of_range) return std::strtod(std::string(text).c_str(), nullptr);
  return value;
}

}  // namespace allpairs::scene
