// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "allpairs/scene/WriteResult.h"

namespace allpairs::app {

/// What the table says besides the result itself.
struct TableNotes {
  std::string method{};                ///< How models are tested, in words.
  std::size_t simulated = 0;           ///< How many models are.
  std::size_t remarkCount = 0;         ///< How much of the input was left out.
  std::optional<std::size_t> width{};  ///< Of the terminal: names are shortened in the middle to stay within it.
  bool isColoured = false;
  bool isPartial = false;  ///< Whether --partial was given, which info needs then too.
};

inline constexpr std::size_t kPairsShown = 50;  ///< A screenful.
inline constexpr std::size_t kLeastName = 12;   ///< Less says nothing, and a line that wraps is better.
inline constexpr std::size_t kNameWidth = 48;   ///< Wider names push what follows aside rather than every line.

/// The line of a table that says that an exhaustive search agrees.
inline constexpr const char* kVerifiedLine =
    "verify   the exhaustive strategy gives the same pairs in the same order\n";

/// The line that says how many pairs a table leaves out; empty for none.
[[nodiscard]] std::string moreLine(std::size_t left);

/// How wide each of two names may be beside so many other columns.
[[nodiscard]] std::size_t mostOfName(const TableNotes& notes, std::size_t others);

/// What stands above and below the pairs of a table; where shapes were looked at too, with how long that took.
[[nodiscard]] std::string tableHead(const scene::ResultView& result, const TableNotes& notes);
[[nodiscard]] std::string tableFoot(const scene::ResultView& result, std::optional<double> exactSeconds = {});

/// Writes a result for people: what was tested, the first pairs and how many more there are, what it cost.
void writeTable(const scene::ResultView& result, const TableNotes& notes, scene::ByteSink sink);

}  // namespace allpairs::app
