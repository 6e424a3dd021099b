// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace allpairs::scene {

/// The names of what a folder holds, in no order; none where `error` says why it cannot be read.
///
/// Not std::filesystem::directory_iterator, which ends the program where there is no memory: this throws
/// std::bad_alloc.
[[nodiscard]] std::vector<std::string> folderNames(const std::filesystem::path& folder, std::error_code& error);

}  // namespace allpairs::scene
