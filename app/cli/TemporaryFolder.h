// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace allpairs::app {

/// The folder for temporary files: what TMPDIR names, else the system's.
///
/// Bad input: one that is none throws FileError, which says what named it.
[[nodiscard]] std::filesystem::path temporaryFolder();

}  // namespace allpairs::app
