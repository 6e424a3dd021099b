// SPDX-License-Identifier: MIT
#pragma once

#include "Inputs.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace allpairs::app {

/// Declares INPUT..., --partial and --data, which every command that reads has.
void addInputOptions(CLI::App& command, InputSettings& settings);

}  // namespace allpairs::app
