// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "allpairs/Span.h"

namespace allpairs::scene {

/// The file that a path means in the end, there or not: what is written in its place replaces the target of a link, and
/// the link stays.
///
/// Bad input: links that lead to each other throw FileError.
[[nodiscard]] std::filesystem::path resolvedTarget(const std::filesystem::path& path);

/// Returns when the name that a file has got is on the disk, as far as the file system can say so.
void syncNameOf(const std::filesystem::path& file) noexcept;

/// Makes sure that a result takes the place of none of the files that it is made from.
///
/// Bad input: an output that is one of the inputs, by whatever name, throws FileError.
void checkIsNoInput(const std::filesystem::path& output, Span<const std::filesystem::path> inputs);

}  // namespace allpairs::scene
