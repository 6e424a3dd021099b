// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "input/ReadScope.h"
#include "mesh/MeshObject.h"

namespace allpairs::scene {

/// Looks through a DXF file for what Assimp puts in wrong places or leaves out without a word. `warnings` says which
/// curves are missing, which blocks are of other drawings, and what of the paper space Assimp takes for the model; texts
/// and dimensions are no shapes, and blocks without shapes may be in any place.
///
/// Bad input: throws FileError, with its line, for blocks that are turned, scaled, repeated or in each other, that are
///            inserted by a name in another case, or in which another entity gives Assimp their base or name; for
///            polylines of several pieces that are no polyface meshes or hide edges of their faces; for solids; and for
///            texts that begin with a brace, behind which Assimp reads nothing for a while, where shapes are there.
/// Reference: AutoCAD DXF Reference, "ENTITIES Section"; Assimp 5.2, DXFLoader.
void checkDxf(const std::filesystem::path& path, const ReadScope& scope, std::vector<FileWarning>& warnings);

}  // namespace allpairs::scene
