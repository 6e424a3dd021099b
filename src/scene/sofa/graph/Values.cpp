// SPDX-License-Identifier: MIT
#include "sofa/graph/Values.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "input/Words.h"

namespace allpairs::scene::sofa {
namespace {

constexpr double kMaxIndex = 1e12;
constexpr double kMaxRange = 50'000'000;  // "0-4000000000" is a mistake, not a list.

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isSign(char c) { return c == '+' || c == '-'; }

/// How much of a word a stream takes for one number.
std::size_t numberLength(std::string_view word) {
  std::size_t i = isSign(word.front()) ? 1 : 0;
  bool hasDot = false, hasExponent = false;
  for (; i < word.size(); ++i) {
    if (isDigit(word[i])) continue;
    if (word[i] == '.' && !hasDot && !hasExponent) {
      hasDot = true;
    } else if ((word[i] == 'e' || word[i] == 'E') && !hasExponent && i > 0) {
      hasExponent = true;
      if (i + 1 < word.size() && isSign(word[i + 1])) ++i;
    } else {
      break;
    }
  }
  return i;
}

bool appendNumber(std::string_view word, std::vector<double>& values) {
  const auto value = parseFinite(word);
  if (value) values.push_back(*value);
  return value.has_value();
}

std::optional<double> parseInteger(std::string_view word, WordEnd end) {
  const auto sign = word.substr(0, !word.empty() && isSign(word[0]) ? 1 : 0);
  const auto* after = std::find_if_not(word.begin() + sign.size(), word.end(), isDigit);
  if (after == word.begin() + sign.size() || (after != word.end() && end == WordEnd::Read)) return std::nullopt;
  return parseFinite({word.begin(), after});
}

struct Range {
  double first = 0;
  double last = 0;
  double step = 0;
};

/// "3-7", or with a step "3-7-2"; against its step a range is read from its end.
std::optional<Range> parseRange(std::string_view word, WordEnd end) {
  const auto dash = word.find('-', 1);
  if (dash == std::string_view::npos) return std::nullopt;
  const auto dash2 = std::min(word.find('-', dash + 2), word.size());
  const auto first = parseInteger(word.substr(0, dash), end);
  const auto last = parseInteger(word.substr(dash + 1, dash2 - dash - 1), end);
  const auto step = dash2 < word.size() ? parseInteger(word.substr(dash2 + 1), end) : 0;
  if (!first || !last || !step) return std::nullopt;
  if (*step == 0) return Range{*first, *last, *first < *last ? 1.0 : -1.0};
  if ((*last - *first) * *step < 0) return Range{*last, *first, *step};
  return Range{*first, *last, *step};
}

bool appendRange(std::string_view word, std::vector<double>& values, ReadScope& scope, WordEnd end) {
  const auto range = parseRange(word, end);
  if (!range || std::abs(range->first) > kMaxIndex || std::abs(range->last) > kMaxIndex) return false;
  const double steps = (range->last - range->first) / range->step;
  if (steps > kMaxRange) return false;
  if (range->step < 0 && steps != std::floor(steps)) return false;  // SOFA's lists and sets end in different ways.
  const auto count = static_cast<std::uint64_t>(steps) + 1;
  if (count > scope.left() / (4 * sizeof(double))) return false;
  scope.takeElements(count, sizeof(double));
  for (std::uint64_t i = 0; i < count; ++i) values.push_back(range->first + static_cast<double>(i) * range->step);
  return true;
}

/// The values of all words, each appended by `append`; nothing, and the word in `bad`, where it returns false.
template <class Append>
std::optional<std::vector<double>> parseWords(std::string_view text, std::string& bad, const Append& append) {
  std::vector<double> values;
  for (auto word = takeWord(text, isBlankOrLineEnd); !word.empty(); word = takeWord(text, isBlankOrLineEnd)) {
    if (append(word, values)) continue;
    bad = word;
    return std::nullopt;
  }
  return values;
}

}  // namespace

Numbers withWidth(const Numbers& numbers, std::size_t width, const std::vector<double>& filler) {
  if (numbers.width == width) return numbers;
  Numbers result{.values = {}, .width = width};
  result.values.reserve(numbers.size() * width);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    for (std::size_t j = 0; j < width; ++j)
      result.values.push_back(j < numbers.width ? numbers.values[i * numbers.width + j]
                                                : (j < filler.size() ? filler[j] : 0.0));
  return result;
}

std::optional<std::vector<double>> parseNumbers(std::string_view text, std::string& bad, const StopFlag* stop) {
  return parseWords(text, bad, [stop](std::string_view word, std::vector<double>& values) {
    checkStop(stop);
    return appendNumber(word, values);
  });
}

std::optional<std::vector<double>> parseNumberStream(std::string_view text, std::string& bad) {
  return parseWords(text, bad, [](std::string_view word, std::vector<double>& values) {
    while (!word.empty()) {
      const auto length = numberLength(word);
      if (!appendNumber(word.substr(0, length), values)) return false;
      word.remove_prefix(length);
    }
    return true;
  });
}

std::optional<std::vector<double>> parseIntegers(std::string_view text, std::string& bad, ReadScope& scope,
                                                 WordEnd end) {
  return parseWords(text, bad, [&](std::string_view word, std::vector<double>& values) {
    if (word.find('-', 1) != std::string_view::npos) return appendRange(word, values, scope, end);
    const auto value = parseInteger(word, end);
    if (value) values.push_back(*value);
    return value.has_value();
  });
}

std::optional<bool> parseBool(std::string_view text) {
  if (text.empty()) return std::nullopt;
  if (text[0] == 'T' || text[0] == 't') return true;
  if (text[0] == 'F' || text[0] == 'f') return false;
  if (text[0] != '-' && (text[0] < '0' || text[0] > '9')) return std::nullopt;
  return std::atoi(std::string{text}.c_str()) != 0;
}

std::optional<double> parseWholeFloat(std::string_view text) {
  while (!text.empty() && isBlankOrLineEnd(text.front())) text.remove_prefix(1);
  const auto value = parseFinite<float>(text);
  return value ? std::optional{static_cast<double>(*value)} : std::nullopt;
}

double leadingNumber(std::string_view text) {
  const auto word = takeWord(text, isBlankOrLineEnd);
  return word.empty() ? 0 : parseFinite(word.substr(0, numberLength(word))).value_or(0);
}

}  // namespace allpairs::scene::sofa
