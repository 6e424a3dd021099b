// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "input/ReadScope.h"

namespace allpairs::scene {

/// How long the unit of an AMF file is in metres, which Assimp does not tell; 0 where it is none of the format.
///
/// Bad input: throws FileError for constellations, whose objects Assimp puts in wrong places without a word.
/// Reference: ISO/ASTM 52915, Additive manufacturing file format.
[[nodiscard]] double checkedAmfUnit(const std::filesystem::path& path, const ReadScope& scope);

}  // namespace allpairs::scene
