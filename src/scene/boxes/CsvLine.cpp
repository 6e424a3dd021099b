// SPDX-License-Identifier: MIT
#include "boxes/CsvLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

/// Takes a quoted field from the position of its opening quote; leaves the position at the comma or the end.
std::string takeQuoted(std::string_view line, std::size_t& position, const TextPlace& place) {
  const std::size_t opening = position;
  std::string text;
  for (++position; position < line.size(); ++position) {
    if (line[position] != '"') {
      text += line[position];
    } else if (position + 1 < line.size() && line[position + 1] == '"') {
      text += line[++position];
    } else {
      position = line.find_first_not_of(kBlanks, position + 1);
      if (position == std::string_view::npos) position = line.size();
      if (position == line.size() || line[position] == ',') return text;
      throw FileError(place.file, "text after a closing quote", place.line, position + 1);
    }
  }
  throw FileError(place.file, "a quote is not closed", place.line, opening + 1);
}

CsvField takeField(std::string_view line, std::size_t& position, const TextPlace& place) {
  std::size_t start = line.find_first_not_of(kBlanks, position);
  if (start == std::string_view::npos) start = line.size();
  CsvField field{{}, start + 1};
  if (start < line.size() && line[start] == '"') {
    position = start;
    field.text = takeQuoted(line, position, place);
    return field;
  }
  const std::size_t end = std::min(line.find(',', position), line.size());
  field.text = trimmed(line.substr(position, end - position));
  position = end;
  return field;
}

}  // namespace

std::size_t csvLineEnd(std::string_view text) {
  const std::size_t lineEnd = std::min(text.find('\n'), text.size());
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first != std::string_view::npos && text[first] == '#') return lineEnd;
  for (std::size_t position = 0;; ++position) {
    const std::size_t start = text.find_first_not_of(kBlanks, position);
    if (start != std::string_view::npos && text[start] == '"') {
      position = text.find('"', start + 1);  // two in a row begin another stretch of the same field
      while (position != std::string_view::npos && text.substr(position + 1).starts_with('"')) {
        position = text.find('"', position + 2);
      }
      if (position == std::string_view::npos) return lineEnd;  // not closed, which splitting the line tells
    }
    position = text.find_first_of(",\n", position);
    if (position == std::string_view::npos) return text.size();
    if (text[position] == '\n') return position;
  }
}

void splitCsvLine(std::string_view line, const TextPlace& place, std::vector<CsvField>& fields) {
  fields.clear();
  std::size_t position = 0;
  fields.push_back(takeField(line, position, place));
  while (position < line.size()) fields.push_back(takeField(line, ++position, place));
}

std::string otherSeparator(std::string_view text) {
  constexpr std::array<std::pair<char, const char*>, 3> kSeparators{
      {{';', "semicolons"}, {'\t', "tabs"}, {' ', "spaces"}}};
  for (const auto& [sign, name] : kSeparators) {
    const auto separates = [sign = sign](char c) { return c == sign; };
    std::size_t words = 0;
    std::size_t numbers = 0;
    std::string_view rest = text;
    for (auto word = takeWord(rest, separates); !word.empty(); word = takeWord(rest, separates)) {
      ++words;
      if (parseNumber(trimmed(word))) ++numbers;
    }
    const bool isInNames = sign == ' ';  // part 1 2
    if (isInNames ? numbers >= kCoordinates : words >= kCoordinates || numbers > 1) return name;
  }
  return {};
}

bool isCsvNumber(const CsvField& field) { return parseNumber(field.text).has_value(); }

double csvNumber(const CsvField& field, const TextPlace& place) {
  if (field.text.empty()) throw FileError(place.file, "a number is missing", place.line, field.column);
  const std::optional<double> value = parseNumber(field.text);
  if (!value) {
    const std::string separator = otherSeparator(field.text);
    const std::string hint = separator.empty() ? "" : "; commas separate numbers, not " + separator;
    throw FileError(place.file, "'" + field.text + "' is not a number" + hint, place.line, field.column);
  }
  if (std::isnan(*value)) throw FileError(place.file, "is not a number (NaN)", place.line, field.column);
  if (std::isinf(*value) && field.text.find_first_of("0123456789") != std::string::npos) {
    throw FileError(place.file, field.text + " is too large for a float64", place.line, field.column);
  }
  return *value;
}

}  // namespace allpairs::scene
