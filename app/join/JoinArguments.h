// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "allpairs/join/Join.h"
#include "cli/Arguments.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace allpairs::app {

/// What join and plan have in common.
struct JoinArguments {
  BoxSetArguments sets;
  std::string memory;
  std::string distance;
};

/// Declares BOXES..., --with, --memory, --distance, and what addBoxValues() declares.
void addJoinArguments(CLI::App& command, JoinArguments& arguments);

/// Bad input: throws UsageError.
[[nodiscard]] join::JoinOptions joinOptions(const JoinArguments& arguments);

/// What --threads says; null for one.
[[nodiscard]] std::unique_ptr<Executor> executorOf(const std::string& threads);

/// Warns of boxes that are empty, if there are any.
void warnOfEmpty(const JoinArguments& arguments, const std::array<scene::EmptyBoxes, 2>& empty);

}  // namespace allpairs::app
