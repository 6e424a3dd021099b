// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "allpairs/scene/Scene.h"
#include "detect/Detection.h"

namespace allpairs::app {

/// Why two models of a scene, given by name or by number, are or are not a pair: as the broad phase judges them.
///
/// Bad input: a name that no model has, or several have, throws UsageError.
[[nodiscard]] std::string whyText(scene::Scene& scene, const std::vector<std::string>& models,
                                  const DetectionOptions& options);

}  // namespace allpairs::app
