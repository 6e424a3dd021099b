// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "input/ReadScope.h"
#include "mesh/MeshObject.h"

namespace allpairs::scene {

/// Looks through a DXF file for what Assimp puts in wrong places or leaves out without a word. `warnings` says which
/// curves are missing; texts and dimensions are no shapes.
///
/// Bad input: throws FileError, with its line, for blocks that are turned, scaled, repeated or in each other, for
///            polylines that are no polyface meshes or hide edges of their faces, and for solids.
/// Reference: AutoCAD DXF Reference, "ENTITIES Section"; Assimp 5.2, DXFLoader.
void checkDxf(const std::filesystem::path& path, const ReadScope& scope, std::vector<FileWarning>& warnings);

}  // namespace allpairs::scene
