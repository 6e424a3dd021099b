// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "Detection.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace allpairs::app {

/// Which pairs to look for, as the command line says: what `view` and `report` have of the options of `detect`.
struct SearchArguments {
  std::string margin;
  std::string box;
};

/// Adds --margin and --box.
void addSearchOptions(CLI::App& command, SearchArguments& arguments);

/// Bad input: a margin that is no number or a box that is no region throws UsageError.
[[nodiscard]] DetectionOptions detectionOptions(const SearchArguments& arguments);

}  // namespace allpairs::app
