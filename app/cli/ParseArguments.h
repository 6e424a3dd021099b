// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <vector>

namespace allpairs::app {

/// Where help and the version go.
using Print = std::function<void(const std::string&)>;

/// Reads the arguments behind the name of the program, which runs the command that they name; `help COMMAND` is
/// `COMMAND --help`. Throws UsageError, in this project's words and not in those of CLI11, of what it can't take.
void parseArguments(CLI::App& program, const std::vector<std::string>& given, const Print& print);

}  // namespace allpairs::app
