// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/StopFlag.h"
#include "input/ReadScope.h"

namespace allpairs::scene::sofa {

/// The value of one of a component's data: numbers, and how many of them make one entry.
struct Numbers {
  std::vector<double> values;
  std::size_t width = 1;

  [[nodiscard]] std::size_t size() const { return values.size() / width; }
};

/// The same entries with another number of numbers each: cut, or filled up from `filler` from that place on.
[[nodiscard]] Numbers withWidth(const Numbers& numbers, std::size_t width, const std::vector<double>& filler = {});

/// All numbers in a text; nothing, and the word at fault in `bad`, if there is one that is no finite number. Throws
/// Stopped soon after a flag that is given is set.
[[nodiscard]] std::optional<std::vector<double>> parseNumbers(std::string_view text, std::string& bad,
                                                              const StopFlag* stop = nullptr);

/// As a stream of C++ reads them, which needs no blank before what cannot go on the number before: "0-1" are 0 and -1,
/// "1.5.2" are 1.5 and 0.2. Nothing, and the word at fault in `bad`, as above.
[[nodiscard]] std::optional<std::vector<double>> parseNumberStream(std::string_view text, std::string& bad);

/// What follows the integer that a word starts with, which in groups SOFA does not look at.
enum class WordEnd { Read, Dropped };

/// As the integers of an index list, where "3-6" means 3 4 5 6, "6-3" the other way round, and "3-7-2" 3 5 7.
/// A range that is larger than may be read is no list.
[[nodiscard]] std::optional<std::vector<double>> parseIntegers(std::string_view text, std::string& bad,
                                                               ReadScope& scope, WordEnd end = WordEnd::Read);

/// Yes and no in the ways in which scenes write them.
[[nodiscard]] std::optional<bool> parseBool(std::string_view text);

/// A text that is one float32 from its first character to its last; nothing otherwise.
[[nodiscard]] std::optional<double> parseWholeFloat(std::string_view text);

/// The number that a text begins with, as a stream of C++ reads it; 0 where it begins with none.
[[nodiscard]] double leadingNumber(std::string_view text);

}  // namespace allpairs::scene::sofa
