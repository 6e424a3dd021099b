// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "allpairs/scene/ReadOptions.h"
#include "allpairs/scene/Scene.h"

namespace allpairs::scene {

/// Reads the collision models of a SOFA scene (.scn, .xml) and its intersection method.
///
/// Bad input: a file that is missing or malformed throws FileError with its line and column; so does an unsupported
///            component that a collision model's position depends on, unless options.partial is set.
[[nodiscard]] Scene readSofaScene(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace allpairs::scene
