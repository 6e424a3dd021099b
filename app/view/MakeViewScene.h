// SPDX-License-Identifier: MIT
#pragma once

#include "ViewScene.h"
#include "input/Inputs.h"
#include "view/ViewRequest.h"

namespace allpairs::app {

/// Reads the inputs, finds their pairs, and puts together all that a page or a report shows of them.
///
/// An array of boxes at several times, (t, n, 6), gives t frames. Where shapes cannot be tested because this program
/// was built without the library for it, and nobody insists, its method says so.
///
/// Bad input: shapes of boxes at several times throw UsageError.
[[nodiscard]] view::ViewScene makeViewScene(const InputSettings& input, const ViewRequest& request);

}  // namespace allpairs::app
