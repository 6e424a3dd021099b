// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace allpairs::app {

/// The file that a path means in the end, there or not, so that a link stays a link and its target is replaced.
[[nodiscard]] std::filesystem::path resolvedTarget(const std::filesystem::path& path);

/// The permissions of the file that takes the target's place: those that it has, or those of a new one.
[[nodiscard]] mode_t modeOfTarget(const std::filesystem::path& target);

}  // namespace allpairs::app
