// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/scene/BoxArray.h"
#include "input/ReadScope.h"

namespace allpairs::scene {

/// Numbers of a box.
inline constexpr std::size_t kCoordinates = 6;

/// Boxes of a text file, within what may be taken.
[[nodiscard]] BoxArray readCsv(const std::filesystem::path& path, ReadScope& scope);

/// Where in a text file something stands; both count from 1, columns in bytes.
struct TextPlace {
  const std::filesystem::path& file;
  std::size_t line = 0;
};

/// One field of a line: its text without surrounding blanks and quotes, and its column.
struct CsvField {
  std::string text;
  std::size_t column = 0;
};

/// Where the first line of a text ends: at a line break that is in no quotes, or at the end of the text.
[[nodiscard]] std::size_t csvLineEnd(std::string_view text);

/// Splits a line at its commas; a field in double quotes may hold commas, and "" stands for one quote.
///
/// Bad input: a quote that isn't closed, or text behind one, throws FileError.
void splitCsvLine(std::string_view line, const TextPlace& place, std::vector<CsvField>& fields);

/// The number that a field holds, infinities included.
///
/// Bad input: an empty field, NaN, or anything that isn't one number throws FileError.
[[nodiscard]] double csvNumber(const CsvField& field, const TextPlace& place);

/// What separates numbers in a text where commas should: "semicolons", "tabs" or "spaces"; empty where nothing does.
[[nodiscard]] std::string otherSeparator(std::string_view text);

/// Whether the field holds a number, NaN included.
[[nodiscard]] bool isCsvNumber(const CsvField& field);

}  // namespace allpairs::scene
