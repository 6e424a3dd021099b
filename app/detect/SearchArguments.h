// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "cli/Options.h"
#include "detect/Detection.h"

namespace allpairs::app {

/// Which pairs to look for, as the command line says: what detect, view and report have in common.
struct SearchArguments {
  std::optional<std::string> distance;
  std::optional<std::string> box;
  std::optional<std::string> clearance;
};

/// Declares --distance, --box and --clearance.
void addSearchOptions(CLI::App& command, SearchArguments& arguments);

/// Bad input: UsageError if the distance is not a number or the box is not a region.
[[nodiscard]] DetectionOptions detectionOptions(const SearchArguments& arguments);

}  // namespace allpairs::app
