// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace allpairs::scene {

/// Of the kinds of nodes that Assimp leaves out, those of shapes and of groups that hold shapes in this file.
/// Viewpoints, sensors and groups without shapes are not among them.
///
/// Reference: ISO/IEC 19775-1, X3D architecture.
[[nodiscard]] std::set<std::string> x3dNodesOfShapes(const std::filesystem::path& path,
                                                     const std::set<std::string>& kinds);

}  // namespace allpairs::scene
