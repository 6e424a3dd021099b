// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "allpairs/scene/EmptyBoxes.h"
#include "cli/Arguments.h"

namespace allpairs::app {

/// Says on standard error, in a line that names the program, where the result may not be what is expected.
void warn(const std::string& text, const char* program = "allpairs");

/// What to say of boxes of one or two sets that are empty; of a set of one file with its name.
[[nodiscard]] std::vector<std::string> emptyTexts(const BoxSetArguments& sets,
                                                  const std::array<scene::EmptyBoxes, 2>& empty);

}  // namespace allpairs::app
