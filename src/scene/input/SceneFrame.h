// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "allpairs/scene/Scene.h"

namespace allpairs::scene {

/// Takes what a file says of its axes and its unit, where none before it did. Where it says otherwise than those, warns:
/// coordinates are compared as they are.
void noteFrame(Scene& scene, const std::filesystem::path& file, int up, std::optional<double> metresPerUnit);

}  // namespace allpairs::scene
