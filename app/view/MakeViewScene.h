// SPDX-License-Identifier: MIT
#pragma once

#include "ViewScene.h"
#include "detect/Detection.h"
#include "input/Inputs.h"

namespace allpairs::app {

/// Reads the inputs, finds their pairs, and puts together all that a page or a report shows of them.
///
/// An array of boxes at several times, (t, n, 6), gives t frames.
[[nodiscard]] view::ViewScene makeViewScene(const InputSettings& input, const DetectionOptions& options);

}  // namespace allpairs::app
