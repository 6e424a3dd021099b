// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <filesystem>

namespace allpairs::app {

/// The permissions of the file that takes the target's place: those that it has, or those of a new one.
[[nodiscard]] mode_t modeOfTarget(const std::filesystem::path& target);

}  // namespace allpairs::app
