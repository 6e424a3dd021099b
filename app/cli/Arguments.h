// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/Box.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace allpairs::app {

/// The arguments as the parser needs them: an option that takes numbers is joined with its value, which may begin with
/// a minus and would otherwise be taken for an option. What follows "--" are paths.
[[nodiscard]] std::vector<std::string> joinNumbers(int count, const char* const* arguments);

/// The number that follows --distance.
///
/// Bad input: anything but a number, NaN and -infinity throw UsageError.
[[nodiscard]] double parseDistance(const std::string& text);

/// The number that follows --clearance.
///
/// Bad input: anything but a finite number that is not negative throws UsageError.
[[nodiscard]] double parseClearance(const std::string& text);

/// The number that follows --threads.
///
/// Bad input: throws UsageError.
[[nodiscard]] std::size_t parseThreads(const std::string& text);

/// The bytes that follow an option such as --max-memory: a whole number above 0, with K, M, G or T behind it for powers of 1024.
///
/// Bad input: throws UsageError.
[[nodiscard]] std::uint64_t parseMemory(const std::string& option, const std::string& text);

/// Declares BOXES... and --with FILE..., the files of one or two sets of boxes.
///
/// Bad input: BOXES after --with, which takes all files that follow it, throw UsageError when the command is parsed.
void addBoxSets(CLI::App& command, std::vector<std::string>& boxes, std::vector<std::string>& with);

/// The region that follows --box: x0,y0,z0,x1,y1,z1 with min < max on every axis.
///
/// Bad input: throws UsageError.
[[nodiscard]] Box parseRegion(const std::string& text);

}  // namespace allpairs::app
