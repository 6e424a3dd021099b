// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace allpairs::app {

/// Declares -o FILE; `path` stays empty where it isn't given.
void addOutputOption(CLI::App& command, std::string& path);

/// The end of a file's name from its last dot, in lower case; empty where there is none.
[[nodiscard]] std::string lowerExtension(const std::string& path);

}  // namespace allpairs::app
