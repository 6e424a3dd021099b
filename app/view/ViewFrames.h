// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ViewScene.h"
#include "input/Inputs.h"
#include "view/ViewRequest.h"

namespace allpairs::app {

/// Whether one of the inputs is an array of boxes at several times, (t, n, 6).
///
/// Bad input: a malformed array throws FileError.
[[nodiscard]] bool isAnyBoxFrames(const std::vector<std::string>& paths);

/// Boxes or meshes that move, frame by frame, as `track` takes them: one array of boxes (t, n, 6), whose frames the
/// inputs then are; or mesh files, one per frame, whose triangles are the models. Two that share a vertex are never
/// paired.
///
/// Bad input: an array among others, or options that only scenes know, throws UsageError; meshes that are not the first
/// ones moved throw FileError; more than a page holds throws Error as soon as that is known.
[[nodiscard]] view::ViewScene makeViewFrames(const InputSettings& input, const ViewRequest& request);

}  // namespace allpairs::app
