// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace allpairs::scene {

/// What separates words within a line; the end of a line from another system counts as one.
inline constexpr std::string_view kBlanks = " \t\r\f\v";

/// Whether it is one of kBlanks.
[[nodiscard]] constexpr bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r' && c != '\n'); }

/// What separates words where lines mean nothing.
[[nodiscard]] constexpr bool isBlankOrLineEnd(char c) { return isBlank(c) || c == '\n'; }

[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

/// Without the digits at its end.
[[nodiscard]] inline std::string_view withoutDigits(std::string_view text) {
  while (!text.empty() && text.back() >= '0' && text.back() <= '9') text.remove_suffix(1);
  return text;
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

[[nodiscard]] inline bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

[[nodiscard]] inline std::string lowerCase(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return result;
}

/// Takes the first word off the text; empty where there is none. `isBlank` says what separates words.
template <class IsBlank>
[[nodiscard]] std::string_view takeWord(std::string_view& text, const IsBlank& isBlank) {
  const auto begin = std::find_if_not(text.begin(), text.end(), isBlank);
  const auto end = std::find_if(begin, text.end(), isBlank);
  const std::string_view word(begin, end);
  text = std::string_view(end, text.end());
  return word;
}

/// The same within a line, whose blanks at its end it takes too.
[[nodiscard]] inline std::string_view takeWord(std::string_view& line) {
  line = trimmed(line);
  return takeWord(line, isBlank);
}

/// Parses a text that is one number from its first character to its last, in the form of std::from_chars. Returns no
/// error, or result_out_of_range, or invalid_argument for all else.
template <class Number>
[[nodiscard]] std::errc parseWhole(std::string_view text, Number& value) {
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  return end == text.data() + text.size() ? problem : std::errc::invalid_argument;
}

/// Whether a number that std::from_chars finds out of range is so because it is near zero. std::strtod would tell, but in
/// the locale of the program, in which a point may mean nothing.
[[nodiscard]] inline bool isNearZero(std::string_view number) {
  const std::size_t end = std::min(number.find_first_of("eE"), number.size());
  const std::string_view digits = number.substr(0, end);
  std::string_view power = number.substr(std::min(end + 1, number.size()));
  if (power.starts_with('+')) power.remove_prefix(1);
  std::int32_t exponent = 0;
  if (parseWhole(power, exponent) == std::errc::result_out_of_range) return power.starts_with('-');
  const auto point = static_cast<std::int64_t>(std::min(digits.find('.'), digits.size()));
  const auto first = static_cast<std::int64_t>(std::min(digits.find_first_of("123456789"), digits.size()));
  return exponent + point - first < 0;
}

/// The number that is all of the text, in any form that C knows but hexadecimal; NaN and infinities included. What is
/// too small for the type is 0, what is too large an infinity.
template <class Number = double>
[[nodiscard]] std::optional<Number> parseNumber(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  Number value{};
  const std::errc problem = parseWhole(text, value);
  if (problem == std::errc::invalid_argument) return std::nullopt;
  if (problem == std::errc::result_out_of_range) {  // which leaves the value alone
    value = isNearZero(text) ? Number{} : std::numeric_limits<Number>::infinity();
    if (text.starts_with('-')) value = -value;
  }
  return value;
}

/// The same for finite numbers only.
template <class Number = double>
[[nodiscard]] std::optional<Number> parseFinite(std::string_view text) {
  const auto value = parseNumber<Number>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// The first of some names, in quotes, and how many others there are.
[[nodiscard]] inline std::string firstOf(const std::vector<std::string>& names) {
  constexpr std::size_t kNamed = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i) text += (i == 0 ? "'" : ", '") + names[i] + '\'';
  return names.size() > kNamed ? text + " and " + std::to_string(names.size() - kNamed) + " more" : text;
}

/// All words of a text in which lines mean nothing. A stream would end early where there is no memory for one.
[[nodiscard]] inline std::vector<std::string> allWords(std::string_view text) {
  std::vector<std::string> words;
  for (auto word = takeWord(text, isBlankOrLineEnd); !word.empty(); word = takeWord(text, isBlankOrLineEnd))
    words.emplace_back(word);
  return words;
}

}  // namespace allpairs::scene
