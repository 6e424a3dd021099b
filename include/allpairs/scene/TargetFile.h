// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace allpairs::scene {

/// The file that a path means in the end, there or not: what is written in its place replaces the target of a link, and
/// the link stays.
[[nodiscard]] std::filesystem::path resolvedTarget(const std::filesystem::path& path);

}  // namespace allpairs::scene
