// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
class Option;
}  // namespace CLI

namespace allpairs::app {

/// Declares an option whose value is one of a few words.
CLI::Option* addChoice(CLI::App& command, const std::string& name, std::string& value,
                       std::vector<std::string> choices);

}  // namespace allpairs::app
