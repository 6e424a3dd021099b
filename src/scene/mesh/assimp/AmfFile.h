// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace allpairs::scene {

/// How long the unit of an AMF file is in metres, which Assimp does not tell; 0 where it is none of the format.
///
/// Bad input: throws FileError for constellations that move, turn or scale objects, which Assimp puts in wrong places
///            without an error. Assimp refuses what is not XML. Call it in Assimp's process, whose memory is bounded.
/// Reference: ISO/ASTM 52915, Additive manufacturing file format.
[[nodiscard]] double checkedAmfUnit(const std::filesystem::path& path);

}  // namespace allpairs::scene
