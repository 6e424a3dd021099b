// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ViewScene.h"
#include "allpairs/BoxView.h"
#include "cli/Options.h"
#include "detect/Detection.h"

namespace allpairs::app {

/// What the user calls the inputs, all together: the names of up to three, or how many.
[[nodiscard]] std::string titleOf(const InputSettings& input);

/// Gives a scene the columns of that many boxes, which have neither flags nor groups.
void addBoxColumns(std::size_t count, view::ViewScene& to);

/// Boxes at one moment, without pairs.
[[nodiscard]] view::ViewFrame boxFrame(const BoxView& boxes, const DetectionOptions& options);

}  // namespace allpairs::app
