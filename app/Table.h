// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "allpairs/scene/WriteResult.h"

namespace allpairs::app {

/// What the table says besides the result itself.
struct TableNotes {
  std::string method;         ///< How boxes are compared, in words.
  std::size_t simulated = 0;  ///< How many models are.
  std::size_t remarks = 0;    ///< How much of the input was left out.
};

/// Writes a result for people: what was tested, the first pairs and how many more there are, what it cost.
void writeTable(const scene::ResultView& result, const TableNotes& notes, scene::ByteSink sink);

/// 1234567 as 1,234,567.
[[nodiscard]] std::string grouped(std::uint64_t number);

/// `count` and the noun, in the plural unless it is 1: "3 boxes".
[[nodiscard]] std::string counted(std::uint64_t count, const std::string& noun, const std::string& plural = {});

/// A box as [0, 0, 0] to [1, 1, 1], short enough to read.
[[nodiscard]] std::string boxText(const Box& box);

}  // namespace allpairs::app
