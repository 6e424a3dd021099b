// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "allpairs/scene/BoxArray.h"
#include "allpairs/scene/ReadOptions.h"
#include "allpairs/scene/Scene.h"

namespace allpairs::scene {

/// Whether a path is that of a SOFA scene, by its extension: .scn or .xml.
[[nodiscard]] bool isSceneFile(const std::filesystem::path& path);

/// Reads any supported input: a SOFA scene (.scn, .xml), boxes (.npy, .csv), a mesh file, or a folder of mesh files.
///
/// Bad input: throws FileError.
[[nodiscard]] Scene readInput(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads a mesh file: OBJ, PLY, STL, OFF, DXF and glTF, and the formats that Assimp reads.
///
/// Each object, or node with a mesh, is a separate body: a model of its triangles, one of its lines and one of
/// its points, as far as it has them. Models have the name in the file, else that of the file; a repeated name
/// gets a number that makes it none of another: "wheel#2".
/// Bad input: throws FileError; also for a file without geometry.
[[nodiscard]] Scene readMesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads all mesh files of a folder, ordered by name, those of a folder within it at that folder's place if they are
/// asked for (ReadOptions::recursive); all else gives a remark.
///
/// Bad input: a folder without mesh files throws FileError; so does a mesh file that cannot be read, unless
///            options.partial is set.
[[nodiscard]] Scene readMeshFolder(const std::filesystem::path& path, const ReadOptions& options = {});

/// Boxes as collision models, each a separate body.
[[nodiscard]] Scene toScene(const BoxArray& boxes);

}  // namespace allpairs::scene
