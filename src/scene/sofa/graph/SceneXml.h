// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "input/ReadScope.h"
#include "sofa/graph/SceneGraph.h"

namespace allpairs::scene::sofa {

/// The tree of nodes and components that a scene file describes, its includes put in, no value looked at yet.
///
/// Bad input: a file that is missing, not well formed, that includes itself, nests nodes without end or has more
///            elements than any scene throws FileError with the line.
[[nodiscard]] std::unique_ptr<Node> readSceneGraph(const std::filesystem::path& path, ReadScope& scope);

}  // namespace allpairs::scene::sofa
