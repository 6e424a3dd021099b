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
  std::optional<std::string> leastDepth;
};

/// Declares --distance, --box, --clearance and --min-depth.
void addSearchOptions(CLI::App& command, SearchArguments& arguments);

/// Bad input: UsageError if the distance is not a number or the box is not a region.
[[nodiscard]] DetectionOptions detectionOptions(const SearchArguments& arguments);

}  // namespace allpairs::app
