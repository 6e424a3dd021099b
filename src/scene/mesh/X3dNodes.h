// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace allpairs::scene {

/// Those of some kinds of nodes, which Assimp leaves out, that are shapes, or in the file hold some: not viewpoints,
/// sensors and the like, nor groups without shapes.
///
/// Reference: ISO/IEC 19775-1, X3D architecture.
[[nodiscard]] std::set<std::string> x3dNodesOfShapes(const std::filesystem::path& path,
                                                     const std::set<std::string>& kinds);

}  // namespace allpairs::scene
