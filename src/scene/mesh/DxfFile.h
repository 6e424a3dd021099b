// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "input/ReadScope.h"
#include "mesh/MeshObject.h"

namespace allpairs::scene {

/// Looks through a DXF file for what Assimp misplaces or leaves out without an error. `warnings` gets the curves that
/// are missing, the blocks of other drawings, and what Assimp reads of the paper space as if it were in the model. Texts
/// and dimensions are not shapes, and blocks without shapes may be anywhere.
///
/// Bad input: throws FileError, with the line, for
///            - blocks that are turned, scaled, repeated, in each other, or inserted by a name in another case,
///            - blocks in which another entity gives Assimp the base or the name of the block,
///            - polylines of several pieces, unless they are polyface meshes that hide no edges,
///            - solids, and
///            - texts that begin with a brace, if shapes follow before Assimp reads on.
/// Reference: AutoCAD DXF Reference, "ENTITIES Section"; Assimp 5.2, DXFLoader.
void checkDxf(const std::filesystem::path& path, const ReadScope& scope, std::vector<FileWarning>& warnings);

}  // namespace allpairs::scene
